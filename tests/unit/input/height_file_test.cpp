#include "input/height_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "base/errors.hpp"
#include "input/case_file.hpp"

namespace mudlark {
namespace {

namespace fs = std::filesystem;

class HeightFileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("mudlark-heights-" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& text, const std::string& name = "bed.txt") {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  HeightFile read(const std::string& text, bool line = false) {
    return read_height_file(write(text), line);
  }
  /// The message behind the name of the file.
  std::string mistake(const std::string& text, bool line = false) {
    try {
      read(text, line);
    } catch (const InputError& error) {
      const std::string all = error.what(), name = (folder_ / "bed.txt").string();
      EXPECT_TRUE(all.starts_with(name)) << all;
      return all.substr(name.size());
    }
    return "";
  }
  /// The shape of the only soil of a case, or the mistakes.
  std::variant<Shape, std::string> shape(const std::string& shape, int dimension,
                                         const std::string& more = "") {
    const std::string upper = dimension == 2 ? "[10, 5]" : "[10, 6, 5]";
    const std::string cells = dimension == 2 ? "[10, 5]" : "[10, 6, 5]";
    write("[domain]\ndimension = " + std::to_string(dimension) + "\nupper = " + upper +
              "\ncells = " + cells + "\n[time]\nend = 1\n[[soil]]\nname = \"s\"\nshape = " + shape +
              "\nporosity = 0.4\npore_water = \"none\"\n" + more +
              "law = { type = \"linear-elastic\", young_modulus = 1e6, poisson_ratio = 0.3 }\n",
          "case.toml");
    try {
      const CaseOptions options = read_case(folder_ / "case.toml", {});
      points_per_cell_ = options.soil->bodies[0].points_per_cell;
      // What is written down as resolved is the same case.
      write(options.resolved_toml, "again.toml");
      EXPECT_EQ(read_case(folder_ / "again.toml", {}).resolved_toml, options.resolved_toml);
      return options.soil->bodies[0].shape;
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  }
  Shape good(const std::string& text, int dimension, const std::string& more = "") {
    auto result = shape(text, dimension, more);
    if (auto* problem = std::get_if<std::string>(&result)) ADD_FAILURE() << *problem;
    return std::get<Shape>(result);
  }
  std::string bad(const std::string& text, int dimension, const std::string& more = "") {
    auto result = shape(text, dimension, more);
    return std::holds_alternative<std::string>(result) ? std::get<std::string>(result) : "";
  }

  fs::path folder_;
  int points_per_cell_ = 0;
};

const std::string grid = R"(ncols 3
nrows 2
xllcorner 100
yllcorner 200
cellsize 2
NODATA_value -99
1 2 3
4 -99
6
)";

TEST_F(HeightFileTest, ReadsAnEsriGridFromNorthToSouthWithHeightsAmidItsCells) {
  const HeightFile file = read(grid);
  EXPECT_EQ(file.x, (std::vector<double>{101.0, 103.0, 105.0}));
  EXPECT_EQ(file.y, (std::vector<double>{201.0, 203.0}));
  EXPECT_EQ(file.heights[0], 4.0);  // the southern row
  EXPECT_TRUE(std::isnan(file.heights[1]));
  EXPECT_EQ(file.heights[5], 3.0);
  const HeightFile centred =
      read("NCOLS 2\nNROWS 2\nXLLCENTER 0\nYLLCENTER -1\nCELLSIZE 0.5\n1 2\n3 -9999\n");
  EXPECT_EQ(centred.x, (std::vector<double>{0.0, 0.5}));
  EXPECT_EQ(centred.y, (std::vector<double>{-1.0, -0.5}));
  EXPECT_EQ(centred.heights[0], 3.0);
  EXPECT_TRUE(std::isnan(centred.heights[1])) << "-9999 is the custom";
}

TEST_F(HeightFileTest, ReadsALatticeInAnyOrderAndALine) {
  const HeightFile file = read("# survey\ny [m];z [cm];x [km]\n0;10;1\n0;20;2\n5;nan;2\n5;40;1\n");
  EXPECT_EQ(file.x, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(file.y, (std::vector<double>{0.0, 5.0}));
  EXPECT_EQ(file.heights[0], 10.0);
  EXPECT_EQ(file.heights[2], 40.0);
  EXPECT_TRUE(std::isnan(file.heights[3]));
  EXPECT_EQ(file.units, (std::array<std::string, 3>{"km", "m", "cm"}));
  const HeightFile line = read("0 1.5\n2 1\n7 3\n", true);
  EXPECT_EQ(line.x, (std::vector<double>{0.0, 2.0, 7.0}));
  EXPECT_EQ(line.heights, (std::vector<double>{1.5, 1.0, 3.0}));
  EXPECT_TRUE(std::isnan(read("0,0,1\n1,0,2\n0,1,3\n").heights[3])) << "no line for this place";
}

TEST_F(HeightFileTest, SaysWhereABrokenFileIsBroken) {
  EXPECT_EQ(mistake(""), ": it is empty");
  EXPECT_EQ(mistake("ncols 3\nnrows 2\ncellsize 1\n1 2 3\n").substr(0, 3), ":4:");
  EXPECT_EQ(mistake("ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n4 5\n"),
            ":7: the file ends after 5 of 3 x 2 heights");
  EXPECT_EQ(mistake("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4 5\n"),
            ":7: more than 2 x 2 heights");
  EXPECT_EQ(mistake("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 four\n"),
            ":7: \"four\" is not a number");
  EXPECT_EQ(mistake("ncols 2\nnrwos 2\n").substr(0, 12), ":2: \"nrwos\" ");
  EXPECT_EQ(mistake("ncols 2.5\nnrows 2\n1 2\n").substr(0, 3), ":3:");
  EXPECT_EQ(mistake("0,0,1\n1,0,2\n0,0,3\n1,1,3\n"), ":3: line 1 has a height for this place, too");
  EXPECT_EQ(mistake("0,0,1\n1,0\n"), ":2: column 3 (z) is missing");
  EXPECT_EQ(mistake("x,y,h\n0,0,1\n"), ":1: there is no column \"z\" in this line, the header");
  EXPECT_EQ(mistake("0,0,1\n1,1,2\n2,2,3\n3,3,4\n4,4,5\n"),
            ": the places are no lattice: 5 different x and 5 different y, but 5 heights");
  EXPECT_EQ(mistake("0,0,1\n1,0,2\n"),
            ": a ground in space needs heights at two places along x and along y");
  EXPECT_EQ(mistake("0,1\n2,1\n2,3\n", true).substr(0, 3), ":3:");
  EXPECT_EQ(mistake("0,1\n2,\n", true), ":2: \"\" is not a number");
  EXPECT_EQ(mistake(grid, true).substr(0, 3), ":1:");
}

TEST_F(HeightFileTest, MakesGroundsOfACase) {
  write("x [m],z [cm]\n-5,100\n5,300\n25,300\n", "line.csv");
  const Shape line = good("{ below = { file = \"line.csv\" } }", 2);
  EXPECT_TRUE(line.contains({2.5, 0.0, 2.49}));
  EXPECT_FALSE(line.contains({2.5, 0.0, 2.51}));
  write("0,0,1\n10,0,3\n0,6,2\n10,6,nan\n", "map.csv");
  const Shape map = good("{ below = { file = \"map.csv\", missing_height = 4.0 } }", 3);
  EXPECT_TRUE(map.contains({5.0, 3.0, 2.49}));
  EXPECT_FALSE(map.contains({5.0, 3.0, 2.51}));
  // Survey of a larger place, in centimetres and other coordinates; its mountain lies outside.
  write(
      "ncols 4\nnrows 2\nxllcorner 100000\nyllcorner 200000\ncellsize 1000\n100 200 200 90000\n"
      "100 200 200 90000\n",
      "survey.asc");
  const Shape survey =
      good("{ below = { file = \"survey.asc\", scale = 0.01, offset = [-1010, -2005, 0.5] } }", 3);
  EXPECT_TRUE(survey.contains({0.0, 3.0, 1.99}));
  EXPECT_FALSE(survey.contains({0.0, 3.0, 2.01}));
  EXPECT_TRUE(survey.contains({5.0, 3.0, 2.49}));
  EXPECT_FALSE(survey.contains({5.0, 3.0, 2.51}));
}

TEST_F(HeightFileTest, MakesLayersAndWhatLiesAboveAGround) {
  const Shape layer = good(
      "{ between = { upper = { line = [[0, 3], [10, 4]] }, lower = { line = [[0, 1]] } } }", 2);
  EXPECT_TRUE(layer.contains({5.0, 0.0, 3.4}));
  EXPECT_TRUE(layer.contains({5.0, 0.0, 1.1}));
  EXPECT_FALSE(layer.contains({5.0, 0.0, 3.6}));
  EXPECT_FALSE(layer.contains({5.0, 0.0, 0.9}));
  const Shape above = good("{ above = { line = [[0, 3], [10, 4]] } }", 2);
  EXPECT_TRUE(above.contains({5.0, 0.0, 3.6}));
  EXPECT_FALSE(above.contains({5.0, 0.0, 3.4}));
  EXPECT_NE(bad("{ between = { upper = { line = [[0, 1]] }, lower = { line = [[0, 3]] } } }", 2)
                .find("nothing is between them"),
            std::string::npos);
  EXPECT_NE(bad("{ between = { upper = { line = [[0, 1]] } } }", 2).find("lower is missing"),
            std::string::npos);
}

TEST_F(HeightFileTest, AsksForHeightsThatTheDomainNeeds) {
  write("0,0,1\n10,0,3\n0,6,2\n10,6,nan\n20,0,nan\n20,6,nan\n", "map.csv");
  EXPECT_NE(bad("{ below = { file = \"map.csv\" } }", 3).find("the height at (10, 6) m is missing"),
            std::string::npos);
  write("0,0,1\n10,0,3\n0,6,2\n10,6,3\n20,0,nan\n20,6,nan\n", "map.csv");
  good("{ below = { file = \"map.csv\" } }", 3);
  EXPECT_NE(bad("{ below = { file = \"nowhere.csv\" } }", 3).find("no such file"),
            std::string::npos);
  EXPECT_NE(bad("{ below = { line = [[0, 1]], scale = 2 } }", 2).find("for a file of heights"),
            std::string::npos);
}

TEST_F(HeightFileTest, PointsStandNoFartherApartThanASpacingAsksFor) {
  const std::string box = "{ box = { lower = [0, 0], upper = [10, 1] } }";
  good(box, 2, "point_spacing = 0.3\n");
  EXPECT_EQ(points_per_cell_, 16);
  good(box, 2, "point_spacing = \"50 cm\"\n");
  EXPECT_EQ(points_per_cell_, 4);
  EXPECT_NE(bad(box, 2, "point_spacing = 0.1\n").find("2 to 6 points"), std::string::npos);
  EXPECT_NE(bad(box, 2, "point_spacing = 0.3\npoints_per_cell = 9\n").find("point_spacing says"),
            std::string::npos);
}

}  // namespace
}  // namespace mudlark
