#pragma once
/// Waves made inside the water: a region where water wells up and sinks as a wave carries it.
#include <memory>
#include <string>
#include <vector>

#include "flow/wave_zone.hpp"
#include "grid/shape.hpp"

namespace mudlark {

/// A box under water. The wave goes to both sides of it along its axis.
struct WaveSourceOptions {
  WaveZoneOptions wave;  ///< its outer end is the middle of the box
  BoxShape box;
};

/// Internal source of Lin & Liu (1999), J. Waterw. Port Coast. Ocean Eng. 125: div v = s =
/// 2 q(t)/A in the box, A its area in the plane of the wave and q what the wave carries through a
/// section, c eta; a sea the sum of that of its components. Where the water's cells hold s, they
/// gain s dt of water in each step, so they stay full.
template <int D>
class WaveSources {
 public:
  WaveSources(const Grid<D>& grid, const std::vector<WaveSourceOptions>& options);

  bool empty() const { return sources_.empty(); }
  /// Adds s at `time` [s] to the divergence that the water's flux must have, per volume of a mean
  /// cell [1/s].
  void add(double time, CellField<D>& target) const;
  /// Gives the cells of the sources back what a velocity with that divergence carried out of them
  /// in dt [s]: `room` is their transported porosity. Cells marked `loose` have no pressure and
  /// take no part. Returns the volume that this rank added [m^D].
  double refill(double time, double dt, const CellField<D>& loose, CellField<D>& room) const;

 private:
  struct Source {
    WaveZoneOptions wave;
    std::unique_ptr<const WaveMotion> motion;
    std::vector<std::ptrdiff_t> cells;
    std::vector<double> shares;  ///< of the box in the cell, per volume of a mean cell [-]
    double area = 0.0;           ///< of the box in the plane of the wave [m2]
  };
  double strength(const Source& source, double time) const;

  const Grid<D>* grid_;
  std::vector<Source> sources_;
};

extern template class WaveSources<2>;
extern template class WaveSources<3>;

}  // namespace mudlark
