#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

#include "base/errors.hpp"
#include "grid/triangle_mesh.hpp"
#include "input/case_file.hpp"

namespace mudlark {
namespace {

namespace fs = std::filesystem;

/// A tetrahedron with three edges of 2 along the axes, volume 8/6.
const std::vector<std::array<std::array<float, 3>, 3>> tetrahedron{
    {{{0, 0, 0}, {0, 2, 0}, {2, 0, 0}}},
    {{{0, 0, 0}, {2, 0, 0}, {0, 0, 2}}},
    {{{0, 0, 0}, {0, 0, 2}, {0, 2, 0}}},
    {{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}}};

class Stl : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("mudlark-stl-" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write_text(std::size_t facets) const {
    std::ofstream file(folder_ / "body.stl");
    file << "solid body\n";
    for (std::size_t i = 0; i < facets; ++i) {
      file << "  facet normal 0 0 0\n    outer loop\n";
      for (const auto& corner : tetrahedron[i])
        file << "      vertex " << corner[0] << " " << corner[1] << " " << corner[2] << "\n";
      file << "    endloop\n  endfacet\n";
    }
    file << "endsolid body\n";
  }
  void write_binary() const {
    std::string bytes = "solid in the header, as some programs write";
    bytes.resize(84 + 50 * tetrahedron.size(), '\0');
    const auto count = static_cast<std::uint32_t>(tetrahedron.size());
    std::memcpy(bytes.data() + 80, &count, 4);
    for (std::size_t i = 0; i < tetrahedron.size(); ++i)
      std::memcpy(bytes.data() + 84 + 50 * i + 12, tetrahedron[i].data(), 36);
    std::ofstream(folder_ / "body.stl", std::ios::binary) << bytes;
  }
  /// The mesh of a soil with this shape; what is wrong is in `problem`.
  std::shared_ptr<const TriangleMesh> read(const std::string& shape, std::string& problem) const {
    std::ofstream(folder_ / "case.toml") << R"([domain]
dimension = 3
upper = [2, 2, 2]
cells = [4, 4, 4]
[time]
end = 1
[[soil]]
name = "body"
shape = )" + shape + R"(
porosity = 0
pore_water = "none"
law = { type = "linear-elastic", young_modulus = 1e6, poisson_ratio = 0.3 }
)";
    try {
      const CaseOptions options = read_case(folder_ / "case.toml", {});
      EXPECT_NE(options.resolved_toml.find((folder_ / "body.stl").string()), std::string::npos);
      return std::get<StlShape>(options.soil->bodies[0].shape.form).mesh;
    } catch (const InputError& error) {
      problem = error.what();
      return {};
    }
  }

  fs::path folder_;
};

TEST_F(Stl, FilesOfTextAndOfNumbersGiveTheSameBodyBesideTheCaseFile) {
  for (const bool binary : {false, true}) {
    if (binary)
      write_binary();
    else
      write_text(4);
    std::string problem;
    const auto mesh =
        read(R"({ stl = "body.stl", scale = 0.5, offset = [0.5, "25 cm", 0.0] })", problem);
    ASSERT_TRUE(mesh) << problem;
    EXPECT_NEAR(mesh->volume(), 1.0 / 6.0, 1e-12);
    EXPECT_DOUBLE_EQ(mesh->lower()[1], 0.25);
    EXPECT_TRUE(mesh->contains({0.7, 0.45, 0.2}));
    EXPECT_FALSE(mesh->contains({0.9, 0.85, 0.6}));
  }
}

TEST_F(Stl, OpenSurfacesAndForeignFilesAreRefused) {
  std::string problem;
  write_text(3);
  EXPECT_FALSE(read(R"({ stl = "body.stl" })", problem));
  EXPECT_NE(problem.find("not closed: 3 edges of a hole"), std::string::npos) << problem;
  std::ofstream(folder_ / "body.stl") << "no triangles here";
  EXPECT_FALSE(read(R"({ stl = "body.stl" })", problem));
  EXPECT_NE(problem.find("neither a text nor a complete binary"), std::string::npos) << problem;
  EXPECT_FALSE(read(R"({ stl = "nowhere.stl" })", problem));
  EXPECT_NE(problem.find("there is no such file"), std::string::npos) << problem;
  write_text(4);
  EXPECT_FALSE(read(R"({ stl = "body.stl", scale = 3 })", problem));
  EXPECT_NE(problem.find("over the domain's top"), std::string::npos) << problem;
}

}  // namespace
}  // namespace mudlark
