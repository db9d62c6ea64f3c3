#include "input/case_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <vector>

#include "base/errors.hpp"

namespace mudlark {
namespace {

namespace fs = std::filesystem;

class CaseFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("mudlark-case-file-" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  CaseOptions read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const fs::path file = folder_ / "case.toml";
    std::ofstream(file) << text;
    return read_case(file, overrides);
  }
  std::string mistakes(const std::string& text, const std::vector<std::string>& overrides = {}) {
    try {
      read(text, overrides);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

const std::string wet_column = R"toml(title = "Column"
[domain]
upper = ["10 cm", 2.0]
cell_size = "5 cm"
gravity = "9.81 m/s2"
[domain.walls]
lower_z = "no-slip"
upper_z = "open"
[time]
end = "2 h"
courant = 0.25
[water]
bulk_modulus = "2.15e4 kPa"
[[water.body]]
shape = { difference = [ { box = { lower = [0, 0], upper = [0.1, 1.8] } }, { circle = { centre = [0.05, 1.5], radius = "1 cm" } } ] }
velocity = ["0.1*z", "0.3*x"]
[[soil]]
name = "column"
shape = { polygon = { corners = [[0, 0], [0.1, 0], [0.1, 1], [0, 1]] } }
porosity = 0.4
hydraulic_conductivity = "1e-4 cm/s"
law = { type = "linear-elastic", young_modulus = "1 MPa", poisson_ratio = 0.3, strain = "log" }
initial_stress = { type = "geostatic", lateral_coefficient = 0.5 }
initial_pore_pressure = "100*(1-z)"
[coupling]
mode = "surface"
mudline = "load-only"
[[load]]
name = "q"
pressure = { time = [0, "1 min"], value = [0, "400 kPa"] }
[[gauge]]
name = "top"
quantity = "settlement"
at = [0.05, 1.0]
every = "1 s"
)toml";

TEST_F(CaseFile, BecomesOptionsInSiUnits) {
  const CaseOptions options = read(wet_column);
  EXPECT_EQ(options.title, "Column");
  EXPECT_EQ(options.domain.cells[0], 2);
  EXPECT_EQ(options.domain.cells[1], 40);
  EXPECT_EQ(options.domain.gravity[1], -9.81);
  EXPECT_EQ(options.domain.walls[1][1], Wall::open);
  EXPECT_EQ(options.time.end, 7200.0);
  ASSERT_TRUE(options.flow && options.soil);
  EXPECT_EQ(options.flow->courant, 0.25);
  EXPECT_EQ(options.soil->courant, 0.25);
  EXPECT_EQ(options.soil->water_bulk_modulus, 2.15e7);
  EXPECT_DOUBLE_EQ(options.flow->bodies[0].velocity[0]({0, 0, 2.0}, 0.0), 0.2);
  EXPECT_DOUBLE_EQ(options.flow->bodies[0].velocity[2]({2.0, 0, 0}, 0.0), 0.6);
  const SoilBody& soil = options.soil->bodies.at(0);
  EXPECT_DOUBLE_EQ(soil.intrinsic_permeability, 1e-6 * 1.002e-3 / 9810.0);
  EXPECT_EQ(soil.strain, StrainMeasure::logarithmic);
  EXPECT_EQ(std::get<GeostaticStress>(soil.initial_stress).lateral_coefficient, 0.5);
  EXPECT_DOUBLE_EQ((*soil.initial_pore_pressure)({0, 0, 0.25}, 0.0), 75.0);
  EXPECT_DOUBLE_EQ(options.soil->loads[0].pressure({}, 30.0), 2e5);
  EXPECT_EQ(options.coupling.mudline, Mudline::load_only);
  EXPECT_EQ(options.gauges[0].at, (Point3{0.05, 0.0, 1.0}));
}

TEST_F(CaseFile, ResolvedInputReadsBackToTheSameInput) {
  const CaseOptions options = read(wet_column);
  const CaseOptions again = read(options.resolved_toml);
  EXPECT_EQ(again.resolved_toml, options.resolved_toml);
  EXPECT_EQ(again.soil->bodies[0].intrinsic_permeability,
            options.soil->bodies[0].intrinsic_permeability);
  EXPECT_EQ(again.soil->loads[0].pressure({}, 17.0), options.soil->loads[0].pressure({}, 17.0));
  EXPECT_EQ(again.domain.cells, options.domain.cells);
  EXPECT_NE(options.resolved_toml.find("initial_pore_pressure = \"100*(1-z)\"  # [Pa]"),
            std::string::npos);
}

TEST_F(CaseFile, ResolvedInputSaysDefaultsThatDependOnTheCase) {
  const CaseOptions options = read(R"([domain]
upper = [4, 2]
cells = [8, 8]
walls = { upper_z = "open" }
[water]
[[water.body]]
shape = { box = { lower = [0, 0], upper = [4, 1] } }
[[stage]]
name = "rest"
end = 1
[[stage]]
name = "run"
end = 2
damping = 0.2
[[soil]]
name = "bed"
shape = { box = { lower = [0, 0], upper = [4, 0.5] } }
porosity = 0.4
pore_water = "unified"
hydraulic_conductivity = 1e-4
initial_stress = "geostatic"
law = { type = "mohr-coulomb", young_modulus = 1e7, poisson_ratio = 0.3, friction_angle = 30 }
[[porous]]
name = "rubble"
shape = { box = { lower = [1, 0.5], upper = [2, 0.75] } }
porosity = 0.4
drag = { type = "ergun", grain_size = 0.1 }
[[boundary]]
name = "river"
side = "lower_x"
pore_water = { type = "head", head = 1 }
[coupling]
mode = "unified"
[soil_solver]
damping = 0.7
)");
  for (const char* words :
       {"relative_permeability = { type = \"power\", exponent = 3, residual_saturation = 0 }",
        "relative_permeability = { type = \"power\", exponent = 1, residual_saturation = 0 }",
        "[water.turbulence]\nmodel = \"none\"", "# lateral_coefficient = 0.5 of \"geostatic\"",
        "# grains: as [domain.walls] says", "# damping = 0.7, that of [soil_solver]",
        "# loads: all", "reset_displacements = false"})
    EXPECT_NE(options.resolved_toml.find(words), std::string::npos) << words;
  EXPECT_EQ(read(options.resolved_toml).resolved_toml, options.resolved_toml);
}

TEST_F(CaseFile, AbsorbingSidesSayTheirDashpots) {
  const CaseOptions options = read(R"([domain]
upper = [1, 1]
cells = [4, 4]
[time]
end = 1
[[soil]]
name = "ground"
shape = { box = { lower = [0, 0], upper = [1, 0.5] } }
porosity = 0.4
pore_water = "none"
law = { type = "linear-elastic", young_modulus = 1e7, poisson_ratio = 0.3 }
[[boundary]]
name = "base"
side = "lower_z"
grains = "absorbing"
)");
  EXPECT_EQ(options.soil->boundaries[0].grains, GrainSide::absorbing);
  EXPECT_NE(
      options.resolved_toml.find("grains = { type = \"absorbing\", normal = 1, tangential = 1 }"),
      std::string::npos);
  EXPECT_EQ(read(options.resolved_toml).resolved_toml, options.resolved_toml);
}

/// Half a heap beside a plane of symmetry, a bank that goes on behind the side, water over both.
TEST_F(CaseFile, GroundAndWaterMayReachOverSidesAndBottom) {
  const CaseOptions options = read(R"([domain]
upper = [4, 2]
cells = [16, 8]
[time]
end = 1
[water]
[[water.body]]
shape = { box = { lower = [-1, -1], upper = [5, 1.5] } }
[[soil]]
name = "heap"
shape = { circle = { centre = [0, 0], radius = 0.5 } }
porosity = 0.4
pore_water = "unified"
hydraulic_conductivity = 1e-4
law = { type = "linear-elastic", young_modulus = 1e7, poisson_ratio = 0.3 }
[[soil]]
name = "bank"
shape = { polygon = { corners = [[2, -1], [6, -1], [6, 1.8], [4.5, 1.8]] } }
porosity = 0.4
pore_water = "unified"
hydraulic_conductivity = 1e-4
law = { type = "linear-elastic", young_modulus = 1e7, poisson_ratio = 0.3 }
[coupling]
mode = "unified"
)");
  EXPECT_EQ(options.soil->bodies.size(), 2u);
  EXPECT_EQ(read(options.resolved_toml).resolved_toml, options.resolved_toml);
}

TEST_F(CaseFile, EveryShippedCaseIsValidAndReadsBack) {
  int count = 0;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(MUDLARK_SOURCE_DIR) / "cases")) {
    if (entry.path().extension() != ".toml") continue;
    const CaseOptions options = read_case(entry.path(), {});
    EXPECT_EQ(read(options.resolved_toml).resolved_toml, options.resolved_toml) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 7);
}

TEST_F(CaseFile, OverridesAreReadLikeTheFile) {
  const CaseOptions options =
      read(wet_column, {"soil.0.porosity=0.35", "soil.law.poisson_ratio=0.2", "time.end=2 s",
                        "domain.walls.upper_z=\"slip\"", "coupling.ramp=1 min", "title=Other"});
  EXPECT_EQ(options.soil->bodies[0].porosity, 0.35);
  EXPECT_EQ(std::get<LinearElasticOptions>(options.soil->bodies[0].law).poisson_ratio, 0.2);
  EXPECT_EQ(options.time.end, 2.0);
  EXPECT_EQ(options.domain.walls[1][1], Wall::slip);
  EXPECT_EQ(options.coupling.ramp, 60.0);
  EXPECT_EQ(options.title, "Other");
}

TEST_F(CaseFile, MistakesInOverridesNameTheOption) {
  const std::string text = mistakes(
      wet_column, {"soil.0.porosity=1.4", "soil.3.porosity=0.3", "tiem.end=3", "nonsense"});
  EXPECT_NE(text.find("--set soil.0.porosity=1.4: soil.porosity = 1.4 is not possible"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("--set soil.3.porosity=0.3: there is no 3 here"), std::string::npos) << text;
  EXPECT_NE(text.find("--set tiem.end=3: unknown key tiem. Did you mean time?"), std::string::npos)
      << text;
  EXPECT_NE(text.find("--set nonsense: not of the form key=value"), std::string::npos) << text;
}

TEST_F(CaseFile, AllMistakesAreReportedTogetherInTheOrderOfTheirLines) {
  const std::string text = mistakes(R"([domain]
upper = [1, 1]
cells = [4, 0]
[time]
end = -1
[[water.body]]
shape = { box = { lower = [0, 0], upper = [1, 2] } }
colour = "blue"
)");
  const std::size_t cells = text.find(":3: domain.cells"), end = text.find(":5: time.end = -1"),
                    shape = text.find(":7: water.body.shape"),
                    colour = text.find(":8: unknown key water.body.colour");
  EXPECT_LT(cells, end);
  EXPECT_LT(end, shape);
  EXPECT_LT(shape, colour);
  EXPECT_NE(colour, std::string::npos) << text;
}

/// What else belongs there, the type would say.
TEST_F(CaseFile, AWrongTypeOfABoundaryIsTheOnlyMistakeOfItsTable) {
  const auto lines = [&](const std::string& boundary) {
    const std::string text =
        mistakes(wet_column + "[[boundary]]\nname = \"side\"\nside = \"upper_x\"\n" + boundary);
    EXPECT_NE(text.find("is not possible"), std::string::npos) << text;
    EXPECT_EQ(text.find("unknown key"), std::string::npos) << text;
    EXPECT_NE(text.find("Did you mean"), std::string::npos) << text;
  };
  lines("pore_water = { type = \"haed\", head = 1.2 }\n");
  lines("grains = { type = \"moveng\", velocity = [0, 0], along = \"slip\" }\n");
}

TEST_F(CaseFile, SyntaxErrorsHaveLineAndColumn) {
  EXPECT_NE(mistakes("[domain]\nupper = [1, \n").find("case.toml:"), std::string::npos);
  EXPECT_NE(mistakes("a = 1\nb = = 2\n").find("case.toml:2:5: this is not valid TOML"),
            std::string::npos);
}

TEST_F(CaseFile, ThreeDimensionsHaveTheirOwnShapesWallsAndGravity) {
  const CaseOptions options = read(R"([domain]
dimension = 3
upper = [1, 2, 3]
cells = [4, 8, 12]
gravity = [0.1, 0, -9.8]
[domain.walls]
lower_y = "periodic"
upper_y = "periodic"
[time]
end = 1
[water]
[[water.body]]
shape = { union = [ { sphere = { centre = [0.5, 1, 1], radius = 0.2 } }, { cylinder = { from = [0.5, 0.5, 2], to = [0.5, 1.5, 2], radius = 0.1 } }, { polygon = { corners = [[0, 0], [1, 0], [1, 1]], bottom = 0, top = 0.5 } } ] }
)");
  EXPECT_EQ(options.domain.gravity[0], 0.1);
  EXPECT_EQ(options.domain.walls[1][0], Wall::periodic);
  EXPECT_TRUE(options.flow->bodies[0].shape.contains({0.9, 0.5, 0.2}));
  EXPECT_FALSE(options.flow->bodies[0].shape.contains({0.1, 0.5, 0.2}));
  EXPECT_EQ(read(options.resolved_toml).resolved_toml, options.resolved_toml);
}

TEST_F(CaseFile, PorousGroundTakesEachLawOfDrag) {
  const auto drag = [&](const std::string& law) {
    return read(R"([domain]
upper = [1, 1]
cells = [4, 4]
[time]
end = 1
[water]
viscosity = 1e-3
[[water.body]]
shape = { box = { lower = [0, 0], upper = [1, 0.5] } }
[[porous]]
name = "sill"
shape = { below = { line = [[0, 0.2], [1, 0.4]] } }
porosity = 0.5
drag = { )" + law +
                " }\n")
        .flow->porous.at(0);
  };
  EXPECT_DOUBLE_EQ(
      drag(R"(type = "darcy", hydraulic_conductivity = "1 cm/s")").intrinsic_permeability,
      1e-2 * 1e-3 / 9810.0);
  EXPECT_EQ(drag(R"(type = "darcy-forchheimer", intrinsic_permeability = 1e-9, forchheimer = 5e5)")
                .forchheimer,
            5e5);
  EXPECT_EQ(drag(R"(type = "ergun", grain_size = "2 cm")").grain_size, 0.02);
  const PorousGround ground =
      drag(R"(type = "van-gent", grain_size = 0.02, alpha = 200, keulegan_carpenter = 10)");
  EXPECT_EQ(ground.alpha, 200.0);
  EXPECT_EQ(ground.beta, 1.1);
  EXPECT_EQ(ground.keulegan_carpenter, 10.0);
}

}  // namespace
}  // namespace mudlark
