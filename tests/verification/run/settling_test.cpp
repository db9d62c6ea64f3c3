// ranks: 1
// Grains that leave the bed settle as Soulsby (1997) and Richardson & Zaki (1954) say, whatever
// share of the water they fill.
#include <gtest/gtest.h>

#include <cmath>

#include "coupling/grain_drag.hpp"
#include "run/gauges.hpp"
#include "run/world.hpp"

namespace mudlark {
namespace {

constexpr double grain_density = 2650.0, density = 1000.0, viscosity = 1e-3, gravity = 9.81;

/// Soulsby's velocity and Rowe's exponent from the diameter, by themselves.
double hindered_velocity(double d, double fraction) {
  const double nu = viscosity / density;
  const double size = std::pow(d, 3) * gravity * (grain_density / density - 1.0) / (nu * nu);
  const double single = nu / d * (std::sqrt(10.36 * 10.36 + 1.049 * size) - 10.36);
  const double reynolds = std::pow(single * d / nu, 0.75);
  const double exponent = (4.7 + 0.41 * reynolds) / (1.0 + 0.175 * reynolds);
  return single * std::pow(1.0 - fraction, exponent);
}

/// A cloud over the whole width of a box of still water, far from its ends.
template <int D>
CaseOptions cloud(double diameter, double fraction) {
  CaseOptions c;
  const double h = 0.02;
  constexpr std::size_t up = D - 1;
  c.domain.dimension = D;
  c.domain.cells = {3, 3, 3};
  c.domain.upper = {3 * h, 3 * h, 3 * h};
  c.domain.cells[up] = 24;
  c.domain.upper[up] = 24 * h;
  c.domain.gravity = {};
  c.domain.gravity[up] = -gravity;
  c.time.end = 1.0;
  FlowOptions flow;
  flow.viscosity = viscosity, flow.density = density;
  flow.bodies.push_back({Shape{BoxShape{{-9, -9, -9}, {9, 9, 9}}}, {}});
  c.flow = flow;
  SoilBody body;
  body.name = "cloud";
  const double low = 6 * h, high = 18 * h;
  body.shape.form = BoxShape{{-9, -9, low}, {9, 9, high}};
  body.porosity = 1.0 - fraction;
  body.grain_density = grain_density;
  body.pore_water = PoreWater::unified;
  body.grain_diameter = diameter;
  body.intrinsic_permeability = 1e-6;
  body.points_per_cell = D == 2 ? 4 : 8;
  MuIOptions law;
  law.young_modulus = 1e4, law.poisson_ratio = 0.2, law.grain_diameter = diameter;
  body.law = law;
  body.strain = StrainMeasure::jaumann;
  SoilOptions soil;
  soil.water_density = density, soil.water_viscosity = viscosity;
  soil.bodies.push_back(body);
  c.soil = soil;
  c.coupling.mode = CouplingMode::unified;
  return c;
}

/// Mean velocity [m/s] at which the middle of the cloud sinks, once it does so steadily.
template <int D>
double settling_velocity(double diameter, double fraction) {
  World<D> world(cloud<D>(diameter, fraction), MPI_COMM_WORLD);
  world.initialise();
  const auto run_until = [&](double time) {
    const double left = time - world.clock().time();
    const int steps = static_cast<int>(std::ceil(left / world.stable_step()));
    for (int step = 0; step < steps; ++step) world.advance(left / steps);
  };
  GaugeOptions gauge;
  gauge.quantity = GaugeQuantity::settlement;
  gauge.at = {0.03, D == 3 ? 0.03 : 0.0, 0.241};
  const double expected = hindered_velocity(diameter, fraction);
  const double begin = 4.0 * expected / gravity, end = begin + 0.04 / expected;
  run_until(begin);
  const double before = read_gauge(world, gauge)[0];
  run_until(end);
  const auto errors = conservation_errors(world);
  EXPECT_LT(errors[0].second, 1e-12) << errors[0].first;
  return (read_gauge(world, gauge)[0] - before) / (end - begin);
}

TEST(Settling, ACloudSinksAsRichardsonAndZakiSay) {
  for (const double diameter : {2e-4, 2e-3})
    for (const double fraction : {0.01, 0.2}) {
      const double expected = hindered_velocity(diameter, fraction);
      EXPECT_NEAR(settling_velocity<2>(diameter, fraction), expected, 0.05 * expected)
          << diameter << " " << fraction;
    }
}
TEST(Settling, ACloudSinksAsRichardsonAndZakiSayIn3D) {
  const double expected = hindered_velocity(2e-3, 0.2);
  EXPECT_NEAR(settling_velocity<3>(2e-3, 0.2), expected, 0.05 * expected);
}

/// Ergun's bed on one side, a single grain on the other, and no jump of value or slope between.
TEST(Settling, DragGoesSmoothlyFromABedToASingleGrain) {
  for (const double d : {1e-4, 1e-3}) {
    const GrainDragLaw law(viscosity, density, grain_density, d);
    const Ergun packed{viscosity, density, d};
    EXPECT_DOUBLE_EQ(law(0.4).linear, packed(0.4).linear);
    EXPECT_DOUBLE_EQ(law(0.4).quadratic, packed(0.4).quadratic);
    const double step = 1e-5;
    double slope = 0.0;
    for (double n = 0.55; n < 0.99; n += step) {
      const double here = law(n).linear, next = law(n + step).linear;
      EXPECT_LT(next, here) << n;
      const double now = (std::log(next) - std::log(here)) / step;
      if (slope != 0.0) {
        EXPECT_NEAR(now, slope, 0.05 + 0.01 * std::abs(slope)) << n;
      }
      slope = now;
    }
  }
}

}  // namespace
}  // namespace mudlark
