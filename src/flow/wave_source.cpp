#include "flow/wave_source.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "grid/halo.hpp"
#include "numerics/loops.hpp"

namespace mudlark {
namespace {

/// What makes a source of the wave's own flux into one of the wave's height, to first order: u of
/// both is split into the modes of the water's depth, and the wave gets the share that the box has
/// of cosh k(z+d), over that which the wave itself has. A box of finite width loses
/// sin(kw/2)/(kw/2). k is that of the wave, of a sea that of its peak.
double mode_factor(const WaveZoneOptions& wave, const BoxShape& box, double length) {
  if (std::holds_alternative<SolitaryWave>(wave.wave) ||
      std::holds_alternative<GivenWave>(wave.wave))
    return 1.0;  // long: the same at all depths
  const auto axis = static_cast<std::size_t>(wave.axis);
  const double k = 2.0 * std::numbers::pi / length, d = wave.depth, bed = wave.still_level - d;
  const double low = std::max(box.lower[2] - bed, 0.0), high = box.upper[2] - bed;
  const double of_box = (std::sinh(k * high) - std::sinh(k * low)) / (k * (high - low));
  const double of_wave = (0.5 * d + 0.25 * std::sinh(2.0 * k * d) / k) / (std::sinh(k * d) / k);
  const double half = 0.5 * k * (box.upper[axis] - box.lower[axis]);
  return of_wave / of_box * half / std::sin(half);
}

}  // namespace

template <int D>
WaveSources<D>::WaveSources(const Grid<D>& grid, const std::vector<WaveSourceOptions>& options)
    : grid_(&grid) {
  const double gravity = std::max(-grid.gravity()[D - 1], 1e-300);
  for (const WaveSourceOptions& given : options) {
    Source source{given.wave, make_wave(given.wave, gravity), {}, {}, 0.0};
    double volume = 0.0;
    for_each(grid.owned(), [&](const Index<D>& cell) {
      const Vec<D> centre = grid.cell_centre(cell);
      Vec<D> half;
      double size = 1.0;
      for (int a = 0; a < D; ++a) {
        half[a] = 0.5 * grid.width(a, cell[a]);
        size *= grid.width(a, cell[a]) / grid.spacing()[a];
      }
      const double share =
          fraction_inside(Shape{given.box}, to_point3(centre - half), to_point3(centre + half), D);
      if (share <= 0.0) return;
      source.cells.push_back(grid.offset(cell));
      source.shares.push_back(share * size);
      volume += share * size;
    });
    double across = 1.0;  // extent of the box along the crests
    if constexpr (D == 3) {
      const auto a = static_cast<std::size_t>(1 - given.wave.axis);
      const int axis = 1 - given.wave.axis;
      across = std::min(given.box.upper[a], grid.upper()[axis]) -
               std::max(given.box.lower[a], grid.lower()[axis]);
    }
    source.area = sum_over_ranks(grid, volume) * grid.cell_volume() / across /
                  mode_factor(given.wave, given.box, source.motion->length());
    sources_.push_back(std::move(source));
  }
}

template <int D>
double WaveSources<D>::strength(const Source& source, double time) const {
  return 2.0 * ramp_share(source.wave.ramp, time) * source.motion->carried({}, time) / source.area;
}

template <int D>
void WaveSources<D>::add(double time, CellField<D>& target) const {
  for (const Source& source : sources_) {
    const double rate = strength(source, time);
    for (std::size_t n = 0; n < source.cells.size(); ++n)
      target.data()[source.cells[n]] += rate * source.shares[n];
  }
}

template <int D>
double WaveSources<D>::refill(double time, double dt, const CellField<D>& loose,
                              CellField<D>& room) const {
  double added = 0.0;
  for (const Source& source : sources_) {
    const double rate = strength(source, time);
    for (std::size_t n = 0; n < source.cells.size(); ++n) {
      const std::ptrdiff_t at = source.cells[n];
      if (loose.data()[at] > 0.0) continue;
      room.data()[at] += rate * dt * source.shares[n];
      added += rate * dt * source.shares[n];
    }
  }
  return added * grid_->cell_volume();
}

template class WaveSources<2>;
template class WaveSources<3>;

}  // namespace mudlark
