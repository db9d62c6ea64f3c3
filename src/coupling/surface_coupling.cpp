#include "coupling/surface_coupling.hpp"

#include <algorithm>
#include <cmath>

namespace mudlark {
namespace {

/// Cells with less than this share of the soil's solid fraction count as open water (or air).
/// Further inside, the flow's pressure is only its estimate of seepage, which at low permeability
/// turns the smallest change of porosity into large pressures: none of that may come back to the
/// soil as a load.
constexpr double open_share = 0.02;

}  // namespace

template <int D>
SurfaceCoupling<D>::SurfaceCoupling(const Grid<D>& grid, const CouplingOptions& options,
                                    const FlowOptions& flow, const SoilSolver<D>& soil)
    : grid_(&grid),
      options_(options),
      halo_(grid),
      extension_(grid),
      room_(grid),
      open_(grid, "open", "1"),
      wet_(grid, "wet", "1"),
      water_density_(flow.density),
      bed_velocity_(grid, "bed velocity", "m/s") {
  const SoilOptions& soils = soil.options();
  full_fraction_ = 1.0;
  impedance_ = 0.0;
  for (std::size_t b = 0; b < soils.bodies.size(); ++b) {
    const SoilBody& body = soils.bodies[b];
    const double n = body.porosity;
    const bool wet = body.pore_water == PoreWater::two_phase;
    const double density = (1.0 - n) * body.grain_density + (wet ? n * soils.water_density : 0.0);
    const double impedance = std::sqrt(density * soil.law(b).shear_modulus());
    full_fraction_ = std::min(full_fraction_, 1.0 - n);
    impedance_ = b == 0 ? impedance : std::min(impedance_, impedance);
  }
}

template <int D>
double SurfaceCoupling<D>::load_share(double time) const {
  if (options_.mudline == Mudline::consistent || time >= options_.ramp) return 1.0;
  return 0.5 * (1.0 - std::cos(3.14159265358979323846 * time / options_.ramp));
}

template <int D>
void SurfaceCoupling<D>::map_soil_to_grid(SoilSolver<D>& soil, const PorousMedium<D>& fixed,
                                          PorousMedium<D>& medium) {
  room_.find(soil, fixed, medium);
  for (int a = 0; a < D; ++a)
    room_.for_each_inner_face(a, [&](const Index<D>& face) {
      medium.grain_velocity[a][face] = bed_velocity_[a][face];
      medium.grain_flux[a][face] = room_.fraction_at(a, face) * bed_velocity_[a][face];
      medium.linear_drag[a][face] = fixed.linear_drag[a][face] + room_.resistance_at(a, face);
      medium.quadratic_drag[a][face] = fixed.quadratic_drag[a][face];
    });
}

template <int D>
void SurfaceCoupling<D>::relax_bed_velocity(const SoilSolver<D>& soil, double dt) {
  const FaceVector<D>& velocity = soil.mean_grain_velocity();
  const double share = 1.0 / (1.0 + 2.0 * options_.added_mass_factor * added_mass(dt));
  for (int a = 0; a < D; ++a)
    for_each(grid_->owned_faces(a), [&](const Index<D>& face) {
      double& bed = bed_velocity_[a][face];
      bed += share * (velocity[a][face] - bed);
    });
  halo_.exchange(bed_velocity_);
}

template <int D>
double SurfaceCoupling<D>::added_mass(double dt) const {
  return dt > 0.0 ? water_density_ * water_depth_ / (impedance_ * dt) : 0.0;
}

/// Depth of the water over the soil: the largest pressure at the mudline, as a column. All of it
/// moves where a bed gives way over its whole width (docs/methods/coupling.md).
template <int D>
void SurfaceCoupling<D>::measure_depth(const CellField<D>& pressure) {
  double depth = 0.0;
  const double weight = water_density_ * std::abs(grid_->gravity()[D - 1]);
  if (weight > 0.0)
    for_each(grid_->owned(), [&](const Index<D>& cell) {
      const double share = room_.fraction()[cell] / full_fraction_;
      if (share > 0.1 && share < 0.9) depth = std::max(depth, pressure[cell] / weight);
    });
  water_depth_ = max_over_ranks(*grid_, depth);
}

template <int D>
void SurfaceCoupling<D>::extended_pressure(const FlowSolver<D>& flow, const SoilSolver<D>& soil,
                                           double share, CellField<D>& pressure) {
  for_each(grid_->owned(), [&](const Index<D>& cell) {
    const bool open = room_.fraction()[cell] < open_share * full_fraction_;
    const bool wet = flow.saturation()[cell] >= 0.5;
    open_[cell] = open ? 1.0 : 0.0;
    wet_[cell] = open && wet ? share : 0.0;
    pressure[cell] = open && wet ? share * flow.pressure()[cell] : 0.0;
  });
  extension_.extend(open_, wet_, water_density_, soil.active(), pressure);
}

template <int D>
void SurfaceCoupling<D>::map_flow_at_begin(const FlowSolver<D>& flow, const SoilSolver<D>& soil,
                                           double time, FluidLoad<D>& load) {
  load.outlet = options_.mudline == Mudline::consistent  ? PoreOutlet::at_water_pressure
                : options_.mudline == Mudline::load_only ? PoreOutlet::at_zero_pressure
                                                         : PoreOutlet::sealed;
  extended_pressure(flow, soil, load_share(time), load.pressure_begin);
}

template <int D>
void SurfaceCoupling<D>::map_flow_at_end(const FlowSolver<D>& flow, const SoilSolver<D>& soil,
                                         double time, FluidLoad<D>& load) {
  extended_pressure(flow, soil, load_share(time), load.pressure_end);
  if (options_.pressure_in_time == PressureInTime::constant)
    load.pressure_begin.copy_values_from(load.pressure_end);
  measure_depth(load.pressure_end);
}

template <int D>
void SurfaceCoupling<D>::initialise(const FlowSolver<D>& flow, SoilSolver<D>& soil,
                                    FluidLoad<D>& load) {
  map_flow_at_begin(flow, soil, 0.0, load);
  if (options_.mudline == Mudline::consistent) soil.set_pore_pressure(load.pressure_begin);
}

template class SurfaceCoupling<2>;
template class SurfaceCoupling<3>;

}  // namespace mudlark
