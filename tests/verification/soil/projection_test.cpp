// ranks: 1
// Formulations u-w-p and u-p: pore pressure by an implicit projection.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "soil/regime.hpp"
#include "verification/soil/column.hpp"
#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

using namespace soil_column;

constexpr std::array<Formulation, 2> projected{Formulation::u_w_p, Formulation::u_p};

const char* name_of(Formulation formulation) {
  return formulation == Formulation::u_w_p ? "u-w-p" : "u-p";
}

// Neither the water's compressibility nor permeability bounds the step, only the skeleton.
TEST(Projection, TakesStepsThatOnlyTheSkeletonBounds) {
  const auto step_of = [](double bulk, double conductivity) {
    Column column;
    column.formulation = Formulation::u_w_p;
    column.bulk = bulk;
    column.conductivity = conductivity;
    const Grid<2> grid = column.grid();
    SoilOptions options = column.options();
    options.courant = 1.0;
    options.bodies[0].initial_stress = SymTensor{};
    SoilSolver<2> soil(grid, options);
    soil.initialise();
    return soil.stable_step();
  };
  const double skeleton = (1.0 / 40) / std::sqrt(Column{}.modulus() / (0.6 * 2650.0));
  EXPECT_NEAR(step_of(2.15e7, 1e-2), skeleton, 1e-12);
  EXPECT_NEAR(step_of(HUGE_VAL, 1e-9), skeleton, 1e-12);
}

// From gravel to clay. Inertia is scaled with 1/k^2, so that clay takes as many steps.
TEST(Projection, FollowsTerzaghiFromGravelToClay) {
  for (const double conductivity : {1e-2, 1e-9}) {
    Column column;
    column.cells = 20;
    column.formulation = Formulation::u_w_p;
    column.conductivity = conductivity;
    if (conductivity > 1e-3) column.height = 10.0;
    column.mass_scaling = std::max(1.0, std::pow(1e-3 / conductivity, 2));
    EXPECT_LT(isochrone_error(column), 0.01);
  }
}

TEST(Projection, FollowsTerzaghiWithIncompressibleWaterAndWithoutRelativeAcceleration) {
  Column column;
  column.cells = 20;
  column.formulation = Formulation::u_w_p;
  column.bulk = HUGE_VAL;
  EXPECT_LT(isochrone_error(column), 0.01);
  column.formulation = Formulation::u_p;
  column.bulk = 2.15e7;
  EXPECT_LT(isochrone_error(column), 0.01);
}

TEST(Projection, KeepsTheUndrainedAnswerWhenSoilHardlyDrains) {
  for (const Formulation formulation : projected)
    for (const double bulk : {2.15e7, HUGE_VAL}) {
      if (formulation == Formulation::u_p && std::isinf(bulk)) continue;
      Column column;
      column.cells = 20;
      column.formulation = formulation;
      column.bulk = bulk;
      column.conductivity = 1e-9;
      column.undrained_start = false;
      column.ramp = 0.1;
      ColumnRun run(column);
      run.steps(4000);
      double sum = 0.0;
      int count = 0;
      for (std::size_t p = 0; p < run.points().size(); ++p) {
        if (run.points().start[1][p] > 0.9) continue;  // the drained end
        const double share = run.points().pore_pressure[p] / column.load;
        EXPECT_NEAR(share, column.undrained_share(), 0.01);
        sum += share;
        ++count;
      }
      std::printf("%s undrained, K_w = %g Pa: p0/q = %.5f, exact %.5f\n", name_of(formulation),
                  bulk, sum / count, column.undrained_share());
      EXPECT_NEAR(sum / count, column.undrained_share(), 1e-3);
    }
}

// Table 1 of the paper under 400 kPa: closed form of Hencky's law for the drained column.
TEST(Projection, EndsAtTheLargeStrainSettlementOfTableOne) {
  for (const double bulk : {2.15e7, HUGE_VAL}) {
    Column column;
    column.cells = 20;
    column.formulation = Formulation::u_w_p;
    column.conductivity = 1e-2;
    column.load = 4e5;
    column.undrained_start = false;
    column.strain = StrainMeasure::hencky;
    column.bulk = bulk;
    ColumnRun run(column);
    run.until(4.0);
    std::printf("large strain, K_w = %g Pa: settlement %.5f m, exact 0.20937 m\n", bulk,
                run.settlement(1.0));
    EXPECT_NEAR(run.settlement(1.0), 0.20937, 0.01 * 0.20937);
  }
}

/// Largest way of a geostatic bed at rest, over the settlement under its submerged weight, and the
/// largest error of pore pressure over that at the base.
template <int D>
std::array<double, 2> bed_at_rest(Formulation formulation, double bulk, Kernel kernel,
                                  Transfer transfer) {
  const int cells = D == 2 ? 20 : 8;
  const Grid<D> grid = soil_runs::make_grid<D>({3, D == 2 ? cells + 4 : 3, cells + 4}, 1.0 / cells,
                                               D == 2 ? "ssso" : "ssssso", 9.81);
  SoilOptions options = soil_runs::make_soil(D, {-1, -1, -1}, {9, 9, 1.0}, true);
  options.formulation = formulation;
  options.water_bulk_modulus = bulk;
  options.kernel = kernel;
  options.transfer = transfer;
  options.bodies[0].initial_stress = GeostaticStress{};
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  double time = 0.0;
  soil_runs::run(soil, time, 1000, soil.stable_step());
  const double weight = 0.6 * 1650.0 * 9.81;
  const double elastic = weight / (2.0 * soil_runs::constrained_modulus(1e6, 0.3));
  std::array<double, 2> worst{};
  const auto& points = soil.points(0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double z = points.position[D - 1][p];
    worst[0] = std::max(worst[0], std::abs(z - points.start[D - 1][p]) / elastic);
    worst[1] = std::max(worst[1], std::abs(points.pore_pressure[p] - 9810.0 * (1.0 - z)) / 9810.0);
  }
  std::printf("at rest, %s, %dD, kernel %d: way %.2e of the settlement, pressure %.2e\n",
              name_of(formulation), D, static_cast<int>(kernel), worst[0], worst[1]);
  return worst;
}

TEST(Projection, LeavesAGeostaticBedAtRest) {
  for (const Kernel kernel : soil_runs::every_kernel)
    for (const auto& [formulation, bulk] :
         {std::pair{Formulation::u_w_p, HUGE_VAL}, std::pair{Formulation::u_w_p, 2e9},
          std::pair{Formulation::u_p, 2e7}}) {
      const auto [way, pressure] = bed_at_rest<2>(formulation, bulk, kernel, Transfer::flip);
      EXPECT_LT(way, 1e-3);
      EXPECT_LT(pressure, 1e-2);  // at the rim; as much as in u-w
    }
  EXPECT_LT(bed_at_rest<2>(Formulation::u_w_p, HUGE_VAL, Kernel::composite, Transfer::apic)[0],
            1e-3);
  EXPECT_LT(bed_at_rest<3>(Formulation::u_w_p, HUGE_VAL, Kernel::composite, Transfer::flip)[0],
            1e-3);
}

// Soil that fills a sealed box has no surface to drain at: pressure is known up to a constant.
TEST(Projection, KeepsTheVolumeOfIncompressibleSoilInAClosedBox) {
  const Grid<2> grid = soil_runs::make_grid<2>({10, 10, 1}, 0.1, "ssss", 9.81);
  SoilOptions options = soil_runs::make_soil(2, {-1, -1, -1}, {9, 9, 9}, true);
  options.formulation = Formulation::u_w_p;
  options.water_bulk_modulus = HUGE_VAL;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  double time = 0.0;
  soil_runs::run(soil, time, 500, soil.stable_step());
  const auto& points = soil.points(0);
  double gravity = 0.0;  // what total stress and weight leave unbalanced
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_NEAR(points.position[0][p], points.start[0][p], 1e-9);
    gravity = std::max(gravity, std::abs(points.position[1][p] - points.start[1][p]));
  }
  // Grains settle through the water, by no more than their drained settlement.
  EXPECT_GT(gravity, 1e-9);
  EXPECT_LT(gravity, 1e-2);
}

TEST(Projection, BalancesItsEnergy) {
  Column column;
  column.cells = 20;
  column.formulation = Formulation::u_w_p;
  column.undrained_start = false;
  column.ramp = 0.05;
  column.damping = 0.0;
  const Grid<2> grid = column.grid();
  SoilOptions options = column.options();
  options.flip_fraction = 1.0;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  double time = 0.0;
  soil_runs::run(soil, time, 2000, soil.stable_step());
  const SoilEnergy& energy = soil.energy();
  const double taken = energy.external - energy.internal - energy.drag - energy.damping -
                       soil.totals().kinetic_energy;
  std::printf("energy: external %.3e, internal %.3e, drag %.3e, damping %.3e, scheme %.3e J\n",
              energy.external, energy.internal, energy.drag, energy.damping, taken);
  EXPECT_LT(std::abs(taken), 1e-3 * energy.external);
  EXPECT_LT(std::abs(energy.damping), 1e-9 * energy.external);
}

/// Rate [1/s] at which a standing wave of the Table 2 soil grows in a periodic column, from the
/// amplitudes that a run of it takes: they follow a recurrence of third order, as three modes do.
double measured_growth(double conductivity, bool inertia, double wave_number) {
  const int cells = 32;  // per wave
  const double h = 2.0 * pi / wave_number / cells;
  const Grid<2> grid = soil_runs::make_grid<2>({3, cells, 1}, h, "pppp");
  SoilOptions options = soil_runs::make_soil(2, {-1, -1, -1}, {9, 9, 9}, true);
  options.formulation = Formulation::u_p;
  options.inertia_in_darcy = inertia;
  options.water_bulk_modulus = 2.15e7;
  options.flip_fraction = 1.0;
  options.courant = 0.05;  // FLIP itself damps, in proportion to the step
  options.bodies[0].law = LinearElasticOptions{1e9, 0.35};
  options.bodies[0].strain = StrainMeasure::small;
  options.bodies[0].intrinsic_permeability = conductivity * 1.002e-3 / 9810.0;
  SoilSolver<2> soil(grid, options);
  soil.initialise();
  soil_runs::set_velocity(soil, [&](int axis, const Vec<2>& x, std::int64_t) {
    return axis == 1 ? 1e-6 * std::sin(wave_number * x[1]) : 0.0;
  });
  const double dt = soil.stable_step();
  constexpr int steps = 40;  // a fifteenth of a period
  double time = 0.0;
  std::vector<double> amplitudes;
  for (int sample = 0; sample < 12; ++sample) {
    double sum = 0.0;
    const auto& points = soil.points(0);
    for (std::size_t p = 0; p < points.size(); ++p)
      sum += points.velocity[1][p] * std::sin(wave_number * points.start[1][p]);
    amplitudes.push_back(sum);
    soil_runs::run(soil, time, steps, dt);
  }
  Eigen::MatrixXd last(amplitudes.size() - 3, 3);
  Eigen::VectorXd next(amplitudes.size() - 3);
  for (Eigen::Index i = 0; i < next.size(); ++i) {
    const auto u = static_cast<std::size_t>(i);
    last.row(i) << amplitudes[u + 2], amplitudes[u + 1], amplitudes[u];
    next[i] = amplitudes[u + 3];
  }
  const Eigen::Vector3d recurrence = last.colPivHouseholderQr().solve(next);
  Eigen::Matrix3d companion;
  companion << recurrence.transpose(), 1.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  const Eigen::Vector3cd factors = companion.eigenvalues();  // of the wave: the one that swings
  Eigen::Index wave = 0;
  factors.imag().maxCoeff(&wave);
  return std::log(std::abs(factors[wave])) / (steps * dt);
}

// Linear theory: with rho_w a_s in Darcy's law and this water u-p is ill-posed at every
// permeability; without it waves fade.
TEST(UP, GrowsAndFadesAtTheRatesOfLinearTheory) {
  const double number = pi / 0.05;
  for (const bool inertia : {true, false})
    for (const double conductivity : {1e-5, 1e-4, 1e-3}) {
      const SaturatedLayer layer{1e9 * 0.65 / (1.35 * 0.3), 0.4, 2650.0, 1000.0, 2.15e7,
                                 conductivity / 9810.0,     1.0};
      const double theory = u_p_growth(layer, number, inertia);
      const double measured = measured_growth(conductivity, inertia, number);
      std::printf("u-p, k = %g m/s, inertia %d: growth %.4g 1/s, theory %.4g 1/s\n", conductivity,
                  inertia, measured, theory);
      EXPECT_NEAR(measured, theory, 0.05 * std::abs(theory) + 5.0);
    }
}

// Figures of the exact solutions in the chart of Zienkiewicz, Chang & Bettess (1980).
TEST(UP, KnowsWhereItHolds) {
  const SaturatedLayer layer{
      1e9 * 0.65 / (1.35 * 0.3), 0.4, 2650.0, 1000.0, 2.15e7, 1e-5 / 9810.0, 1.0};
  EXPECT_NEAR(layer.undrained_wave(), 912.97, 0.01);
  const RegimeNumbers numbers = regime_numbers(layer, layer.first_frequency());
  EXPECT_NEAR(numbers.second, 0.25 * pi * pi, 1e-12);
  EXPECT_NEAR(numbers.first * numbers.second, 1e-5 * layer.first_frequency() * 1.99 / 9.81, 1e-9);
  EXPECT_TRUE(u_p_holds({5.0, 0.01}));
  EXPECT_FALSE(u_p_holds({7.0, 0.01}));
  EXPECT_FALSE(u_p_holds({1e-6, 50.0}));
  // Growth of waves of 0.1 m as Routh and Hurwitz have it, and as small permeability makes it.
  const double number = pi / 0.05;
  EXPECT_NEAR(u_p_growth(layer, number, true), 51.0, 0.5);
  EXPECT_LT(u_p_growth(layer, number, false), 0.0);
  SaturatedLayer stiff_water = layer;
  stiff_water.water_bulk_modulus = 2.2e9;
  EXPECT_LT(u_p_growth(stiff_water, number, true), 0.0);
}

}  // namespace
}  // namespace mudlark
