#pragma once
/// Rigid bodies against each other and against the domain's closed sides.
#include <optional>
#include <vector>

#include "grid/grid.hpp"
#include "grid/solid.hpp"
#include "grid/surface_places.hpp"

namespace mudlark {

/// Free bodies do not go into closed sides of the domain nor into other bodies: where they touch,
/// the velocity must not point inwards faster than the gap allows. Collisions are inelastic, with
/// Coulomb's friction of the larger of the two coefficients; the impulses of all contacts are found
/// together by a projected Gauss-Seidel iteration (Moreau & Jean 1996, Engineering Systems Design
/// and Analysis 4). A body touches with places on its surface (surface_places). All ranks hold the
/// same bodies and find the same impulses.
class SolidCollisions {
 public:
  using Vector = Eigen::Vector3d;
  struct Body {
    const RigidPose* pose;
    RigidVelocity velocity;
    double friction;  ///< Coulomb's coefficient [-]
    Solid* free;      ///< none where the motion is given
  };

  /// Between bodies in water there must be room for it: they keep 1.25 cells from one another,
  /// for two surfaces in one are none, and half a cell from the sides. Those that start closer keep
  /// what they have. `start`: where the bodies are at time zero.
  template <int D>
  SolidCollisions(const Grid<D>& grid, bool in_water, const std::vector<RigidPose>& start);

  /// Corrects the velocities of the free bodies over a step of dt [s].
  void settle(const std::vector<Body>& bodies, double dt);
  void settle(std::vector<Solid>& solids, double dt);

 private:
  struct Side {
    int axis;
    double place, inward;  ///< [m], and +1 at a lower side, -1 at an upper one
    double friction, margin;
  };
  struct Contact {
    std::size_t body, other;  ///< other: a body, or, from the number of bodies on, a side
    Vector place, normal;     ///< towards `body`
    double approach;          ///< largest speed against the normal [m/s]
    double friction;
    double pressed = 0.0;           ///< impulse along the normal [N s]
    Vector along = Vector::Zero();  ///< and across it
  };

  void find_gaps(const std::vector<RigidPose>& start);
  void find_contacts(const std::vector<Body>& bodies, double dt);
  void keep_outermost(std::size_t first);
  template <class F>
  void for_each_touch(const std::vector<const RigidPose*>& poses, std::size_t body,
                      std::size_t other, double reach, F&& f) const;
  static std::optional<Vector> meets(const Body& other, const SurfacePlace& at,
                                     const Vector& velocity, const SurfaceDistance& away,
                                     double kept, double dt);
  double& gap(std::size_t body, std::size_t other) { return gaps_[body * others_ + other]; }
  bool relax(Contact& contact, const std::vector<Body>& bodies);
  void give(const Contact& contact, const Vector& impulse, const std::vector<Body>& bodies);
  Vector speed(const Contact& contact, const std::vector<Body>& bodies) const;
  double mobility(const Contact& contact, const Vector& way, const std::vector<Body>& bodies) const;

  std::vector<Side> sides_;
  double margin_ = 0.0;                             ///< between bodies [m]
  std::size_t others_ = 0;                          ///< bodies and sides
  std::vector<std::vector<SurfacePlace>> surface_;  ///< of each body where it starts
  std::vector<double> farthest_;                    ///< of them from the body's centre [m]
  std::vector<double> gaps_;                        ///< that bodies keep from the others [m]
  std::vector<Contact> contacts_;
  std::vector<RigidVelocity> now_;  ///< velocities of the iteration
  struct Load {
    Vector impulse = Vector::Zero(), moment = Vector::Zero();
  };
  std::vector<Load> loads_;
};

}  // namespace mudlark
