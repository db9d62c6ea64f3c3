#pragma once
/// The points' part of an implicit step: stresses at trial displacements, residual and tangent.
#include <Eigen/Core>

#include "soil/implicit_step.hpp"
#include "soil/implicit_tangent.hpp"
#include "soil/kinematics.hpp"

namespace mudlark {

template <int D>
class ImplicitPoints {
 public:
  explicit ImplicitPoints(const ImplicitProblem<D>& problem);

  /// Stress of all points at displacements; with `tangents` also how it changes with the gradient.
  /// False when a law fails or a point turns inside out.
  bool evaluate(const ImplicitFields<D>& state, bool tangents);
  /// Unbalanced forces on grains and water [N] and volume of water that came in, times a stiffness
  /// per length [N], of the last evaluation.
  void add_residual(const ImplicitFields<D>& state, ImplicitFields<D>& sums) const;
  /// The points of all bodies, linearised about the last evaluation with tangents.
  const std::vector<LinearPoint<D>>& linear() const { return linear_; }
  /// What the balance of water is multiplied by [Pa/m].
  double water_scale() const { return water_scale_; }
  /// The point of this rank that the last evaluation failed at, in words; empty if it did not.
  const std::string& failure() const { return failure_; }
  /// Forces below this are round-off [N].
  double smallest_residual() const;
  /// Takes the last evaluation over into the points.
  void finish(const ImplicitFields<D>& state, ImplicitOutcome& outcome);

 private:
  static constexpr int G = D * D;
  using Gradient = typename LinearPoint<D>::Gradient;

  /// One body's points.
  struct Body {
    std::vector<double> gradient;                   ///< of the displacement, G per point
    std::vector<double> pressure;                   ///< pore pressure at the end [Pa]
    std::vector<double> load, drained;              ///< surface pressures at the points [Pa]
    std::vector<Vec<D>> load_slope, drained_slope;  ///< and their gradients [Pa/m]
    SoilParticles<D> trial;                         ///< with the stress at the end
    std::vector<Gradient> stress;    ///< first Piola-Kirchhoff, total plus surface pressure [Pa]
    std::vector<Gradient> cofactor;  ///< J F^-T [-]
  };
  /// What one point knows of its own share of the problem.
  struct Share {
    double volume, mass, porosity, drag;
    bool wet;
  };
  template <class K>
  void interpolate(std::size_t b, const ImplicitFields<D>& state);
  template <class K>
  void sample_loads(std::size_t b);
  template <class K>
  void scatter(std::size_t b, const ImplicitFields<D>& state, ImplicitFields<D>& sums) const;
  bool difference_stress(std::size_t b, LinearPoint<D>* linear);
  bool update_stress(std::size_t b, const std::vector<double>& gradient,
                     std::vector<Gradient>& stress, std::vector<Gradient>* cofactor);
  Share share(std::size_t b, std::size_t p) const;

  const ImplicitProblem<D>* problem_;
  std::vector<Body> bodies_;
  std::vector<LinearPoint<D>> linear_;
  std::string failure_;
  double water_scale_ = 1.0;  ///< [Pa/m], makes volumes of water forces
};

extern template class ImplicitPoints<2>;
extern template class ImplicitPoints<3>;

}  // namespace mudlark
