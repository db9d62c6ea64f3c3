#pragma once
/// Axes whose cells are fine in some regions and grow away from them.
#include <vector>

namespace mudlark {

/// Cells of `size` between `from` and `to`; away from there each cell is at most `growth` times its
/// neighbour, up to the size of the rest.
struct Refinement {
  double from = 0.0, to = 0.0;  ///< [m]
  double size = 0.0;            ///< [m]
  double growth = 1.1;          ///< ratio of neighbouring cells, above 1
};

/// Positions of the faces of an axis from `lower` to `upper` [m], both ends included. The ends of
/// every region are faces. Between them the wanted size h(x) = min(coarse, size + ln(growth)
/// distance) over the regions is met exactly where it is fine, and the number of cells is rounded
/// up by growing a little less. Regions must lie inside the axis and not overlap; a region smaller
/// than its cell size gets one cell.
std::vector<double> graded_faces(double lower, double upper, double coarse,
                                 std::vector<Refinement> regions);

}  // namespace mudlark
