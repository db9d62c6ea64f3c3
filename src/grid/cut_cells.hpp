#pragma once
/// What rigid bodies leave of cells and faces, and where their surface lies in a cell.
///
/// The signed distance is taken at the corners of cells and is linear in between, on triangles or
/// tetrahedra around each centre: exact for planes, of second order for curved surfaces and at
/// edges. Shares of cells and faces belong to one closed polyhedron, so uniform pressure gives no
/// force on a body, and one cell thick in space is the same as the plane. What is thinner than a
/// cell may be missed.
#include <vector>

#include "grid/field.hpp"
#include "grid/rigid_pose.hpp"

namespace mudlark {

/// The surface of bodies in one cell.
template <int D>
struct CutCell {
  Index<D> cell;
  std::size_t body = 0;  ///< the nearest one
  Vec<D> area;           ///< integral of the normal out of the body [m^(D-1)]
  Vec<D> middle;         ///< centre of the surface [m]
  /// Per component of the normal: integral of it times the way from the middle [m^D]. Zero on a
  /// plane; where an edge lies in the cell, each of its sides has a centre of its own.
  std::array<Vec<D>, D> spread{};
};

template <int D>
class CutCells {
 public:
  explicit CutCells(const Grid<D>& grid);

  /// Finds everything anew for bodies where they are now. Behind closed walls lies the mirror
  /// image, across a periodic seam the other end.
  void find(const std::vector<RigidPose>& bodies);

  const CellField<D>& volume() const { return volume_; }       ///< open share of cells
  const FaceVector<D>& aperture() const { return aperture_; }  ///< 0 beside cells without volume
  /// Of the cells that this rank owns.
  const std::vector<CutCell<D>>& surface() const { return surface_; }
  /// The nearest surface, and whose it is; only bodies within `reach` [m] count.
  SurfaceDistance nearest(const std::vector<RigidPose>& bodies, const Point3& place, double reach,
                          std::size_t& body) const;

 private:
  double place_of(int axis, int twice) const;
  bool unseen(const SurfaceDistance& found, const Vec<D>& place, int axis, double outwards) const;
  double sample(const std::vector<RigidPose>& bodies, const Index<D>& twice) const;
  std::size_t node(const Index<D>& index) const;
  void sample_nodes(const std::vector<RigidPose>& bodies, const IndexBox<D>& box);
  void mirror_nodes();
  bool is_near(const Index<D>& cell, double& sign) const;
  double nonzero(double distance) const;
  void cut(const Index<D>& cell);
  double share_of_face(int axis, const Index<D>& face) const;
  Vec<D> open_centre(int axis, const Index<D>& face) const;
  void close_faces();
  void add_surface(const std::vector<RigidPose>& bodies, const Index<D>& cell);
  template <class Take>
  void for_each_simplex(const Index<D>& cell, Take&& take) const;

  const Grid<D>* grid_;
  double diagonal_, snap_;  ///< of a cell; what counts as on the surface [m]
  Index<D> nodes_;          ///< per axis, in the local box
  std::vector<double> distance_;
  CellField<D> volume_;
  FaceVector<D> aperture_, geometric_;  ///< geometric: before faces beside full cells are closed
  std::vector<CutCell<D>> surface_;
};

extern template class CutCells<2>;
extern template class CutCells<3>;

}  // namespace mudlark
