#pragma once
/// What holds for soil and its water at the sides of the domain, cell by cell.
#include <array>
#include <optional>
#include <vector>

#include "grid/field.hpp"
#include "soil/mirror.hpp"
#include "soil/side_options.hpp"

namespace mudlark {

/// What a component of motion behind a side owes to its mirror image before it:
///   grains     v(behind) = grain_sign v(before) + 2 velocity
///   seepage    w(behind) = flux_sign w(before) + (what `water` and `water_value` say)
struct SideNode {
  bool mirrored = true;  ///< else grains may go through: nothing is mirrored
  double grain_sign = 1.0, flux_sign = 1.0;
  double velocity = 0.0;         ///< of the side along the component, mean over the step [m/s]
  double velocity_before = 0.0;  ///< the same of the step before [m/s]
  WaterSide water = WaterSide::sealed;  ///< sealed, pressure or inflow
  /// Component along the side's normal: its pressure [Pa], or its flux along the axis [m/s]. Along
  /// the side: how its pressure grows along the component [Pa/m].
  double water_value = 0.0;
};

/// Joins the walls of the grid and the boundaries of the case. A part of a side holds for the cells
/// whose centres lie in it.
template <int D>
class SoilSides {
 public:
  /// `inertia`: factor on the masses of grains and water [-], SoilOptions::mass_scaling.
  SoilSides(const Grid<D>& grid, const std::vector<SoilBoundary>& boundaries, double water_density,
            double inertia);
  /// Only the walls of the grid.
  explicit SoilSides(const Grid<D>& grid) : SoilSides(grid, {}, 1000.0, 1.0) {}

  const Grid<D>& grid() const { return *grid_; }
  double water_density() const { return water_density_; }  ///< [kg/m3]
  double inertia() const { return inertia_; }
  void set_inertia(double factor) { inertia_ = factor; }

  /// Takes pressures, fluxes and motions of the step from `time` to `time + dt` [s].
  void update(double time, double dt);
  /// While soil comes to rest before time zero sides do not move, and absorbing ones are slip.
  void hold_still(bool still) { still_ = still; }
  bool holds_still() const { return still_; }

  /// For a component at an index; the coordinate along the side's axis does not matter.
  SideNode node(int axis, int side, int component, const Index<D>& index) const;
  /// The same wherever the side is one and nothing on it varies.
  const SideNode* plain(int axis, int side, int component) const;
  /// May grains go through somewhere?
  bool lets_through(int axis, int side) const;

  /// Of the cell at the side.
  GrainSide grains(int axis, int side, const Index<D>& cell) const;
  double friction(int axis, int side, const Index<D>& cell) const;
  const Absorber* absorber(int axis, int side, const Index<D>& cell) const;
  WaterSide water(int axis, int side, const Index<D>& cell) const;
  double water_value(int axis, int side, const Index<D>& cell) const;
  /// Pressure of a side opposite a position [Pa], straight between its cells and going on from the
  /// nearest one with a pressure for up to two cells; zero further away.
  double pressure_opposite(int axis, int side, const Vec<D>& position) const;

  bool has(GrainSide kind) const;
  bool has(WaterSide kind) const;

  const std::vector<SoilBoundary>& boundaries() const { return boundaries_; }
  /// Does a boundary say what holds for the pore water at a cell on its side?
  bool belongs_to(std::size_t boundary, const Index<D>& cell) const;

  /// The cell at the side that one beyond other sides is the image of; periodic ones stay where
  /// they are on this rank.
  Index<D> original_on_rank(int axis, int side, const Index<D>& cell) const;

  bool is_seepage_face(int axis, int side, const Index<D>& cell) const;
  /// Opens and closes seepage faces on a side: `open(cell)` of the cells next to it on this rank,
  /// ghosts included.
  void set_open(int axis, int side, const CellField<D>& open);

 private:
  static constexpr int walls = -1;  ///< part of a side that no boundary speaks of

  /// What holds at one cell of a side, now.
  struct Now {
    Vec<D> velocity{}, velocity_before{};
    double water = 0.0;  ///< pressure [Pa], or flux into the soil [m/s]
    Vec<D> slope{};      ///< of the pressure along the side [Pa/m]
    bool open = true;    ///< of a seepage face
  };
  struct Side {
    std::vector<int> grains, water;  ///< boundary per cell of this rank's part of the side
    std::vector<Index<D>> nearest;   ///< cell with a pressure, per cell
    std::vector<Now> now;
    bool varies = false;  ///< do parts or values differ from place to place?
    std::array<SideNode, D> plain;
  };
  const Side& at(int axis, int side) const {
    return sides_[static_cast<std::size_t>(2 * axis + side)];
  }
  Side& at(int axis, int side) { return sides_[static_cast<std::size_t>(2 * axis + side)]; }
  std::size_t place(int axis, const Index<D>& index) const;
  GrainSide kind_of(int axis, int side, int boundary) const;
  bool holds_along(int axis, int side, int boundary) const;
  WaterSide water_of(const Side& side, std::size_t place) const;
  Index<D> original(int axis, int side, Index<D> cell) const;
  Point3 centre_on_side(int axis, int side, Index<D> cell) const;
  void assign_parts(int axis, int side);
  void find_nearest(int axis, int side);
  bool has_pressure(const Side& side, std::size_t place) const;
  void update_side(int axis, int side, double time, double dt);
  void update_slopes(int axis, int side);

  const Grid<D>* grid_;
  std::vector<SoilBoundary> boundaries_;
  double water_density_, inertia_;
  bool still_ = false;
  std::array<Side, 2 * D> sides_;
};

/// Calls f(node, behind, before) for each pair of mirrored places of a component at both sides of
/// an axis.
template <int D, class F>
void for_each_image(const SoilSides<D>& sides, const IndexBox<D>& box, int axis, int component,
                    F&& f) {
  const Grid<D>& grid = sides.grid();
  const bool faces_of_axis = component == axis;
  for (int side = 0; side < 2; ++side) {
    if (!grid.touches(axis, side)) continue;
    if (const SideNode* plain = sides.plain(axis, side, component)) {
      if (plain->mirrored)
        for_each_mirror_pair(
            grid, box, axis, side, faces_of_axis,
            [&](const Index<D>& behind, const Index<D>& before) { f(*plain, behind, before); });
    } else {
      for_each_mirror_pair(grid, box, axis, side, faces_of_axis,
                           [&](const Index<D>& behind, const Index<D>& before) {
                             const SideNode node = sides.node(axis, side, component, before);
                             if (node.mirrored) f(node, behind, before);
                           });
    }
  }
}

/// Calls f(side, node, face) for each face on both sides of an axis that grains do not go through.
template <int D, class F>
void for_each_face_on_sides(const SoilSides<D>& sides, const IndexBox<D>& box, int axis, F&& f) {
  const Grid<D>& grid = sides.grid();
  for (int side = 0; side < 2; ++side) {
    if (!grid.touches(axis, side)) continue;
    IndexBox<D> faces = box;
    faces.lower[axis] = side == 0 ? 0 : grid.cells()[axis];
    faces.upper[axis] = faces.lower[axis] + 1;
    for_each(faces.intersected(box), [&](const Index<D>& face) {
      const SideNode node = sides.node(axis, side, axis, face);
      if (node.mirrored) f(side, node, face);
    });
  }
}

extern template class SoilSides<2>;
extern template class SoilSides<3>;

}  // namespace mudlark
