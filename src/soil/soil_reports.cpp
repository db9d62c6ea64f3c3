/// What the soil solver says of itself: sums over all points, and the point that went wrong.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "parallel/collective_error.hpp"
#include "soil/exact_sum.hpp"
#include "soil/point_report.hpp"
#include "soil/regime.hpp"
#include "soil/soil_solver.hpp"

namespace mudlark {

/// Adds the work of the open outer step and what left in it, once per step whoever asks, so that
/// sums are the same in a resumed run.
template <int D>
void SoilSolver<D>::settle_sums() {
  const std::array<double, 5> mine{recent_energy_.external, recent_energy_.internal,
                                   recent_energy_.drag, recent_energy_.damping,
                                   recently_removed_mass_};
  std::array<double, 5> all{};
  MPI_Allreduce(mine.data(), all.data(), 5, MPI_DOUBLE, MPI_SUM, grid_->comm());
  energy_ += SoilEnergy{0.0, all[0], all[1], all[2], all[3]};
  removed_grain_mass_ += all[4];
  recent_energy_ = SoilEnergy{};
  recently_removed_mass_ = 0.0;
}

/// Keeps where and in which state the first point that a law could not integrate was.
template <int D>
void SoilSolver<D>::note_failed_stress(std::size_t body, const StressResult& result) {
  const auto& points = points_[body];
  const std::size_t p = result.first_failed;
  failed_stress_ = fmt::format("soil {}: law {} could not be integrated at {}, t = {:.6g} s ({})",
                               options_.bodies[body].name, laws_[body]->name(), place_of(points, p),
                               time_, state_of(points, p));
}

/// Names the worst point of all ranks and throws.
template <int D>
void SoilSolver<D>::report_bad_point(double largest_speed, std::size_t failed) const {
  std::string problem = failed_stress_;
  for (std::size_t b = 0; b < points_.size() && problem.empty(); ++b) {
    const auto& points = points_[b];
    for (std::size_t p = 0; p < points.size() && problem.empty(); ++p) {
      double speed2 = 0.0;
      for (int a = 0; a < D; ++a) speed2 += points.velocity[a][p] * points.velocity[a][p];
      const double porosity =
          1.0 - points.grain_mass[p] / (constants_[b].grain_density * points.volume[p]);
      const bool bad_speed = !(std::sqrt(speed2) < 0.99 * largest_speed) || !std::isfinite(speed2);
      const bool bad_porosity = constants_[b].water_density > 0.0 && !(porosity > 0.0);
      if (!bad_porosity && !(failed == 0 && bad_speed)) continue;
      const Point3 x = to_point3(points.position_of(p));
      problem = fmt::format(
          "soil {}: {} at ({:.6g}, {:.6g}, {:.6g}) m, t = {:.6g} s (point {}: speed {:.4g} m/s, "
          "porosity {:.4g}, "
          "pore pressure {:.4g} Pa)",
          options_.bodies[b].name,
          bad_porosity ? "the pores closed (porosity <= 0)" : "the velocity diverged", x[0], x[1],
          x[2], time_, points.id[p], std::sqrt(speed2), porosity, points.pore_pressure[p]);
    }
  }
  throw_divergence_if_any(grid_->comm(), problem);
  throw DivergenceError(fmt::format("soil: motion out of range at t = {:.6g} s", time_));
}

template <int D>
std::vector<std::string> SoilSolver<D>::warnings() const {
  return regime_warnings(*grid_, options_, points_, constants_, laws_);
}

template <int D>
double SoilSolver<D>::largest_displacement() const {
  double largest = 0.0;
  for (const SoilParticles<D>& points : points_)
    for (std::size_t p = 0; p < points.size(); ++p) {
      double squared = 0.0;
      for (int a = 0; a < D; ++a) {
        const double moved = points.position[a][p] - points.start[a][p];
        squared += moved * moved;
      }
      largest = std::max(largest, squared);
    }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, grid_->comm());
  return std::sqrt(largest);
}

template <int D>
typename SoilSolver<D>::Totals SoilSolver<D>::totals() const {
  std::array<double, 5 + D> mine{};
  double total_grain_mass = 0.0;
  for (std::size_t b = 0; b < points_.size(); ++b) {
    const auto& points = points_[b];
    const BodyConstants& body = constants_[b];
    ExactSum grain_mass(body.grain_density * grid_->cell_volume());
    for (std::size_t p = 0; p < points.size(); ++p) {
      const double grains = points.grain_mass[p];
      const double water = (points.volume[p] - grains / body.grain_density) * body.water_density;
      grain_mass.add(grains);
      mine[1] += water;
      for (int a = 0; a < D; ++a) {
        const double v = points.velocity[a][p], vw = points.water_velocity[a][p];
        mine[2] += 0.5 * (grains * v * v + water * vw * vw);
        mine[static_cast<std::size_t>(5 + a)] += grains * v + water * vw;
      }
    }
    mine[4] += static_cast<double>(points.size());
    total_grain_mass += grain_mass.over_ranks(grid_->comm());
  }
  mine[3] = recently_removed_mass_;
  std::array<double, 5 + D> all{};
  MPI_Allreduce(mine.data(), all.data(), 5 + D, MPI_DOUBLE, MPI_SUM, grid_->comm());
  Totals totals{total_grain_mass,
                all[1],
                options_.mass_scaling * all[2],
                {},
                removed_grain_mass_ + all[3],
                excavated_grain_mass_,
                placed_grain_mass_,
                static_cast<long long>(all[4])};
  for (int a = 0; a < D; ++a) totals.momentum[a] = all[static_cast<std::size_t>(5 + a)];
  return totals;
}

template void SoilSolver<2>::settle_sums();
template void SoilSolver<3>::settle_sums();
template void SoilSolver<2>::note_failed_stress(std::size_t, const StressResult&);
template void SoilSolver<3>::note_failed_stress(std::size_t, const StressResult&);
template void SoilSolver<2>::report_bad_point(double, std::size_t) const;
template void SoilSolver<3>::report_bad_point(double, std::size_t) const;
template std::vector<std::string> SoilSolver<2>::warnings() const;
template std::vector<std::string> SoilSolver<3>::warnings() const;
template double SoilSolver<2>::largest_displacement() const;
template double SoilSolver<3>::largest_displacement() const;
template SoilSolver<2>::Totals SoilSolver<2>::totals() const;
template SoilSolver<3>::Totals SoilSolver<3>::totals() const;

}  // namespace mudlark
