#pragma once
/// Text of the XDMF files (XDMF 2 model, see xdmf.org): which numbers of an HDF5 file are what.
#include <array>
#include <string>
#include <vector>

#include "output/output_series.hpp"

namespace mudlark {

/// Rectangular grid in space, axes x y z; `faces` of stretched axes, else empty. A 2D grid is shown
/// as a sheet of one cell from y = 0 on, in the x-z plane: ParaView 5.11 reads no cell values of a
/// grid without thickness.
struct XdmfGrid {
  std::array<double, 3> lower{}, spacing{};  ///< [m]
  std::array<int, 3> cells{};
  std::array<std::vector<double>, 3> faces;  ///< [m]
};

/// Cell values on a rectangular grid at several times.
std::string xdmf_of_fields(const std::string& data_file, const XdmfGrid& grid,
                           const std::vector<StoredOutput>& outputs);

/// Points with values at several times; each output has an array "position".
std::string xdmf_of_points(const std::string& data_file, const std::vector<StoredOutput>& outputs);

}  // namespace mudlark
