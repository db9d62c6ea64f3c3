#include "grid/halo.hpp"

#include <array>
#include <type_traits>

namespace mudlark {
namespace {

/// Box of `width` layers on one side of the owned box along `axis`: inside it, or outside (ghosts).
/// Across the other axes it spans the whole local box.
template <int D>
IndexBox<D> layers(const Grid<D>& grid, int axis, int side, bool ghost) {
  IndexBox<D> box = grid.local();
  const int edge = side == 0 ? grid.owned().lower[axis] : grid.owned().upper[axis];
  const bool below = (side == 0) == ghost;
  box.lower[axis] = below ? edge - ghost_layers : edge;
  box.upper[axis] = box.lower[axis] + ghost_layers;
  return box;
}

template <int D>
std::size_t count(const IndexBox<D>& box) {
  std::size_t n = 1;
  for (int a = 0; a < D; ++a) n *= static_cast<std::size_t>(box.upper[a] - box.lower[a]);
  return n;
}

}  // namespace

/// One message along `axis`: values leave towards `side` and arrive from the opposite side.
template <int D>
template <class T>
void Halo<D>::shift(std::span<T* const> fields, std::size_t components, int axis, int side,
                    bool add) {
  const auto& neighbour = grid_->partition().neighbour[static_cast<std::size_t>(axis)];
  const int to = neighbour[static_cast<std::size_t>(side)];
  const int from = neighbour[static_cast<std::size_t>(1 - side)];
  if (to == MPI_PROC_NULL && from == MPI_PROC_NULL) return;
  // Forward: my inner layers at `side` become the neighbour's ghosts. Adding: my ghosts go home.
  const IndexBox<D> out = layers(*grid_, axis, side, add);
  const IndexBox<D> in = layers(*grid_, axis, 1 - side, !add);
  const std::size_t length = count(out) * fields.size() * components;
  send_.resize(length * sizeof(T));
  receive_.resize(length * sizeof(T));
  T *sent = reinterpret_cast<T*>(send_.data()), *received = reinterpret_cast<T*>(receive_.data());
  std::size_t k = 0;
  if (to != MPI_PROC_NULL)
    for (T* field : fields)
      for_each(out, [&](const Index<D>& i) {
        const T* place = field + static_cast<std::size_t>(grid_->offset(i)) * components;
        for (std::size_t c = 0; c < components; ++c) sent[k++] = place[c];
      });
  const MPI_Datatype type = std::is_same_v<T, double> ? MPI_DOUBLE : MPI_BYTE;
  MPI_Sendrecv(sent, to == MPI_PROC_NULL ? 0 : static_cast<int>(length), type, to, 7, received,
               from == MPI_PROC_NULL ? 0 : static_cast<int>(length), type, from, 7, grid_->comm(),
               MPI_STATUS_IGNORE);
  if (from == MPI_PROC_NULL) return;
  k = 0;
  for (T* field : fields)
    for_each(in, [&](const Index<D>& i) {
      T* place = field + static_cast<std::size_t>(grid_->offset(i)) * components;
      for (std::size_t c = 0; c < components; ++c)
        place[c] = add ? static_cast<T>(place[c] + received[k++]) : received[k++];
    });
}

template <int D>
void Halo<D>::exchange(std::span<double* const> fields, std::size_t components) {
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side) shift(fields, components, axis, side, false);
}

template <int D>
void Halo<D>::exchange(Field<std::uint8_t, AtCell, D>& marks) {
  const std::array<std::uint8_t*, 1> one{marks.data()};
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side)
      shift(std::span<std::uint8_t* const>(one), 1, axis, side, false);
}

template <int D>
void Halo<D>::add_to_owners(std::span<double* const> fields, std::size_t components) {
  for (int axis = D - 1; axis >= 0; --axis)
    for (int side = 0; side < 2; ++side) shift(fields, components, axis, side, true);
}

template <int D>
void Halo<D>::exchange(CellField<D>& field) {
  const std::array<double*, 1> one{field.data()};
  exchange(one);
}

template <int D>
void Halo<D>::exchange(FaceVector<D>& field) {
  std::array<double*, D> all{};
  for (int a = 0; a < D; ++a) all[static_cast<std::size_t>(a)] = field[a].data();
  exchange(all);
}

template class Halo<2>;
template class Halo<3>;

namespace {
double reduce(MPI_Comm comm, double value, MPI_Op operation) {
  double result = 0.0;
  MPI_Allreduce(&value, &result, 1, MPI_DOUBLE, operation, comm);
  return result;
}
}  // namespace

template <int D>
double sum_over_ranks(const Grid<D>& grid, double value) {
  return reduce(grid.comm(), value, MPI_SUM);
}
template <int D>
double max_over_ranks(const Grid<D>& grid, double value) {
  return reduce(grid.comm(), value, MPI_MAX);
}
template <int D>
double min_over_ranks(const Grid<D>& grid, double value) {
  return reduce(grid.comm(), value, MPI_MIN);
}
template double sum_over_ranks(const Grid<2>&, double);
template double sum_over_ranks(const Grid<3>&, double);
template double max_over_ranks(const Grid<2>&, double);
template double max_over_ranks(const Grid<3>&, double);
template double min_over_ranks(const Grid<2>&, double);
template double min_over_ranks(const Grid<3>&, double);

}  // namespace mudlark
