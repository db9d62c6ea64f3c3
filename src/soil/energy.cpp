#include "soil/energy.hpp"

#include "soil/point_group.hpp"

namespace mudlark {

template <int D>
double internal_work(const SoilParticles<D>& points, PointRange range, const PointMotion& motion,
                     double dt, bool pore_water) {
  TensorValue work{};
  for_each_group(range, [&](const PointGroup& group) {
    const std::size_t k = group.first - range.first;
    const MatrixLanes g = group.gradient<D>(motion.gradient.data(), range);
    const auto stress = [&](int c) { return group.get(points.stress[c]); };
    TensorValue density = stress(0) * g[0] + stress(2) * g[8] + stress(5) * (g[2] + g[6]);
    if constexpr (D == 3)
      density += stress(1) * g[4] + stress(3) * (g[1] + g[3]) + stress(4) * (g[5] + g[7]);
    if (pore_water)
      density -=
          dt * group.get(points.pore_pressure) * group.get(motion.flux_divergence.data() + k);
    const TensorValue part = group.get(points.volume) * density;
    for (std::size_t i = 0; i < group.live; ++i) work[i] += part[i];
  });
  double sum = 0.0;
  for (std::size_t i = 0; i < tensor_lanes; ++i) sum += work[i];
  return sum;
}

template double internal_work(const SoilParticles<2>&, PointRange, const PointMotion&, double,
                              bool);
template double internal_work(const SoilParticles<3>&, PointRange, const PointMotion&, double,
                              bool);

}  // namespace mudlark
