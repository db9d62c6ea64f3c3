/// Points to grid, a cell at a time. What a point gives to its nodes is the product of a row
/// factor, the same for all nodes of a row along x, and the spline along x. Row factors are
/// computed with points as lanes; then, row by row, point after point, lanes are the nodes of the
/// row, and the sums stay in registers until the batch is through.
#include "soil/cell_splines.hpp"
#include "soil/cell_transfer.hpp"
#include "soil/grains_in_cells.hpp"

namespace mudlark {
namespace {

/// The same for each point of a batch, as lanes.
template <int D, class K>
struct BatchSource {
  static constexpr int lanes = point_lanes<D>;
  using Value = Lanes<lanes>;

  Vec<D> per_spacing;
  std::array<Value, D> place;
  std::array<AxisSpline<Value, 4>, D> face;  ///< first axis not used: see the node splines
  std::array<AxisSpline<Value, 3>, D> centre;
  std::array<NodeSpline, lanes> face_x, centre_x;
  Value grain_mass, volume, held_volume, water_mass, drag, pore_pressure;
  Value traction{}, drained{};
  std::array<Value, D> traction_gradient{}, drained_gradient{};

  BatchSource(const CellBatches<D>& batches, const CellBatch<D>& batch)
      : per_spacing(batches.per_spacing()) {
    for (int a = 0; a < D; ++a) {
      const auto u = static_cast<std::size_t>(a);
      place[u] = batches.place(batch, a);
      if (a > 0) face[u] = face_spline<K::along>(place[u], per_spacing[a]);
      centre[u] = centre_spline(place[u], per_spacing[a]);
    }
    for (std::size_t p = 0; p < static_cast<std::size_t>(batch.live); ++p) {
      face_x[p] = NodeSpline::about_faces<K::along>(place[0][p], per_spacing[0]);
      centre_x[p] = NodeSpline::about_centres(place[0][p], per_spacing[0]);
    }
  }
  template <int Component, int Axis>
  const auto& on() const {
    if constexpr (Component == Axis)
      return face[static_cast<std::size_t>(Axis)];
    else
      return centre[static_cast<std::size_t>(Axis)];
  }
};

/// Value and gradient of a cell field at the points.
template <int D, class K>
void sample(const BatchSource<D, K>& source, const double* first_node,
            const std::array<std::ptrdiff_t, 3>& stride, Lanes<point_lanes<D>>& value,
            std::array<Lanes<point_lanes<D>>, D>& gradient) {
  using Value = Lanes<point_lanes<D>>;
  const auto &sx = source.centre[0], &sz = source.centre[D - 1];
  value = Value{};
  gradient = {};
  for (std::size_t k = 0; k < 3; ++k) {
    Value plane{}, plane_x{}, plane_y{};
    for (std::size_t j = 0; j < (D == 3 ? 3 : 1); ++j) {
      const double* row = first_node + static_cast<std::ptrdiff_t>(k) * stride[2] +
                          static_cast<std::ptrdiff_t>(j) * stride[1];
      Value sum{}, slope{};
      for (std::size_t i = 0; i < 3; ++i)
        sum += sx.weight[i] * row[i], slope += sx.slope[i] * row[i];
      if constexpr (D == 3) {
        const auto& sy = source.centre[1];
        plane += sy.weight[j] * sum, plane_x += sy.weight[j] * slope, plane_y += sy.slope[j] * sum;
      } else {
        plane = sum, plane_x = slope;
      }
    }
    value += sz.weight[k] * plane;
    gradient[0] += sz.weight[k] * plane_x;
    if constexpr (D == 3) gradient[1] += sz.weight[k] * plane_y;
    gradient[D - 1] += sz.slope[k] * plane;
  }
}

/// Kozeny-Carman or constant permeability, see permeability().
template <class Value>
Value permeability_of(const BodyConstants& body, const Value& porosity) {
  if (body.permeability_law == PermeabilityLaw::constant)
    return body.intrinsic_permeability - Value{};
  const Value pores = porosity / body.start_porosity;
  const Value grains = (1.0 - body.start_porosity) / (1.0 - porosity);
  return body.intrinsic_permeability * pores * pores * pores * grains * grains;
}

template <int D, class K, bool affine, bool wet>
class CellScatter {
 public:
  using Value = Lanes<point_lanes<D>>;
  CellScatter(const Grid<D>& grid, const SoilParticles<D>& points, const BodyConstants& body,
              const SurfacePressure<D>& surface, NodeField<NodeSums, D>& nodes)
      : grid_(grid), points_(points), body_(body), surface_(surface), nodes_(nodes) {
    stride_ = {1, D == 3 ? grid.stride(1) : 0, grid.stride(D - 1)};
  }

  void add(const CellBatches<D>& batches, const CellBatch<D>& batch) {
    BatchSource<D, K> source(batches, batch);
    Index<D> corner = batch.cell;
    for (int a = 0; a < D; ++a) --corner[a];
    const std::ptrdiff_t first = grid_.offset(corner);
    source.grain_mass = batch.get(points_.grain_mass);
    source.volume = batch.get(points_.volume);
    source.held_volume = held_volume(body_, source.grain_mass, source.volume);
    if (surface_.traction)
      sample<D, K>(source, surface_.traction->data() + first, stride_, source.traction,
                   source.traction_gradient);
    if constexpr (wet) {
      const Value n = 1.0 - source.grain_mass / (body_.grain_density * source.volume);
      source.water_mass = n * source.volume * body_.water_density;
      source.drag = source.volume * n * n * body_.water_viscosity / permeability_of(body_, n);
      source.pore_pressure = batch.get(points_.pore_pressure);
      if (surface_.drained)
        sample<D, K>(source, surface_.drained->data() + first, stride_, source.drained,
                     source.drained_gradient);
    }
    add_component<0>(batch, source, first);
    add_component<1>(batch, source, first);
    if constexpr (D == 3) add_component<2>(batch, source, first);
  }

 private:
  static constexpr std::size_t lanes = point_lanes<D>;

  /// What multiplies the spline along x, per row and point: for the four sums of dry soil (grain
  /// mass, volume, momentum, force), then for water mass, drag, momentum and force; with `slope`
  /// what multiplies the slope of the spline, with `moment` what multiplies spline times node
  /// count.
  struct Rows {
    static constexpr std::size_t most = 16;
    alignas(64) double sum[most][wet ? 8 : 4][lanes];
    alignas(64) double force_slope[most][lanes], water_slope[most][lanes];
    alignas(64) double moment[most][lanes], water_moment[most][lanes];
  };

  /// Momentum per mass at the first node of the first row, and its change per node and axis.
  template <int Component>
  void affine_velocity(const CellBatch<D>& batch, const BatchSource<D, K>& source,
                       const PointQuantity<D>& velocity, const PointQuantity<D * D>& affine_matrix,
                       Value& constant, std::array<Value, D>& per_node) const {
    constant = batch.get(velocity[Component]);
    per_node = {};
    if constexpr (affine)
      for (int a = 0; a < D; ++a) {
        const auto u = static_cast<std::size_t>(a);
        per_node[u] = batch.get(affine_matrix[Component * D + a]) * grid_.spacing()[a];
        constant += per_node[u] * ((a == Component ? first_face : first_centre) - source.place[u]);
      }
  }

  template <int Component>
  void fill_rows(const CellBatch<D>& batch, const BatchSource<D, K>& source, Rows& rows) const {
    constexpr int d = Component;
    constexpr std::size_t ny = D == 3 ? (d == 1 ? 4 : 3) : 1, nz = d == D - 1 ? 4 : 3;
    std::array<Value, D> force;  // -V (sigma - p I + p_e I), row d
    for (int j = 0; j < D; ++j) {
      Value stress = batch.get(points_.stress[tensor_component(d, j)]);
      if (j == d) {
        stress += source.traction;
        if constexpr (wet) stress -= source.pore_pressure;
      }
      force[static_cast<std::size_t>(j)] = -source.volume * stress;
    }
    const double gravity = grid_.gravity()[d];
    Value body_force = source.grain_mass * gravity - source.volume * source.traction_gradient[d];
    Value water_force{}, water_body{}, water_velocity{};
    Value velocity;
    std::array<Value, D> per_node, water_per_node;
    affine_velocity<d>(batch, source, points_.velocity, points_.affine, velocity, per_node);
    if constexpr (wet) {
      body_force += source.water_mass * gravity;
      water_force = source.volume * (source.pore_pressure - source.drained);
      water_body = source.volume * (body_.water_density * gravity - source.drained_gradient[d]);
      affine_velocity<d>(batch, source, points_.water_velocity, points_.water_affine,
                         water_velocity, water_per_node);
    }
    const auto& sz = source.template on<d, D - 1>();
    for (std::size_t k = 0; k < nz; ++k)
      for (std::size_t j = 0; j < ny; ++j) {
        const std::size_t row = k * ny + j;
        Value w = sz.weight[k], slope_y{}, slope_z = sz.slope[k];
        if constexpr (D == 3) {
          const auto& sy = source.template on<d, 1>();
          slope_y = sy.slope[j] * w;
          w *= sy.weight[j];
          slope_z *= sy.weight[j];
        }
        auto& sum = rows.sum[row];
        const Value mass = w * source.grain_mass;
        Value u = velocity;
        if constexpr (affine) {
          u += static_cast<double>(k) * per_node[D - 1];
          if constexpr (D == 3) u += static_cast<double>(j) * per_node[1];
          store<lanes>(mass * per_node[0], rows.moment[row]);
        }
        store<lanes>(mass, sum[0]);
        store<lanes>(w * source.held_volume, sum[1]);
        store<lanes>(mass * u, sum[2]);
        Value total = w * body_force + slope_z * force[D - 1];
        if constexpr (D == 3) total += slope_y * force[1];
        store<lanes>(total, sum[3]);
        store<lanes>(w * force[0], rows.force_slope[row]);
        if constexpr (wet) {
          const Value water_mass = w * source.water_mass;
          u = water_velocity;
          if constexpr (affine) {
            u += static_cast<double>(k) * water_per_node[D - 1];
            if constexpr (D == 3) u += static_cast<double>(j) * water_per_node[1];
            store<lanes>(water_mass * water_per_node[0], rows.water_moment[row]);
          }
          store<lanes>(water_mass, sum[4]);
          store<lanes>(w * source.drag, sum[5]);
          store<lanes>(water_mass * u, sum[6]);
          total = w * water_body;
          if constexpr (d == D - 1) total += slope_z * water_force;
          if constexpr (D == 3 && d == 1) total += slope_y * water_force;
          store<lanes>(total, sum[7]);
          if constexpr (d == 0) store<lanes>(w * water_force, rows.water_slope[row]);
        }
      }
  }

  template <int Component>
  void add_component(const CellBatch<D>& batch, const BatchSource<D, K>& source,
                     std::ptrdiff_t first) {
    constexpr int d = Component;
    constexpr std::size_t ny = D == 3 ? (d == 1 ? 4 : 3) : 1, nz = d == D - 1 ? 4 : 3;
    Rows rows;
    fill_rows<d>(batch, source, rows);
    const auto& splines = d == 0 ? source.face_x : source.centre_x;
    const auto live = static_cast<std::size_t>(batch.live);
    NodeSums* base = nodes_[static_cast<std::size_t>(d)].data() + first;
    for (std::size_t k = 0; k < nz; ++k)
      for (std::size_t j = 0; j < ny; ++j) {
        const std::size_t row = k * ny + j;
        Lanes<4> grains[4]{}, water[4]{};
        for (std::size_t p = 0; p < live; ++p) {
          const Lanes<4> w = splines[p].weight, slope = splines[p].slope;
          const auto& sum = rows.sum[row];
          for (std::size_t q = 0; q < 4; ++q) grains[q] += sum[q][p] * w;
          grains[3] += rows.force_slope[row][p] * slope;
          if constexpr (wet) {
            for (std::size_t q = 0; q < 4; ++q) water[q] += sum[4 + q][p] * w;
            if constexpr (d == 0) water[3] += rows.water_slope[row][p] * slope;
          }
          if constexpr (affine) {
            const Lanes<4> moment = w * Lanes<4>{0.0, 1.0, 2.0, 3.0};
            grains[2] += rows.moment[row][p] * moment;
            if constexpr (wet) water[2] += rows.water_moment[row][p] * moment;
          }
        }
        NodeSums* to = base + static_cast<std::ptrdiff_t>(k) * stride_[2] +
                       static_cast<std::ptrdiff_t>(j) * stride_[1];
        add_row<d == 0 ? 4 : 3>(grains, water, to);
      }
  }

  /// Adds the sums of a row, lanes being its nodes.
  template <std::size_t Nodes>
  static void add_row(const Lanes<4> (&grains)[4], const Lanes<4> (&water)[4], NodeSums* row) {
    Lanes<4> node[4], wet_node[4];
    transpose(grains, node);
    if constexpr (wet) transpose(water, wet_node);
    for (std::size_t i = 0; i < Nodes; ++i) {
      auto* sums = reinterpret_cast<double*>(row + i);
      store<4>(load<4>(sums + 2) + node[i], sums + 2);
      if constexpr (wet) {
        const Lanes<4> add = wet_node[i];
        sums[0] += add[0], sums[1] += add[1], sums[6] += add[2], sums[7] += add[3];
      }
    }
  }

  /// Which component of the stress couples two axes (2D: axis 1 is z).
  static constexpr int tensor_component(int row, int column) {
    const int r = D == 2 && row == 1 ? 2 : row, c = D == 2 && column == 1 ? 2 : column;
    if (r == c) return r;
    return r + c == 1 ? 3 : r + c == 3 ? 4 : 5;
  }

  const Grid<D>& grid_;
  const SoilParticles<D>& points_;
  const BodyConstants& body_;
  const SurfacePressure<D>& surface_;
  NodeField<NodeSums, D>& nodes_;
  std::array<std::ptrdiff_t, 3> stride_;
};

}  // namespace

template <int D, class K, bool affine>
void scatter_by_cell(const Grid<D>& grid, const SoilParticles<D>& points, const BodyConstants& body,
                     const SurfacePressure<D>& surface, NodeField<NodeSums, D>& nodes) {
  CellBatches<D> batches(grid, points);
  const auto run = [&](auto scatter) {
    batches.for_each({0, points.size()},
                     [&](const CellBatch<D>& batch) { scatter.add(batches, batch); });
  };
  if (body.water_density > 0.0)
    run(CellScatter<D, K, affine, true>(grid, points, body, surface, nodes));
  else
    run(CellScatter<D, K, affine, false>(grid, points, body, surface, nodes));
}

// clang-format off
template void scatter_by_cell<2, QuadraticKernel, false>(const Grid<2>&, const SoilParticles<2>&, const BodyConstants&, const SurfacePressure<2>&, NodeField<NodeSums, 2>&);
template void scatter_by_cell<2, QuadraticKernel, true>(const Grid<2>&, const SoilParticles<2>&, const BodyConstants&, const SurfacePressure<2>&, NodeField<NodeSums, 2>&);
template void scatter_by_cell<2, CompositeKernel, false>(const Grid<2>&, const SoilParticles<2>&, const BodyConstants&, const SurfacePressure<2>&, NodeField<NodeSums, 2>&);
template void scatter_by_cell<2, CompositeKernel, true>(const Grid<2>&, const SoilParticles<2>&, const BodyConstants&, const SurfacePressure<2>&, NodeField<NodeSums, 2>&);
template void scatter_by_cell<3, QuadraticKernel, false>(const Grid<3>&, const SoilParticles<3>&, const BodyConstants&, const SurfacePressure<3>&, NodeField<NodeSums, 3>&);
template void scatter_by_cell<3, QuadraticKernel, true>(const Grid<3>&, const SoilParticles<3>&, const BodyConstants&, const SurfacePressure<3>&, NodeField<NodeSums, 3>&);
template void scatter_by_cell<3, CompositeKernel, false>(const Grid<3>&, const SoilParticles<3>&, const BodyConstants&, const SurfacePressure<3>&, NodeField<NodeSums, 3>&);
template void scatter_by_cell<3, CompositeKernel, true>(const Grid<3>&, const SoilParticles<3>&, const BodyConstants&, const SurfacePressure<3>&, NodeField<NodeSums, 3>&);
// clang-format on

}  // namespace mudlark
