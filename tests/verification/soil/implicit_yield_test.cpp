// ranks: 1 3
// Implicit steps with laws that yield: equilibrium under weight, clay that consolidates for weeks,
// soil that does not stand.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "base/errors.hpp"
#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// Long runs of small systems, which gain nothing from more ranks and take them long.
bool on_several_ranks() {
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size > 1;
}

MohrCoulombOptions sand(double cohesion) {
  MohrCoulombOptions law;
  law.young_modulus = 1e7;
  law.poisson_ratio = 0.3;
  law.cohesion = cohesion;
  law.friction_angle = 30 * degree;
  return law;
}
ModifiedCamClayOptions clay() {
  ModifiedCamClayOptions law;
  law.compression_index = 0.2;
  law.swelling_index = 0.04;
  law.critical_stress_ratio = 1.0;
  law.poisson_ratio = 0.3;
  return law;
}

template <int D>
double largest_way(const SoilSolver<D>& soil) {
  return soil.largest_displacement();
}

/// One implicit step with nothing to do: how far it moves the soil.
template <int D>
double restlessness(SoilSolver<D>& soil, double dt) {
  soil.begin_step(0.0, dt, nullptr);
  soil.advance(dt);
  return largest_way(soil);
}

// Wet soil without any stress at the start ends with buoyant weight on its grains and water that
// stands, whatever time it takes.
template <int D>
void expect_geostatic(int cells) {
  const Grid<D> grid = soil_runs::make_grid<D>({2, D == 2 ? cells + 3 : 2, cells + 3}, 1.0 / cells,
                                               D == 2 ? "ssno" : "ssssno", 9.81, MPI_COMM_WORLD);
  SoilOptions options = soil_runs::make_soil(D, {-1, -1, -1}, {9, 9, 1.0}, true);
  options.bodies[0].law = LinearElasticOptions{1e8, 0.3};
  options.method = TimeMethod::implicit_steps;
  options.start_in_equilibrium = EquilibriumStart{};
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  soil.find_equilibrium();
  EXPECT_EQ(largest_way(soil), 0.0);
  EXPECT_EQ(soil.totals().kinetic_energy, 0.0);
  const auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double depth = 1.0 - points.start[D - 1][p];
    if (depth < 1.5 / cells) continue;  // the rim of the splines
    const double close = 0.2 * 9810.0 / cells;
    EXPECT_NEAR(-points.stress[2][p], 0.6 * 1650.0 * 9.81 * depth, close);
    EXPECT_NEAR(-points.stress[0][p], 0.3 / 0.7 * 0.6 * 1650.0 * 9.81 * depth, close);
    EXPECT_NEAR(points.pore_pressure[p], 9810.0 * depth, close);
  }
  EXPECT_LE(soil.implicit_effort().newton_iterations, 20);
  // Points have moved since their places were last weighed: some thousandths of their way there.
  EXPECT_LT(restlessness(soil, 10.0), 1e-6);
}

TEST(ImplicitEquilibrium, OfAWetColumnIsGeostatic) {
  expect_geostatic<2>(12);
  expect_geostatic<3>(6);
}

template <int D>
SoilOptions slope(const SoilLawOptions& law, bool wet, double toe) {
  SoilOptions options = soil_runs::make_soil(D, {}, {}, wet);
  options.bodies[0].shape.form = BelowShape{{{{0.0, 1.0}}, {{0.8, 1.0}}, {{2.0, toe}}}};
  options.bodies[0].law = law;
  options.bodies[0].strain = StrainMeasure::jaumann;
  options.bodies[0].initial_stress = GeostaticStress{};
  options.method = TimeMethod::implicit_steps;
  options.start_in_equilibrium = EquilibriumStart{};
  return options;
}

template <int D>
void expect_rest(const SoilLawOptions& law, bool wet, double toe, double h, double rest,
                 const char* name) {
  const int x = static_cast<int>(std::lround(2.4 / h)), z = static_cast<int>(std::lround(1.4 / h));
  const Grid<D> grid = soil_runs::make_grid<D>({x, D == 2 ? z : 2, z}, h,
                                               D == 2 ? "ssno" : "ssssno", 9.81, MPI_COMM_WORLD);
  SoilSolver<D> soil(grid, slope<D>(law, wet, toe));
  soil.initialise();
  soil.find_equilibrium();
  const auto effort = soil.implicit_effort();
  const double moved = restlessness(soil, 1.0);
  std::printf("%s, %dD: %lld Newton iterations, %lld shares repeated, then %.1e m\n", name, D,
              static_cast<long long>(effort.newton_iterations),
              static_cast<long long>(effort.repeated), moved);
  EXPECT_LT(moved, rest);
}

TEST(ImplicitEquilibrium, OfSlopesThatYieldIsFoundAndStays) {
  expect_rest<2>(sand(2e3), false, 0.4, 0.1, 1e-7, "dry Mohr-Coulomb slope");
  expect_rest<2>(sand(1e4), true, 0.4, 0.1, 1e-7, "wet Mohr-Coulomb slope");
  expect_rest<3>(sand(2e3), false, 0.4, 0.15, 1e-7, "dry Mohr-Coulomb slope");
  expect_rest<3>(clay(), false, 0.8, 0.15, 3e-4, "dry Cam-Clay slope");
}

// A vertical cut stands to the height 3.83 c / (gamma tan(45 - phi/2)) at most (Taylor 1948); with
// a tenth of that cohesion it does not, and says where.
TEST(ImplicitEquilibrium, OfACutThatIsTooHighDoesNotExist) {
  if (on_several_ranks()) GTEST_SKIP();
  SoilOptions options = soil_runs::make_soil(2, {-1, -1, -1}, {1.0, 9, 1.0}, false);
  options.bodies[0].law = sand(200.0);
  options.bodies[0].strain = StrainMeasure::jaumann;
  options.method = TimeMethod::implicit_steps;
  options.start_in_equilibrium = EquilibriumStart{};
  const Grid<2> grid = soil_runs::make_grid<2>({20, 12, 1}, 0.1, "ssno", 9.81, MPI_COMM_WORLD);
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  try {
    soil.find_equilibrium();
    FAIL() << "an equilibrium";
  } catch (const InputError& error) {
    std::printf("%s\n", error.what());
    EXPECT_NE(std::string(error.what()).find("there is no equilibrium beyond"), std::string::npos);
  }
}

// The stress ratio q/p' that Cam-Clay keeps in confined compression (Wood 1990, Eq. 10.16).
double confined_ratio(const ModifiedCamClayOptions& law) {
  const double plastic = 1.0 - law.swelling_index / law.compression_index;
  double low = 0.0, high = law.critical_stress_ratio;
  for (int i = 0; i < 60; ++i) {
    const double ratio = 0.5 * (low + high);
    const double left =
        ratio * (1 + law.poisson_ratio) * (1 - plastic) / (3 * (1 - 2 * law.poisson_ratio)) +
        3 * ratio * plastic / (std::pow(law.critical_stress_ratio, 2) - ratio * ratio);
    (left < 1.0 ? low : high) = ratio;
  }
  return 0.5 * (low + high);
}

// A metre of normally consolidated silty clay, k = 2e-8 m/s, at 50 kPa: in the first week the load
// grows to 100 kPa and stays for three more, in the fifth it grows to 200 kPa and stays until the
// tenth. When the water has drained the void ratio has fallen by the compression index times the
// logarithm of the stress (C_c log10 of oedometer tests, C_c = 2.303 lambda).
TEST(ImplicitConsolidation, OfNormallyConsolidatedClayOverWeeks) {
  if (on_several_ranks()) GTEST_SKIP();
  constexpr double week = 7 * 86400.0, porosity = 0.5;
  const ModifiedCamClayOptions law = clay();
  const double ratio = confined_ratio(law), start = 50e3;
  const double mean = start / (1.0 + 2.0 / 3.0 * ratio);
  SoilOptions options = soil_runs::make_soil(2, {-1, -1, -1}, {9, 9, 1.0}, true);
  SoilBody& body = options.bodies[0];
  body.law = law;
  body.strain = StrainMeasure::jaumann;
  body.porosity = porosity;
  body.intrinsic_permeability = 2e-8 * 1.002e-3 / 9810.0;
  const double lateral = -(mean - ratio * mean / 3.0);
  body.initial_stress = SymTensor{lateral, lateral, -start, 0, 0, 0};
  options.water_bulk_modulus = 2e9;
  options.method = TimeMethod::implicit_steps;
  options.step_tolerance = 3e-3;
  options.loads.push_back({"fill", Varying(
                                       [](const Point3&, double t) {
                                         const double first = std::min(t / week, 1.0);
                                         const double second = std::clamp(t / week - 4.0, 0.0, 1.0);
                                         return 50e3 * (1.0 + first + 2.0 * second);
                                       },
                                       "filled twice")});
  const int cells = 16;
  const Grid<2> grid =
      soil_runs::make_grid<2>({1, cells + 3, 1}, 1.0 / cells, "ssso", 0.0, MPI_COMM_WORLD);
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  const auto settlement = [&] {  // mean strain of the column
    std::array<double, 2> mine{}, all{};
    const auto& points = soil.points(0);
    for (std::size_t p = 0; p < points.size(); ++p)
      mine[0] += points.start_volume[p] - points.volume[p], mine[1] += points.start_volume[p];
    MPI_Allreduce(mine.data(), all.data(), 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return all[0] / all[1];
  };
  double time = 0.0;
  for (const auto& [end, stress] : {std::pair{4.0 * week, 100e3}, std::pair{10.0 * week, 200e3}}) {
    while (time < end) {
      const double dt = std::min({soil.outer_step(), 0.25 * week, end - time});
      soil.begin_step(time, dt, nullptr);
      soil.advance(dt);
      time += dt;
    }
    const double exact = law.compression_index * std::log(stress / start) * (1.0 - porosity);
    double pressure = 0.0;
    for (const double p : soil.points(0).pore_pressure) pressure = std::max(pressure, p);
    std::printf("%.0f weeks: settlement %.4f m (exact %.4f), excess pressure %.0f Pa, %lld steps\n",
                time / week, settlement(), exact, pressure,
                static_cast<long long>(soil.implicit_effort().steps));
    EXPECT_NEAR(settlement(), exact, 0.01 * exact);
  }
}

// A footing beyond what cohesive sand without weight can carry, c N_c = 30 kPa: the run stops, and
// tells at which time, why and where.
TEST(ImplicitSteps, StopWhereTheLoadCannotBeCarried) {
  if (on_several_ranks()) GTEST_SKIP();
  SoilOptions options = soil_runs::make_soil(2, {-1, -1, -1}, {9, 9, 0.6}, false);
  options.bodies[0].law = sand(1e3);
  options.bodies[0].strain = StrainMeasure::jaumann;
  options.method = TimeMethod::implicit_steps;
  options.step_tolerance = 0.05;
  options.loads.push_back(
      {"q", Varying([](const Point3& x, double t) { return x[0] < 0.3 ? 2e5 * t : 0.0; },
                    "growing load")});
  const Grid<2> grid = soil_runs::make_grid<2>({10, 10, 1}, 0.1, "ssso", 0.0, MPI_COMM_WORLD);
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  try {
    double time = 0.0;
    while (time < 1.0) {
      const double dt = std::min(soil.outer_step(), 0.1);
      soil.begin_step(time, dt, nullptr);
      soil.advance(dt);
      time += dt;
    }
    FAIL() << "carried the load";
  } catch (const DivergenceError& error) {
    std::printf("%s\n", error.what());
    EXPECT_NE(std::string(error.what()).find("implicit step of"), std::string::npos);
  }
}

}  // namespace
}  // namespace mudlark
