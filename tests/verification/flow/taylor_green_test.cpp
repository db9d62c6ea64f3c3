// ranks: 1
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "verification/flow/flow_setup.hpp"

namespace mudlark {
namespace {

constexpr double pi = std::numbers::pi;

struct Case {
  double permeability = 0.0;  ///< 0: open water
  double porosity = 1.0;
  bool advection = true;
};

/// Largest error of the velocity of decaying vortices in a periodic unit square, at t = 0.1 s.
/// u = sin(kx) cos(kz) e^{-at}, w = -cos(kx) sin(kz) e^{-at}, a = 2 nu k^2 + n nu / kappa (Taylor &
/// Green 1937; with Darcy drag see the validation catalogue, section 15).
double error(int cells, const Case& c) {
  const double nu = 0.01, k = 2.0 * pi;
  FlowOptions options;
  options.density = 1.0;
  options.viscosity = nu;
  options.advection = c.advection;
  WaterBody body = water_box({-far_away, -far_away, -far_away}, {far_away, far_away, far_away});
  body.velocity[0] = Varying(
      [k](const Point3& x, double) { return std::sin(k * x[0]) * std::cos(k * x[2]); }, "u");
  body.velocity[2] = Varying(
      [k](const Point3& x, double) { return -std::cos(k * x[0]) * std::sin(k * x[2]); }, "w");
  options.bodies = {body};
  double rate = 2.0 * nu * k * k;
  if (c.permeability > 0.0) {
    PorousGround ground;
    ground.shape.form = BoxShape{{-far_away, -far_away, -far_away}, {far_away, far_away, far_away}};
    ground.porosity = c.porosity;
    ground.intrinsic_permeability = c.permeability;
    options.porous = {ground};
    rate += c.porosity * nu / c.permeability;
  }
  FlowRun<2> run(flow_domain({cells, cells, 1}, {1.0, 1.0, 1.0}, {0.0, 0.0, 0.0}, Wall::periodic),
                 options);
  const double end = 0.1;
  const int steps = cells * cells / 16;  // dt falls with h^2, so that space is what is measured
  for (int step = 0; step < steps; ++step) run.step(end / steps);
  double largest = 0.0;
  for_each(run.grid.owned(), [&](const Index<2>& face) {
    const Vec<2> x = run.grid.face_centre(0, face);
    const double exact = std::sin(k * x[0]) * std::cos(k * x[1]) * std::exp(-rate * end);
    largest = std::max(largest, std::abs(run.flow.velocity()[0][face] - exact));
  });
  EXPECT_LE(run.flow.water_fraction()[run.grid.owned().lower],
            run.flow.porosity()[run.grid.owned().lower] + 1e-12);
  return largest;
}

void expect_second_order(const Case& c, double lowest_order) {
  const double coarse = error(16, c), middle = error(32, c), fine = error(64, c);
  EXPECT_GT(std::log2(coarse / middle), lowest_order - 0.2)
      << coarse << " " << middle << " " << fine;
  EXPECT_GT(std::log2(middle / fine), lowest_order) << coarse << " " << middle << " " << fine;
  EXPECT_LT(fine, 2e-3);
}

TEST(TaylorGreen, DecaysAtSecondOrderInOpenWater) { expect_second_order({}, 1.8); }
TEST(TaylorGreen, DecaysAtSecondOrderWithoutAdvection) {
  expect_second_order({0.0, 1.0, false}, 1.95);
}
TEST(TaylorGreen, DecaysAtSecondOrderInAPorousMediumWithDarcyDrag) {
  expect_second_order({2e-3, 0.4, true}, 1.8);
}

}  // namespace
}  // namespace mudlark
