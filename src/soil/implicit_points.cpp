#include "soil/implicit_points.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "soil/point_stencil.hpp"
#include "soil/splitting.hpp"

namespace mudlark {
namespace {

/// Step of the displacement gradient by which tangents are differenced [-].
constexpr double difference = 1e-7;

/// The nodes around a point: faces of all components, then cells.
template <int D>
struct Nodes {
  struct Face {
    int component;
    std::ptrdiff_t at;
    double weight;
    Vec<D> slope;
  };
  struct Cell {
    std::ptrdiff_t at;
    double weight;
  };
  std::vector<Face> faces;
  std::vector<Cell> cells;

  template <class K>
  void find(const Grid<D>& grid, const Vec<D>& per_spacing, const PointSplines<D, K>& splines) {
    faces.clear();
    cells.clear();
    PointSplines<D, K>::template static_for<D>([&]<int Component>() {
      splines.template for_each_node<Component>(
          grid, per_spacing, [&](std::ptrdiff_t at, double w, const Vec<D>& slope, const Vec<D>&) {
            faces.push_back({Component, at, w, slope});
          });
    });
    splines.template for_each_node<-1>(
        grid, per_spacing, [&](std::ptrdiff_t at, double w, const Vec<D>&, const Vec<D>&) {
          cells.push_back({at, w});
        });
  }
  bool same_places(const Nodes& other) const {
    return !faces.empty() && faces.size() == other.faces.size() &&
           faces.front().at == other.faces.front().at && faces.back().at == other.faces.back().at &&
           cells.front().at == other.cells.front().at;
  }
};

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
    body.pressure[p] =
        points.pore_pressure[p] + sample(grid, splines, per_spacing, &state.pressure).value;
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
  bool good = true;
  for (std::size_t p = 0; p < start.size(); ++p) {
    const Gradient f = Gradient::Identity() + Eigen::Map<const Gradient>(&gradient[p * G]);
    const double j = f.determinant();
    good = good && j > 0.05;
    body.trial.volume[p] = start.volume[p] * std::max(j, 0.05);
  }
  if (!good) return false;
  std::vector<double> by_component(gradient.size());
  for (std::size_t p = 0; p < start.size(); ++p)
    for (std::size_t c = 0; c < G; ++c) by_component[c * start.size() + p] = gradient[p * G + c];
  const StressResult result = mudlark::update_stress(
      body.trial, by_component, *problem_->laws[b], problem_->options.bodies[b].strain,
      {problem_->dt, problem_->time, problem_->grid.smallest_spacing()});
  if (result.failed > 0) return false;
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

template <int D>
bool ImplicitPoints<D>::evaluate(const ImplicitFields<D>& state, bool tangents) {
  bool good = true;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    Body& body = bodies_[b];
    with_kernel(problem_->options.kernel, [&]<class K>(K) { interpolate<K>(b, state); });
    if (tangents) {
      std::vector<double> gradient = body.gradient;
      std::vector<Gradient> ahead, behind;
      body.tangent.resize(problem_->bodies[b].size());
      for (int c = 0; c < G; ++c) {
        const auto nudge = [&](double by) {
          for (std::size_t at = static_cast<std::size_t>(c); at < gradient.size(); at += G)
            gradient[at] = body.gradient[at] + by;
        };
        nudge(difference);
        good = update_stress(b, gradient, ahead, nullptr) && good;
        nudge(-difference);
        good = update_stress(b, gradient, behind, nullptr) && good;
        nudge(0.0);
        if (!good) break;
        for (std::size_t p = 0; p < body.tangent.size(); ++p)
          for (int r = 0; r < G; ++r)
            body.tangent[p](r, c) = (ahead[p].data()[r] - behind[p].data()[r]) / (2.0 * difference);
      }
    }
    good = update_stress(b, body.gradient, body.stress, &body.cofactor) && good;
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
  Nodes<D> nodes;
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

/// Dense blocks of points that share their nodes, added to the matrix at once.
template <int D>
template <class K>
void ImplicitPoints<D>::assemble(std::size_t b, const ImplicitUnknowns<D>& unknowns, ::Mat matrix,
                                 bool pattern) const {
  const Grid<D>& grid = problem_->grid;
  const auto& points = problem_->bodies[b];
  const Body& body = bodies_[b];
  const Vec<D> per_spacing = inverse(grid.spacing());
  const double bulk = problem_->options.water_bulk_modulus, dt = problem_->dt;
  Nodes<D> nodes, group;
  Eigen::MatrixXd block;
  Eigen::VectorXd signs;
  std::vector<PetscInt> numbers;
  const auto flush = [&] {
    if (group.faces.empty()) return;
    for (Eigen::Index c = 0; c < block.cols(); ++c)  // column-major and sign of mirrored places
      block.col(c) = (block.col(c).array() * signs.array() * signs[c]).matrix();
    const Eigen::MatrixXd rows = block.transpose();  // PETSc reads rows
    const auto n = static_cast<PetscInt>(numbers.size());
    MatSetValues(matrix, n, numbers.data(), n, numbers.data(), rows.data(), ADD_VALUES);
  };
  const auto open = [&] {
    group = nodes;
    const std::size_t faces = nodes.faces.size(), cells = nodes.cells.size();
    numbers.resize(2 * faces + cells);
    signs = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(numbers.size()));
    for (std::size_t i = 0; i < faces; ++i) {
      const auto u = static_cast<std::size_t>(nodes.faces[i].component);
      const auto at = static_cast<std::size_t>(nodes.faces[i].at);
      numbers[i] = unknowns.grains[u][at];
      numbers[faces + i] = unknowns.water[u][at];
      signs[static_cast<Eigen::Index>(i)] = signs[static_cast<Eigen::Index>(faces + i)] =
          unknowns.sign[u][at];
    }
    for (std::size_t i = 0; i < cells; ++i)
      numbers[2 * faces + i] = unknowns.pressure[static_cast<std::size_t>(nodes.cells[i].at)];
    block = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(numbers.size()),
                                  static_cast<Eigen::Index>(numbers.size()));
  };
  for (std::size_t p = 0; p < points.size(); ++p) {
    nodes.find(grid, per_spacing,
               PointSplines<D, K>(in_cells(grid, per_spacing, points.position_of(p))));
    if (!nodes.same_places(group)) {
      flush();
      open();
    }
    if (pattern) continue;
    const Share s = share(b, p);
    const auto faces = static_cast<Eigen::Index>(nodes.faces.size());
    const auto cells = static_cast<Eigen::Index>(nodes.cells.size());
    // Columns: gradient of the displacement of each face's component.
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(G, faces);
    Eigen::VectorXd volume_change(faces), divergence(faces), cell_weight(cells);
    const Gradient& c = body.cofactor[p];
    for (Eigen::Index i = 0; i < faces; ++i) {
      const auto& face = nodes.faces[static_cast<std::size_t>(i)];
      double change = 0.0;
      for (int j = 0; j < D; ++j) {
        slopes(face.component * D + j, i) = face.slope[j];
        change += c(face.component, j) * face.slope[j];
      }
      volume_change[i] = change;
      divergence[i] = face.slope[face.component];
    }
    for (Eigen::Index i = 0; i < cells; ++i)
      cell_weight[i] = nodes.cells[static_cast<std::size_t>(i)].weight;
    block.topLeftCorner(faces, faces).noalias() +=
        s.volume * (slopes.transpose() * (body.tangent[p] * slopes));
    if (!s.wet) continue;
    block.block(0, 2 * faces, faces, cells) -= s.volume * volume_change * cell_weight.transpose();
    for (Eigen::Index i = 0; i < faces; ++i)
      block(faces + i, faces + i) +=
          s.volume * nodes.faces[static_cast<std::size_t>(i)].weight * s.drag / dt;
    block.block(faces, 2 * faces, faces, cells) -= s.volume * divergence * cell_weight.transpose();
    const double scale = water_scale_ * s.volume;
    block.block(2 * faces, 0, cells, faces) += scale * cell_weight * volume_change.transpose();
    block.block(2 * faces, faces, cells, faces) += scale * cell_weight * divergence.transpose();
    block.bottomRightCorner(cells, cells) +=
        scale * s.porosity / bulk * cell_weight * cell_weight.transpose();
  }
  flush();
}

template <int D>
void ImplicitPoints<D>::add_jacobian(const ImplicitUnknowns<D>& unknowns, ::Mat matrix) const {
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    with_kernel(problem_->options.kernel,
                [&]<class K>(K) { assemble<K>(b, unknowns, matrix, false); });
}
template <int D>
void ImplicitPoints<D>::add_pattern(const ImplicitUnknowns<D>& unknowns, ::Mat matrix) const {
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    with_kernel(problem_->options.kernel,
                [&]<class K>(K) { assemble<K>(b, unknowns, matrix, true); });
}

template <int D>
double ImplicitPoints<D>::smallest_residual() const {
  double force = 0.0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const auto& points = problem_->bodies[b];
    for (std::size_t p = 0; p < points.size(); ++p) {
      const SymTensor stress = get_tensor(points.stress, p);
      const double pressure = std::sqrt(stress.squared_norm()) + std::abs(points.pore_pressure[p]) +
                              std::abs(bodies_[b].load[p]);
      force = std::max(force, pressure * points.volume[p] / problem_->grid.smallest_spacing());
    }
  }
  return std::max(1e-9 * max_over_ranks(problem_->grid, force), 1e-12);
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
      Nodes<D> nodes;
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
