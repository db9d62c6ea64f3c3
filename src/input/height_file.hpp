#pragma once
/// Files of ground heights: comma-separated values, and ESRI ASCII grids.
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace mudlark {

/// Heights as the file has them, in its own units and coordinates.
struct HeightFile {
  std::vector<double> x, y;  ///< ascending; y is empty for a line
  /// Along the line, or row after row, x fastest; NaN where the file has none.
  std::vector<double> heights;
  std::array<std::string, 3> units{};  ///< of x, y, z, where the header says so: "x [cm]"
};

/// A line: columns x, z in the order of growing x (or named so in a header). Otherwise columns x,
/// y, z of a rectangular lattice in any order, or an ESRI ASCII grid, which begins with `ncols`.
/// Throws InputError with the name of the file and the line.
HeightFile read_height_file(const std::filesystem::path& file, bool line);

}  // namespace mudlark
