// ranks: 1 3
#include <gtest/gtest.h>

#include <cmath>

#include "verification/flow/flow_setup.hpp"

namespace mudlark {
namespace {

/// Permeameter: a column of water whose ends are joined, half of it filled with ground; gravity
/// drives the water round. Steady: the discharge w is the same everywhere and rho g H = (A + B w) w
/// L (Darcy 1856, Forchheimer 1901); in the ground the pressure rises upwards by (A + B w) w - rho
/// g per length. Without advection, whose entrance and exit losses the formula leaves out; what is
/// left to 1e-6 is the viscous term where v jumps.
template <int D>
void permeameter(DragLaw law, double tolerance) {
  FlowOptions options;
  options.advection = false;
  options.bodies = {water_box({-far_away, -far_away, -far_away}, {far_away, far_away, far_away})};
  PorousGround ground;
  ground.shape.form = BoxShape{{-far_away, -far_away, 0.25}, {far_away, far_away, 0.75}};
  ground.porosity = 0.4;
  ground.drag = law;
  ground.intrinsic_permeability = 1e-8;
  ground.forchheimer = 4e6;
  ground.grain_size = 5e-3;
  options.porous = {ground};
  DomainOptions domain = D == 2 ? flow_domain({4, 32, 1}, {0.125, 1.0, 1.0}, {0.0, -9.81, 0.0})
                                : flow_domain({4, 4, 32}, {0.125, 0.125, 1.0}, {0.0, 0.0, -9.81});
  domain.walls[D - 1] = {Wall::periodic, Wall::periodic};
  FlowRun<D> run(domain, options);
  const DragCoefficients drag = drag_of(ground, options);
  const double pressure = 9810.0 * 1.0, length = 0.5;
  const double a = drag.linear * length, b = drag.quadratic * length;
  const double discharge =
      b > 0.0 ? (std::sqrt(a * a + 4.0 * b * pressure) - a) / (2.0 * b) : pressure / a;
  const double inertia_time = 1000.0 * (0.5 + 0.5 / 0.4) / (a + 2.0 * b * discharge);
  for (int step = 0; step < 600; ++step)
    run.step(std::min(inertia_time / 20.0, run.flow.stable_step(run.medium)));
  Vec<D> low, high;
  for (int axis = 0; axis < D; ++axis) low[axis] = high[axis] = 0.06;
  low[D - 1] = 0.30;
  high[D - 1] = 0.63;
  EXPECT_NEAR(-0.4 * run.flow.velocity_at(low)[D - 1], discharge, tolerance * discharge);
  EXPECT_NEAR(run.flow.pressure_at(high) - run.flow.pressure_at(low), 9810.0 * 0.33,
              tolerance * 9810.0);
}

TEST(PorousFlow, DarcyColumnHasTheExactDischargeAndALinearPressure) {
  permeameter<2>(DragLaw::darcy, 1e-6);
  permeameter<3>(DragLaw::darcy, 1e-6);
}
TEST(PorousFlow, DarcyForchheimerColumnHasTheExactDischarge) {
  permeameter<2>(DragLaw::darcy_forchheimer, 1e-6);
}
TEST(PorousFlow, ErgunColumnHasTheExactDischarge) { permeameter<2>(DragLaw::ergun, 1e-6); }
TEST(PorousFlow, VanGentColumnHasTheExactDischarge) { permeameter<2>(DragLaw::van_gent, 1e-6); }

}  // namespace
}  // namespace mudlark
