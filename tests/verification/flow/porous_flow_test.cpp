// ranks: 1 3
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

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
  ground.drag_coefficient = 1.5;
  ground.drag_length = 0.01;
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
TEST(PorousFlow, CadmasColumnHasTheExactDischarge) { permeameter<2>(DragLaw::cadmas, 1e-6); }

/// Water in a ring of ground, periodic along x, with an acceleration along it; it fills the domain.
template <int D>
struct Ring {
  PorousGround ground;
  FlowOptions options;
  DomainOptions domain = D == 2 ? flow_domain({12, 4, 1}, {0.4, 0.2, 1.0}, {0.0, 0.0, 0.0})
                                : flow_domain({12, 4, 4}, {0.4, 0.2, 0.2}, {0.0, 0.0, 0.0});

  Ring() {
    options.bodies = {water_box({-far_away, -far_away, -far_away}, {far_away, far_away, far_away})};
    ground.shape.form = BoxShape{{0.0, -1.0, 0.0}, {0.4, 1.0, 0.2}};
    ground.porosity = 0.45;
    domain.walls[0] = {Wall::periodic, Wall::periodic};
  }
  /// Interstitial velocity after so many steps until `end`.
  double velocity_after(double end, int steps) {
    options.porous = {ground};
    FlowRun<D> run(domain, options);
    for (int step = 0; step < steps; ++step) run.step(end / steps);
    Vec<D> seam;  // ground goes on over the seam
    for (int a = 1; a < D; ++a) seam[a] = 0.1;
    return run.flow.velocity_at(seam)[0];
  }
};

/// (rho + m) dv/dt + n A v = rho a0 cos(wt), m = C_A rho (1-n)/n: amplitude and phase of the exact
/// solution, first order in the step.
template <int D>
void oscillating_block() {
  Ring<D> ring;
  const double n = ring.ground.porosity, rate = 8.0, push = 2.0, end = 1.0;
  ring.ground.drag = DragLaw::darcy;
  ring.ground.intrinsic_permeability = 1e-7;
  ring.ground.inertia_coefficient = 1.2;
  ring.options.body_acceleration.emplace();
  (*ring.options.body_acceleration)[0] =
      Varying([=](const Point3&, double t) { return push * std::cos(rate * t); }, "oscillation");
  const double drag = ring.options.viscosity / 1e-7;
  const double inertia = 1000.0 * (1.0 + 1.2 * (1.0 - n) / n);
  const std::complex<double> amplitude =
      1000.0 * push / std::complex<double>(n * drag, rate * inertia);
  ring.options.bodies[0].velocity[0] = Varying(amplitude.real());
  const double exact = (amplitude * std::polar(1.0, rate * end)).real();
  const double coarse = ring.velocity_after(end, 200) - exact;
  const double fine = ring.velocity_after(end, 400) - exact;
  EXPECT_NEAR(coarse / fine, 2.0, 0.1);
  EXPECT_NEAR(2.0 * fine - coarse, 0.0, 1e-4 * std::abs(amplitude));
}

TEST(PorousFlow, WaterInABlockOscillatesWithTheAddedMassOfItsGrains) {
  oscillating_block<2>();
  oscillating_block<3>();
}

/// Start under a constant gradient with Forchheimer's drag: c dw/dt = I - a w - b w^2 has a closed
/// form (logistic), c = (1 + 0.34 (1-n)/n)/(n g) of van Gent (1995).
TEST(PorousFlow, StartsInGravelAsTheClosedFormSays) {
  Ring<2> ring;
  const double n = ring.ground.porosity, g = 9.81, gradient = 0.1, end = 0.15;
  ring.ground.drag = DragLaw::van_gent;
  ring.ground.grain_size = 0.02;
  ring.ground.inertia_coefficient = 0.34;
  ring.domain.gravity = {gradient * g, 0.0, 0.0};
  const DragCoefficients drag = drag_of(ring.ground, ring.options);
  const double a = drag.linear / (1000.0 * g), b = drag.quadratic / (1000.0 * g);
  const double c = (1.0 + 0.34 * (1.0 - n) / n) / (n * g);
  const double root = std::sqrt(a * a + 4.0 * b * gradient), decay = std::exp(-root * end / c);
  const double steady = 2.0 * gradient / (a + root);
  const double exact =
      steady * (1.0 - decay) / (1.0 + 4.0 * b * gradient / ((a + root) * (a + root)) * decay) / n;
  const double coarse = ring.velocity_after(end, 100) - exact;
  const double fine = ring.velocity_after(end, 200) - exact;
  EXPECT_NEAR(coarse / fine, 2.0, 0.1);
  EXPECT_NEAR(2.0 * fine - coarse, 0.0, 1e-4 * exact);
}

/// CADMAS-SURF writes lambda dv/dt = -gamma grad p/rho - R with lambda = gamma + (1-gamma) C_M and
/// R = 1/2 C_D/dx (1-gamma) v|v|: divided by gamma it is what the predictor solves.
TEST(PorousFlow, CadmasLawHasTheCoefficientsOfCadmasSurf) {
  Ring<2> ring;
  const double gamma = ring.ground.porosity, speed = 0.3;
  ring.ground.drag = DragLaw::cadmas;
  ring.ground.drag_coefficient = 1.5;
  ring.ground.drag_length = 0.05;
  ring.ground.inertia_coefficient = 1.2;
  ring.options.porous = {ring.ground};
  const FlowRun<2> run(ring.domain, ring.options);
  const Index<2> inside{{run.grid.owned().lower[0], 1}};
  EXPECT_NEAR(run.medium.added_mass[0][inside],
              1000.0 * ((gamma + (1.0 - gamma) * 1.2) / gamma - 1.0), 1e-10);
  const double seepage = gamma * speed;
  EXPECT_NEAR(gamma * run.medium.quadratic_drag[0][inside] * seepage * seepage,
              1000.0 * 0.5 * 1.5 / 0.05 * (1.0 - gamma) * speed * speed, 1e-9);
}

/// Ground ends with the domain: a body that reaches beyond it is the one cut off there.
TEST(PorousFlow, ABodyHalfOutOfTheDomainIsTheOneCutOffAtItsEdge) {
  Ring<2> inside, beyond;
  inside.ground.drag = beyond.ground.drag = DragLaw::ergun;
  inside.ground.grain_size = beyond.ground.grain_size = 0.01;
  inside.ground.inertia_coefficient = beyond.ground.inertia_coefficient = 0.34;
  inside.domain.walls = beyond.domain.walls = {
      {{Wall::open, Wall::open}, {Wall::slip, Wall::open}, {Wall::slip, Wall::slip}}};
  inside.ground.shape.form = BoxShape{{0.11, -1.0, 0.0}, {0.4, 1.0, 0.13}};
  beyond.ground.shape.form = BoxShape{{0.11, -1.0, -3.0}, {7.0, 1.0, 0.13}};
  inside.options.porous = {inside.ground}, beyond.options.porous = {beyond.ground};
  const FlowRun<2> one(inside.domain, inside.options), other(beyond.domain, beyond.options);
  for_each(one.grid.owned(), [&](const Index<2>& cell) {
    EXPECT_DOUBLE_EQ(one.medium.porosity[cell], other.medium.porosity[cell]);
  });
  double largest = 0.0;
  for (int axis = 0; axis < 2; ++axis)
    for_each(one.grid.owned_faces(axis), [&](const Index<2>& face) {
      EXPECT_DOUBLE_EQ(one.medium.quadratic_drag[axis][face],
                       other.medium.quadratic_drag[axis][face]);
      EXPECT_DOUBLE_EQ(one.medium.added_mass[axis][face], other.medium.added_mass[axis][face]);
      if (face[axis] == one.grid.cells()[axis])
        largest = std::max(largest, one.medium.quadratic_drag[axis][face]);
    });
  // The faces on the edge carry all of the drag, not that of half a box.
  EXPECT_NEAR(max_over_ranks(one.grid, largest), drag_of(inside.ground, inside.options).quadratic,
              1e-9 * largest);
}

}  // namespace
}  // namespace mudlark
