// ranks: 1 4
// Soil that yields, on a floor of friction and under a load: the same on one rank and on all of
// them, and in the plane and in space, one cell thick.
#include <gtest/gtest.h>

#include <cstdio>

#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

using namespace soil_runs;

constexpr double h = 0.1;

struct Setting {
  const char* name;
  SoilLawOptions law;
  bool wet = false;
  Transfer transfer = Transfer::flip;
  StrainMeasure strain = StrainMeasure::jaumann;
  bool gently = false;  ///< between two walls, under a load that grows
};

MohrCoulombOptions weakening_sand() {
  MohrCoulombOptions law;
  law.young_modulus = 1e6, law.poisson_ratio = 0.3;
  law.friction_angle = 0.6, law.dilatancy_angle = 0.1, law.cohesion = 200.0;
  law.tension_cutoff = 0.0;
  MohrCoulombOptions::Residual residual;
  residual.friction_angle = 0.5;
  residual.softening.strain = 0.1;
  law.residual = residual;
  return law;
}

DruckerPragerOptions rubble() {
  DruckerPragerOptions law;
  law.young_modulus = 1e6, law.poisson_ratio = 0.3, law.friction_angle = 0.6;
  return law;
}

TrescaOptions soft_clay() {
  TrescaOptions law;
  law.young_modulus = 1e6, law.poisson_ratio = 0.45, law.undrained_strength = 1000.0;
  return law;
}

VonMisesOptions softening_clay() {
  VonMisesOptions law;
  law.young_modulus = 1e6, law.poisson_ratio = 0.45, law.undrained_strength = 1000.0;
  law.residual = UndrainedResidual{};
  law.residual->strength = 700.0;
  law.residual->softening.strain = 0.1;
  return law;
}

SekiguchiOhtaOptions anisotropic_clay() {
  SekiguchiOhtaOptions law;
  law.compression_index = 0.1, law.swelling_index = 0.02, law.critical_stress_ratio = 1.1;
  law.overconsolidation_ratio = 1.5;
  return law;
}

NewtonianOptions mud() { return {1e6, 1.0, 0.0}; }

MuIOptions flowing_sand() {
  MuIOptions law;
  law.young_modulus = 1e6, law.poisson_ratio = 0.3, law.grain_diameter = 1e-3;
  law.grain_density = 2650.0;
  return law;
}

ModifiedCamClayOptions clay() {
  ModifiedCamClayOptions law;
  law.compression_index = 0.1, law.swelling_index = 0.02, law.critical_stress_ratio = 1.1;
  law.overconsolidation_ratio = 1.5;
  return law;
}

const std::vector<Setting>& settings() {
  static const std::vector<Setting> all{
      {"mohr-coulomb, softening", weakening_sand(), false, Transfer::flip, StrainMeasure::jaumann},
      {"mohr-coulomb, hencky, wet", weakening_sand(), true, Transfer::apic, StrainMeasure::hencky},
      {"drucker-prager", rubble(), true, Transfer::flip, StrainMeasure::jaumann},
      {"tresca", soft_clay(), false, Transfer::apic, StrainMeasure::jaumann},
      {"von-mises, softening", softening_clay(), false, Transfer::flip, StrainMeasure::jaumann},
      {"newtonian", mud(), false, Transfer::flip, StrainMeasure::jaumann},
      {"sekiguchi-ohta", anisotropic_clay(), true, Transfer::flip, StrainMeasure::jaumann},
      {"mu-i", flowing_sand(), false, Transfer::apic, StrainMeasure::jaumann},
      {"modified-cam-clay", clay(), true, Transfer::flip, StrainMeasure::jaumann},
      // Where waves turn its loading round within a few steps, round-off grows a hundredfold a
      // step.
      {"sanisand", SanisandOptions::toyoura(), false, Transfer::flip, StrainMeasure::jaumann,
       true}};
  return all;
}

/// Values of a point behind the number of its place at the start: position, velocities, stress,
/// pressure; out of the plane nothing may move.
using Values = std::map<std::pair<long, long>, std::vector<double>>;

template <int D>
Values values_of(const SoilSolver<D>& soil) {
  Values all;
  const auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    std::vector<double> v;
    for (const int a : {0, D - 1}) {
      v.push_back(points.position[a][p]);
      v.push_back(points.velocity[a][p]);
      v.push_back(points.water_velocity[a][p]);
    }
    for (int c = 0; c < 6; ++c) v.push_back(points.stress[c][p] / 1e4);
    v.push_back(points.pore_pressure[p] / 1e4);
    v.push_back(points.volume[p] / points.start_volume[p]);
    v.push_back(D == 3 ? points.velocity[1][p] : 0.0);
    all[{std::lround(points.start[0][p] / (0.25 * h)),
         std::lround(points.start[D - 1][p] / (0.25 * h))}] = v;
  }
  return all;
}

/// A block beside a wall that sags and spreads under a load on its top, 0.5 m wide and 0.4 m high.
template <int D>
Values run_block(MPI_Comm comm, const Setting& setting) {
  DomainOptions domain;
  domain.dimension = D;
  domain.cells = {setting.gently ? 6 : 12, D == 2 ? 8 : 1, 8};
  for (std::size_t a = 0; a < static_cast<std::size_t>(D); ++a)
    domain.upper[a] = domain.cells[a] * h;
  domain.walls[0] = {Wall::slip, setting.gently ? Wall::slip : Wall::open};
  domain.walls[D - 1] = {Wall::friction, Wall::open};
  domain.wall_friction[D - 1][0] = 0.4;
  domain.gravity[D - 1] = -9.81;
  const Grid<D> grid(domain, comm);
  SoilOptions options =
      make_soil(D, {-1, -1, -1}, {setting.gently ? 0.6 : 0.5, D == 2 ? 0.4 : 9, 0.4}, setting.wet);
  options.transfer = setting.transfer;
  options.bodies[0].law = setting.law;
  options.bodies[0].strain = setting.strain;
  options.bodies[0].initial_stress = GeostaticStress{};
  const bool gently = setting.gently;
  options.loads.push_back({"footing", Varying(
                                          [gently](const Point3& x, double time) {
                                            if (x[2] < 0.3) return 0.0;
                                            return gently ? 4e5 * time * (0.5 + x[0]) : 2e3 * x[0];
                                          },
                                          "footing")});
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  double time = 0.0;
  for (int i = 0; i < 200; ++i) run(soil, time, 1, 2.5e-4);
  return values_of(soil);
}

double largest_difference(const Values& some, const Values& all) {
  double worst = 0.0;
  for (const auto& [place, values] : some)
    for (std::size_t k = 0; k < values.size(); ++k)
      worst = std::max(worst, std::abs(values[k] - all.at(place)[k]));
  return worst;
}

TEST(Laws, GiveTheSameOnAnyRanksAndInASliceOfSpace) {
  for (const Setting& setting : settings()) {
    const Values serial = run_block<2>(MPI_COMM_SELF, setting);
    const double ranks = largest_difference(run_block<2>(MPI_COMM_WORLD, setting), serial);
    const double space = largest_difference(run_block<3>(MPI_COMM_WORLD, setting), serial);
    double fastest = 0.0;
    for (const auto& [place, values] : serial) fastest = std::max(fastest, std::abs(values[1]));
    std::printf("%s: ranks %.1e, space %.1e, fastest %.3f m/s\n", setting.name, ranks, space,
                fastest);
    EXPECT_LT(ranks, 1e-8) << setting.name;
    EXPECT_LT(space, 1e-8) << setting.name;
    EXPECT_GT(fastest, setting.gently ? 5e-4 : 0.05) << setting.name;
  }
}

}  // namespace
}  // namespace mudlark
