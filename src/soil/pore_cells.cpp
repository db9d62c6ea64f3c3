#include "soil/pore_cells.hpp"

#include "soil/point_stencil.hpp"

namespace mudlark {

template <int D>
void add_filling(const Grid<D>& grid, const SoilParticles<D>& points, const BodyConstants& body,
                 Kernel kernel, CellField<D>& filling, CellField<D>& pores) {
  const Vec<D> per_spacing = inverse(grid.spacing());
  const double per_cell = 1.0 / grid.cell_volume();
  double *all = filling.data(), *water = pores.data();
  with_kernel(kernel, [&]<class K>(K) {
    for (std::size_t p = 0; p < points.size(); ++p) {
      const PointSplines<D, K> splines(in_cells(grid, per_spacing, points.position_of(p)));
      const double volume = per_cell * points.volume[p];
      const double open = volume - per_cell * points.grain_mass[p] / body.grain_density;
      splines.template for_each_node<-1>(
          grid, per_spacing, [&](std::ptrdiff_t at, double w, const Vec<D>&, const Vec<D>&) {
            all[at] += w * volume;
            water[at] += w * open;
          });
    }
  });
}

template <int D>
void sample_range(const Grid<D>& grid, const SoilParticles<D>& points, PointRange range,
                  Kernel kernel, const CellField<D>& field, std::vector<double>& values) {
  const Vec<D> per_spacing = inverse(grid.spacing());
  const double* cells = field.data();
  values.resize(range.last - range.first);
  with_kernel(kernel, [&]<class K>(K) {
    for (std::size_t p = range.first; p < range.last; ++p) {
      const PointSplines<D, K> splines(in_cells(grid, per_spacing, points.position_of(p)));
      double sum = 0.0;
      splines.template for_each_node<-1>(
          grid, per_spacing,
          [&](std::ptrdiff_t at, double w, const Vec<D>&, const Vec<D>&) { sum += w * cells[at]; });
      values[p - range.first] = sum;
    }
  });
}

template void add_filling(const Grid<2>&, const SoilParticles<2>&, const BodyConstants&, Kernel,
                          CellField<2>&, CellField<2>&);
template void add_filling(const Grid<3>&, const SoilParticles<3>&, const BodyConstants&, Kernel,
                          CellField<3>&, CellField<3>&);
template void sample_range(const Grid<2>&, const SoilParticles<2>&, PointRange, Kernel,
                           const CellField<2>&, std::vector<double>&);
template void sample_range(const Grid<3>&, const SoilParticles<3>&, PointRange, Kernel,
                           const CellField<3>&, std::vector<double>&);

}  // namespace mudlark
