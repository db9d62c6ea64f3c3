#pragma once
/// Impermeable bodies in the water: where they are, what they leave of cells and faces, and what
/// water sees of them.
#include <functional>
#include <optional>

#include "flow/options.hpp"
#include "flow/porous_medium.hpp"
#include "grid/cut_cells.hpp"
#include "grid/solid.hpp"
#include "grid/solid_collisions.hpp"
#include "numerics/wall_band.hpp"

namespace mudlark {

/// A cell too small to stand alone: its room and its water belong to a neighbour.
template <int D>
struct JoinedCell {
  Index<D> cell, host;
};

template <int D>
class SolidBodies {
 public:
  /// In water of a density [kg/m3].
  SolidBodies(const Grid<D>& grid, const std::vector<FlowSolid>& options, double density);

  /// Whether a small cell keeps its faces beside a host.
  using MayStand = std::function<bool(const Index<D>& cell, const Index<D>& host)>;

  bool empty() const { return options_.empty(); }
  bool moving() const { return moving_; }
  bool no_slip() const { return no_slip_; }
  /// The longest part of `step` from `time` on in which no surface moves by more than a quarter of
  /// a cell: a body that passes a cell in a few steps hands its water on in as many parts [s].
  double limited_step(double time, double step) const;
  std::size_t size() const { return options_.size(); }
  const FlowSolid& options(std::size_t body) const { return options_[body]; }
  const RigidPose& pose(std::size_t body) const { return poses_[body]; }
  const RigidVelocity& velocity(std::size_t body) const { return velocities_[body]; }
  /// Of a place on a body [m/s].
  Vec<D> velocity_at(std::size_t body, const Vec<D>& place) const;
  /// The body of that name, if there is one.
  std::optional<std::size_t> find(const std::string& name) const;

  /// Moves the bodies over a step [s]; free ones with the velocity that the water's flux has at its
  /// start, so it makes the room that they take; then they have that of follow().
  void move(double time, double dt);
  /// Free bodies take the velocity of others with their names, and leave it to them from then on.
  void follow(const std::vector<Solid>& leaders);
  /// Puts free bodies with the same names where they will be after a step of dt [s], with the
  /// velocity that the water's flux has now.
  void lead(std::vector<Solid>& leaders, double dt) const;
  /// Free bodies that nothing else drives.
  std::vector<Solid>& free() { return free_; }
  /// Corrects their velocities where they touch a side or another body, for a step of dt [s] from
  /// `time` on.
  void collide(double time, double dt);
  /// Of sides and other bodies in the last step [N].
  Eigen::Vector3d collision_force(std::size_t body) const;
  /// Room that the bodies leave where they are now, and the volume flux of those that move. Cells
  /// too small for water to pass within a step are joined to others, or, where `stands` says so,
  /// keep their faces and the pressure (docs/decisions/0097).
  void fill(PorousMedium<D>& medium, const MayStand& stands);
  /// Those that stand now have room of their own: after fill() of a state just loaded.
  void begin();

  const std::vector<CutCell<D>>& surface() const { return cut_.surface(); }
  /// Share of each cell that is no body, before small cells are joined to others.
  const CellField<D>& open_volume() const { return cut_.volume(); }
  WallBand<D>& walls() { return walls_; }
  const WallBand<D>& walls() const { return walls_; }

  /// After bodies moved: cells that became too small hand their room and water to their hosts, and
  /// those that are no longer take theirs back; small ones that stand alone share anew with theirs.
  /// Volume stays to the last bit but round-off. Throws
  /// DivergenceError when water is shut in.
  void regroup(const Space<D>& space, CellField<D>& capacity, CellField<D>& water);

  template <class Archive>
  void archive(Archive& a) {
    for (std::size_t b = 0; b < poses_.size(); ++b) {
      const std::string at = "solid in water/" + options_[b].name + "/";
      poses_[b].archive(a, at);
      for (int i = 0; i < 3; ++i) {
        a.number(at + "velocity " + std::to_string(i), velocities_[b].velocity[i]);
        a.number(at + "spin " + std::to_string(i), velocities_[b].spin[i]);
        a.number(at + "next velocity " + std::to_string(i), next_[b].velocity[i]);
        a.number(at + "next spin " + std::to_string(i), next_[b].spin[i]);
      }
    }
    for (Solid& solid : free_) solid.archive(a);
  }

 private:
  void find_standing(const MayStand& stands);
  template <class Body>
  void for_each_standing(Body&& body) const;
  void join_small_cells(Space<D>& space);
  bool is_inside(const Index<D>& cell) const;
  std::optional<Index<D>> host_of(const Index<D>& cell) const;
  void close_lone_cells(Space<D>& space);
  void close_faces(Space<D>& space) const;
  void find_flux(FaceVector<D>& flux) const;
  void hand_on_flux(const JoinedCell<D>& joined, FaceVector<D>& flux) const;
  void check_shut_in(const Space<D>& space, CellField<D>& capacity,
                     const CellField<D>& water) const;

  const Grid<D>* grid_;
  std::vector<FlowSolid> options_;
  std::vector<RigidPose> poses_;
  std::vector<RigidVelocity> velocities_;
  std::vector<RigidVelocity> next_;  ///< of free bodies, for the water's flux of the coming step
  std::vector<Solid> free_;
  std::optional<SolidCollisions> collisions_;  ///< of them
  bool moving_ = false, no_slip_ = false;
  Space<D> open_;  ///< without bodies
  CutCells<D> cut_;
  CellField<D> stands_;  ///< 1 in small cells that stand alone
  WallBand<D> walls_;
  Ghosts<D> ghosts_;
  std::vector<JoinedCell<D>> joined_, joined_before_;
};

extern template class SolidBodies<2>;
extern template class SolidBodies<3>;

}  // namespace mudlark
