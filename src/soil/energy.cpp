#include "soil/energy.hpp"

namespace mudlark {

template <int D>
double internal_work(const SoilParticles<D>& points, const PointMotion& motion, double dt,
                     bool pore_water) {
  double work = 0.0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double* g = motion.gradient.data() + p * D * D;
    double density;
    if constexpr (D == 2) {
      density = points.stress[0][p] * g[0] + points.stress[2][p] * g[3] +
                points.stress[5][p] * (g[1] + g[2]);
    } else {
      density = points.stress[0][p] * g[0] + points.stress[1][p] * g[4] +
                points.stress[2][p] * g[8] + points.stress[3][p] * (g[1] + g[3]) +
                points.stress[4][p] * (g[5] + g[7]) + points.stress[5][p] * (g[2] + g[6]);
    }
    if (pore_water) density -= dt * points.pore_pressure[p] * motion.flux_divergence[p];
    work += points.volume[p] * density;
  }
  return work;
}

template double internal_work(const SoilParticles<2>&, const PointMotion&, double, bool);
template double internal_work(const SoilParticles<3>&, const PointMotion&, double, bool);

}  // namespace mudlark
