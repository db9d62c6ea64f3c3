#pragma once
/// Force and moment of the water on bodies.
#include <optional>

#include "flow/solid_bodies.hpp"

namespace mudlark {

struct SolidLoad {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N], N/m in the plane
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< about the body's centre [N m]
};

/// Pressure beside walls, taken from the centres of cells by its gradient.
template <int D>
class WallPressure {
 public:
  /// `unknown`: 1 in cells with a pressure; `room`: 0 in cells that are closed or joined to others;
  /// density [kg/m3]. Ghosts of all fields valid.
  WallPressure(const Grid<D>& grid, const CellField<D>& pressure, const CellField<D>& unknown,
               const CellField<D>& room, const CellField<D>& saturation, double density)
      : grid_(&grid),
        pressure_(&pressure),
        unknown_(&unknown),
        room_(&room),
        saturation_(&saturation),
        density_(density) {}

  /// Gradient in a cell with a pressure, from those neighbours that have one [Pa/m].
  Vec<D> gradient(const Index<D>& cell) const;
  /// That gradient where at() takes the pressure from [Pa/m].
  Vec<D> slope(const Index<D>& cell) const;
  /// Linear from the cell's centre [Pa]; a cell without a pressure takes it from the nearest
  /// neighbour that has one; without any it is zero.
  double at(const Index<D>& cell, const Vec<D>& place) const;
  /// Mean over a wall of the given height around a place in a cell where the surface may lie: there
  /// is no suction above it.
  double mean(const Index<D>& cell, const Vec<D>& place, double height) const;

  bool wet(const Index<D>& cell) const { return (*saturation_)[cell] > 0.5; }

 private:
  bool known(const Index<D>& cell) const { return (*unknown_)[cell] > 0.0; }
  std::optional<Index<D>> source(const Index<D>& cell) const;

  const Grid<D>* grid_;
  const CellField<D>*pressure_, *unknown_, *room_, *saturation_;
  double density_;
};

/// Sum over the cells of a body's surface of -p n, and of the shear on no-slip bodies; of what lies
/// in `part`, where given. `viscosity` is dynamic [Pa s]. With `ahead` [s] the body is where it
/// will be then, in the present water. Collective.
template <int D>
SolidLoad load_on(const Grid<D>& grid, const SolidBodies<D>& solids, std::size_t body,
                  const std::optional<BoxShape>& part, const WallPressure<D>& pressure,
                  const FaceVector<D>& velocity, double viscosity, double ahead = 0.0);

/// Adds the resistance of no-slip bodies per volume of water [Pa s/m2]: a linear profile between
/// the wall and the centre of the cut cell. `capacity` of cells.
template <int D>
void find_body_friction(const Grid<D>& grid, const SolidBodies<D>& solids,
                        const CellField<D>& capacity, double viscosity, FaceVector<D>& resistance);

extern template class WallPressure<2>;
extern template class WallPressure<3>;

}  // namespace mudlark
