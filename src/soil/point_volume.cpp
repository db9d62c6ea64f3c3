#include "soil/point_volume.hpp"

#include "soil/point_group.hpp"

namespace mudlark {

template <int D>
std::size_t update_volumes(const PointMotion& motion, const BodyConstants& body,
                           double water_bulk_modulus, double dt, PointRange range,
                           SoilParticles<D>& points) {
  std::size_t without_pores = 0;
  for_each_group(range, [&](const PointGroup& group) {
    const std::size_t k = group.first - range.first;
    MatrixLanes g = group.gradient<D>(motion.gradient.data(), range);
    for (const std::size_t i : {0u, 4u, 8u}) g[i] += 1.0;
    TensorValue stretch;
    if constexpr (D == 2)
      stretch = g[0] * g[8] - g[2] * g[6];
    else
      stretch = g[0] * (g[4] * g[8] - g[5] * g[7]) - g[1] * (g[3] * g[8] - g[5] * g[6]) +
                g[2] * (g[3] * g[7] - g[4] * g[6]);
    const TensorValue volume = group.get(points.volume) * stretch;
    group.set(volume, points.volume);
    if (body.water_density == 0.0) return;
    const TensorValue porosity = 1.0 - group.get(points.grain_mass) / (body.grain_density * volume);
    const TensorValue rise =
        motion.pressure_rise.empty()
            ? -dt * water_bulk_modulus / porosity * group.get(motion.flux_divergence.data() + k)
            : group.get(motion.pressure_rise.data() + k);
    group.set(group.get(points.pore_pressure) + rise, points.pore_pressure);
    for (std::size_t i = 0; i < group.live; ++i)
      if (!(porosity[i] > 0.0)) ++without_pores;
  });
  return without_pores;
}

template std::size_t update_volumes(const PointMotion&, const BodyConstants&, double, double,
                                    PointRange, SoilParticles<2>&);
template std::size_t update_volumes(const PointMotion&, const BodyConstants&, double, double,
                                    PointRange, SoilParticles<3>&);

}  // namespace mudlark
