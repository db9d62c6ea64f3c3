// Particle-to-grid and back: conservation, exactness for linear fields, compatibility with the
// staggered divergence.
#include "soil/transfer.hpp"

#include <gtest/gtest.h>

#include "soil/grains_in_cells.hpp"
#include "soil/pore_cells.hpp"
#include "soil/walls.hpp"
#include "unit/soil/soil_setup.hpp"

namespace mudlark {
namespace {

using namespace soil_test;

/// Sums over the points: what each component of the grid must hold.
template <int D>
struct Sums {
  NodeSums scalar;
  Vec<D> grain_momentum{}, water_momentum{};
};

template <int D>
Sums<D> sum_points(const SoilParticles<D>& points, const BodyConstants& body) {
  Sums<D> sums;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double grains = points.grain_mass[p], volume = points.volume[p];
    const double n = 1.0 - grains / (body.grain_density * volume);
    const double water = water_mass_of(grains, volume, body);
    sums.scalar.grain_mass += grains;
    sums.scalar.water_mass += water;
    sums.scalar.volume += volume;
    sums.scalar.drag += volume * n * n * body.water_viscosity / permeability(body, n);
    for (int a = 0; a < D; ++a) {
      sums.grain_momentum[a] += grains * points.velocity[a][p];
      sums.water_momentum[a] += water * points.water_velocity[a][p];
    }
  }
  return sums;
}

template <int D>
NodeSums sum_faces(const Field<NodeSums, AtFace, D>& field, const IndexBox<D>& box) {
  NodeSums sums;
  for_each(box, [&](const Index<D>& face) {
    const NodeSums& node = field[face];
    sums.grain_mass += node.grain_mass;
    sums.water_mass += node.water_mass;
    sums.volume += node.volume;
    sums.drag += node.drag;
    sums.grain_momentum += node.grain_momentum;
    sums.water_momentum += node.water_momentum;
    sums.mixture_force += node.mixture_force;
    sums.water_force += node.water_force;
  });
  return sums;
}

void expect_scalars_equal(const NodeSums& grid, const NodeSums& points) {
  EXPECT_NEAR(grid.grain_mass / points.grain_mass, 1.0, 1e-13);
  EXPECT_NEAR(grid.water_mass / points.water_mass, 1.0, 1e-13);
  EXPECT_NEAR(grid.volume / points.volume, 1.0, 1e-13);
  EXPECT_NEAR(grid.drag / points.drag, 1.0, 1e-13);
}

template <int D>
void expect_transfer_conserves(Kernel kernel, Transfer transfer) {
  SCOPED_TRACE(std::string(name_of(kernel)) + (transfer == Transfer::apic ? " APIC" : " FLIP"));
  const Grid<D> grid = make_grid<D>({8, 8, 8}, Wall::slip);
  const BodyConstants body = saturated_sand();
  const SoilParticles<D> points = make_cloud(grid, cube<D>(2, 6), 2, 1.0);
  auto nodes = make_nodes<NodeSums>(grid);
  points_to_grid(grid, points, body, kernel, transfer, {}, nodes);
  const Sums<D> expected = sum_points(points, body);
  for (int a = 0; a < D; ++a) {
    const NodeSums sums = sum_faces(nodes[static_cast<std::size_t>(a)], grid.local());
    expect_scalars_equal(sums, expected.scalar);
    EXPECT_NEAR(sums.grain_momentum, expected.grain_momentum[a], 1e-13 * sums.grain_mass);
    EXPECT_NEAR(sums.water_momentum, expected.water_momentum[a], 1e-13 * sums.water_mass);
  }
}

TEST(Transfer, GridHoldsMassVolumeDragAndMomentumOfThePoints) {
  for (const Kernel kernel : every_kernel)
    for (const Transfer transfer : every_transfer) {
      expect_transfer_conserves<2>(kernel, transfer);
      expect_transfer_conserves<3>(kernel, transfer);
    }
}

/// The faces of an axis within the domain, both walls included.
template <int D>
IndexBox<D> faces_of_domain(const Grid<D>& grid, int axis) {
  return grid.global().extended(axis, 1);
}

template <int D>
void expect_walls_give_back(Kernel kernel) {
  SCOPED_TRACE(name_of(kernel));
  const Grid<D> grid = make_grid<D>({5, 4, 6}, Wall::slip);
  const BodyConstants body = saturated_sand();
  SoilParticles<D> points = make_cloud(grid, grid.global(), 2, 1.0);
  auto nodes = make_nodes<NodeSums>(grid);
  points_to_grid(grid, points, body, kernel, Transfer::flip, {}, nodes);
  fold_into_domain(SoilSides<D>(grid), grid.local(), nodes);
  const Sums<D> expected = sum_points(points, body);
  for (int a = 0; a < D; ++a)
    expect_scalars_equal(sum_faces(nodes[static_cast<std::size_t>(a)], faces_of_domain(grid, a)),
                         expected.scalar);
  // Momentum along slip walls comes back too: one axis closed, the motion across it.
  for (int a = 1; a < D; ++a) {
    double momentum = 0.0;
    IndexBox<D> box = grid.local();
    box.lower[0] = 0, box.upper[0] = grid.cells()[0];
    auto only = make_nodes<NodeSums>(grid);
    points_to_grid(grid, points, body, kernel, Transfer::flip, {}, only);
    DomainOptions one_axis;
    one_axis.cells = {5, 4, 6};
    one_axis.lower = {-1.0, 2.0, -3.0};
    for (std::size_t k = 0; k < 3; ++k)
      one_axis.upper[k] = one_axis.lower[k] + std::array{2.5, 1.6, 1.8}[k];
    for (std::size_t k = 1; k < 3; ++k) one_axis.walls[k] = {Wall::open, Wall::open};
    const Grid<D> along(one_axis, MPI_COMM_SELF);
    fold_into_domain(SoilSides<D>(along), along.local(), only);
    for_each(box, [&](const Index<D>& face) {
      momentum += only[static_cast<std::size_t>(a)][face].grain_momentum;
    });
    EXPECT_NEAR(momentum, expected.grain_momentum[a], 1e-13 * expected.scalar.grain_mass);
  }
}

TEST(Transfer, SlipWallsGiveBackMassAndTangentialMomentum) {
  for (const Kernel kernel : every_kernel) {
    expect_walls_give_back<2>(kernel);
    expect_walls_give_back<3>(kernel);
  }
}

/// v_i = c_i + sum_j g_ij x_j
template <int D>
struct LinearVelocity {
  Vec<D> constant;
  std::array<Vec<D>, D> slope;

  LinearVelocity() {
    for (int i = 0; i < D; ++i) {
      constant[i] = 0.3 - 0.5 * i;
      for (int j = 0; j < D; ++j) slope[static_cast<std::size_t>(i)][j] = 0.7 * i - 0.4 * j + 0.2;
    }
  }
  double operator()(int component, const Vec<D>& x) const {
    return constant[component] + dot(slope[static_cast<std::size_t>(component)], x);
  }
};

template <int D>
void expect_linear_motion_is_exact(Kernel kernel, Transfer transfer) {
  SCOPED_TRACE(std::string(name_of(kernel)) + (transfer == Transfer::apic ? " APIC" : " FLIP"));
  const Grid<D> grid = make_grid<D>({7, 6, 8}, Wall::slip);
  const LinearVelocity<D> velocity;
  auto nodes = make_nodes<NodeMotion>(grid);
  for (int a = 0; a < D; ++a)
    for_each(grid.local(), [&](const Index<D>& face) {
      const double v = velocity(a, grid.face_centre(a, face));
      nodes[static_cast<std::size_t>(a)][face] = {v, 0.25 * v, 2.0 * v, 0.5 * v, v};
    });
  SoilParticles<D> points = make_cloud(grid, grid.global(), 2, 1.0);
  const SoilParticles<D> before = points;
  PointMotion motion;
  const double dt = 0.01, flip = 0.75;
  grid_to_points(grid, nodes, kernel, transfer, flip, dt, true, points, motion);
  double trace = 0.0;
  for (int a = 0; a < D; ++a) trace += velocity.slope[static_cast<std::size_t>(a)][a];
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_NEAR(motion.flux_divergence[p], trace, 1e-12);
    for (int i = 0; i < D; ++i) {
      const double v = velocity(i, before.position_of(p));
      const double grains = transfer == Transfer::apic
                                ? v
                                : flip * (before.velocity[i][p] + 0.25 * v) + (1.0 - flip) * v;
      const double water =
          transfer == Transfer::apic
              ? 2.0 * v
              : flip * (before.water_velocity[i][p] + 0.5 * v) + (1.0 - flip) * 2.0 * v;
      EXPECT_NEAR(points.velocity[i][p], grains, 1e-12);
      EXPECT_NEAR(points.water_velocity[i][p], water, 1e-12);
      EXPECT_NEAR(points.position[i][p], before.position[i][p] + dt * v, 1e-13);
      for (int j = 0; j < D; ++j) {
        const double slope = velocity.slope[static_cast<std::size_t>(i)][j];
        EXPECT_NEAR(motion.gradient[static_cast<std::size_t>(i * D + j) * points.size() + p],
                    dt * slope, 1e-14);
        if (transfer == Transfer::flip) continue;
        EXPECT_NEAR(points.affine[i * D + j][p], slope, 1e-12);
        if (kernel == Kernel::linear) continue;
        EXPECT_NEAR(points.water_affine[i * D + j][p], 2.0 * slope, 1e-12);
      }
    }
  }
}

TEST(Transfer, LinearMotionReachesThePointsExactlyWithItsGradient) {
  for (const Kernel kernel : every_kernel)
    for (const Transfer transfer : every_transfer) {
      expect_linear_motion_is_exact<2>(kernel, transfer);
      expect_linear_motion_is_exact<3>(kernel, transfer);
    }
}

/// Angular momentum of the grain velocity on the grid about the domain's corner, all pairs of axes.
template <int D>
std::vector<double> angular_momentum(const Grid<D>& grid, const NodeField<NodeSums, D>& nodes) {
  std::vector<double> moments;
  for (int i = 0; i < D; ++i)
    for (int j = i + 1; j < D; ++j) {
      double sum = 0.0;
      for_each(grid.local(), [&](const Index<D>& face) {
        sum += nodes[static_cast<std::size_t>(j)][face].grain_momentum *
                   (grid.face_centre(j, face)[i] - grid.lower()[i]) -
               nodes[static_cast<std::size_t>(i)][face].grain_momentum *
                   (grid.face_centre(i, face)[j] - grid.lower()[j]);
      });
      moments.push_back(sum);
    }
  return moments;
}

/// Change of angular momentum over grid -> points -> grid, as a share of its largest component.
template <int D>
double angular_momentum_error(Kernel kernel, Transfer transfer, double flip) {
  const Grid<D> grid = make_grid<D>({10, 10, 10}, Wall::slip);
  const BodyConstants body = saturated_sand();
  SoilParticles<D> points = make_cloud(grid, cube<D>(3, 7), 2, 0.8);
  auto sums = make_nodes<NodeSums>(grid);
  points_to_grid(grid, points, body, kernel, transfer, {}, sums);
  const std::vector<double> before = angular_momentum(grid, sums);
  auto nodes = make_nodes<NodeMotion>(grid);
  for (std::size_t a = 0; a < static_cast<std::size_t>(D); ++a)
    for_each(grid.local(), [&](const Index<D>& face) {
      const NodeSums& sum = sums[a][face];
      if (sum.grain_mass > 0.0) nodes[a][face].grain_velocity = sum.grain_momentum / sum.grain_mass;
    });
  PointMotion motion;
  grid_to_points(grid, nodes, kernel, transfer, flip, 0.02, false, points, motion);
  auto again = make_nodes<NodeSums>(grid);
  points_to_grid(grid, points, body, kernel, transfer, {}, again);
  const std::vector<double> after = angular_momentum(grid, again);
  double error = 0.0, scale = 0.0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    error = std::max(error, std::abs(after[k] - before[k]));
    scale = std::max(scale, std::abs(before[k]));
  }
  return error / scale;
}

TEST(Transfer, ApicKeepsAngularMomentum) {
  for (const Kernel kernel : {Kernel::quadratic, Kernel::composite}) {
    EXPECT_LT(angular_momentum_error<2>(kernel, Transfer::apic, 1.0), 1e-12) << name_of(kernel);
    EXPECT_LT(angular_momentum_error<3>(kernel, Transfer::apic, 1.0), 1e-12) << name_of(kernel);
    EXPECT_GT(angular_momentum_error<2>(kernel, Transfer::flip, 0.0), 1e-6)
        << "PIC loses it, so this test can see a loss";
  }
}

template <int D>
void expect_divergence_is_that_of_the_grid() {
  const Grid<D> grid = make_grid<D>({6, 5, 7}, Wall::slip);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  auto nodes = make_nodes<NodeMotion>(grid);
  for (auto& field : nodes)
    for_each(grid.local(), [&](const Index<D>& face) {
      field[face].total_flux = unit(generator);
      field[face].grain_velocity = unit(generator);
    });
  CellField<D> flux(grid, "flux", "1/s"), grains(grid, "grains", "1/s");
  IndexBox<D> cells = grid.local();
  for (int a = 0; a < D; ++a) --cells.upper[a];
  for_each(cells, [&](const Index<D>& cell) {
    for (int a = 0; a < D; ++a) {
      const auto& field = nodes[static_cast<std::size_t>(a)];
      const Index<D> next = cell.shifted(a, 1);
      flux[cell] += (field[next].total_flux - field[cell].total_flux) / grid.spacing()[a];
      grains[cell] += (field[next].grain_velocity - field[cell].grain_velocity) / grid.spacing()[a];
    }
  });
  SoilParticles<D> points = make_cloud(grid, cube<D>(0, 5), 3, 1.0);
  const PointRange all{0, points.size()};
  std::vector<double> expected, strain;
  sample_range(grid, points, all, Kernel::composite, flux, expected);
  sample_range(grid, points, all, Kernel::composite, grains, strain);
  PointMotion motion;
  grid_to_points(grid, nodes, Kernel::composite, Transfer::flip, 1.0, 1.0, true, points, motion);
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_NEAR(motion.flux_divergence[p], expected[p], 1e-12);
    double trace = 0.0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(D); ++a)
      trace += motion.gradient[(a * D + a) * points.size() + p];
    EXPECT_NEAR(trace, strain[p], 1e-12);
  }
}

TEST(Transfer, CompositeKernelSeesTheStaggeredDivergenceInterpolated) {
  expect_divergence_is_that_of_the_grid<2>();
  expect_divergence_is_that_of_the_grid<3>();
}

template <int D>
void expect_internal_forces_balance(Kernel kernel) {
  SCOPED_TRACE(name_of(kernel));
  const Grid<D> grid = make_grid<D>({8, 8, 8}, Wall::slip);
  const SoilParticles<D> points = make_cloud(grid, cube<D>(2, 6), 2, 1.0);
  auto nodes = make_nodes<NodeSums>(grid);
  points_to_grid(grid, points, saturated_sand(), kernel, Transfer::flip, {}, nodes);
  double scale = 0.0;
  for (const auto& field : nodes)
    for_each(grid.local(), [&](const Index<D>& f) { scale += std::abs(field[f].mixture_force); });
  ASSERT_GT(scale, 1e3);
  for (const auto& field : nodes) {
    const NodeSums sums = sum_faces(field, grid.local());
    EXPECT_NEAR(sums.mixture_force, 0.0, 1e-13 * scale);
    EXPECT_NEAR(sums.water_force, 0.0, 1e-13 * scale);
  }
  for (int i = 0; i < D; ++i)
    for (int j = i + 1; j < D; ++j) {
      double torque = 0.0;
      for_each(grid.local(), [&](const Index<D>& face) {
        torque +=
            nodes[static_cast<std::size_t>(j)][face].mixture_force * grid.face_centre(j, face)[i] -
            nodes[static_cast<std::size_t>(i)][face].mixture_force * grid.face_centre(i, face)[j];
      });
      EXPECT_NEAR(torque, 0.0, 1e-12 * scale) << "axes " << i << j;
    }
}

TEST(Transfer, InternalForcesHaveNoResultantAndNoTorque) {
  for (const Kernel kernel : every_kernel) {
    expect_internal_forces_balance<2>(kernel);
    expect_internal_forces_balance<3>(kernel);
  }
}

template <int D>
void expect_uniform_fraction() {
  const Grid<D> grid = make_grid<D>({6, 5, 7}, Wall::slip);
  SoilParticles<D> points = make_cloud(grid, grid.global(), 2, 0.0);
  points.volume = points.start_volume;
  for (const Kernel kernel : every_kernel) {
    CellField<D> fraction(grid, "fraction", "1"), resistance(grid, "resistance", "Pa s/m2");
    const BodyConstants body = saturated_sand();
    add_solid_fraction(grid, points, 2650.0, kernel, 1.0, fraction);
    add_resistance(grid, points, body, kernel, resistance);
    fold_cells(SoilSides<D>(grid), grid.local(), fraction);
    fold_cells(SoilSides<D>(grid), grid.local(), resistance);
    const double full = body.water_viscosity / permeability(body, 0.4);
    for_each(grid.global(), [&](const Index<D>& c) {
      EXPECT_NEAR(fraction[c], 0.6, 1e-13);
      EXPECT_NEAR(resistance[c], full, 1e-12 * full);
    });
  }
}

TEST(Transfer, ALatticeOfPointsGivesAUniformSolidFractionUpToTheWalls) {
  expect_uniform_fraction<2>();
  expect_uniform_fraction<3>();
}

TEST(Permeability, FollowsKozenyCarmanOrStays) {
  BodyConstants body = saturated_sand();
  EXPECT_DOUBLE_EQ(permeability(body, 0.4), 1e-10);
  EXPECT_NEAR(permeability(body, 0.3), 1e-10 * (0.027 / 0.49) / (0.064 / 0.36), 1e-24);
  body.permeability_law = PermeabilityLaw::constant;
  EXPECT_DOUBLE_EQ(permeability(body, 0.3), 1e-10);
}

}  // namespace
}  // namespace mudlark
