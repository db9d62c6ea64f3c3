// ranks: 1
// One-dimensional consolidation against Terzaghi's series, and the undrained limit.
#include <gtest/gtest.h>

#include <cmath>

#include "soil/soil_solver.hpp"

namespace mudlark {
namespace {

constexpr double pi = 3.14159265358979323846;

struct Column {
  int cells = 40;
  double height = 1.0, conductivity = 1e-2, load = 1000.0;
  double young = 1e6, poisson = 0.3, porosity = 0.4, bulk = 2.15e7;
  StrainMeasure strain = StrainMeasure::small;
  bool undrained_start = true;
  double damping = 0.0, courant = 0.5, ramp = 0.0;
  Kernel kernel = Kernel::composite;

  double modulus() const { return young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)); }
  double undrained_share() const { return (bulk / porosity) / (modulus() + bulk / porosity); }
  double diffusivity() const { return conductivity / 9810.0 / (1 / modulus() + porosity / bulk); }

  Grid<2> grid() const {
    DomainOptions domain;
    const double h = height / cells;
    domain.upper = {2 * h, height * 1.25, 0};
    domain.cells = {2, cells + cells / 4, 1};
    return Grid<2>(domain, MPI_COMM_WORLD);
  }
  SoilOptions options() const {
    SoilOptions soil;
    SoilBody body;
    body.name = "column";
    body.shape.form = BoxShape{{-1, -1, -1}, {10, 10, height}};
    body.porosity = porosity;
    body.intrinsic_permeability = conductivity * 1.002e-3 / 9810.0;
    body.law = LinearElasticOptions{young, poisson, strain};
    if (undrained_start) {
      const double effective = -(1 - undrained_share()) * load, lateral = poisson / (1 - poisson) * effective;
      body.initial_stress = SymTensor{lateral, lateral, effective, 0, 0, 0};
      body.initial_pore_pressure = Varying(undrained_share() * load);
    }
    soil.bodies.push_back(body);
    const double q = load, t1 = ramp;
    soil.loads.push_back({"load", ramp > 0 ? Varying([q, t1](const Point3&, double t) {
                            return t >= t1 ? q : q * 0.5 * (1 - std::cos(pi * t / t1));
                          }, "ramp") : Varying(load)});
    soil.water_bulk_modulus = bulk;
    soil.damping = damping;
    soil.courant = courant;
    soil.kernel = kernel;
    return soil;
  }
};

double terzaghi(double depth, double time_factor) {
  double sum = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double m = (2 * i + 1) * pi / 2;
    sum += 2 / m * std::sin(m * depth) * std::exp(-m * m * time_factor);
  }
  return sum;
}

/// RMS error of pore pressure over depth and time factors, in shares of the load.
double isochrone_error(const Column& column) {
  const Grid<2> grid = column.grid();
  SoilSolver<2> soil(grid, column.options());
  soil.initialise();
  double time = 0.0, squares = 0.0;
  int samples = 0;
  for (const double target : {0.02, 0.05, 0.1, 0.2, 0.5, 1.0}) {
    const double end = target * column.height * column.height / column.diffusivity();
    const int steps = static_cast<int>(std::ceil((end - time) / soil.stable_step()));
    const double dt = (end - time) / steps;
    soil.begin_step(time, end - time, nullptr);
    for (int i = 0; i < steps; ++i) soil.advance(dt);
    time = end;
    const auto& points = soil.points(0);
    double worst = 0, here = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
      const double depth = 1.0 - points.position[1][p] / column.height;
      const double exact = column.undrained_share() * terzaghi(depth, target);
      const double error = points.pore_pressure[p] / column.load - exact;
      squares += error * error;
      here += error * error;
      worst = std::max(worst, std::abs(error));
      ++samples;
    }
    std::printf("k=%g cells=%d T=%g steps=%d rms=%g worst=%g\n", column.conductivity, column.cells, target, steps,
                std::sqrt(here / static_cast<double>(points.size())), worst);
  }
  return std::sqrt(squares / samples);
}

TEST(Consolidation, FollowsTerzaghi) {
  for (double damping : {0.0, 0.05})
  for (int cells : {10, 20, 40}) {
    Column column;
    column.cells = cells;
    column.conductivity = 1e-3;
    column.damping = damping;
    std::printf("%d: %g\n", cells, isochrone_error(column));
  }
}

TEST(Consolidation, LargeStrain) {
  const char* names[] = {"small", "log", "hencky", "objective"};
  const double exact[] = {0.29714, 0.25706, 0.20937, 0.22907};
  for (int law = 0; law < 4; ++law) {
    Column column;
    column.cells = 20;
    column.conductivity = 1e-3;
    column.load = 4e5;
    column.undrained_start = false;
    column.ramp = 0.05;
    column.strain = static_cast<StrainMeasure>(law);
    const Grid<2> grid = column.grid();
    SoilSolver<2> soil(grid, column.options());
    soil.initialise();
    double time = 0; int n = 0;
    for (double end : {0.05, 0.1, 0.5, 0.952, 3.961, 10.0, 20.0}) {
      while (time < end) {
        const double step = soil.stable_step();
        const int k = std::min(50, static_cast<int>(std::ceil((end - time) / step)));
        const double dt = k == 50 ? step : (end - time) / k;
        soil.begin_step(time, k * dt, nullptr);
        for (int i = 0; i < k; ++i) soil.advance(dt);
        n += k;
        time += k * dt;
        if (k < 50) time = end;
      }
      double sum[5] = {};
      const auto& points = soil.points(0);
      double top = 0, x0 = 0, pmin = 1e9, pmax = -1e9;
      for (std::size_t p = 0; p < points.size(); ++p) {
        if (points.start[1][p] > x0) x0 = points.start[1][p], top = x0 - points.position[1][p];
        pmin = std::min(pmin, points.pore_pressure[p]), pmax = std::max(pmax, points.pore_pressure[p]);
      }
      (void)sum;
      std::printf("%s t=%g steps=%d top %.6f / %.6f: %.6f p %g..%g\n", names[law], end, n, top, x0, top / x0, pmin, pmax);
    }
    std::printf("exact %g\n", exact[law]);
  }
}

}  // namespace
}  // namespace mudlark
