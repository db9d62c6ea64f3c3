// ranks: 1
#include <gtest/gtest.h>

#include <cmath>

#include "run/gauges.hpp"
#include "run/world.hpp"

namespace mudlark {
namespace {

CaseOptions column(double water_height, double impedance_factor, Mudline mudline) {
  CaseOptions c;
  const double h = 0.05;
  const int n = static_cast<int>(std::ceil((1.0 + water_height) / h)) + 6;
  c.domain.cells = {2, n, 1};
  c.domain.upper = {0.1, n * h, 0};
  c.domain.gravity = {0, -9.81, 0};
  c.domain.walls[1][0] = Wall::no_slip;
  c.domain.walls[1][1] = Wall::open;
  c.time.end = 200.0;
  FlowOptions flow;
  flow.bodies.push_back({Shape{BoxShape{{0, -1, 0}, {0.1, 1, 1.0 + water_height}}}, {}});
  c.flow = flow;
  SoilOptions soil;
  SoilBody body;
  body.name = "column";
  body.shape.form = BoxShape{{0, -1, 0}, {0.1, 1, 1.0}};
  body.intrinsic_permeability = 1e-4 * 1.002e-3 / 9810.0;
  body.law = LinearElasticOptions{1e6, 0.3, StrainMeasure::hencky};
  body.initial_stress = GeostaticStress{};
  soil.bodies.push_back(body);
  soil.water_bulk_modulus = 2.15e7;
  c.soil = soil;
  c.coupling.mode = CouplingMode::surface;
  c.coupling.mudline = mudline;
  c.coupling.added_mass_factor = impedance_factor;
  c.coupling.ramp = 0.05;
  return c;
}

TEST(Coupling, Column) {
  const char* env = std::getenv("FACTOR");
  const char* hw = std::getenv("WATER");
  const char* md = std::getenv("MUD");
  const char* te = std::getenv("TEND");
  World<2> world(column(hw ? atof(hw) : 40.775, env ? atof(env) : 1.0, md ? static_cast<Mudline>(atoi(md)) : Mudline::load_only), MPI_COMM_WORLD);
  world.initialise();
  double next = 0.0;
  while (world.clock().time() < (te ? atof(te) : 2.0)) {
    const double dt = world.clock().choose_step(world.stable_step());
    world.advance(dt);
    if (world.clock().time() < next) continue;
    next += te ? atof(te) / 40 : 0.0;
    GaugeOptions g;
    g.quantity = GaugeQuantity::settlement;
    g.at = {0.05, 0, 1.0};
    const double s = read_gauge(world, g)[0];
    g.quantity = GaugeQuantity::pressure;
    g.at = {0.05, 0, 1.1};
    const double p = read_gauge(world, g)[0];
    g.quantity = GaugeQuantity::pore_pressure;
    g.at = {0.05, 0, 0.1};
    std::printf("t=%.4f dt=%.4g s=%.9f p=%.6g pore=%.6g level=%.6f vmax=%g water=%.15g\n", world.clock().time(), dt, s, p, read_gauge(world, g)[0],
                world.flow()->surface_height(Vec<2>{{0.05, 0}}), world.flow()->max_speed().speed, world.flow()->ledger().present);
  }
  std::printf("flow %g soil %g map %g steps %ld\n", world.effort().flow, world.effort().soil, world.effort().mapping, world.effort().soil_steps);
}

}  // namespace
}  // namespace mudlark
