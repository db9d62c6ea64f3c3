#pragma once
/// Closed sides of the domain that hold the grains of the ground and let its water through: given
/// pressures, seepage faces, given fluxes, and levels, which hold the open water over the ground as
/// well.
#include <limits>
#include <string>
#include <vector>

#include "base/pore_filling.hpp"
#include "base/varying.hpp"
#include "flow/part_of_side.hpp"
#include "grid/halo.hpp"

namespace mudlark {

/// pressure: of the water behind the side, in and out. head: of water at rest with a level, below
/// that level; above it a seepage face; of open water beside an upright side at every height.
/// seepage_face: water leaves at zero pressure, none comes in.
/// inflow: a flux into the ground.
enum class GroundSideWater { pressure, head, seepage_face, inflow };

/// What the water of the ground does at a part of a side.
struct GroundSideOptions : PartOfSide {
  GroundSideWater water = GroundSideWater::seepage_face;
  Varying value;  ///< pressure [Pa], level [m], or flux into the ground [m/s]
};

/// What water and grains bring to a step at the faces of sides, and what becomes of the water's
/// velocity and of its answer to pressure there.
template <int D>
struct WaterAtSides {
  double dt;                        ///< [s]
  const FaceVector<D>& capacity;    ///< theta_f [-]
  const FaceVector<D>& resistance;  ///< mu/kappa [Pa s/m2]
  const CellField<D>& water;        ///< free water W [-]
  const CellField<D>& room;         ///< its room [-]
  const CellField<D>& unknown;      ///< 1 in cells with a pressure
  const PoreFilling& filling;       ///< of pores that are not full
  FaceVector<D>& velocity;          ///< [m/s]
  FaceVector<D>& mobility;          ///< of the water at held grains [m2 s/kg]
  FaceVector<D>& flux_mobility;     ///< theta times that [m2 s/kg]
  FaceVector<D>& water_share;       ///< theta_f [-]
  FaceVector<D>& grain_velocity;    ///< zero on the sides [m/s]
  FaceVector<D>& grain_mobility;    ///< zero on the sides [m2 s/kg]
};

/// The pressure of a side stands half a cell before the first cell centre, and between them lies
/// ground like that of the cell: M_l dv/dt = theta (rho g - dp/dn) - theta^2 A v, A = mu/kappa. So
/// the side is a Dirichlet value of the one pressure. Open water is the same without A; its
/// momentum through the side is that behind it, as on open walls.
template <int D>
class GroundSides {
 public:
  GroundSides(const Grid<D>& grid, const std::vector<GroundSideOptions>& options, double density);

  /// Pressures at `time` [s] and the faces that pass: those with ground behind them (`ground`, 1 or
  /// 0), on seepage faces where the last pressure [Pa] drives water out. Fields with ghosts.
  /// Collective.
  void find(const CellField<D>& ground, const CellField<D>& pressure, const FaceVector<D>& capacity,
            double time);
  /// Puts the water's velocities into the faces of sides and behind, and into the cells behind what
  /// comes in.
  void apply(const CellField<D>& porosity, CellField<D>& water, FaceVector<D>& velocity) const;
  /// Sets the share of water in what comes in [-] on the faces of these sides.
  void add_inflow(FaceVector<D>& inflow) const;
  /// 1 on faces whose pressure is given.
  const FaceVector<D>& passes() const { return passes_; }

  /// The water's answer to pressure alone, before grains hold it [m2 s/kg].
  void note_mobility(const FaceVector<D>& mobility) { alone_.copy_values_from(mobility); }
  /// After the transport: momentum of open water goes on through the side. `water` in `porosity` as
  /// it has just moved.
  void carry_momentum(const CellField<D>& water, const CellField<D>& porosity,
                      const FaceVector<D>& velocity);
  /// Momentum of the water on faces whose grains are held, drag implicit, pressure apart.
  void move(const WaterAtSides<D>& at_sides) const;
  /// Gravity, for the pressure of water at rest.
  void weigh(FaceVector<D>& velocity) const;
  /// Adds what the given pressures do; the pressure solve takes them for zero.
  void push(const FaceVector<D>& mobility, const CellField<D>& unknown,
            FaceVector<D>& velocity) const;
  /// Velocities of the step that ends. Collective.
  void note_velocity(const FaceVector<D>& velocity);

  /// Where no pressure holds open water, at its surface, it passes as it moves inside: after the
  /// velocity was continued there. Collective.
  void follow_surface(const CellField<D>& unknown, const FaceVector<D>& velocity);

  /// Adds up what passed in a step of dt [s]: `carried` as a share of a cell's volume.
  void count(const FaceVector<D>& carried, double dt);
  /// Out of the domain through a part, mean over the last step [m^D/s]. Collective.
  double discharge(const std::string& name) const;

  template <class Archive>
  void archive(Archive& a) {
    a.faces("velocity on sides of the ground", through_);
    for (Side& side : sides_) {
      double all = sum_over_ranks(*grid_, side.discharge);
      a.number("discharge of side " + side.options.name, all);
      side.discharge = grid_->rank() == 0 ? all : 0.0;
    }
  }

 private:
  struct Side {
    GroundSideOptions options;
    double discharge = 0.0;    ///< of this rank, out of the domain [m^D/s]
    bool holds_level = false;  ///< of open water
  };
  /// What a face is at a time, from what is behind it.
  void find_face(const Side& side, std::ptrdiff_t at, const Index<D>& face, bool ground,
                 double pressure, double time);
  template <class Body>
  void for_each_face(const Side& side, bool owned, Body&& body) const;
  void fill_rows_behind_sides();
  /// From a face to the cell in the domain beside it, and to that cell's other face.
  std::ptrdiff_t inside(const Side& side) const;
  std::ptrdiff_t inner_face(const Side& side) const;
  bool comes_in(const Side& side, std::ptrdiff_t at) const;
  double gap(const Side& side) const;  ///< between the side and the first cell centre [m]

  const Grid<D>* grid_;
  Halo<D> halo_;
  double density_;
  std::vector<Side> sides_;
  FaceVector<D> passes_;
  FaceVector<D> two_ways_;  ///< 1 where water may also come in
  FaceVector<D> open_;      ///< 1 where open water is held at a level
  FaceVector<D> inflow_;    ///< share of water in what comes in [-]
  FaceVector<D> pressure_;  ///< [Pa]
  FaceVector<D> through_;   ///< velocity of the water through the sides [m/s]
  FaceVector<D> alone_;
};

extern template class GroundSides<2>;
extern template class GroundSides<3>;

}  // namespace mudlark
