// ranks: 1 3 4
// The same soil on one rank and on all of them, and in the plane and in space; errors on all ranks.
#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "verification/soil/soil_runs.hpp"

namespace mudlark {
namespace {

using namespace soil_runs;

struct Setting {
  Kernel kernel = Kernel::composite;
  Transfer transfer = Transfer::flip;
  LoadForm load_form = LoadForm::virtual_stress;
  const char* walls = "ppssso";  // x, (y,) z
  bool two_bodies = false;
  Formulation formulation = Formulation::u_w;
  int outer_steps = 6, steps = 25;
};

template <int D>
SoilOptions make_bed(const Setting& setting) {
  SoilOptions soil = make_soil(D, {-1, -1, -1}, {9, 9, 0.55}, true);
  soil.kernel = setting.kernel;
  soil.transfer = setting.transfer;
  soil.load_form = setting.load_form;
  soil.formulation = setting.formulation;
  if (setting.formulation == Formulation::u_w_p) soil.water_bulk_modulus = HUGE_VAL;
  soil.bodies[0].initial_stress = GeostaticStress{};
  soil.bodies[0].permeability_law = PermeabilityLaw::kozeny_carman;
  if (setting.two_bodies) {
    SoilBody dry = soil.bodies[0];
    dry.name = "dry";
    dry.shape.form = BoxShape{{0.2, -1, 0.6}, {0.5, 9, 0.8}};
    dry.pore_water = PoreWater::none;
    dry.law = LinearElasticOptions{2e6, 0.2};
    dry.strain = StrainMeasure::objective;
    soil.bodies.push_back(dry);
  }
  soil.loads.push_back(
      {"wave", Varying([](const Point3& x,
                          double t) { return 2e3 * (1.0 + std::sin(5.0 * x[0] - 300.0 * t)); },
                       "wave")});
  return soil;
}

/// All values of a point behind its id: position, velocities, stress, pressure, volume.
template <int D>
std::map<std::int64_t, std::vector<double>> values_by_id(const SoilSolver<D>& soil) {
  std::map<std::int64_t, std::vector<double>> all;
  for (std::size_t b = 0; b < soil.bodies(); ++b) {
    const auto& points = soil.points(b);
    for (std::size_t p = 0; p < points.size(); ++p) {
      std::vector<double>& v = all[points.id[p]];
      for (int a = 0; a < D; ++a) v.push_back(points.position[a][p]);
      for (int a = 0; a < D; ++a) v.push_back(points.velocity[a][p]);
      for (int a = 0; a < D; ++a) v.push_back(points.water_velocity[a][p]);
      for (int c = 0; c < 6; ++c) v.push_back(points.stress[c][p] / 1e4);
      v.push_back(points.pore_pressure[p] / 1e4);
      v.push_back(points.volume[p] / points.start_volume[p]);
    }
  }
  return all;
}

template <int D>
std::map<std::int64_t, std::vector<double>> run_bed(MPI_Comm comm, const Setting& setting,
                                                    std::vector<double>* steps = nullptr) {
  const Grid<D> grid = make_grid<D>({12, D == 2 ? 12 : 9, 12}, 0.08, setting.walls, 9.81, comm);
  SoilSolver<D> soil(grid, make_bed<D>(setting));
  soil.initialise();
  set_velocity(soil, [](int axis, const Vec<D>& x, std::int64_t id) {
    return 0.3 * noise(id, axis) + (axis == 0 ? 1.0 + x[D - 1] : 0.0);
  });
  double time = 0.0;
  for (int i = 0; i < setting.outer_steps; ++i) {
    const double dt = soil.stable_step();
    if (steps) steps->push_back(dt);
    soil.begin_step(time, setting.steps * dt, nullptr);
    for (int k = 0; k < setting.steps; ++k) soil.advance(dt);
    time += setting.steps * dt;
  }
  return values_by_id(soil);
}

template <int D>
void expect_same_on_any_ranks(const Setting& setting) {
  std::vector<double> steps, serial_steps;
  const auto serial = run_bed<D>(MPI_COMM_SELF, setting, &serial_steps);
  const auto mine = run_bed<D>(MPI_COMM_WORLD, setting, &steps);
  for (std::size_t i = 0; i < steps.size(); ++i)
    EXPECT_NEAR(steps[i] / serial_steps[i], 1.0, 1e-12) << "stable step " << i;
  double worst = 0.0, count = static_cast<double>(mine.size()), all = 0.0;
  for (const auto& [id, values] : mine) {
    ASSERT_EQ(serial.count(id), 1u);
    for (std::size_t k = 0; k < values.size(); ++k)
      worst = std::max(worst, std::abs(values[k] - serial.at(id)[k]));
  }
  EXPECT_LT(worst, 1e-10);
  MPI_Allreduce(&count, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(all, static_cast<double>(serial.size()));
}

TEST(Ranks, GiveTheSameMotionIn2D) {
  for (const Kernel kernel : every_kernel) {
    Setting setting;
    setting.walls = "ppso";
    setting.kernel = kernel;
    expect_same_on_any_ranks<2>(setting);
  }
}

TEST(Ranks, GiveTheSameMotionWithApicAndWallsAllAround) {
  Setting setting;
  setting.walls = "snso";
  setting.transfer = Transfer::apic;
  expect_same_on_any_ranks<2>(setting);
}

TEST(Ranks, GiveTheSameMotionWithFacetsAndPointsThatChangeCells) {
  Setting setting;
  setting.walls = "ppso";
  setting.load_form = LoadForm::facets;
  setting.outer_steps = 2;
  setting.steps = 300;  // points wander between ranks within an outer step
  expect_same_on_any_ranks<2>(setting);
}

TEST(Ranks, GiveTheSameMotionOfTwoBodies) {
  Setting setting;
  setting.walls = "ppso";
  setting.two_bodies = true;
  expect_same_on_any_ranks<2>(setting);
}

TEST(Ranks, GiveTheSameMotionIn3D) {
  Setting setting;
  setting.outer_steps = 3;
  expect_same_on_any_ranks<3>(setting);
}

// Points change cells, soil fills a part of the ranks only, and some faces join wet soil and dry.
TEST(Ranks, GiveTheSameMotionWithProjectedPorePressure) {
  for (const Formulation formulation : {Formulation::u_w_p, Formulation::u_p}) {
    Setting setting;
    setting.formulation = formulation;
    setting.walls = "snso";
    setting.two_bodies = true;
    expect_same_on_any_ranks<2>(setting);
    setting.walls = "ppso";
    setting.outer_steps = 2;
    setting.steps = 60;
    expect_same_on_any_ranks<2>(setting);
    setting.walls = "ppssso";
    setting.outer_steps = 1;
    setting.steps = 20;
    expect_same_on_any_ranks<3>(setting);
  }
}

TEST(Ranks, GiveTheSameSolidFractionAndMeanVelocity) {
  const auto fields = [](MPI_Comm comm) {
    auto grid = std::make_unique<Grid<2>>(make_grid<2>({12, 12, 1}, 0.08, "ppso", 9.81, comm));
    SoilSolver<2> soil(*grid, make_bed<2>({}));
    soil.initialise();
    double time = 0.0;
    run(soil, time, 40, soil.stable_step());
    CellField<2> fraction(*grid, "f", "1"), resistance(*grid, "r", "1");
    soil.solid_fraction(fraction, resistance);
    std::map<std::pair<int, int>, std::array<double, 4>> values;
    for_each(grid->owned(), [&](const Index<2>& c) {
      values[{c[0], c[1]}] = {fraction[c], resistance[c] / 1e6,
                              1e3 * soil.mean_grain_velocity()[0][c],
                              1e3 * soil.mean_grain_velocity()[1][c]};
    });
    return values;
  };
  const auto serial = fields(MPI_COMM_SELF), mine = fields(MPI_COMM_WORLD);
  for (const auto& [cell, values] : mine)
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(values[k], serial.at(cell)[k], 1e-10)
          << k << " at " << cell.first << " " << cell.second;
}

/// A bed in the plane, and the same one a few cells thick in y.
void expect_plane_equals_space(const char* walls_2d, const char* walls_3d, int thick,
                               Transfer transfer, Formulation formulation = Formulation::u_w) {
  SoilOptions plane = make_soil(2, {-1, -1, -1}, {9, 9, 0.5}, true);
  plane.formulation = formulation;
  plane.transfer = transfer;
  plane.bodies[0].initial_stress = GeostaticStress{};
  SoilOptions space = plane;
  space.bodies[0].points_per_cell = 8;
  const Grid<2> grid2 = make_grid<2>({8, 9, 1}, 0.1, walls_2d, 9.81, MPI_COMM_WORLD);
  const Grid<3> grid3 = make_grid<3>({8, thick, 9}, 0.1, walls_3d, 9.81, MPI_COMM_WORLD);
  SoilSolver<2> soil2(grid2, plane);
  SoilSolver<3> soil3(grid3, space);
  soil2.initialise();
  soil3.initialise();
  const auto velocity = [](int axis, double x, double z) {
    return axis == 0 ? 0.2 * std::sin(7.0 * x) * z : 0.1 * std::cos(5.0 * x + 3.0 * z) * z;
  };
  set_velocity(soil2,
               [&](int a, const Vec<2>& x, std::int64_t) { return velocity(a, x[0], x[1]); });
  set_velocity(soil3, [&](int a, const Vec<3>& x, std::int64_t) {
    return a == 1 ? 0.0 : velocity(a, x[0], x[2]);
  });
  const double dt = 0.8 * soil2.stable_step();
  double t2 = 0.0, t3 = 0.0;
  run(soil2, t2, 150, dt);
  run(soil3, t3, 150, dt);
  const auto key = [](double x, double z) {
    return std::pair{std::lround(x / 0.05), std::lround(z / 0.05)};
  };
  std::map<std::pair<long, long>, std::array<double, 6>> plane_values;
  const auto& points2 = soil2.points(0);
  std::vector<double> mine;
  for (std::size_t p = 0; p < points2.size(); ++p)
    for (const double v : {points2.start[0][p], points2.start[1][p], points2.position[0][p],
                           points2.position[1][p], points2.velocity[0][p], points2.velocity[1][p],
                           points2.pore_pressure[p] / 1e4, points2.stress[1][p] / 1e4})
      mine.push_back(v);
  int length = static_cast<int>(mine.size()), total = 0;
  std::vector<int> lengths(static_cast<std::size_t>(grid2.ranks())), places(lengths.size());
  MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, MPI_COMM_WORLD);
  for (std::size_t r = 0; r < lengths.size(); ++r) places[r] = total, total += lengths[r];
  std::vector<double> all(static_cast<std::size_t>(total));
  MPI_Allgatherv(mine.data(), length, MPI_DOUBLE, all.data(), lengths.data(), places.data(),
                 MPI_DOUBLE, MPI_COMM_WORLD);
  for (std::size_t k = 0; k < all.size(); k += 8)
    plane_values[key(all[k], all[k + 1])] = {all[k + 2], all[k + 3], all[k + 4],
                                             all[k + 5], all[k + 6], all[k + 7]};
  const auto& points3 = soil3.points(0);
  double worst = 0.0;
  for (std::size_t p = 0; p < points3.size(); ++p) {
    const auto& expected = plane_values.at(key(points3.start[0][p], points3.start[2][p]));
    const std::array<double, 6> values{points3.position[0][p],         points3.position[2][p],
                                       points3.velocity[0][p],         points3.velocity[2][p],
                                       points3.pore_pressure[p] / 1e4, points3.stress[1][p] / 1e4};
    for (std::size_t k = 0; k < 6; ++k) worst = std::max(worst, std::abs(values[k] - expected[k]));
    worst = std::max(worst, std::abs(points3.velocity[1][p]));
  }
  EXPECT_LT(worst, 1e-10) << thick << " cells thick";
}

TEST(PlaneStrain, EqualsASliceInSpaceBetweenSlipWallsOrPeriodicOnes) {
  expect_plane_equals_space("ssso", "ssssso", 3, Transfer::flip);
  expect_plane_equals_space("snno", "snssno", 3, Transfer::apic);
  expect_plane_equals_space("ppso", "ppppso", 3, Transfer::flip);
  expect_plane_equals_space("ssso", "ssssso", 1, Transfer::flip);
  expect_plane_equals_space("snno", "snssno", 3, Transfer::flip, Formulation::u_w_p);
  expect_plane_equals_space("ppso", "ppppso", 3, Transfer::flip, Formulation::u_p);
}

template <int D>
std::string divergence_of(double courant, bool wet) {
  const Grid<D> grid = make_grid<D>({6, D == 2 ? 12 : 6, 12}, 0.1, "ssssso", 9.81, MPI_COMM_WORLD);
  SoilOptions options = make_soil(D, {-1, -1, -1}, {9, 9, 0.8}, wet);
  options.courant = courant;
  SoilSolver<D> soil(grid, options);
  soil.initialise();
  double time = 0.0;
  try {
    for (int i = 0; i < 100; ++i) run(soil, time, 20, soil.stable_step());
  } catch (const DivergenceError& error) {
    return error.what();
  }
  return {};
}

TEST(OverlongStep, EndsInAnErrorThatNamesPlaceAndTime) {
  for (const bool wet : {false, true})
    for (const std::string& text : {divergence_of<2>(3.0, wet), divergence_of<3>(4.0, wet)}) {
      ASSERT_FALSE(text.empty()) << "nothing noticed";
      EXPECT_NE(text.find(" at ("), std::string::npos) << text;
      EXPECT_NE(text.find("t = "), std::string::npos) << text;
      EXPECT_NE(text.find("soil block"), std::string::npos) << text;
      RecordProperty("text", text);
    }
  EXPECT_EQ(divergence_of<2>(0.5, true), "");
}

}  // namespace
}  // namespace mudlark
