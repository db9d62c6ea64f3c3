#pragma once
/// Points taken a few at a time, all of one cell, so that one instruction serves them all.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "grid/grid.hpp"
#include "soil/lanes.hpp"
#include "soil/particles.hpp"

namespace mudlark {

/// Up to `point_lanes<D>` points of one cell. Lanes from `live` on repeat or continue others: their
/// results are dropped.
template <int D>
struct CellBatch {
  static constexpr int lanes = point_lanes<D>;
  Index<D> cell;
  int live;
  bool contiguous;  ///< do all lanes follow the first in the arrays?
  std::array<std::size_t, lanes> point;

  Lanes<lanes> get(const std::vector<double>& array) const {
    if (contiguous) return load<lanes>(array.data() + point[0]);
    Lanes<lanes> values;
    for (std::size_t i = 0; i < lanes; ++i) values[i] = array[point[i]];
    return values;
  }
  void set(const Lanes<lanes>& values, std::vector<double>& array) const {
    set(values, array.data(), 0);
  }
  /// The same in an array that starts with point `first`.
  void set(const Lanes<lanes>& values, double* array, std::size_t first) const {
    if (contiguous && live == lanes) return store<lanes>(values, array + (point[0] - first));
    for (int i = 0; i < live; ++i)
      array[point[static_cast<std::size_t>(i)] - first] = values[static_cast<std::size_t>(i)];
  }
};

/// Sorts the points of a range into batches. The cells are those that points lie in now; where they
/// were when last sorted only decides how many batches are full.
template <int D>
class CellBatches {
 public:
  /// Strays are collected over this many points.
  static constexpr std::size_t window = 1024;

  CellBatches(const Grid<D>& grid, const SoilParticles<D>& points)
      : points_(&points), lower_(grid.lower()) {
    for (int a = 0; a < D; ++a) per_spacing_[a] = 1.0 / grid.spacing()[a];
  }

  /// Calls f(batch) until each point of the range had its turn. Returns how many points had left
  /// the cell that they were sorted into.
  template <class F>
  std::size_t for_each(PointRange range, F&& f) {
    std::size_t strays = 0;
    for (std::size_t first = range.first; first < range.last;) {
      count_ = 0;
      const std::size_t limit = std::min(range.last, first + window);
      while (first < limit) {
        const auto [cell, end] = run_at(first, limit);
        for (; first < end; first += std::min<std::size_t>(lanes, end - first))
          take(cell, first, std::min<std::size_t>(lanes, end - first), f);
      }
      strays += count_;
      collect_strays(f);
    }
    return strays;
  }

  const Vec<D>& per_spacing() const { return per_spacing_; }
  /// Place of the batch's points in their cell along an axis, 0 to 1.
  Lanes<CellBatch<D>::lanes> place(const CellBatch<D>& batch, int axis) const {
    return (batch.get(points_->position[axis]) - lower_[axis]) * per_spacing_[axis] -
           static_cast<double>(batch.cell[axis]);
  }

 private:
  static constexpr int lanes = CellBatch<D>::lanes;
  struct Stray {
    Index<D> cell;
    std::size_t point;
    friend bool operator<(const Stray& left, const Stray& right) {
      return left.cell.component < right.cell.component;
    }
  };

  Index<D> cell_of(std::size_t p) const {
    Index<D> cell;
    for (int a = 0; a < D; ++a)
      cell[a] =
          static_cast<int>(std::floor((points_->position[a][p] - lower_[a]) * per_spacing_[a]));
    return cell;
  }

  /// The cell that point `first` was sorted into, and the end of its points there, at most `limit`.
  std::pair<Index<D>, std::size_t> run_at(std::size_t first, std::size_t limit) {
    const auto& runs = points_->runs;
    if (runs.empty()) {  // never sorted
      const Index<D> cell = cell_of(first);
      std::size_t end = first + 1;
      while (end < limit && cell_of(end) == cell) ++end;
      return {cell, end};
    }
    if (run_ >= runs.size() || runs[run_].first > first) run_ = 0;
    if (run_ + 1 < runs.size() && runs[run_ + 1].first <= first) {
      ++run_;
      if (run_ + 1 < runs.size() && runs[run_ + 1].first <= first)
        run_ = static_cast<std::size_t>(
                   std::upper_bound(runs.begin(), runs.end(), first,
                                    [](std::size_t p, const auto& run) { return p < run.first; }) -
                   runs.begin()) -
               1;
    }
    return {runs[run_].cell,
            run_ + 1 < runs.size() ? std::min(runs[run_ + 1].first, limit) : limit};
  }

  /// `length` points from `first` on, sorted into `cell`.
  template <class F>
  void take(const Index<D>& cell, std::size_t first, std::size_t length, F&& f) {
    CellBatch<D> batch{cell, static_cast<int>(length), first + lanes <= points_->size(), {}};
    for (std::size_t i = 0; i < lanes; ++i) batch.point[i] = first + std::min(i, length - 1);
    Lanes<lanes> outside{};  // larger than zero: out of the cell
    for (int a = 0; a < D; ++a) {
      const Lanes<lanes> r = place(batch, a);
      outside = (r >= 0.0) & (r < 1.0) ? outside : outside + 1.0;
    }
    bool all = true;
    for (std::size_t i = 0; i < length; ++i) all = all && outside[i] == 0.0;
    if (all) return f(batch);
    CellBatch<D> inside{cell, 0, false, batch.point};
    for (std::size_t i = 0; i < length; ++i) {
      if (outside[i] == 0.0)
        inside.point[static_cast<std::size_t>(inside.live++)] = first + i;
      else
        strays_[count_++] = {cell_of(first + i), first + i};
    }
    if (inside.live > 0) f(inside);
  }

  template <class F>
  void collect_strays(F&& f) {
    std::sort(strays_.begin(), strays_.begin() + static_cast<std::ptrdiff_t>(count_));
    for (std::size_t at = 0; at < count_;) {
      CellBatch<D> batch{strays_[at].cell, 0, false, {}};
      batch.point.fill(strays_[at].point);
      for (; at < count_ && batch.live < lanes && strays_[at].cell == batch.cell; ++at)
        batch.point[static_cast<std::size_t>(batch.live++)] = strays_[at].point;
      f(batch);
    }
  }

  const SoilParticles<D>* points_;
  Vec<D> lower_, per_spacing_;
  std::array<Stray, window> strays_;
  std::size_t count_ = 0, run_ = 0;
};

}  // namespace mudlark
