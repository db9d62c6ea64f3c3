#pragma once
/// Rain: water that falls on the ground, or on the water over it.
#include <limits>
#include <string>
#include <vector>

#include "base/varying.hpp"
#include "grid/halo.hpp"

namespace mudlark {

/// On the columns of cells whose centres lie between two places.
struct RainOptions {
  std::string name;
  Point3 from{-infinite, -infinite, 0.0}, to{infinite, infinite, 0.0};  ///< [m]
  Varying intensity;  ///< volume per area of the horizontal and time [m/s]

  static constexpr double infinite = std::numeric_limits<double>::infinity();
};

/// Each column gets its rain in its highest cell that is ground or at least half full of water, or
/// on top of it when that one has no room: rain seeps into ground that takes it and else stands and
/// runs on it. It comes with the velocity of what is there.
template <int D>
class Rain {
 public:
  Rain(const Grid<D>& grid, const std::vector<RainOptions>& options);

  bool empty() const { return rains_.empty(); }
  /// Adds the rain of a step of dt [s] from `time` on to the water in the room `porosity`. `ground`
  /// is 1 in the cells of the ground. Returns the volume that this rank added [m^D]. Collective.
  double fall(const CellField<D>& ground, const CellField<D>& porosity, double time, double dt,
              CellField<D>& water);

 private:
  std::size_t column(const Index<D>& cell) const;
  void find_targets(const CellField<D>& ground, const CellField<D>& porosity,
                    const CellField<D>& water);

  const Grid<D>* grid_;
  std::vector<RainOptions> rains_;
  std::vector<double> amounts_;  ///< of the columns in this step, as a share of a mean cell [-]
  std::vector<int> targets_;     ///< cells of the columns along the vertical that take it
};

extern template class Rain<2>;
extern template class Rain<3>;

}  // namespace mudlark
