#include "soil/transfer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "soil/cell_transfer.hpp"
#include "soil/grains_in_cells.hpp"
#include "soil/point_stencil.hpp"

namespace mudlark {
namespace {

/// Pores do not close altogether for the water that is asked to pass them [-].
constexpr double least_porosity_of_drag = 0.01;

/// What one point gives to its nodes, apart from what depends on the component.
template <int D>
struct PointSource {
  double grain_mass, water_mass, water_density, volume, held_volume, drag, pore_pressure;
  SymTensor stress;
  Sample<D> traction, drained;
};

/// Momentum of phase at a node: m w (v + C (x_node - x_point)).
struct AffineMomentum {
  double constant = 0.0;
  std::array<double, 3> per_node{};
};

template <int D, int Component>
AffineMomentum affine_momentum(const PointQuantity<D * D>& affine, std::size_t p, double velocity,
                               const Vec<D>& first_from_point, const Vec<D>& spacing) {
  AffineMomentum m{velocity, {}};
  for (int a = 0; a < D; ++a) {
    const double slope = affine[Component * D + a][p] * spacing[a];
    m.constant += slope * first_from_point[a];
    m.per_node[static_cast<std::size_t>(a)] = slope;
  }
  return m;
}

template <int D, class K, bool affine, int Component>
void scatter_component(const Grid<D>& grid, const PointSplines<D, K>& splines,
                       const Vec<D>& per_spacing, const Vec<D>& cells,
                       const SoilParticles<D>& points, std::size_t p, const PointSource<D>& source,
                       NodeSums* nodes) {
  constexpr int d = Component;
  const double v = points.velocity[d][p], vw = points.water_velocity[d][p];
  const double volume = source.volume, traction = source.traction.value;
  Vec<D> force;  // -V (sigma - p I + p_e I), row d
  for (int j = 0; j < D; ++j)
    force[j] = -volume * (source.stress.template between<D>(d, j) +
                          (j == d ? traction - source.pore_pressure : 0.0));
  const double gravity = grid.gravity()[d];
  const double body_force =
      (source.grain_mass + source.water_mass) * gravity - volume * source.traction.gradient[d];
  const double water_force = volume * (source.pore_pressure - source.drained.value);
  const double water_body = volume * (source.water_density * gravity - source.drained.gradient[d]);
  AffineMomentum grains{v, {}}, water{vw, {}};
  if constexpr (affine) {
    const Vec<D> first = splines.template first_from_point<Component>(cells);
    grains = affine_momentum<D, Component>(points.affine, p, v, first, grid.spacing());
    water = affine_momentum<D, Component>(points.water_affine, p, vw, first, grid.spacing());
  }
  splines.template for_each_node<Component>(
      grid, per_spacing, [&](std::ptrdiff_t at, double w, const Vec<D>& g, const Vec<D>& count) {
        NodeSums& node = nodes[at];
        double u = grains.constant, uw = water.constant;
        if constexpr (affine)
          for (int a = 0; a < D; ++a) {
            u += grains.per_node[static_cast<std::size_t>(a)] * count[a];
            uw += water.per_node[static_cast<std::size_t>(a)] * count[a];
          }
        node.grain_mass += w * source.grain_mass;
        node.water_mass += w * source.water_mass;
        node.volume += w * source.held_volume;
        node.drag += w * source.drag;
        node.grain_momentum += w * source.grain_mass * u;
        node.water_momentum += w * source.water_mass * uw;
        node.mixture_force += w * body_force + dot(force, g);
        node.water_force += w * water_body + water_force * g[d];
      });
}

template <int D, class K, bool affine>
void scatter(const Grid<D>& grid, const SoilParticles<D>& points, const BodyConstants& body,
             const SurfacePressure<D>& surface, NodeField<NodeSums, D>& nodes) {
  const Vec<D> per_spacing = inverse(grid.spacing());
  const bool wet = body.water_density > 0.0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Vec<D> cells = in_cells(grid, per_spacing, points.position_of(p));
    const PointSplines<D, K> splines(cells);
    PointSource<D> source;
    source.grain_mass = points.grain_mass[p];
    source.volume = points.volume[p];
    source.held_volume = held_volume(body, points.grain_mass[p], source.volume);
    source.water_density = body.water_density;
    source.stress = get_tensor(points.stress, p);
    source.traction = sample(grid, splines, per_spacing, surface.traction);
    source.water_mass = source.drag = source.pore_pressure = 0.0;
    if (wet) {
      const double n = 1.0 - source.grain_mass / (body.grain_density * source.volume);
      source.water_mass = n * source.volume * body.water_density;
      source.drag = source.volume * n * n * body.water_viscosity / permeability(body, n);
      source.pore_pressure = points.pore_pressure[p];
      source.drained = sample(grid, splines, per_spacing, surface.drained);
    }
    PointSplines<D, K>::template static_for<D>([&]<int Component>() {
      scatter_component<D, K, affine, Component>(grid, splines, per_spacing, cells, points, p,
                                                 source,
                                                 nodes[static_cast<std::size_t>(Component)].data());
    });
  }
}

/// Motion of one component around a point.
template <int D>
struct Gathered {
  double velocity = 0.0, change = 0.0, water_velocity = 0.0, water_change = 0.0, flux_slope = 0.0;
  Vec<D> gradient{};
  Vec<D> moment{}, water_moment{};  ///< sum w v (node count along each axis), for APIC
};

template <int D, class K, bool affine, int Component>
Gathered<D> gather_component(const Grid<D>& grid, const PointSplines<D, K>& splines,
                             const Vec<D>& per_spacing, const NodeMotion* nodes) {
  Gathered<D> sum;
  splines.template for_each_node<Component>(
      grid, per_spacing, [&](std::ptrdiff_t at, double w, const Vec<D>& g, const Vec<D>& count) {
        const NodeMotion& node = nodes[at];
        sum.velocity += w * node.grain_velocity;
        sum.change += w * node.grain_change;
        sum.water_velocity += w * node.water_velocity;
        sum.water_change += w * node.water_change;
        sum.flux_slope += g[Component] * node.total_flux;
        sum.gradient += node.grain_velocity * g;
        if constexpr (affine)
          for (int a = 0; a < D; ++a) {
            sum.moment[a] += w * node.grain_velocity * count[a];
            sum.water_moment[a] += w * node.water_velocity * count[a];
          }
      });
  return sum;
}

/// Row `Component` of the APIC matrix: C = sum w v (x_node - x_point)^T / D with D = h^2/4
/// (quadratic), h^2/3 (cubic) per axis (Jiang et al. 2015); linear splines take the velocity
/// gradient, which is their limit.
template <int D, class K, int Component>
void set_affine(const PointSplines<D, K>& splines, const Vec<D>& cells, const Grid<D>& grid,
                const Gathered<D>& sum, std::size_t p, bool pore_water, SoilParticles<D>& points) {
  const Vec<D> first = splines.template first_from_point<Component>(cells);
  for (int a = 0; a < D; ++a) {
    const int degree = a == Component ? K::along : K::across;
    const double scale = (degree == 3 ? 3.0 : 4.0) / grid.spacing()[a];
    points.affine[Component * D + a][p] =
        degree == 1 ? sum.gradient[a] : scale * (sum.moment[a] + first[a] * sum.velocity);
    if (!pore_water) continue;
    points.water_affine[Component * D + a][p] =
        degree == 1 ? sum.gradient[a]
                    : scale * (sum.water_moment[a] + first[a] * sum.water_velocity);
  }
}

template <int D, class K, bool affine>
void gather(const Grid<D>& grid, const NodeField<NodeMotion, D>& nodes, const PointUpdate& update,
            PointRange range, SoilParticles<D>& points, PointMotion& motion) {
  const Vec<D> per_spacing = inverse(grid.spacing());
  const double flip = update.flip_fraction;
  double largest = 0.0;
  for (std::size_t p = range.first; p < range.last; ++p) {
    const Vec<D> cells = in_cells(grid, per_spacing, points.position_of(p));
    const PointSplines<D, K> splines(cells);
    double divergence = 0.0, speed2 = 0.0;
    PointSplines<D, K>::template static_for<D>([&]<int Component>() {
      constexpr int d = Component;
      const Gathered<D> sum = gather_component<D, K, affine, Component>(
          grid, splines, per_spacing, nodes[static_cast<std::size_t>(d)].data());
      double& v = points.velocity[d][p];
      v = affine ? sum.velocity : flip * (v + sum.change) + (1.0 - flip) * sum.velocity;
      if (update.pore_water) {
        double& vw = points.water_velocity[d][p];
        vw = affine ? sum.water_velocity
                    : flip * (vw + sum.water_change) + (1.0 - flip) * sum.water_velocity;
      }
      if constexpr (affine)
        set_affine<D, K, Component>(splines, cells, grid, sum, p, update.pore_water, points);
      points.position[d][p] += update.dt * sum.velocity;
      for (int j = 0; j < D; ++j)
        motion.gradient[static_cast<std::size_t>(d * D + j) * (range.last - range.first) + p -
                        range.first] = update.dt * sum.gradient[j];
      divergence += sum.flux_slope;
      speed2 += std::max(v * v, sum.velocity * sum.velocity);
    });
    if (update.pore_water) motion.flux_divergence[p - range.first] = divergence;
    if (!(speed2 <= largest))
      largest = speed2 < 1e300 ? speed2 : std::numeric_limits<double>::infinity();
  }
  motion.largest_speed = std::max(motion.largest_speed, std::sqrt(largest));
}

/// Adds value(point) to the cells around each point.
template <int D, class K, class Value>
void add_to_cells(const Grid<D>& grid, const SoilParticles<D>& points, CellField<D>& field,
                  Value&& value) {
  const Vec<D> per_spacing = inverse(grid.spacing());
  double* values = field.data();
  for (std::size_t p = 0; p < points.size(); ++p) {
    const PointSplines<D, K> splines(in_cells(grid, per_spacing, points.position_of(p)));
    const double share = value(p);
    splines.template for_each_node<-1>(
        grid, per_spacing, [&](std::ptrdiff_t at, double w, const Vec<D>&, const Vec<D>&) {
          values[at] += w * share;
        });
  }
}

}  // namespace

double permeability(const BodyConstants& body, double porosity) {
  if (body.permeability_law == PermeabilityLaw::constant) return body.intrinsic_permeability;
  const double pores = porosity / body.start_porosity;
  const double grains = (1.0 - body.start_porosity) / (1.0 - porosity);
  return body.intrinsic_permeability * pores * pores * pores * grains * grains;
}

template <int D>
void points_to_grid_one_by_one(const Grid<D>& grid, const SoilParticles<D>& points,
                               const BodyConstants& body, Kernel kernel, Transfer transfer,
                               const SurfacePressure<D>& surface, NodeField<NodeSums, D>& nodes) {
  with_kernel(kernel, [&]<class K>(K) {
    if (transfer == Transfer::apic)
      scatter<D, K, true>(grid, points, body, surface, nodes);
    else
      scatter<D, K, false>(grid, points, body, surface, nodes);
  });
}

template <int D>
void points_to_grid(const Grid<D>& grid, const SoilParticles<D>& points, const BodyConstants& body,
                    Kernel kernel, Transfer transfer, const SurfacePressure<D>& surface,
                    NodeField<NodeSums, D>& nodes) {
  with_kernel(kernel, [&]<class K>(K) {
    if constexpr (K::across != 2)
      points_to_grid_one_by_one(grid, points, body, kernel, transfer, surface, nodes);
    else if (transfer == Transfer::apic)
      scatter_by_cell<D, K, true>(grid, points, body, surface, nodes);
    else
      scatter_by_cell<D, K, false>(grid, points, body, surface, nodes);
  });
}

namespace {

template <int D>
void make_room(PointRange range, bool pore_water, PointMotion& motion) {
  motion.gradient.resize((range.last - range.first) * D * D);
  if (pore_water) motion.flux_divergence.resize(range.last - range.first);
}

}  // namespace

template <int D>
void grid_to_points_one_by_one(const Grid<D>& grid, const NodeField<NodeMotion, D>& nodes,
                               Kernel kernel, Transfer transfer, const PointUpdate& update,
                               PointRange range, SoilParticles<D>& points, PointMotion& motion) {
  make_room<D>(range, update.pore_water, motion);
  with_kernel(kernel, [&]<class K>(K) {
    if (transfer == Transfer::apic)
      gather<D, K, true>(grid, nodes, update, range, points, motion);
    else
      gather<D, K, false>(grid, nodes, update, range, points, motion);
  });
}

template <int D>
void grid_to_points(const Grid<D>& grid, const NodeField<NodeMotion, D>& nodes, Kernel kernel,
                    Transfer transfer, const PointUpdate& update, PointRange range,
                    SoilParticles<D>& points, PointMotion& motion) {
  make_room<D>(range, update.pore_water, motion);
  with_kernel(kernel, [&]<class K>(K) {
    if constexpr (K::across != 2)
      grid_to_points_one_by_one(grid, nodes, kernel, transfer, update, range, points, motion);
    else if (transfer == Transfer::apic)
      gather_by_cell<D, K, true>(grid, nodes, update, range, points, motion);
    else
      gather_by_cell<D, K, false>(grid, nodes, update, range, points, motion);
  });
}

template <int D>
void add_solid_fraction(const Grid<D>& grid, const SoilParticles<D>& points, double grain_density,
                        Kernel kernel, double weight, CellField<D>& solid_fraction) {
  const double per_mass = weight / (grain_density * grid.cell_volume());
  with_kernel(kernel, [&]<class K>(K) {
    add_to_cells<D, K>(grid, points, solid_fraction,
                       [&](std::size_t p) { return per_mass * points.grain_mass[p]; });
  });
}

template <int D>
void add_resistance(const Grid<D>& grid, const SoilParticles<D>& points, const BodyConstants& body,
                    Kernel kernel, CellField<D>& resistance) {
  const double scale = body.water_viscosity / grid.cell_volume();
  with_kernel(kernel, [&]<class K>(K) {
    add_to_cells<D, K>(grid, points, resistance, [&](std::size_t p) {
      const double porosity = 1.0 - points.grain_mass[p] / (body.grain_density * points.volume[p]);
      return scale * points.volume[p] /
             permeability(body, std::max(least_porosity_of_drag, porosity));
    });
  });
}

template void points_to_grid(const Grid<2>&, const SoilParticles<2>&, const BodyConstants&, Kernel,
                             Transfer, const SurfacePressure<2>&, NodeField<NodeSums, 2>&);
template void points_to_grid(const Grid<3>&, const SoilParticles<3>&, const BodyConstants&, Kernel,
                             Transfer, const SurfacePressure<3>&, NodeField<NodeSums, 3>&);
template void points_to_grid_one_by_one(const Grid<2>&, const SoilParticles<2>&,
                                        const BodyConstants&, Kernel, Transfer,
                                        const SurfacePressure<2>&, NodeField<NodeSums, 2>&);
template void grid_to_points(const Grid<2>&, const NodeField<NodeMotion, 2>&, Kernel, Transfer,
                             const PointUpdate&, PointRange, SoilParticles<2>&, PointMotion&);
template void grid_to_points_one_by_one(const Grid<2>&, const NodeField<NodeMotion, 2>&, Kernel,
                                        Transfer, const PointUpdate&, PointRange, SoilParticles<2>&,
                                        PointMotion&);
template void points_to_grid_one_by_one(const Grid<3>&, const SoilParticles<3>&,
                                        const BodyConstants&, Kernel, Transfer,
                                        const SurfacePressure<3>&, NodeField<NodeSums, 3>&);
template void grid_to_points(const Grid<3>&, const NodeField<NodeMotion, 3>&, Kernel, Transfer,
                             const PointUpdate&, PointRange, SoilParticles<3>&, PointMotion&);
template void grid_to_points_one_by_one(const Grid<3>&, const NodeField<NodeMotion, 3>&, Kernel,
                                        Transfer, const PointUpdate&, PointRange, SoilParticles<3>&,
                                        PointMotion&);
template void add_solid_fraction(const Grid<2>&, const SoilParticles<2>&, double, Kernel, double,
                                 CellField<2>&);
template void add_solid_fraction(const Grid<3>&, const SoilParticles<3>&, double, Kernel, double,
                                 CellField<3>&);
template void add_resistance(const Grid<2>&, const SoilParticles<2>&, const BodyConstants&, Kernel,
                             CellField<2>&);
template void add_resistance(const Grid<3>&, const SoilParticles<3>&, const BodyConstants&, Kernel,
                             CellField<3>&);

}  // namespace mudlark
