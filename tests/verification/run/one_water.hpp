#pragma once
/// What tests of one water share (NUMERICS C2).
#include <gtest/gtest.h>

#include <cmath>

#include "run/world.hpp"

namespace mudlark {

/// In equal steps, as the clock of a run takes them: pressure is what a step needs to keep the
/// volume, so a last step of next to nothing would find a pressure of next to anything.
template <int D>
inline void run_until(World<D>& world, double time) {
  const double left = time - world.clock().time();
  const int steps = static_cast<int>(std::ceil(left / world.stable_step()));
  for (int step = 0; step < steps; ++step) world.advance(left / steps);
}

template <int D>
inline void expect_conservation(World<D>& world) {
  const auto errors = conservation_errors(world);
  EXPECT_LT(errors[0].second, 1e-12) << errors[0].first;
  EXPECT_EQ(errors[1].second, 0.0) << errors[1].first;
}

/// Soil of a shape and of water's permeability `conductivity` [m/s] in water up to a level [m], in
/// the plane.
inline CaseOptions soil_in_water(const Shape& shape, double level, double conductivity,
                                 double modulus) {
  CaseOptions c;
  constexpr double gravity = 9.81, density = 1000.0;
  c.domain.gravity = {0.0, -gravity, 0.0};
  c.domain.walls[1][1] = Wall::open;
  c.time.end = 1.0;
  FlowOptions flow;
  flow.density = density;
  flow.bodies.push_back({Shape{BoxShape{{-9, -9, -9}, {9, 9, level}}}, {}});
  c.flow = flow;
  SoilBody body;
  body.name = "soil";
  body.shape = shape;
  body.porosity = 0.4;
  body.pore_water = PoreWater::unified;
  body.intrinsic_permeability = conductivity * flow.viscosity / (density * gravity);
  body.points_per_cell = 9;
  body.law = LinearElasticOptions{modulus, 0.3};
  body.strain = StrainMeasure::hencky;
  SoilOptions soil;
  soil.bodies.push_back(body);
  soil.flooded.push_back(flow.bodies.front().shape);
  c.soil = soil;
  c.coupling.mode = CouplingMode::unified;
  return c;
}

}  // namespace mudlark
