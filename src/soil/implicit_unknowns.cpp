#include "soil/implicit_unknowns.hpp"

#include "soil/mirror.hpp"
#include "soil/point_stencil.hpp"

namespace mudlark {
namespace {

/// Faces and cells with less than this share of a cell's volume in their reach are held: they touch
/// the outermost points only.
constexpr double smallest_share = 1e-4;

template <int D>
void fold_faces(const Grid<D>& grid, int component, bool signs, FaceField<D>& field) {
  for_each_closed_wall(grid, [&](int axis, int side, Wall wall) {
    const double sign = signs ? parity(component, axis, wall) : 1.0;
    for_each_mirror_pair(grid, grid.local(), axis, side, component == axis,
                         [&](const Index<D>& behind, const Index<D>& before) {
                           field[before] += sign * field[behind];
                         });
  });
}

template <int D>
void fold_pressure(const Grid<D>& grid, CellField<D>& field) {
  for_each_closed_wall(grid, [&](int axis, int side, Wall) {
    for_each_mirror_pair(
        grid, grid.local(), axis, side, false,
        [&](const Index<D>& behind, const Index<D>& before) { field[before] += field[behind]; });
  });
}

/// Adds the volume of points to faces and cells around them.
template <int D>
void add_volume(const Grid<D>& grid, Kernel kernel, const SoilParticles<D>& points,
                ImplicitFields<D>& sums, bool with_water) {
  const Vec<D> per_spacing = inverse(grid.spacing());
  with_kernel(kernel, [&]<class K>(K) {
    for (std::size_t p = 0; p < points.size(); ++p) {
      const PointSplines<D, K> splines(in_cells(grid, per_spacing, points.position_of(p)));
      const double volume = points.volume[p];
      PointSplines<D, K>::template static_for<D>([&]<int Component>() {
        double* grains = sums.grains[Component].data();
        double* water = sums.water[Component].data();
        splines.template for_each_node<Component>(
            grid, per_spacing, [&](std::ptrdiff_t at, double w, const Vec<D>&, const Vec<D>&) {
              grains[at] += w * volume;
              if (with_water) water[at] += w * volume;
            });
      });
      if (!with_water) continue;
      double* cells = sums.pressure.data();
      splines.template for_each_node<-1>(
          grid, per_spacing, [&](std::ptrdiff_t at, double w, const Vec<D>&, const Vec<D>&) {
            cells[at] += w * volume;
          });
    }
  });
}

/// Numbers of the owned entries above the threshold as doubles, -1 elsewhere.
template <class Field, class Box>
void number_owned(Field& field, const Box& box, double threshold, PetscInt& next) {
  std::vector<double> volume(field.data(), field.data() + field.size());
  field.fill(-1.0);
  for_each(box, [&](const auto& index) {
    if (volume[field.offset(index)] > threshold) field[index] = static_cast<double>(next++);
  });
}

std::vector<PetscInt> as_numbers(const double* values, std::size_t count) {
  std::vector<PetscInt> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<PetscInt>(values[i]);
  return numbers;
}

/// The closed walls' own faces do not move.
template <int D>
void hold_walls(const Grid<D>& grid, int component, FaceField<D>& volume) {
  for (int side = 0; side < 2; ++side) {
    if (!grid.touches(component, side) || !closed(grid.wall(component, side))) continue;
    IndexBox<D> face = grid.local();
    face.lower[component] = side == 0 ? 0 : grid.cells()[component];
    face.upper[component] = face.lower[component] + 1;
    for_each(face, [&](const Index<D>& index) { volume[index] = 0.0; });
  }
}

}  // namespace

template <int D>
ImplicitFields<D>::ImplicitFields(const Grid<D>& grid)
    : grains(grid, "displacement of grains", "m"),
      water(grid, "displacement of water", "m"),
      pressure(grid, "rise of pore pressure", "Pa") {}

template <int D>
void ImplicitFields<D>::clear() {
  grains.fill(0.0);
  water.fill(0.0);
  pressure.fill(0.0);
}

template <int D>
void ImplicitFields<D>::load(const Grid<D>& grid, Halo<D>& halo,
                             const ImplicitUnknowns<D>& unknowns, ::Vec values) {
  const PetscScalar* x = nullptr;
  VecGetArrayRead(values, &x);
  const auto value = [&](PetscInt number) { return number < 0 ? 0.0 : x[number - unknowns.first]; };
  clear();
  for (int d = 0; d < D; ++d) {
    const auto u = static_cast<std::size_t>(d);
    for_each(grid.owned_faces(d), [&](const Index<D>& face) {
      const std::size_t at = grains[d].offset(face);
      grains[d].data()[at] = value(unknowns.grains[u][at]);
      water[d].data()[at] = value(unknowns.water[u][at]);
    });
  }
  for_each(grid.owned(), [&](const Index<D>& cell) {
    const std::size_t at = pressure.offset(cell);
    pressure.data()[at] = value(unknowns.pressure[at]);
  });
  VecRestoreArrayRead(values, &x);
  halo.exchange(grains);
  halo.exchange(water);
  halo.exchange(pressure);
  for_each_closed_wall(grid, [&](int axis, int side, Wall wall) {
    for (int d = 0; d < D; ++d) {
      const double sign = parity(d, axis, wall);
      for_each_mirror_pair(grid, grid.local(), axis, side, d == axis,
                           [&](const Index<D>& behind, const Index<D>& before) {
                             grains[d][behind] = sign * grains[d][before];
                             water[d][behind] = sign * water[d][before];
                           });
    }
    for_each_mirror_pair(grid, grid.local(), axis, side, false,
                         [&](const Index<D>& behind, const Index<D>& before) {
                           pressure[behind] = pressure[before];
                         });
  });
}

template <int D>
void ImplicitFields<D>::store(const Grid<D>& grid, Halo<D>& halo,
                              const ImplicitUnknowns<D>& unknowns, ::Vec values) {
  std::vector<double*> all;
  for (int d = 0; d < D; ++d) all.push_back(grains[d].data()), all.push_back(water[d].data());
  all.push_back(pressure.data());
  halo.add_to_owners(all);
  for (int d = 0; d < D; ++d) {
    fold_faces(grid, d, true, grains[d]);
    fold_faces(grid, d, true, water[d]);
  }
  fold_pressure(grid, pressure);
  PetscScalar* x = nullptr;
  VecGetArray(values, &x);
  const auto put = [&](PetscInt number, double value) {
    if (number >= 0) x[number - unknowns.first] = value;
  };
  for (int d = 0; d < D; ++d) {
    const auto u = static_cast<std::size_t>(d);
    for_each(grid.owned_faces(d), [&](const Index<D>& face) {
      const std::size_t at = grains[d].offset(face);
      put(unknowns.grains[u][at], grains[d].data()[at]);
      put(unknowns.water[u][at], water[d].data()[at]);
    });
  }
  for_each(grid.owned(), [&](const Index<D>& cell) {
    const std::size_t at = pressure.offset(cell);
    put(unknowns.pressure[at], pressure.data()[at]);
  });
  VecRestoreArray(values, &x);
}

template <int D>
ImplicitUnknowns<D> number_unknowns(const Grid<D>& grid, Kernel kernel,
                                    const std::vector<SoilParticles<D>>& bodies,
                                    const std::vector<bool>& wet) {
  Halo<D> halo(grid);
  ImplicitFields<D> sums(grid);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    add_volume(grid, kernel, bodies[b], sums, static_cast<bool>(wet[b]));
  std::vector<double*> all;
  for (int d = 0; d < D; ++d)
    all.push_back(sums.grains[d].data()), all.push_back(sums.water[d].data());
  all.push_back(sums.pressure.data());
  halo.add_to_owners(all);
  ImplicitUnknowns<D> unknowns;
  const double threshold = smallest_share * grid.cell_volume();
  PetscInt next = 0;
  for (int d = 0; d < D; ++d)
    for (FaceField<D>* field : {&sums.grains[d], &sums.water[d]}) {
      fold_faces(grid, d, false, *field);
      hold_walls(grid, d, *field);
      number_owned(*field, grid.owned_faces(d), threshold, next);
    }
  fold_pressure(grid, sums.pressure);
  number_owned(sums.pressure, grid.owned(), threshold, next);
  unknowns.owned = next;
  MPI_Exscan(&next, &unknowns.first, 1, MPIU_INT, MPI_SUM, grid.comm());
  if (grid.rank() == 0) unknowns.first = 0;
  for (double* values : all)
    for (std::size_t i = 0; i < grid.local_size(); ++i)
      if (values[i] >= 0.0) values[i] += static_cast<double>(unknowns.first);
  // Ghosts take -1 where their owner has none: exchange overwrites them all.
  halo.exchange(all);
  for (int d = 0; d < D; ++d)
    unknowns.sign[static_cast<std::size_t>(d)].assign(grid.local_size(), 1.0);
  for_each_closed_wall(grid, [&](int axis, int side, Wall wall) {
    for (int d = 0; d < D; ++d) {
      auto& sign = unknowns.sign[static_cast<std::size_t>(d)];
      for_each_mirror_pair(grid, grid.local(), axis, side, d == axis,
                           [&](const Index<D>& behind, const Index<D>& before) {
                             sums.grains[d][behind] = sums.grains[d][before];
                             sums.water[d][behind] = sums.water[d][before];
                             sign[sums.grains[d].offset(behind)] =
                                 parity(d, axis, wall) * sign[sums.grains[d].offset(before)];
                           });
    }
    for_each_mirror_pair(grid, grid.local(), axis, side, false,
                         [&](const Index<D>& behind, const Index<D>& before) {
                           sums.pressure[behind] = sums.pressure[before];
                         });
  });
  for (int d = 0; d < D; ++d) {
    const auto u = static_cast<std::size_t>(d);
    unknowns.grains[u] = as_numbers(sums.grains[d].data(), grid.local_size());
    unknowns.water[u] = as_numbers(sums.water[d].data(), grid.local_size());
  }
  unknowns.pressure = as_numbers(sums.pressure.data(), grid.local_size());
  return unknowns;
}

template struct ImplicitFields<2>;
template struct ImplicitFields<3>;
template ImplicitUnknowns<2> number_unknowns(const Grid<2>&, Kernel,
                                             const std::vector<SoilParticles<2>>&,
                                             const std::vector<bool>&);
template ImplicitUnknowns<3> number_unknowns(const Grid<3>&, Kernel,
                                             const std::vector<SoilParticles<3>>&,
                                             const std::vector<bool>&);

}  // namespace mudlark
