#include "run/material_gauge.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mudlark {
namespace {

template <int D>
int components(MaterialQuantity quantity) {
  switch (quantity) {
    case MaterialQuantity::displacement:
      return D;
    case MaterialQuantity::effective_stress:
      return 4;
    case MaterialQuantity::pore_pressure:
    case MaterialQuantity::porosity:
      return 1;
  }
  return 0;
}

template <int D>
void read_point(const SoilParticles<D>& points, const BodyConstants& body, std::size_t p,
                MaterialQuantity quantity, double* values) {
  switch (quantity) {
    case MaterialQuantity::displacement:
      for (int a = 0; a < D; ++a) values[a] = points.position[a][p] - points.start[a][p];
      return;
    case MaterialQuantity::pore_pressure:
      values[0] = points.pore_pressure[p];
      return;
    case MaterialQuantity::effective_stress: {
      const SymTensor s = get_tensor(points.stress, p);
      values[0] = s.xx, values[1] = s.yy, values[2] = s.zz, values[3] = s.zx;
      return;
    }
    case MaterialQuantity::porosity:
      values[0] = 1.0 - points.grain_mass[p] / (body.grain_density * points.volume[p]);
      return;
  }
}

/// Where a point started, seen from a place, in cells.
template <int D>
Vec<D> cells_away(const Grid<D>& grid, const SoilParticles<D>& points, std::size_t p,
                  const Vec<D>& at) {
  Vec<D> away;
  for (int a = 0; a < D; ++a) {
    away[a] = (points.start[a][p] - at[a]) / grid.spacing()[a];
    if (grid.periodic(a))  // the start of a point that crossed the seam lies one length away
      away[a] -= grid.cells()[a] * std::round(away[a] / grid.cells()[a]);
  }
  return away;
}

/// The stage whose soil started nearest to a place: ground and fill beside each other have not
/// moved together. Collective.
template <int D>
std::size_t nearest_stage(const Grid<D>& grid, const SoilSolver<D>& soil, const Vec<D>& at) {
  const std::size_t stages = soil.options().stages.size();
  if (stages < 2) return 0;
  std::vector<double> mine(stages, std::numeric_limits<double>::infinity()), all = mine;
  for (std::size_t b = 0; b < soil.bodies(); ++b) {
    double& nearest = mine[soil.options().bodies[b].stage];
    for (std::size_t p = 0; p < soil.points(b).size(); ++p) {
      const Vec<D> away = cells_away(grid, soil.points(b), p, at);
      nearest = std::min(nearest, dot(away, away));
    }
  }
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(stages), MPI_DOUBLE, MPI_MIN,
                grid.comm());
  constexpr double hair = 1e-9;  // of two that are as near, the older one
  std::size_t nearest = 0;
  for (std::size_t s = 1; s < stages; ++s)
    if (all[s] < all[nearest] * (1.0 - hair)) nearest = s;
  return nearest;
}

}  // namespace

template <int D>
std::vector<double> read_material(const Grid<D>& grid, const SoilSolver<D>& soil,
                                  MaterialQuantity quantity, const Vec<D>& at) {
  constexpr int basis = D + 1;
  const int width = components<D>(quantity);
  // Moments of the fit: basis x basis, then basis x width, then the number of points.
  std::vector<double> mine(static_cast<std::size_t>(basis * basis + basis * width + 1), 0.0),
      all = mine;
  std::array<double, 4> values{};
  const std::size_t stage = nearest_stage(grid, soil, at);
  for (std::size_t b = 0; b < soil.bodies(); ++b) {
    if (soil.options().bodies[b].stage != stage) continue;
    const auto& points = soil.points(b);
    for (std::size_t p = 0; p < points.size(); ++p) {
      std::array<double, basis> term{1.0};
      double weight = 1.0;
      const Vec<D> away = cells_away(grid, points, p, at);
      for (int a = 0; a < D; ++a) {
        term[static_cast<std::size_t>(a + 1)] = away[a];
        weight *= std::max(0.0, 1.0 - std::abs(away[a]) / 1.5);
      }
      if (weight <= 0.0) continue;
      read_point(points, soil.constants(b), p, quantity, values.data());
      for (std::size_t i = 0; i < basis; ++i) {
        for (std::size_t j = 0; j < basis; ++j) mine[i * basis + j] += weight * term[i] * term[j];
        for (std::size_t c = 0; c < static_cast<std::size_t>(width); ++c)
          mine[basis * basis + i * static_cast<std::size_t>(width) + c] +=
              weight * term[i] * values[c];
      }
      mine.back() += 1.0;
    }
  }
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(mine.size()), MPI_DOUBLE, MPI_SUM,
                grid.comm());
  if (all.back() == 0.0) return {};
  using Dynamic = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Dynamic> matrix(all.data(), basis, basis);
  const Eigen::Map<const Dynamic> right(all.data() + basis * basis, basis, width);
  // Too few points for a slope along an axis leave the matrix singular: the least-norm answer has
  // no slope there.
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> fit;
  fit.setThreshold(1e-9);
  fit.compute(matrix);
  const Eigen::MatrixXd coefficients = fit.solve(Eigen::MatrixXd(right));
  std::vector<double> result(static_cast<std::size_t>(width));
  for (int c = 0; c < width; ++c) result[static_cast<std::size_t>(c)] = coefficients(0, c);
  return result;
}

template std::vector<double> read_material(const Grid<2>&, const SoilSolver<2>&, MaterialQuantity,
                                           const Vec<2>&);
template std::vector<double> read_material(const Grid<3>&, const SoilSolver<3>&, MaterialQuantity,
                                           const Vec<3>&);

}  // namespace mudlark
