#include "soil/implicit_unknowns.hpp"

#include <algorithm>

#include "soil/point_stencil.hpp"

namespace mudlark {
namespace {

/// Faces with less than this share of a cell's volume in their reach are held: they touch the
/// outermost points only. Cells need more: a pore pressure that hardly any point feels is not
/// determined by the balance of water, and the system is singular but for round-off.
constexpr double smallest_face_share = 1e-4, smallest_cell_share = 0.02;

/// Adds what lies behind closed sides to the places before them.
template <int D>
void fold_volumes(const SoilSides<D>& sides, int component, FaceField<D>& field) {
  for (int axis = 0; axis < D; ++axis)
    for_each_image(sides, sides.grid().local(), axis, component,
                   [&](const SideNode&, const Index<D>& behind, const Index<D>& before) {
                     field[before] += field[behind];
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

/// Faces on sides are not unknowns: grains are held, and water unless the side has a pressure.
template <int D>
void hold_sides(const SoilSides<D>& sides, int component, bool water, FaceField<D>& volume) {
  for_each_face_on_sides(sides, sides.grid().local(), component,
                         [&](int, const SideNode& node, const Index<D>& face) {
                           if (!water || node.water != WaterSide::pressure) volume[face] = 0.0;
                         });
}

/// Numbers and signs of the places behind sides.
template <int D>
void number_images(const SoilSides<D>& sides, ImplicitFields<D>& numbers,
                   ImplicitUnknowns<D>& unknowns) {
  const Grid<D>& grid = sides.grid();
  for (std::size_t d = 0; d < D; ++d) {
    unknowns.grain_sign[d].assign(grid.local_size(), 1.0);
    unknowns.water_sign[d].assign(grid.local_size(), 1.0);
  }
  unknowns.pressure_sign.assign(grid.local_size(), 1.0);
  for (int axis = 0; axis < D; ++axis) {
    for (int d = 0; d < D; ++d) {
      auto& grain_sign = unknowns.grain_sign[static_cast<std::size_t>(d)];
      auto& water_sign = unknowns.water_sign[static_cast<std::size_t>(d)];
      for_each_image(sides, grid.local(), axis, d,
                     [&](const SideNode& node, const Index<D>& behind, const Index<D>& before) {
                       const auto to = static_cast<std::size_t>(grid.offset(behind)),
                                  from = static_cast<std::size_t>(grid.offset(before));
                       numbers.grains[d].data()[to] = numbers.grains[d].data()[from];
                       numbers.water[d].data()[to] = numbers.water[d].data()[from];
                       grain_sign[to] = node.grain_sign * grain_sign[from];
                       water_sign[to] = node.flux_sign * water_sign[from];
                     });
    }
    for_each_image_of_cells(
        sides, grid.local(), axis,
        [&](int, const SideNode& node, const Index<D>& behind, const Index<D>& before) {
          const auto to = static_cast<std::size_t>(grid.offset(behind)),
                     from = static_cast<std::size_t>(grid.offset(before));
          numbers.pressure.data()[to] = numbers.pressure.data()[from];
          unknowns.pressure_sign[to] = pressure_sign(node) * unknowns.pressure_sign[from];
        });
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
  std::fill(bodies.begin(), bodies.end(), 0.0);
}

template <int D>
void ImplicitFields<D>::load(const ImplicitSides<D>& sides, Halo<D>& halo,
                             const ImplicitUnknowns<D>& unknowns, ::Vec values) {
  const Grid<D>& grid = sides.sides().grid();
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
  load_bodies(grid, unknowns, values, bodies);
  halo.exchange(grains);
  halo.exchange(water);
  halo.exchange(pressure);
  sides.complete(grains, water, pressure);
}

template <int D>
void ImplicitFields<D>::store(const ImplicitSides<D>& sides, Halo<D>& halo,
                              const ImplicitUnknowns<D>& unknowns, ::Vec values) {
  const Grid<D>& grid = sides.sides().grid();
  std::vector<double*> all;
  for (int d = 0; d < D; ++d) all.push_back(grains[d].data()), all.push_back(water[d].data());
  all.push_back(pressure.data());
  halo.add_to_owners(all);
  sides.fold(grains, water, pressure);
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
  store_bodies(grid, unknowns, bodies, values);
}

template <int D>
void load_bodies(const Grid<D>& grid, const ImplicitUnknowns<D>& unknowns, ::Vec values,
                 std::vector<double>& bodies) {
  bodies.resize(static_cast<std::size_t>(unknowns.body_freedoms));
  if (bodies.empty()) return;
  if (grid.rank() == 0) {
    const PetscScalar* x = nullptr;
    VecGetArrayRead(values, &x);
    std::copy_n(x + unknowns.first_body, bodies.size(), bodies.begin());
    VecRestoreArrayRead(values, &x);
  }
  MPI_Bcast(bodies.data(), unknowns.body_freedoms, MPI_DOUBLE, 0, grid.comm());
}

template <int D>
void store_bodies(const Grid<D>& grid, const ImplicitUnknowns<D>& unknowns,
                  const std::vector<double>& bodies, ::Vec values) {
  if (unknowns.body_freedoms == 0) return;
  std::vector<double> all(bodies.size());
  MPI_Reduce(bodies.data(), all.data(), unknowns.body_freedoms, MPI_DOUBLE, MPI_SUM, 0,
             grid.comm());
  if (grid.rank() != 0) return;
  PetscScalar* x = nullptr;
  VecGetArray(values, &x);
  std::copy(all.begin(), all.end(), x + unknowns.first_body);
  VecRestoreArray(values, &x);
}

template <int D>
ImplicitUnknowns<D> number_unknowns(const SoilSides<D>& sides, Kernel kernel,
                                    const std::vector<SoilParticles<D>>& bodies,
                                    const std::vector<bool>& wet, int body_freedoms) {
  const Grid<D>& grid = sides.grid();
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
  PetscInt next = 0;
  for (int d = 0; d < D; ++d)
    for (FaceField<D>* field : {&sums.grains[d], &sums.water[d]}) {
      fold_volumes(sides, d, *field);
      hold_sides(sides, d, field == &sums.water[d], *field);
      number_owned(*field, grid.owned_faces(d), smallest_face_share * grid.cell_volume(), next);
    }
  fold_cells(sides, grid.local(), sums.pressure);
  number_owned(sums.pressure, grid.owned(), smallest_cell_share * grid.cell_volume(), next);
  unknowns.first_body = next;
  MPI_Bcast(&unknowns.first_body, 1, MPIU_INT, 0, grid.comm());
  unknowns.body_freedoms = body_freedoms;
  if (grid.rank() == 0) next += body_freedoms;
  unknowns.owned = next;
  MPI_Exscan(&next, &unknowns.first, 1, MPIU_INT, MPI_SUM, grid.comm());
  if (grid.rank() == 0) unknowns.first = 0;
  MPI_Allreduce(&next, &unknowns.total, 1, MPIU_INT, MPI_SUM, grid.comm());
  for (double* values : all)
    for (std::size_t i = 0; i < grid.local_size(); ++i)
      if (values[i] >= 0.0) values[i] += static_cast<double>(unknowns.first);
  // Ghosts take -1 where their owner has none: exchange overwrites them all.
  halo.exchange(all);
  number_images(sides, sums, unknowns);
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
template void load_bodies(const Grid<2>&, const ImplicitUnknowns<2>&, ::Vec, std::vector<double>&);
template void load_bodies(const Grid<3>&, const ImplicitUnknowns<3>&, ::Vec, std::vector<double>&);
template void store_bodies(const Grid<2>&, const ImplicitUnknowns<2>&, const std::vector<double>&,
                           ::Vec);
template void store_bodies(const Grid<3>&, const ImplicitUnknowns<3>&, const std::vector<double>&,
                           ::Vec);
template ImplicitUnknowns<2> number_unknowns(const SoilSides<2>&, Kernel,
                                             const std::vector<SoilParticles<2>>&,
                                             const std::vector<bool>&, int);
template ImplicitUnknowns<3> number_unknowns(const SoilSides<3>&, Kernel,
                                             const std::vector<SoilParticles<3>>&,
                                             const std::vector<bool>&, int);

}  // namespace mudlark
