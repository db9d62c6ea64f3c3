/// Each doubt by a case that has it, and by the same case without the slip.
#include "run/doubts.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "grid/triangle_mesh.hpp"

namespace mudlark {
namespace {

/// 10 m by 2 m, gravity downwards, cells of 0.1 m.
CaseOptions box_case() {
  CaseOptions options;
  options.domain.dimension = 2;
  options.domain.upper = {10.0, 2.0, 0.0};
  options.domain.cells = {100, 20, 1};
  options.domain.gravity = {0.0, -9.81, 0.0};
  return options;
}

/// Dry sand of 1.5 m.
CaseOptions sand() {
  CaseOptions options = box_case();
  SoilBody body;
  body.name = "sand";
  body.shape.form = BoxShape{{0.0, -1.0, 0.0}, {10.0, 1.0, 1.5}};
  body.pore_water = PoreWater::none;
  MohrCoulombOptions law;
  law.young_modulus = 1e7;
  law.poisson_ratio = 0.3;
  law.friction_angle = 33.0 * std::numbers::pi / 180.0;
  body.law = law;
  options.soil.emplace();
  options.soil->bodies.push_back(body);
  return options;
}

/// Water 1 m deep.
CaseOptions pond() {
  CaseOptions options = box_case();
  WaterBody water;
  water.shape.form = BoxShape{{0.0, -1.0, 0.0}, {10.0, 1.0, 1.0}};
  options.flow.emplace();
  options.flow->bodies.push_back(water);
  return options;
}

WaveZoneOptions waves(double still_level) {
  WaveZoneOptions zone;
  zone.name = "sea";
  zone.wave = RegularWave{};
  std::get<RegularWave>(zone.wave).height = 0.2;
  std::get<RegularWave>(zone.wave).period = 2.0;
  zone.outer = 0.0, zone.inner = 5.0;
  zone.still_level = still_level, zone.depth = 1.0;
  return zone;
}

/// The one doubt there is must say all of these words.
void expect_doubt(const CaseOptions& options, std::initializer_list<const char*> words) {
  const std::vector<std::string> found = doubts(options);
  ASSERT_EQ(found.size(), 1u) << (found.empty() ? "" : found.back());
  for (const char* word : words) EXPECT_NE(found[0].find(word), std::string::npos) << found[0];
}

TEST(Doubts, SoilThatHangsFromAClosedSide) {
  CaseOptions full = sand();
  std::get<BoxShape>(full.soil->bodies[0].shape.form).upper[2] = 2.0;
  expect_doubt(full, {"sand", "hangs", "upper_z = \"open\""});
  full.domain.walls[1][1] = Wall::open;
  EXPECT_TRUE(doubts(full).empty());
}

TEST(Doubts, AreNotRaisedByUsualCases) {
  EXPECT_TRUE(doubts(sand()).empty());
  CaseOptions sea = pond();
  sea.flow->waves.push_back(waves(1.0));
  EXPECT_TRUE(doubts(sea).empty());
}

TEST(Doubts, SoilSofterThanItsWeight) {
  CaseOptions options = sand();
  std::get<MohrCoulombOptions>(options.soil->bodies[0].law).young_modulus = 10.0;
  expect_doubt(options, {"sand", "young_modulus = 10 Pa", "MPa"});
}

TEST(Doubts, FrictionInRadians) {
  CaseOptions options = sand();
  std::get<MohrCoulombOptions>(options.soil->bodies[0].law).friction_angle =
      0.5 * std::numbers::pi / 180.0;
  expect_doubt(options, {"friction_angle = 0.5 degree", "0.5 rad"});
}

TEST(Doubts, DensityInGramsPerCubicCentimetre) {
  CaseOptions options = sand();
  options.soil->bodies[0].grain_density = 2.65;
  expect_doubt(options, {"grain_density = 2.65 kg/m3", "2.65 g/cm3"});
}

TEST(Doubts, InitialStressThatPulls) {
  CaseOptions options = sand();
  StressField stress;
  for (std::size_t c = 0; c < 3; ++c)
    stress.component[c] =
        Varying([](const Point3& x, double) { return 16e3 * (1.5 - x[2]); }, "16e3*(1.5-z)");
  options.soil->bodies[0].initial_stress = stress;
  expect_doubt(options, {"initial_stress", "minus"});
  for (std::size_t c = 0; c < 3; ++c)
    stress.component[c] =
        Varying([](const Point3& x, double) { return -16e3 * (1.5 - x[2]); }, "-16e3*(1.5-z)");
  options.soil->bodies[0].initial_stress = stress;
  EXPECT_TRUE(doubts(options).empty());
}

TEST(Doubts, SoilAndFlowingWaterWithoutCoupling) {
  CaseOptions options = sand();
  options.flow = pond().flow;
  expect_doubt(options, {"coupling.mode", "surface", "unified"});
  options.coupling.mode = CouplingMode::surface;
  EXPECT_TRUE(doubts(options).empty());
}

TEST(Doubts, WaterOfTheWrongUnit) {
  CaseOptions options = pond();
  options.flow->viscosity = 1e-6;
  expect_doubt(options, {"viscosity", "kinematic"});
  options = pond();
  options.flow->density = 1.0;
  expect_doubt(options, {"water.density", "1000"});
}

TEST(Doubts, StillLevelThatTheWaterDoesNotHave) {
  CaseOptions options = pond();
  options.flow->waves.push_back(waves(1.3));
  expect_doubt(options, {"sea", "still_level is 1.3 m", "1 m when the run starts"});
}

TEST(Doubts, WavesOfTooFewCells) {
  CaseOptions options = pond();
  options.domain.cells = {20, 4, 1};  // 0.5 m, for a wave 0.2 m high
  options.flow->waves.push_back(waves(1.0));
  expect_doubt(options, {"sea", "0.4 cells high"});
}

TEST(Doubts, ObliqueWavesThatDoNotFitBetweenPeriodicSides) {
  CaseOptions options = pond();  // waves of 5.302 m
  options.domain.dimension = 3;
  options.domain.upper = {10.0, 8.0, 2.0};
  options.domain.cells = {100, 80, 20};
  options.domain.gravity = {0.0, 0.0, -9.81};
  std::get<BoxShape>(options.flow->bodies[0].shape.form).upper[1] = 8.0;
  options.flow->waves.push_back(waves(1.0));
  options.flow->waves[0].direction = -20.0 * std::numbers::pi / 180.0;
  EXPECT_TRUE(doubts(options).empty());  // closed sides throw it back, as they should
  options.domain.walls[1] = {Wall::periodic, Wall::periodic};
  expect_doubt(options, {"sea", "0.516 waves", "direction = -41.51", "15.5 m wide"});
  options.flow->waves[0].direction = -41.51 * std::numbers::pi / 180.0;
  EXPECT_TRUE(doubts(options).empty());
  IrregularSea sea;
  sea.significant_height = 0.2, sea.sea.spectrum.peak_period = 2.0;
  options.flow->waves[0].direction = 0.0, options.flow->waves[0].wave = sea;
  EXPECT_TRUE(doubts(options).empty());
  sea.sea.spreading = 10.0, options.flow->waves[0].wave = sea;
  expect_doubt(options, {"sea", "components do not fit", "spreading"});
}

TEST(Doubts, SurfaceInMillimetres) {
  CaseOptions options = pond();
  FlowSolid block;
  const auto mesh = [](double size) {  // a tetrahedron
    const Point3 o{0.0, 0.0, 0.0}, x{size, 0.0, 0.0}, y{0.0, size, 0.0}, z{0.0, 0.0, size};
    return StlShape{std::make_shared<const TriangleMesh>(
        std::vector<Triangle>{{o, y, x}, {o, x, z}, {o, z, y}, {x, y, z}})};
  };
  block.name = "block", block.shape.form = mesh(1500.0);
  options.flow->solids.push_back(block);
  expect_doubt(options, {"block", "1500 m long", "scale = 0.001"});
  options.flow->solids[0].shape.form = mesh(1.5);
  EXPECT_TRUE(doubts(options).empty());
}

TEST(Doubts, NozzleAboveTheWaterWithoutALevel) {
  CaseOptions options = pond();
  FlowSideOptions nozzle;
  nozzle.name = "nozzle";
  nozzle.from[2] = 1.5, nozzle.to[2] = 1.7;
  options.flow->sides.push_back(nozzle);
  expect_doubt(options, {"nozzle", "level = 1.7"});
  options.flow->sides[0].level = Varying(1.7);
  EXPECT_TRUE(doubts(options).empty());
  options.flow->sides[0] = FlowSideOptions{};  // the whole side: up to the water's level
  EXPECT_TRUE(doubts(options).empty());
}

/// Water 1 m deep over 0.5 m of sand with its pores full of it.
CaseOptions bed() {
  CaseOptions options = sand();
  options.soil->bodies[0].shape.form = BoxShape{{0.0, -1.0, 0.0}, {10.0, 1.0, 0.5}};
  options.soil->bodies[0].pore_water = PoreWater::unified;
  options.coupling.mode = CouplingMode::unified;
  options.soil->water_density = 1000.0, options.soil->water_bulk_modulus = 2e9;
  options.flow = pond().flow;
  return options;
}

TEST(Doubts, EmptyPoresUnderOpenWater) {
  CaseOptions options = bed();
  EXPECT_TRUE(doubts(options).empty());
  for (const double foot : {0.5, 0.7}) {  // down to the bed only, and not even so far
    options.flow->bodies[0].shape.form = BoxShape{{0.0, -1.0, foot}, {10.0, 1.0, 1.0}};
    expect_doubt(options, {"sand", "empty", foot == 0.5 ? "0.5 m" : "0.7 m", "reach down"});
  }
  options.soil->bodies[0].filling.suction = 1000.0;  // whoever says how it is wetted knows
  EXPECT_TRUE(doubts(options).empty());
  options.soil->bodies[0].filling.suction = 0.0;
  FlowSolid plate;
  plate.name = "plate", plate.shape.form = BoxShape{{-1.0, -1.0, 0.5}, {11.0, 1.0, 0.6}};
  options.flow->solids.push_back(plate);
  EXPECT_TRUE(doubts(options).empty());
}

TEST(Doubts, GrainsThatKeepTheirVolumeInOneWater) {
  CaseOptions options = bed();
  std::get<MohrCoulombOptions>(options.soil->bodies[0].law).poisson_ratio = 0.49;
  expect_doubt(options, {"sand", "0.49", "0.2 to 0.3"});
  options = sand();
  std::get<MohrCoulombOptions>(options.soil->bodies[0].law).poisson_ratio = 0.49;
  EXPECT_TRUE(doubts(options).empty());  // total stresses
}

TEST(Doubts, BodiesInTonnesPerCubicMetre) {
  FreeSolid motion;
  motion.density = 2.4;
  CaseOptions options = pond();
  FlowSolid block;
  block.name = "block", block.shape.form = BoxShape{{1.0, -1.0, 0.5}, {2.0, 1.0, 0.9}};
  block.motion = motion;
  options.flow->solids.push_back(block);
  expect_doubt(options, {"block", "2.4 kg/m3", "2400"});
  motion.density = 2400.0;
  options.flow->solids[0].motion = motion;
  EXPECT_TRUE(doubts(options).empty());
}

TEST(Doubts, SolitaryWaveThatIsThereAlready) {
  CaseOptions options = pond();
  WaveZoneOptions zone = waves(1.0);
  zone.wave = SolitaryWave{0.2, -1.0};
  options.flow->waves.push_back(zone);
  expect_doubt(options, {"sea", "jolt", "crest = -6.83"});
  std::get<SolitaryWave>(options.flow->waves[0].wave).crest = -6.83;
  EXPECT_TRUE(doubts(options).empty());
}

TEST(Doubts, OpenWaterAtASideOfAnotherHead) {
  CaseOptions options = bed();
  GroundSideOptions side;
  side.name = "side", side.water = GroundSideWater::head, side.value = Varying(0.7);
  options.flow->ground_sides.push_back(side);
  expect_doubt(options, {"side", "head is 0.7 m", "stands at 1 m", "falls"});
  options.flow->ground_sides[0].value = Varying(1.05);
  EXPECT_TRUE(doubts(options).empty());
  options.flow->ground_sides[0].value = Varying(0.7);
  options.flow->ground_sides[0].to[2] = 0.5;  // of the ground alone
  EXPECT_TRUE(doubts(options).empty());
}

}  // namespace
}  // namespace mudlark
