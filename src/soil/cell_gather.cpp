/// Grid to points, a cell at a time: lanes are points, and the motion of a node is the same for
/// all of them. Sums run along x, then y, then z.
#include <limits>

#include "soil/cell_splines.hpp"
#include "soil/cell_transfer.hpp"

namespace mudlark {
namespace {

/// Spline, its slope, and spline times distance of the node from the point in cells (for APIC).
template <class Value, std::size_t N>
struct GatherSpline {
  AxisSpline<Value, static_cast<int>(N)> spline;
  std::array<Value, N> moment;

  void set(const AxisSpline<Value, static_cast<int>(N)>& on, const Value& place, double first) {
    spline = on;
    for (std::size_t k = 0; k < N; ++k)
      moment[k] = spline.weight[k] * (static_cast<double>(k) + first - place);
  }
};

/// Sums over the nodes of one component around the points; what a mode does not need stays out.
template <int D, bool affine, bool wet>
struct Sums {
  using Value = Lanes<point_lanes<D>>;
  Value velocity{}, change{}, water_velocity{}, water_change{}, flux_slope{};
  std::array<Value, D> gradient{}, moment{}, water_moment{};

  /// Adds what a line or plane of nodes across `axis` gave; the axes below are summed already.
  template <int Component, int Axis, std::size_t N>
  void add(const Sums& part, const GatherSpline<Value, N>& on, std::size_t k) {
    const Value &w = on.spline.weight[k], &slope = on.spline.slope[k];
    velocity += w * part.velocity;
    for (std::size_t a = 0; a < Axis; ++a) gradient[a] += w * part.gradient[a];
    gradient[Axis] += slope * part.velocity;
    if constexpr (affine) {
      for (std::size_t a = 0; a < Axis; ++a) moment[a] += w * part.moment[a];
      moment[Axis] += on.moment[k] * part.velocity;
    } else {
      change += w * part.change;
    }
    if constexpr (!wet) return;
    flux_slope += (Component == Axis ? slope : w) * part.flux_slope;
    water_velocity += w * part.water_velocity;
    if constexpr (affine) {
      for (std::size_t a = 0; a < Axis; ++a) water_moment[a] += w * part.water_moment[a];
      water_moment[Axis] += on.moment[k] * part.water_velocity;
    } else {
      water_change += w * part.water_change;
    }
  }
  template <int Component, std::size_t N>
  void add_node(const NodeMotion& node, const GatherSpline<Value, N>& on, std::size_t i) {
    const Value &w = on.spline.weight[i], &slope = on.spline.slope[i];
    velocity += w * node.grain_velocity;
    gradient[0] += slope * node.grain_velocity;
    if constexpr (affine)
      moment[0] += on.moment[i] * node.grain_velocity;
    else
      change += w * node.grain_change;
    if constexpr (!wet) return;
    flux_slope += (Component == 0 ? slope : w) * node.total_flux;
    water_velocity += w * node.water_velocity;
    if constexpr (affine)
      water_moment[0] += on.moment[i] * node.water_velocity;
    else
      water_change += w * node.water_change;
  }
};

template <int D, class K, bool affine, bool wet>
class CellGather {
 public:
  using Value = Lanes<point_lanes<D>>;
  CellGather(const Grid<D>& grid, const NodeField<NodeMotion, D>& nodes, const PointUpdate& update,
             PointRange range, SoilParticles<D>& points, PointMotion& motion)
      : grid_(grid),
        nodes_(nodes),
        update_(update),
        range_(range),
        points_(points),
        motion_(motion),
        stride_{1, D == 3 ? grid.stride(1) : 0, grid.stride(D - 1)} {}

  void take(const CellBatches<D>& batches, const CellBatch<D>& batch) {
    const Vec<D>& per_spacing = batches.per_spacing();
    Splines splines;
    for (int a = 0; a < D; ++a) {
      const auto u = static_cast<std::size_t>(a);
      const Value r = batches.place(batch, a);
      splines.face[u].set(face_spline<K::along>(r, per_spacing[a]), r, first_face);
      splines.centre[u].set(centre_spline(r, per_spacing[a]), r, first_centre);
    }
    Index<D> corner = batch.cell;
    for (int a = 0; a < D; ++a) --corner[a];
    const std::ptrdiff_t first = grid_.offset(corner);
    Value divergence{}, speed2{};
    take_component<0>(batch, per_spacing, splines, first, divergence, speed2);
    take_component<1>(batch, per_spacing, splines, first, divergence, speed2);
    if constexpr (D == 3) take_component<2>(batch, per_spacing, splines, first, divergence, speed2);
    if constexpr (wet) batch.set(divergence, motion_.flux_divergence.data(), range_.first);
    for (int i = batch.live; i < CellBatch<D>::lanes; ++i)
      speed2[static_cast<std::size_t>(i)] = 0.0;
    largest_ = speed2 > largest_ ? speed2 : largest_;
    beyond_ = speed2 < 1e300 ? beyond_ : beyond_ + 1.0;
  }
  double largest_speed() const {
    double largest = 0.0;
    for (std::size_t i = 0; i < CellBatch<D>::lanes; ++i)
      largest = std::max(largest,
                         beyond_[i] > 0.0 ? std::numeric_limits<double>::infinity() : largest_[i]);
    return std::sqrt(largest);
  }

 private:
  /// Splines of a batch, which the components share.
  struct Splines {
    using Face = GatherSpline<Value, 4>;
    using Centre = GatherSpline<Value, 3>;
    std::array<Face, D> face;
    std::array<Centre, D> centre;

    template <int Component, int Axis>
    const auto& on() const {
      if constexpr (Component == Axis)
        return face[static_cast<std::size_t>(Axis)];
      else
        return centre[static_cast<std::size_t>(Axis)];
    }
  };

  template <int Component>
  Sums<D, affine, wet> sum_nodes(const Splines& splines, const NodeMotion* corner) const {
    using Part = Sums<D, affine, wet>;
    constexpr int d = Component;
    constexpr std::size_t nx = d == 0 ? 4 : 3, ny = d == 1 ? 4 : 3, nz = d == D - 1 ? 4 : 3;
    const auto& x = splines.template on<d, 0>();
    const auto& z = splines.template on<d, D - 1>();
    Part all;
    for (std::size_t k = 0; k < nz; ++k) {
      const NodeMotion* plane = corner + static_cast<std::ptrdiff_t>(k) * stride_[2];
      Part sum;
      if constexpr (D == 2) {
        for (std::size_t i = 0; i < nx; ++i) sum.template add_node<d>(plane[i], x, i);
      } else {
        const auto& y = splines.template on<d, 1>();
        for (std::size_t j = 0; j < ny; ++j) {
          const NodeMotion* row = plane + static_cast<std::ptrdiff_t>(j) * stride_[1];
          Part line;
          for (std::size_t i = 0; i < nx; ++i) line.template add_node<d>(row[i], x, i);
          sum.template add<d, 1>(line, y, j);
        }
      }
      all.template add<d, D - 1>(sum, z, k);
    }
    return all;
  }

  template <int Component>
  void take_component(const CellBatch<D>& batch, const Vec<D>& per_spacing, const Splines& splines,
                      std::ptrdiff_t first, Value& divergence, Value& speed2) {
    constexpr int d = Component;
    const auto sum = sum_nodes<d>(splines, nodes_[static_cast<std::size_t>(d)].data() + first);
    const double flip = update_.flip_fraction;
    Value v = sum.velocity;
    if constexpr (!affine)
      v = flip * (batch.get(points_.velocity[d]) + sum.change) + (1.0 - flip) * sum.velocity;
    batch.set(v, points_.velocity[d]);
    if constexpr (wet) {
      Value water = sum.water_velocity;
      if constexpr (!affine)
        water = flip * (batch.get(points_.water_velocity[d]) + sum.water_change) +
                (1.0 - flip) * sum.water_velocity;
      batch.set(water, points_.water_velocity[d]);
      divergence += sum.flux_slope;
    }
    if constexpr (affine)
      for (int a = 0; a < D; ++a) {  // see set_affine in transfer.cpp
        const auto u = static_cast<std::size_t>(a);
        const double scale = (a == d && K::along == 3 ? 3.0 : 4.0) * per_spacing[a];
        batch.set(scale * sum.moment[u], points_.affine[d * D + a]);
        if constexpr (wet) batch.set(scale * sum.water_moment[u], points_.water_affine[d * D + a]);
      }
    batch.set(batch.get(points_.position[d]) + update_.dt * sum.velocity, points_.position[d]);
    const Value point2 = v * v, grid2 = sum.velocity * sum.velocity;
    speed2 += point2 > grid2 ? point2 : grid2;
    for (std::size_t j = 0; j < D; ++j) {
      double* row = motion_.gradient.data() + (d * D + j) * (range_.last - range_.first);
      batch.set(update_.dt * sum.gradient[j], row, range_.first);
    }
  }

  const Grid<D>& grid_;
  const NodeField<NodeMotion, D>& nodes_;
  const PointUpdate& update_;
  PointRange range_;
  SoilParticles<D>& points_;
  PointMotion& motion_;
  std::array<std::ptrdiff_t, 3> stride_;
  Value largest_{}, beyond_{};  ///< square of the speed; above zero: too large or not a number
};

}  // namespace

template <int D, class K, bool affine>
void gather_by_cell(const Grid<D>& grid, const NodeField<NodeMotion, D>& nodes,
                    const PointUpdate& update, PointRange range, SoilParticles<D>& points,
                    PointMotion& motion) {
  CellBatches<D> batches(grid, points);
  const auto run = [&](auto gather) {
    motion.strays +=
        batches.for_each(range, [&](const CellBatch<D>& batch) { gather.take(batches, batch); });
    motion.largest_speed = std::max(motion.largest_speed, gather.largest_speed());
  };
  if (update.pore_water)
    run(CellGather<D, K, affine, true>(grid, nodes, update, range, points, motion));
  else
    run(CellGather<D, K, affine, false>(grid, nodes, update, range, points, motion));
}

// clang-format off
template void gather_by_cell<2, QuadraticKernel, false>(const Grid<2>&, const NodeField<NodeMotion, 2>&, const PointUpdate&, PointRange, SoilParticles<2>&, PointMotion&);
template void gather_by_cell<2, QuadraticKernel, true>(const Grid<2>&, const NodeField<NodeMotion, 2>&, const PointUpdate&, PointRange, SoilParticles<2>&, PointMotion&);
template void gather_by_cell<2, CompositeKernel, false>(const Grid<2>&, const NodeField<NodeMotion, 2>&, const PointUpdate&, PointRange, SoilParticles<2>&, PointMotion&);
template void gather_by_cell<2, CompositeKernel, true>(const Grid<2>&, const NodeField<NodeMotion, 2>&, const PointUpdate&, PointRange, SoilParticles<2>&, PointMotion&);
template void gather_by_cell<3, QuadraticKernel, false>(const Grid<3>&, const NodeField<NodeMotion, 3>&, const PointUpdate&, PointRange, SoilParticles<3>&, PointMotion&);
template void gather_by_cell<3, QuadraticKernel, true>(const Grid<3>&, const NodeField<NodeMotion, 3>&, const PointUpdate&, PointRange, SoilParticles<3>&, PointMotion&);
template void gather_by_cell<3, CompositeKernel, false>(const Grid<3>&, const NodeField<NodeMotion, 3>&, const PointUpdate&, PointRange, SoilParticles<3>&, PointMotion&);
template void gather_by_cell<3, CompositeKernel, true>(const Grid<3>&, const NodeField<NodeMotion, 3>&, const PointUpdate&, PointRange, SoilParticles<3>&, PointMotion&);
// clang-format on

}  // namespace mudlark
