/// STL files: binary and text.
#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/errors.hpp"
#include "grid/triangle_mesh.hpp"
#include "input/sections.hpp"

namespace mudlark {
namespace {

constexpr std::size_t header_bytes = 84, triangle_bytes = 50;

/// 80 bytes of header, a count, and per triangle a normal, three corners (12 floats, little endian)
/// and two unused bytes. Nothing when the length does not fit.
std::vector<Triangle> read_binary(const std::string& bytes) {
  if (bytes.size() < header_bytes) return {};
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  if (count == 0 || bytes.size() < header_bytes + triangle_bytes * static_cast<std::size_t>(count))
    return {};
  std::vector<Triangle> triangles(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<float, 9> corners;
    std::memcpy(corners.data(), bytes.data() + header_bytes + triangle_bytes * i + 12,
                sizeof corners);
    for (std::size_t k = 0; k < 9; ++k)
      triangles[i][k / 3][k % 3] = static_cast<double>(corners[k]);
  }
  return triangles;
}

/// "vertex x y z" three times per facet; everything else is skipped.
std::vector<Triangle> read_text(const std::string& text) {
  std::vector<Triangle> triangles;
  std::istringstream words(text);
  std::size_t corner = 0;
  for (std::string word; words >> word;) {
    if (word != "vertex") continue;
    if (corner == 0) triangles.emplace_back();
    Point3& place = triangles.back()[corner];
    if (!(words >> place[0] >> place[1] >> place[2]))
      throw InputError(
          fmt::format("facet {}: three numbers are expected after \"vertex\"", triangles.size()));
    corner = (corner + 1) % 3;
  }
  if (corner != 0) throw InputError("the last facet has fewer than three corners");
  return triangles;
}

/// Throws InputError.
std::vector<Triangle> read_triangles(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  std::uint32_t count = 0;
  if (bytes.size() >= header_bytes) std::memcpy(&count, bytes.data() + 80, sizeof count);
  // Text begins with "solid", but so do the headers of some binary files: the length decides.
  const bool binary =
      bytes.size() == header_bytes + triangle_bytes * static_cast<std::size_t>(count);
  if (!binary && bytes.compare(0, 5, "solid") == 0) return read_text(bytes);
  std::vector<Triangle> triangles = read_binary(bytes);
  if (triangles.empty()) throw InputError("it is neither a text nor a complete binary STL file");
  return triangles;
}

}  // namespace

std::optional<Shape> read_stl(Section& shape) {
  const std::filesystem::path path = shape.file("stl", "an STL file", "\"hull.stl\"");
  const double scale =
      shape.number("scale", quantity::number,
                   positive("lengths of the file are multiplied by it, to metres"), 1.0);
  const auto offset = shape.numbers("offset", quantity::length, 3, std::vector<double>(3, 0.0));
  if (path.empty() || offset.size() != 3 || !(scale > 0.0)) return {};
  try {
    std::vector<Triangle> triangles = read_triangles(path);
    for (Triangle& triangle : triangles)
      for (Point3& corner : triangle)
        for (std::size_t a = 0; a < 3; ++a) corner[a] = scale * corner[a] + offset[a];
    return Shape{StlShape{std::make_shared<const TriangleMesh>(triangles)}};
  } catch (const InputError& error) {
    shape.fail("stl", error.what(), "Repair the mesh, for example in MeshLab or Blender.");
    return {};
  }
}

}  // namespace mudlark
