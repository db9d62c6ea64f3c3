#include "numerics/multigrid_level.hpp"

#include <algorithm>
#include <utility>

namespace mudlark {
namespace {
constexpr int red = 0, black = 1;  // cells whose indices have an even or odd sum
}

template <int D>
MultigridLevel<D>::MultigridLevel(const Partition<D>& partition, const Index<D>& cells)
    : packed_(partition), cells_(cells) {
  std::array<int, D> narrowest{};
  for (int a = 0; a < D; ++a)
    narrowest[static_cast<std::size_t>(a)] = owned().upper[a] - owned().lower[a];
  MPI_Allreduce(MPI_IN_PLACE, narrowest.data(), D, MPI_INT, MPI_MIN, partition.comm);
  for (int a = 0; a < D; ++a) {
    const auto u = static_cast<std::size_t>(a);
    const bool around = partition.neighbour[u][0] != MPI_PROC_NULL && partition.processes[a] == 1;
    halves_[u] = narrowest[u] >= (around ? 4 : 2);
  }
}

template <int D>
MultigridLevel<D> MultigridLevel<D>::halved(int axis) const {
  Partition<D> partition = packed_.partition();
  partition.owned.lower[axis] = (partition.owned.lower[axis] + 1) / 2;
  partition.owned.upper[axis] = (partition.owned.upper[axis] + 1) / 2;
  Index<D> cells = cells_;
  cells[axis] = (cells[axis] + 1) / 2;
  return MultigridLevel(partition, cells);
}

template <int D>
int MultigridLevel<D>::choose_axis() const {
  std::array<double, D> sum{};
  for (int a = 0; a < D; ++a) {
    const double* c = coupling[static_cast<std::size_t>(a)].data();
    packed_.for_each(
        [&](std::ptrdiff_t at, const Run&) { sum[static_cast<std::size_t>(a)] += c[at]; });
  }
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), D, MPI_DOUBLE, MPI_SUM, packed_.partition().comm);
  int best = -1;
  for (int a = 0; a < D; ++a) {
    const auto u = static_cast<std::size_t>(a);
    // Sums of different ranks differ by round-off: of equals the last one is taken.
    if (halves_[u] && (best < 0 || sum[u] >= (1.0 - 1e-6) * sum[static_cast<std::size_t>(best)]))
      best = a;
  }
  return best;
}

/// Makes room for cells with an unknown and for blocks of cells that somebody asks for.
template <int D>
void MultigridLevel<D>::store(const std::vector<RowPart<D>>& cells,
                              const std::vector<IndexBox<D>>& asked) {
  packed_.store(cells, asked);
  for (Values* values : {&excess, &right_side, &solution, &inverse_, &below_, &above_, &residual_})
    values->assign(packed_.size(), 0.0);
  for (Values& values : coupling) values.assign(packed_.size(), 0.0);
}

template <int D>
double MultigridLevel<D>::diagonal(std::ptrdiff_t at, const Run& run) const {
  double sum = 0.0;
  for (std::size_t a = 0; a < D; ++a) {
    const double* c = coupling[a].data();
    sum += c[at] + c[at + run.above[a]];
  }
  return excess[static_cast<std::size_t>(at)] + sum;
}

template <int D>
void MultigridLevel<D>::assemble() {
  for (Values& values : coupling) packed_.exchange_with_corners(values);
  packed_.exchange_with_corners(excess);
  packed_.for_each([&](std::ptrdiff_t at, const Run& run) {
    const double sum = diagonal(at, run);
    inverse_[static_cast<std::size_t>(at)] = sum > 0.0 ? 1.0 / sum : 0.0;
  });
}

/// Weights of the cells between. A cell that keeps its place gets them too, and nobody asks.
template <int D>
void MultigridLevel<D>::find_weights() {
  const auto axis = static_cast<std::size_t>(axis_);
  const double* c = coupling[axis].data();
  packed_.for_each([&](std::ptrdiff_t at, const Run& run) {
    const auto u = static_cast<std::size_t>(at);
    const double upper = c[at + run.above[axis]];
    const double sum = c[at] + upper + excess[u];
    below_[u] = sum > 0.0 ? c[at] / sum : 0.0;
    above_[u] = sum > 0.0 ? upper / sum : 0.0;
  });
  packed_.exchange_with_corners(below_);
  packed_.exchange_with_corners(above_);
  packed_.exchange_with_corners(inverse_);
}

/// What a kept cell takes over of the excesses of the cells beside it.
template <int D>
double MultigridLevel<D>::coarse_excess(std::ptrdiff_t at, const Kept& run) const {
  const std::ptrdiff_t lower = at + run.below, upper = at + run.above;
  const double* e = excess.data();
  return e[at] + above_[static_cast<std::size_t>(lower)] * e[lower] +
         below_[static_cast<std::size_t>(upper)] * e[upper];
}

/// Ways from a cell to those one before, level with or behind it along `axis` (first index) and
/// along the halved axis (second).
template <int D>
typename MultigridLevel<D>::Cross MultigridLevel<D>::ways_across(const Index<D>& cell,
                                                                 int axis) const {
  Cross ways;
  for (int across = 0; across < 3; ++across)
    for (int along = 0; along < 3; ++along)
      ways[static_cast<std::size_t>(across)][static_cast<std::size_t>(along)] =
          packed_.at(cell.shifted(axis, across - 1).shifted(axis_, along - 1)) - packed_.at(cell);
  return ways;
}

/// Coupling of a kept cell with its lower (side 0) or upper neighbour along an axis that is not
/// halved.
template <int D>
double MultigridLevel<D>::coupling_across(std::ptrdiff_t at, int axis, const Cross& ways,
                                          std::size_t side) const {
  const double* c = coupling[static_cast<std::size_t>(axis)].data() + at;
  const double *below = below_.data() + at, *above = above_.data() + at;
  const auto &lower = ways[side], &upper = ways[side + 1];
  return c[upper[1]] + 0.5 * (above[upper[0]] + above[lower[0]]) * c[upper[0]] +
         0.5 * (below[upper[2]] + below[lower[2]]) * c[upper[2]];
}

/// Cells with an unknown that stay, as cells of the coarse level.
template <int D>
std::vector<RowPart<D>> MultigridLevel<D>::kept_runs() const {
  std::vector<RowPart<D>> kept;
  for (const Run& run : runs()) {
    const int odd = run.first[axis_] % 2;
    if (axis_ != 0 && odd == 1) continue;
    const int count = axis_ == 0 ? (run.cells + 1 - odd) / 2 : run.cells;
    if (count == 0) continue;
    const Index<D> stays = run.first.shifted(axis_, odd);
    kept.push_back({stays.shifted(axis_, -stays[axis_] / 2), count});
  }
  return kept;
}

/// Cells of the coarse level that cells of this one follow, an unknown there or not.
template <int D>
std::vector<IndexBox<D>> MultigridLevel<D>::asked_below() const {
  std::vector<IndexBox<D>> asked;
  for (const Run& run : runs()) {
    IndexBox<D> box{run.first, run.first};
    for (int a = 0; a < D; ++a) box.upper[a] += a == 0 ? run.cells : 1;
    box.lower[axis_] = box.lower[axis_] / 2;
    box.upper[axis_] = box.upper[axis_] / 2 + 1;
    asked.push_back(box);
  }
  return asked;
}

/// Where the runs of the two levels lie in one another.
template <int D>
void MultigridLevel<D>::find_ways(const MultigridLevel& coarse) {
  kept_.clear();
  for (const Run& run : coarse.runs()) {
    const Index<D> cell = run.first.shifted(axis_, run.first[axis_]);
    const std::ptrdiff_t at = packed_.at(cell);
    kept_.push_back({run.at, at, packed_.at(cell.shifted(axis_, -1)) - at,
                     packed_.at(cell.shifted(axis_, 1)) - at, run.cells});
  }
  followed_.clear();
  for (const Run& run : runs()) {
    const int half = run.first[axis_] / 2;
    const Index<D> image = run.first.shifted(axis_, half - run.first[axis_]);
    const std::ptrdiff_t from = coarse.packed_.at(image);
    followed_.push_back(
        {run.first[axis_] % 2 != 0, from, coarse.packed_.at(image.shifted(axis_, 1)) - from});
  }
}

template <int D>
void MultigridLevel<D>::coarsen(MultigridLevel& coarse, int axis) {
  axis_ = axis;
  find_weights();
  coarse.store(kept_runs(), asked_below());
  find_ways(coarse);
  const std::ptrdiff_t step = axis_ == 0 ? 2 : 1;
  const auto along = static_cast<std::size_t>(axis);
  for (std::size_t n = 0; n < kept_.size(); ++n) {
    const Kept& run = kept_[n];
    std::array<Cross, D> ways;
    const Index<D>& first = coarse.runs()[n].first;
    for (int a = 0; a < D; ++a)
      if (a != axis)
        ways[static_cast<std::size_t>(a)] = ways_across(first.shifted(axis, first[axis]), a);
    std::ptrdiff_t at = run.at;
    for (std::ptrdiff_t kept = run.kept; kept < run.kept + run.cells; ++kept, at += step) {
      double& e = coarse.excess[static_cast<std::size_t>(kept)];
      e = coarse_excess(at, run);
      coarse.coupling[along][static_cast<std::size_t>(kept)] =
          below_[static_cast<std::size_t>(at + run.below)] *
          coupling[along][static_cast<std::size_t>(at)];
      for (int a = 0; a < D; ++a) {
        if (a == axis) continue;
        const Cross& way = ways[static_cast<std::size_t>(a)];
        const double lower = coupling_across(at, a, way, 0);
        double& c = coarse.coupling[static_cast<std::size_t>(a)][static_cast<std::size_t>(kept)];
        c = lower;
        // Where the neighbour does not stay below, a coupling is to a value of zero.
        if (inverse_[static_cast<std::size_t>(at + way[0][1])] == 0.0) e += lower, c = 0.0;
        if (inverse_[static_cast<std::size_t>(at + way[2][1])] == 0.0)
          e += coupling_across(at, a, way, 1);
      }
    }
  }
  coarse.assemble();
}

/// Calls body(place, run) for every cell of a colour with an unknown.
template <int D>
template <class Body>
void MultigridLevel<D>::for_each_of_colour(int colour, Body&& body) const {
  for (const Run& run : runs())
    for (std::ptrdiff_t at = run.at + (run.colour ^ colour); at < run.at + run.cells; at += 2)
      body(at, run);
}

/// Sum of couplings times the neighbours' solutions.
template <int D>
double MultigridLevel<D>::neighbours(std::ptrdiff_t at, const Run& run) const {
  const double* x = solution.data();
  double sum = 0.0;
  for (std::size_t a = 0; a < D; ++a) {
    const double* c = coupling[a].data();
    const std::ptrdiff_t below = at + run.below[a], above = at + run.above[a];
    sum += c[at] * x[below] + c[above] * x[above];
  }
  return sum;
}

template <int D>
void MultigridLevel<D>::sweep(int colour) {
  packed_.exchange(solution);
  const double *b = right_side.data(), *inverse = inverse_.data();
  double* x = solution.data();
  for_each_of_colour(colour, [&](std::ptrdiff_t at, const Run& run) {
    x[at] = (b[at] + neighbours(at, run)) * inverse[at];
  });
}

template <int D>
void MultigridLevel<D>::smooth_from_zero() {
  const double *b = right_side.data(), *inverse = inverse_.data();
  double* x = solution.data();
  for_each_of_colour(red, [&](std::ptrdiff_t at, const Run&) { x[at] = b[at] * inverse[at]; });
  sweep(black);
}

template <int D>
void MultigridLevel<D>::smooth_back() {
  sweep(black);
  sweep(red);
}

/// After the sweep black cells have no residual, and red ones what black ones brought.
template <int D>
void MultigridLevel<D>::restrict_to(MultigridLevel& coarse) {
  packed_.exchange(solution);
  double* r = residual_.data();
  for_each_of_colour(red, [&](std::ptrdiff_t at, const Run& run) { r[at] = neighbours(at, run); });
  packed_.exchange(residual_);
  const double *below = below_.data(), *above = above_.data();
  const std::ptrdiff_t step = axis_ == 0 ? 2 : 1;
  double* b = coarse.right_side.data();
  for (const Kept& run : kept_) {
    std::ptrdiff_t at = run.at;
    for (std::ptrdiff_t kept = run.kept; kept < run.kept + run.cells; ++kept, at += step) {
      const std::ptrdiff_t lower = at + run.below, upper = at + run.above;
      b[kept] = r[at] + above[lower] * r[lower] + below[upper] * r[upper];
    }
  }
}

template <int D>
void MultigridLevel<D>::add_from(MultigridLevel& coarse) {
  coarse.packed_.exchange(coarse.solution);
  const double *below = below_.data(), *above = above_.data(), *y = coarse.solution.data();
  double* x = solution.data();
  for (std::size_t n = 0; n < runs().size(); ++n) {
    const std::ptrdiff_t first = runs()[n].at, last = first + runs()[n].cells;
    const auto [between, image, s] = followed_[n];
    std::ptrdiff_t from = image;
    if (axis_ == 0) {
      for (std::ptrdiff_t at = first, odd = between; at < last; ++at, odd = 1 - odd) {
        x[at] += odd == 0 ? y[from] : below[at] * y[from] + above[at] * y[from + 1];
        from += odd;
      }
    } else if (between) {
      for (std::ptrdiff_t at = first; at < last; ++at, ++from)
        x[at] += below[at] * y[from] + above[at] * y[from + s];
    } else {
      for (std::ptrdiff_t at = first; at < last; ++at, ++from) x[at] += y[from];
    }
  }
}

template class MultigridLevel<2>;
template class MultigridLevel<3>;

}  // namespace mudlark
