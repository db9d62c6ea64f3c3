#include "soil/implicit_points.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "soil/implicit_nodes.hpp"
#include "soil/point_report.hpp"
#include "soil/splitting.hpp"
#include "soil/stable_step.hpp"

namespace mudlark {
namespace {

/// Step of the displacement gradient by which tangents are differenced [-].
constexpr double difference = 1e-7;
/// A trial that leaves a point less than this share of its volume is none [-].
constexpr double smallest_volume = 0.05;

}  // namespace

template <int D>
ImplicitPoints<D>::ImplicitPoints(const ImplicitProblem<D>& problem)
    : problem_(&problem), bodies_(problem.bodies.size()) {
  double stiffness = 1.0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    stiffness = std::max(stiffness, problem.laws[b]->wave_modulus({}, {}));
    with_kernel(problem.options.kernel, [&]<class K>(K) { sample_loads<K>(b); });
  }
  water_scale_ = max_over_ranks(problem.grid, stiffness) / problem.grid.smallest_spacing();
}

template <int D>
template <class K>
void ImplicitPoints<D>::sample_loads(std::size_t b) {
  const Grid<D>& grid = problem_->grid;
  const auto& points = problem_->bodies[b];
  Body& body = bodies_[b];
  const Vec<D> per_spacing = inverse(grid.spacing());
  body.load.resize(points.size()), body.drained.resize(points.size());
  body.load_slope.resize(points.size()), body.drained_slope.resize(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    const PointSplines<D, K> splines(in_cells(grid, per_spacing, points.position_of(p)));
    const Sample<D> load = sample(grid, splines, per_spacing, problem_->surface.traction);
    const Sample<D> drained = sample(grid, splines, per_spacing, problem_->surface.drained);
    body.load[p] = load.value, body.load_slope[p] = load.gradient;
    body.drained[p] = drained.value, body.drained_slope[p] = drained.gradient;
  }
}

template <int D>
typename ImplicitPoints<D>::Share ImplicitPoints<D>::share(std::size_t b, std::size_t p) const {
  const auto& points = problem_->bodies[b];
  const BodyConstants& body = problem_->constants[b];
  Share s{points.volume[p], points.grain_mass[p], 0.0, 0.0, body.water_density > 0.0};
  if (!s.wet) return s;
  s.porosity = 1.0 - points.grain_mass[p] / (body.grain_density * s.volume);
  s.mass += s.porosity * s.volume * body.water_density;
  s.drag = body.water_viscosity / permeability(body, s.porosity);
  return s;
}

/// Gradient of the displacements, and pore pressure, at the points.
template <int D>
template <class K>
void ImplicitPoints<D>::interpolate(std::size_t b, const ImplicitFields<D>& state) {
  const Grid<D>& grid = problem_->grid;
  const auto& points = problem_->bodies[b];
  Body& body = bodies_[b];
  const Vec<D> per_spacing = inverse(grid.spacing());
  const bool wet = problem_->constants[b].water_density > 0.0;  // dry soil on wet feels none of it
  body.gradient.assign(points.size() * G, 0.0);
  body.pressure.resize(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    const PointSplines<D, K> splines(in_cells(grid, per_spacing, points.position_of(p)));
    PointSplines<D, K>::template static_for<D>([&]<int Component>() {
      const double* u = state.grains[Component].data();
      double* row = &body.gradient[p * G + static_cast<std::size_t>(Component * D)];
      splines.template for_each_node<Component>(
          grid, per_spacing, [&](std::ptrdiff_t at, double, const Vec<D>& slope, const Vec<D>&) {
            for (int j = 0; j < D; ++j) row[j] += u[at] * slope[j];
          });
    });
    body.pressure[p] = points.pore_pressure[p];
    if (wet) body.pressure[p] += sample(grid, splines, per_spacing, &state.pressure).value;
  }
}

/// First Piola-Kirchhoff stress of all points of a body for given gradients.
template <int D>
bool ImplicitPoints<D>::update_stress(std::size_t b, const std::vector<double>& gradient,
                                      std::vector<Gradient>& stress,
                                      std::vector<Gradient>* cofactor) {
  Body& body = bodies_[b];
  const auto& start = problem_->bodies[b];
  body.trial = start;
  const std::string& name = problem_->options.bodies[b].name;
  for (std::size_t p = 0; p < start.size(); ++p) {
    const Gradient f = Gradient::Identity() + Eigen::Map<const Gradient>(&gradient[p * G]);
    const double j = f.determinant();
    if (!(j > smallest_volume)) {
      failure_ =
          fmt::format("soil {}: the point at {} would be pressed to {:.3g} of its volume ({})",
                      name, place_of(start, p), j, state_of(start, p));
      return false;
    }
    body.trial.volume[p] = start.volume[p] * j;
  }
  std::vector<double> by_component(gradient.size());
  for (std::size_t p = 0; p < start.size(); ++p)
    for (std::size_t c = 0; c < G; ++c) by_component[c * start.size() + p] = gradient[p * G + c];
  const StressResult result = mudlark::update_stress(
      body.trial, by_component, *problem_->laws[b], problem_->options.bodies[b].strain,
      {problem_->dt, problem_->time, problem_->grid.smallest_spacing()});
  if (result.failed > 0) {
    failure_ = fmt::format("soil {}: law {} could not be integrated at {} ({})", name,
                           problem_->laws[b]->name(), place_of(start, result.first_failed),
                           state_of(start, result.first_failed));
    return false;
  }
  if (start.carries_extent) follow_extent(by_component, PointRange{0, start.size()}, body.trial);
  stress.resize(start.size());
  if (cofactor) cofactor->resize(start.size());
  for (std::size_t p = 0; p < start.size(); ++p) {
    const Gradient f = Gradient::Identity() + Eigen::Map<const Gradient>(&gradient[p * G]);
    const Gradient c = f.determinant() * f.inverse().transpose();
    const SymTensor cauchy = get_tensor(body.trial.stress, p);
    Gradient total;
    for (int i = 0; i < D; ++i)
      for (int k = 0; k < D; ++k) total(i, k) = cauchy.between<D>(i, k);
    total += (body.load[p] - body.pressure[p]) * Gradient::Identity();
    stress[p] = total * c;
    if (cofactor) (*cofactor)[p] = c;
  }
  return true;
}

/// Tangents of a body's points by central differences of the whole stress update.
template <int D>
bool ImplicitPoints<D>::difference_stress(std::size_t b, LinearPoint<D>* linear) {
  Body& body = bodies_[b];
  std::vector<double> gradient = body.gradient;
  std::vector<Gradient> ahead, behind;
  for (int c = 0; c < G; ++c) {
    const auto nudge = [&](double by) {
      for (std::size_t at = static_cast<std::size_t>(c); at < gradient.size(); at += G)
        gradient[at] = body.gradient[at] + by;
    };
    nudge(difference);
    bool good = update_stress(b, gradient, ahead, nullptr);
    nudge(-difference);
    good = update_stress(b, gradient, behind, nullptr) && good;
    nudge(0.0);
    if (!good) return false;
    for (std::size_t p = 0; p < ahead.size(); ++p)
      for (int r = 0; r < G; ++r)
        linear[p].tangent(r, c) = (ahead[p].data()[r] - behind[p].data()[r]) / (2.0 * difference);
  }
  return true;
}

template <int D>
bool ImplicitPoints<D>::evaluate(const ImplicitFields<D>& state, bool tangents) {
  bool good = true;
  failure_.clear();
  std::size_t first = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    Body& body = bodies_[b];
    const std::size_t count = problem_->bodies[b].size();
    with_kernel(problem_->options.kernel, [&]<class K>(K) { interpolate<K>(b, state); });
    if (tangents) {
      linear_.resize(std::max(linear_.size(), first + count));
      good = difference_stress(b, &linear_[first]) && good;
    }
    good = update_stress(b, body.gradient, body.stress, &body.cofactor) && good;
    if (tangents && good)
      for (std::size_t p = 0; p < count; ++p) {
        LinearPoint<D>& point = linear_[first + p];
        const Share s = share(b, p);
        point.position = problem_->bodies[b].position_of(p);
        point.volume = s.volume;
        point.storage = s.wet ? s.porosity / problem_->options.water_bulk_modulus : 0.0;
        point.drag = s.drag;
        point.wet = s.wet;
        point.cofactor = body.cofactor[p];
      }
    first += count;
  }
  return good;
}

template <int D>
template <class K>
void ImplicitPoints<D>::scatter(std::size_t b, const ImplicitFields<D>& state,
                                ImplicitFields<D>& sums) const {
  const Grid<D>& grid = problem_->grid;
  const auto& points = problem_->bodies[b];
  const Body& body = bodies_[b];
  const Vec<D> per_spacing = inverse(grid.spacing());
  const double bulk = problem_->options.water_bulk_modulus, dt = problem_->dt;
  ImplicitNodes<D> nodes;
  for (std::size_t p = 0; p < points.size(); ++p) {
    nodes.find(grid, per_spacing,
               PointSplines<D, K>(in_cells(grid, per_spacing, points.position_of(p))));
    const Share s = share(b, p);
    const Gradient& stress = body.stress[p];
    const Gradient& cofactor = body.cofactor[p];
    double flow = 0.0;  // divergence of the water's way
    for (const auto& face : nodes.faces) {
      const int d = face.component;
      double force = s.mass * grid.gravity()[d] * face.weight;
      double push = 0.0;  // slope of the surface pressure in the end's place
      for (int j = 0; j < D; ++j) {
        force -= s.volume * stress(d, j) * face.slope[j];
        push += cofactor(d, j) * body.load_slope[p][j];
      }
      force -= s.volume * face.weight * push;
      sums.grains[d].data()[face.at] -= force;
      if (!s.wet) continue;
      const double way = state.water[d].data()[face.at];
      flow += way * face.slope[d];
      const double drive =
          s.volume * ((body.pressure[p] - body.drained[p]) * face.slope[d] +
                      face.weight * (problem_->constants[b].water_density * grid.gravity()[d] -
                                     body.drained_slope[p][d]));
      sums.water[d].data()[face.at] += s.volume * face.weight * s.drag * way / dt - drive;
    }
    if (!s.wet) continue;
    const double stretch = body.trial.volume[p] / s.volume - 1.0;
    const double volume =
        s.volume *
        (s.porosity / bulk * (body.pressure[p] - points.pore_pressure[p]) + stretch + flow);
    for (const auto& cell : nodes.cells)
      sums.pressure.data()[cell.at] += water_scale_ * cell.weight * volume;
  }
}

template <int D>
void ImplicitPoints<D>::add_residual(const ImplicitFields<D>& state,
                                     ImplicitFields<D>& sums) const {
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    with_kernel(problem_->options.kernel, [&]<class K>(K) { scatter<K>(b, state, sums); });
}

template <int D>
double ImplicitPoints<D>::smallest_residual() const {
  const double spacing = problem_->grid.smallest_spacing();
  double force = 0.0, rounding = 0.0, count = 0.0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const auto& points = problem_->bodies[b];
    const double modulus = largest_wave_modulus(points, *problem_->laws[b]);
    count += static_cast<double>(points.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
      const SymTensor stress = get_tensor(points.stress, p);
      const double pressure = std::sqrt(stress.squared_norm()) + std::abs(points.pore_pressure[p]) +
                              std::abs(bodies_[b].load[p]);
      force = std::max(force, pressure * points.volume[p] / spacing);
      rounding = std::max(rounding, modulus * points.volume[p] / spacing);
    }
  }
  // F = I + grad u is known to the last digit of 1, so stress to the last digit of the modulus:
  // what the points leave of that on the faces adds up as the root of their number. Soil that is
  // stiff against what it carries could not get below it.
  MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_DOUBLE, MPI_SUM, problem_->grid.comm());
  rounding = std::numeric_limits<double>::epsilon() * std::sqrt(count) *
             max_over_ranks(problem_->grid, rounding);
  return std::max({1e-9 * max_over_ranks(problem_->grid, force), rounding, 1e-12});
}

/// Moves the points; velocities are the step's means.
template <int D>
void ImplicitPoints<D>::finish(const ImplicitFields<D>& state, ImplicitOutcome& outcome) {
  const Grid<D>& grid = problem_->grid;
  const Vec<D> per_spacing = inverse(grid.spacing());
  const double dt = problem_->dt;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    Body& body = bodies_[b];
    for (const double g : body.gradient)
      outcome.largest_strain = std::max(outcome.largest_strain, std::abs(g));
    with_kernel(problem_->options.kernel, [&]<class K>(K) {
      ImplicitNodes<D> nodes;
      for (std::size_t p = 0; p < body.trial.size(); ++p) {
        nodes.find(grid, per_spacing,
                   PointSplines<D, K>(in_cells(grid, per_spacing, body.trial.position_of(p))));
        const double porosity = std::max(share(b, p).porosity, 1e-6);
        Vec<D> way, water;
        for (const auto& face : nodes.faces) {
          way[face.component] += face.weight * state.grains[face.component].data()[face.at];
          water[face.component] += face.weight * state.water[face.component].data()[face.at];
        }
        outcome.largest_step = std::max(outcome.largest_step, norm(way));
        double change = 0.0, way2 = 0.0;
        for (int a = 0; a < D; ++a) {
          const double velocity = way[a] / dt;
          change += (velocity - body.trial.velocity[a][p]) * (velocity - body.trial.velocity[a][p]);
          body.trial.position[a][p] += way[a];
          const double moved = body.trial.position[a][p] - body.trial.start[a][p];
          way2 += moved * moved;
          body.trial.velocity[a][p] = velocity;
          body.trial.water_velocity[a][p] = velocity + water[a] / (dt * porosity);
        }
        outcome.largest_change = std::max(outcome.largest_change, std::sqrt(change));
        outcome.largest_way = std::max(outcome.largest_way, std::sqrt(way2));
        body.trial.pore_pressure[p] = body.pressure[p];
      }
    });
    problem_->bodies[b] = body.trial;
  }
}

template class ImplicitPoints<2>;
template class ImplicitPoints<3>;

}  // namespace mudlark
