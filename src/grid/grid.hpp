#pragma once
/// The one grid that water and soil share: rectangular, staggered (MAC), split over MPI ranks. Axes
/// may be stretched, for water alone: see Space for what that does to a cell.
#include <array>
#include <cstddef>
#include <vector>

#include "base/vec.hpp"
#include "grid/domain_options.hpp"
#include "parallel/partition.hpp"

namespace mudlark {

/// Layers of cells kept around each rank's box: neighbours' cells, or the mirror region behind a
/// wall.
inline constexpr int ghost_layers = 3;

/// Value type. Cell `c` spans lower + c*spacing .. lower + (c+1)*spacing on a uniform axis, between
/// the given faces on a stretched one; face `c` of axis `a` is the lower face of cell `c` along
/// `a`, so that axis has faces 0 .. cells[a] (the last one closes the domain and lies, on the last
/// rank, in the first ghost layer).
template <int D>
class Grid {
 public:
  /// Splits the domain over the ranks of `comm`. Throws InputError when the ranks are too many.
  Grid(const DomainOptions& options, MPI_Comm comm);

  const Index<D>& cells() const { return cells_; }
  const Vec<D>& lower() const { return lower_; }
  Vec<D> upper() const;
  const Vec<D>& spacing() const { return spacing_; }  ///< [m]; of stretched axes the mean
  const Vec<D>& gravity() const { return gravity_; }  ///< [m/s2]
  double cell_volume() const { return volume_; }      ///< [m^D], area in 2D; of mean cells
  double smallest_spacing() const;                    ///< [m]
  bool stretched(int axis) const { return !faces_[static_cast<std::size_t>(axis)].empty(); }
  bool stretched() const;
  /// Position of a face, size of a cell and distance between the centres of the cells beside a face
  /// along an axis, ghost layers included [m].
  double face_position(int axis, int face) const;
  double width(int axis, int cell) const;
  double gap(int axis, int face) const;
  Wall wall(int axis, int side) const {
    return walls_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)];
  }
  /// Coefficient of a friction wall [-].
  double wall_friction(int axis, int side) const {
    return wall_friction_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)];
  }
  bool periodic(int axis) const { return wall(axis, 0) == Wall::periodic; }
  MPI_Comm comm() const { return partition_.comm; }
  int rank() const { return partition_.rank; }
  int ranks() const { return partition_.size; }
  const Partition<D>& partition() const { return partition_; }

  /// Cells that this rank owns, and those with the ghost layers around them (the local arrays).
  const IndexBox<D>& owned() const { return partition_.owned; }
  const IndexBox<D>& local() const { return local_; }
  /// All cells of the domain.
  IndexBox<D> global() const { return {Index<D>{}, cells_}; }
  /// Faces of an axis for which this rank is responsible; each face of the domain has one owner.
  /// Without periodicity the last rank along the axis also owns the closing face.
  IndexBox<D> owned_faces(int axis) const;
  /// Does this rank's box touch the domain's wall on that side (never true on a periodic axis)?
  bool touches(int axis, int side) const;

  std::ptrdiff_t stride(int axis) const { return strides_[static_cast<std::size_t>(axis)]; }
  const std::array<std::ptrdiff_t, D>& strides() const { return strides_; }
  std::size_t local_size() const { return local_size_; }
  /// Position of an index in the local arrays.
  std::ptrdiff_t offset(const Index<D>& index) const {
    std::ptrdiff_t at = 0;
    for (int a = 0; a < D; ++a) at += (index[a] - local_.lower[a]) * stride(a);
    return at;
  }

  Vec<D> cell_centre(const Index<D>& cell) const;            ///< [m]
  Vec<D> face_centre(int axis, const Index<D>& face) const;  ///< [m]
  /// Index along an axis of a place in the local arrays.
  int index_along(int axis, std::ptrdiff_t at) const;
  /// Size along an axis of the cell at a place in the local arrays [m].
  double width_at(int axis, std::ptrdiff_t at) const {
    return stretched(axis) ? width(axis, index_along(axis, at)) : spacing_[axis];
  }
  /// Cell that holds a position; outside the domain the index lies outside global().
  Index<D> cell_at(const Vec<D>& position) const;

 private:
  Index<D> cells_;
  Vec<D> lower_, spacing_, gravity_;
  double volume_ = 1.0;
  std::array<std::vector<double>, D> faces_;  ///< of stretched axes, with the ghost layers
  std::array<std::array<Wall, 2>, D> walls_{};
  std::array<std::array<double, 2>, D> wall_friction_{};
  Partition<D> partition_;
  IndexBox<D> local_;
  std::array<std::ptrdiff_t, D> strides_{};
  std::size_t local_size_ = 1;
};

extern template class Grid<2>;
extern template class Grid<3>;

}  // namespace mudlark
