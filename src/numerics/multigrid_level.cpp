#include "numerics/multigrid_level.hpp"

#include <algorithm>
#include <utility>

namespace mudlark {
namespace {
constexpr int red = 0, black = 1;  // cells whose indices have an even or odd sum
}

template <int D>
MultigridLevel<D>::MultigridLevel(const Partition<D>& partition, const Index<D>& cells)
    : partition_(partition), cells_(cells) {
  std::size_t size = 1;
  std::array<int, D> narrowest{};
  for (int a = 0; a < D; ++a) {
    const auto u = static_cast<std::size_t>(a);
    strides_[u] = static_cast<std::ptrdiff_t>(size);
    const int width = owned().upper[a] - owned().lower[a];
    size *= static_cast<std::size_t>(width + 2);
    narrowest[u] = width;
  }
  MPI_Allreduce(MPI_IN_PLACE, narrowest.data(), D, MPI_INT, MPI_MIN, partition_.comm);
  for (int a = 0; a < D; ++a) {
    const auto u = static_cast<std::size_t>(a);
    const bool around = partition_.neighbour[u][0] != MPI_PROC_NULL && partition_.processes[a] == 1;
    halves_[u] = narrowest[u] >= (around ? 4 : 2);
  }
  for (Values* values : {&excess, &right_side, &solution, &inverse_, &below_, &above_, &residual_})
    values->resize(size);
  for (Values& values : coupling) values.resize(size);
}

template <int D>
MultigridLevel<D> MultigridLevel<D>::halved(int axis) const {
  Partition<D> partition = partition_;
  partition.owned.lower[axis] = (partition.owned.lower[axis] + 1) / 2;
  partition.owned.upper[axis] = (partition.owned.upper[axis] + 1) / 2;
  Index<D> cells = cells_;
  cells[axis] = (cells[axis] + 1) / 2;
  return MultigridLevel(partition, cells);
}

template <int D>
Index<D> MultigridLevel<D>::index_of(std::ptrdiff_t at) const {
  Index<D> index;
  for (int a = D - 1; a >= 0; --a) {
    index[a] = static_cast<int>(at / stride(a)) + owned().lower[a] - 1;
    at %= stride(a);
  }
  return index;
}

template <int D>
int MultigridLevel<D>::choose_axis() const {
  std::array<double, D> sum{};
  for (int a = 0; a < D; ++a) {
    const double* c = coupling[static_cast<std::size_t>(a)].data();
    for_each_offset(spans_, [&](std::ptrdiff_t at) { sum[static_cast<std::size_t>(a)] += c[at]; });
  }
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), D, MPI_DOUBLE, MPI_SUM, partition_.comm);
  int best = -1;
  for (int a = 0; a < D; ++a) {
    const auto u = static_cast<std::size_t>(a);
    // Sums of different ranks differ by round-off: of equals the last one is taken.
    if (halves_[u] && (best < 0 || sum[u] >= (1.0 - 1e-6) * sum[static_cast<std::size_t>(best)]))
      best = a;
  }
  return best;
}

template <int D>
void MultigridLevel<D>::take_unknowns(Spans spans) {
  for_each_offset(spans_, [&](std::ptrdiff_t at) {
    const auto u = static_cast<std::size_t>(at);
    for (Values& values : coupling) values[u] = 0.0;
    excess[u] = right_side[u] = solution[u] = residual_[u] = 0.0;
    inverse_[u] = below_[u] = above_[u] = 0.0;
  });
  spans_ = std::move(spans);
  colours_.clear();
  for (const Span& span : spans_) {
    const Index<D> index = index_of(span.first);
    int sum = 0;
    for (int a = 0; a < D; ++a) sum += index[a];
    colours_.push_back(sum & 1);
  }
}

template <int D>
double MultigridLevel<D>::coupled(std::ptrdiff_t at) const {
  double sum = 0.0;
  for (int a = 0; a < D; ++a) {
    const double* c = coupling[static_cast<std::size_t>(a)].data();
    sum += c[at] + c[at + stride(a)];
  }
  return sum;
}

template <int D>
void MultigridLevel<D>::assemble() {
  for (Values& values : coupling) exchange_with_corners(values);
  exchange_with_corners(excess);
  for_each_offset(spans_, [&](std::ptrdiff_t at) {
    const auto u = static_cast<std::size_t>(at);
    const double diagonal = excess[u] + coupled(at);
    inverse_[u] = diagonal > 0.0 ? 1.0 / diagonal : 0.0;
  });
}

/// Calls body(place in the coarse level, place of the same cell here).
template <int D>
template <class Body>
void MultigridLevel<D>::for_each_kept(const MultigridLevel& coarse, Body&& body) const {
  const std::ptrdiff_t step = axis_ == 0 ? 2 : 1;
  for (const Span& span : coarse.spans_) {
    Index<D> index = coarse.index_of(span.first);
    index[axis_] *= 2;
    std::ptrdiff_t at = offset(index);
    for (std::ptrdiff_t kept = span.first; kept < span.last; ++kept, at += step) body(kept, at);
  }
}

/// Weights of the cells between. A cell that keeps its place gets them too, and nobody asks.
template <int D>
void MultigridLevel<D>::find_weights() {
  const double* c = coupling[static_cast<std::size_t>(axis_)].data();
  const std::ptrdiff_t s = stride(axis_);
  for_each_offset(spans_, [&](std::ptrdiff_t at) {
    const auto u = static_cast<std::size_t>(at);
    const double sum = c[at] + c[at + s] + excess[u];
    below_[u] = sum > 0.0 ? c[at] / sum : 0.0;
    above_[u] = sum > 0.0 ? c[at + s] / sum : 0.0;
  });
  exchange_with_corners(below_);
  exchange_with_corners(above_);
  exchange_with_corners(inverse_);
}

/// What a kept cell takes over of the excesses of the cells beside it.
template <int D>
double MultigridLevel<D>::coarse_excess(std::ptrdiff_t at) const {
  const std::ptrdiff_t s = stride(axis_);
  const double* e = excess.data();
  return e[at] + above_[static_cast<std::size_t>(at - s)] * e[at - s] +
         below_[static_cast<std::size_t>(at + s)] * e[at + s];
}

/// Coupling of a kept cell with its lower neighbour among the kept ones along an axis.
template <int D>
double MultigridLevel<D>::coarse_coupling(std::ptrdiff_t at, int axis) const {
  const std::ptrdiff_t s = stride(axis_), across = stride(axis);
  const double* c = coupling[static_cast<std::size_t>(axis)].data();
  const double *below = below_.data(), *above = above_.data();
  if (axis == axis_) return below[at - s] * c[at];
  return c[at] + 0.5 * (above[at - s] + above[at - s - across]) * c[at - s] +
         0.5 * (below[at + s] + below[at + s - across]) * c[at + s];
}

/// Cells with an unknown that stay, as places in the coarse level.
template <int D>
Spans MultigridLevel<D>::kept_spans(const MultigridLevel& coarse) const {
  Spans kept;
  for (const Span& span : spans_) {
    const Index<D> first = index_of(span.first);
    const int odd = first[axis_] % 2;
    if (axis_ != 0 && odd == 1) continue;
    const std::ptrdiff_t cells = span.last - span.first;
    const std::ptrdiff_t count = axis_ == 0 ? (cells + 1 - odd) / 2 : cells;
    if (count == 0) continue;
    const Index<D> stays = first.shifted(axis_, odd);
    const std::ptrdiff_t at = coarse.offset(stays.shifted(axis_, -stays[axis_] / 2));
    kept.push_back({at, at + count});
  }
  return kept;
}

template <int D>
void MultigridLevel<D>::coarsen(MultigridLevel& coarse, int axis) {
  axis_ = axis;
  find_weights();
  coarse.take_unknowns(kept_spans(coarse));
  for_each_kept(coarse, [&](std::ptrdiff_t kept, std::ptrdiff_t at) {
    double& e = coarse.excess[static_cast<std::size_t>(kept)];
    e = coarse_excess(at);
    for (int a = 0; a < D; ++a) {
      const double lower = coarse_coupling(at, a);
      double& c = coarse.coupling[static_cast<std::size_t>(a)][static_cast<std::size_t>(kept)];
      c = lower;
      if (a == axis) continue;
      // Where the neighbour does not stay below, a coupling is to a value of zero.
      if (inverse_[static_cast<std::size_t>(at - stride(a))] == 0.0) e += lower, c = 0.0;
      if (inverse_[static_cast<std::size_t>(at + stride(a))] == 0.0)
        e += coarse_coupling(at + stride(a), a);
    }
  });
  coarse.assemble();
}

template <int D>
template <class Body>
void MultigridLevel<D>::for_each_of_colour(int colour, Body&& body) const {
  for (std::size_t n = 0; n < spans_.size(); ++n)
    for (std::ptrdiff_t at = spans_[n].first + (colours_[n] ^ colour); at < spans_[n].last; at += 2)
      body(at);
}

/// Sum of couplings times the neighbours' solutions.
template <int D>
double MultigridLevel<D>::neighbours(std::ptrdiff_t at) const {
  const double* x = solution.data();
  double sum = 0.0;
  for (int a = 0; a < D; ++a) {
    const double* c = coupling[static_cast<std::size_t>(a)].data();
    const std::ptrdiff_t s = stride(a);
    sum += c[at] * x[at - s] + c[at + s] * x[at + s];
  }
  return sum;
}

template <int D>
void MultigridLevel<D>::sweep(int colour) {
  exchange(solution);
  const double *b = right_side.data(), *inverse = inverse_.data();
  double* x = solution.data();
  for_each_of_colour(colour,
                     [&](std::ptrdiff_t at) { x[at] = (b[at] + neighbours(at)) * inverse[at]; });
}

template <int D>
void MultigridLevel<D>::smooth_from_zero() {
  const double *b = right_side.data(), *inverse = inverse_.data();
  double* x = solution.data();
  for_each_of_colour(red, [&](std::ptrdiff_t at) { x[at] = b[at] * inverse[at]; });
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
  exchange(solution);
  double* r = residual_.data();
  for_each_of_colour(red, [&](std::ptrdiff_t at) { r[at] = neighbours(at); });
  exchange(residual_);
  const double *below = below_.data(), *above = above_.data();
  const std::ptrdiff_t s = stride(axis_);
  double* b = coarse.right_side.data();
  for_each_kept(coarse, [&](std::ptrdiff_t kept, std::ptrdiff_t at) {
    b[kept] = r[at] + above[at - s] * r[at - s] + below[at + s] * r[at + s];
  });
}

template <int D>
void MultigridLevel<D>::add_from(MultigridLevel& coarse) {
  coarse.exchange(coarse.solution);
  const double *below = below_.data(), *above = above_.data(), *y = coarse.solution.data();
  double* x = solution.data();
  const std::ptrdiff_t s = coarse.stride(axis_);
  for (const Span& span : spans_) {
    Index<D> index = index_of(span.first);
    const bool between = index[axis_] % 2 != 0;
    index[axis_] /= 2;
    std::ptrdiff_t from = coarse.offset(index);
    const auto add = [&](std::ptrdiff_t at, bool here) {
      x[at] += here ? y[from] : below[at] * y[from] + above[at] * y[from + s];
    };
    if (axis_ == 0) {
      for (std::ptrdiff_t at = span.first, odd = between; at < span.last; ++at, odd = 1 - odd) {
        add(at, odd == 0);
        from += odd;
      }
    } else {
      for (std::ptrdiff_t at = span.first; at < span.last; ++at, ++from) add(at, !between);
    }
  }
}

/// Layer of cells at a side along an axis, this rank's or the ghosts beyond; across with ghosts.
template <int D>
IndexBox<D> MultigridLevel<D>::layer(int axis, int side, bool ghost) const {
  IndexBox<D> box = owned().grown(1);
  const int inside = side == 0 ? owned().lower[axis] : owned().upper[axis] - 1;
  box.lower[axis] = ghost ? inside + (side == 0 ? -1 : 1) : inside;
  box.upper[axis] = box.lower[axis] + 1;
  return box;
}

/// Messages to and from all neighbours along some axes at a time: none of them waits for another.
template <int D>
void MultigridLevel<D>::exchange_along(int first, int last, Values& values) {
  std::array<MPI_Request, 4 * D> requests;
  int count = 0;
  for (int axis = first; axis < last; ++axis)
    for (int side = 0; side < 2; ++side) {
      const auto n = static_cast<std::size_t>(2 * axis + side);
      const int neighbour =
          partition_.neighbour[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)];
      if (neighbour == MPI_PROC_NULL) continue;
      send_[n].clear();
      for_each(layer(axis, side, false), [&](const Index<D>& index) {
        send_[n].push_back(values[static_cast<std::size_t>(offset(index))]);
      });
      receive_[n].resize(send_[n].size());
      const int length = static_cast<int>(send_[n].size());
      // What leaves at one side arrives at the other: the tag says which, two ranks may share both.
      MPI_Irecv(receive_[n].data(), length, MPI_DOUBLE, neighbour, 2 * axis + 1 - side,
                partition_.comm, &requests[static_cast<std::size_t>(count++)]);
      MPI_Isend(send_[n].data(), length, MPI_DOUBLE, neighbour, 2 * axis + side, partition_.comm,
                &requests[static_cast<std::size_t>(count++)]);
    }
  if (count == 0) return;
  MPI_Waitall(count, requests.data(), MPI_STATUSES_IGNORE);
  for (int axis = first; axis < last; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (partition_.neighbour[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)] ==
          MPI_PROC_NULL)
        continue;
      const double* next = receive_[static_cast<std::size_t>(2 * axis + side)].data();
      for_each(layer(axis, side, true), [&](const Index<D>& index) {
        values[static_cast<std::size_t>(offset(index))] = *next++;
      });
    }
}

template <int D>
void MultigridLevel<D>::exchange(Values& values) {
  exchange_along(0, D, values);
}

template <int D>
void MultigridLevel<D>::exchange_with_corners(Values& values) {
  for (int axis = 0; axis < D; ++axis) exchange_along(axis, axis + 1, values);
}

template class MultigridLevel<2>;
template class MultigridLevel<3>;

}  // namespace mudlark
