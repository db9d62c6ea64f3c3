#pragma once
/// The cells near the water, where alone a flow with a free surface has anything to compute.
#include <algorithm>
#include <span>
#include <vector>

#include "numerics/ghosts.hpp"
#include "numerics/spans.hpp"

namespace mudlark {

/// Within five cells of water (and of ground, where its grains take part) and two of a velocity; at
/// first all cells. The velocity is extended by three layers of faces beyond the surface, water
/// moves less than a cell in a step, and stencils see one cell more. Farther cells keep what they
/// have from one step to the next: no pressure, no velocity, no flux. Water that vanishes counts
/// for one step more, in which all that it moved comes to rest.
template <int D>
class NearWater {
 public:
  /// Cells of one row along the first axis, `end` being the first beyond; `at` is the place of the
  /// first in the local arrays.
  struct Run {
    Index<D> first;
    int end;
    std::ptrdiff_t at;
  };

  explicit NearWater(const Grid<D>& grid);

  /// Looks for them, all inputs having valid ghosts; with `ground` near cells with less porosity
  /// than 1 too. Without `anywhere` no water and no velocity is farther than the present near
  /// cells. Collective.
  void find(const CellField<D>& water, const CellField<D>& porosity, const FaceVector<D>& velocity,
            bool ground, bool anywhere = true);
  /// All cells.
  void take_all();

  /// Those of the rows `lower` to `upper` - 1 along the second axis, in space in one plane.
  std::span<const Run> runs(int lower, int upper, int plane) const {
    const IndexBox<D>& local = grid_->local();
    std::ptrdiff_t row = lower - local.lower[1];
    if (D == 3) row += (plane - local.lower[D - 1]) * (local.upper[1] - local.lower[1]);
    const auto* start = row_starts_.data() + row;
    return {runs_.data() + *start, runs_.data() + *(start + upper - lower)};
  }

 private:
  template <class Body>
  void for_each_candidate(bool anywhere, Body&& body) const;
  template <int Cells>
  void dilate();
  void find_runs();

  const Grid<D>* grid_;
  Ghosts<D> ghosts_;
  Field<std::uint8_t, AtCell, D> near_, wider_, wet_;
  bool all_ = false;
  std::vector<Run> runs_;                ///< of this rank's cells and ghosts, row after row
  std::vector<std::size_t> row_starts_;  ///< the first run of each row, and the end of the last
};

/// Calls body(run, at, first, end) for the piece of every run that lies in the box. Its cells along
/// the first axis are first ... end - 1, and `at` is the place of the first.
template <int D, class Body>
inline void for_each_piece(const NearWater<D>& near, const IndexBox<D>& box, Body&& body) {
  if (box.empty()) return;
  const int first_plane = D == 3 ? box.lower[D - 1] : 0;
  const int end_plane = D == 3 ? box.upper[D - 1] : 1;
  for (int plane = first_plane; plane < end_plane; ++plane)
    for (const auto& run : near.runs(box.lower[1], box.upper[1], plane)) {
      const int first = std::max(run.first[0], box.lower[0]);
      const int end = std::min(run.end, box.upper[0]);
      if (first < end) body(run, run.at + (first - run.first[0]), first, end);
    }
}

/// As the loops over boxes (numerics/loops.hpp), but near the water only.
template <int D, class Body>
inline void for_each_offset(const NearWater<D>& near, const IndexBox<D>& box, Body&& body) {
  for_each_piece(near, box, [&](const auto&, std::ptrdiff_t at, int first, int end) {
    for (const std::ptrdiff_t last = at + (end - first); at < last; ++at) body(at);
  });
}
template <int D, class Body>
inline void for_each_place(const NearWater<D>& near, const IndexBox<D>& box, Body&& body) {
  for_each_piece(near, box, [&](const auto& run, std::ptrdiff_t at, int first, int end) {
    Index<D> index = run.first;
    for (index[0] = first; index[0] < end; ++index[0], ++at) body(at, std::as_const(index));
  });
}

template <int D, class Taken>
void find_spans(const NearWater<D>& near, const IndexBox<D>& box, Taken&& taken, Spans& spans) {
  spans.clear();
  for_each_piece(near, box, [&](const auto&, std::ptrdiff_t at, int first, int end) {
    add_spans(at, at + (end - first), taken, spans);
  });
}

extern template class NearWater<2>;
extern template class NearWater<3>;

}  // namespace mudlark
