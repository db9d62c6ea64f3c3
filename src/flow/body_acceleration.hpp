#pragma once
/// A given acceleration of all water, beside gravity: a tank that is shaken, seen from the tank.
#include <optional>

#include "flow/options.hpp"
#include "grid/field.hpp"

namespace mudlark {

template <int D>
class BodyAcceleration {
 public:
  BodyAcceleration(const Grid<D>& grid, const FlowOptions& options);

  bool given() const { return given_.has_value(); }
  /// Adds the acceleration along an axis at a time [s] to `out` [m/s2], on bounding faces.
  void add(int axis, double time, FaceField<D>& out) const;
  /// Largest size of it among the faces at a time [m/s2]; 0 when the case gives none. Collective.
  double largest(double time) const;

 private:
  template <class Body>
  void for_each_value(int axis, double time, Body&& body) const;

  const Grid<D>* grid_;
  std::optional<std::array<Varying, 3>> given_;
};

extern template class BodyAcceleration<2>;
extern template class BodyAcceleration<3>;

}  // namespace mudlark
