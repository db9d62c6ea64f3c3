#pragma once
/// A saturated column under a load, and Terzaghi's solution for it.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "soil/soil_solver.hpp"

namespace mudlark::soil_column {

inline constexpr double pi = 3.14159265358979323846;

struct Column {
  int cells = 40;
  double height = 1.0, conductivity = 1e-3, load = 1000.0;
  double young = 1e6, poisson = 0.3, porosity = 0.4, bulk = 2.15e7;
  StrainMeasure strain = StrainMeasure::small;
  bool undrained_start = true;
  double damping = 0.05, courant = 0.5, ramp = 0.0;
  int points_per_cell = 4;
  Formulation formulation = Formulation::u_w;
  double mass_scaling = 1.0;

  double modulus() const { return young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)); }
  double undrained_share() const { return 1 / (1 + modulus() * porosity / bulk); }
  double diffusivity() const { return conductivity / 9810.0 / (1 / modulus() + porosity / bulk); }

  Grid<2> grid() const {
    DomainOptions domain;
    const double h = height / cells;
    domain.upper = {h, height + 3 * h, 0};
    domain.cells = {1, cells + 3, 1};
    return Grid<2>(domain, MPI_COMM_WORLD);
  }
  SoilOptions options() const {
    SoilOptions soil;
    SoilBody body;
    body.name = "column";
    body.shape.form = BoxShape{{-1, -1, -1}, {10, 10, height}};
    body.porosity = porosity;
    body.points_per_cell = points_per_cell;
    body.intrinsic_permeability = conductivity * 1.002e-3 / 9810.0;
    body.law = LinearElasticOptions{young, poisson};
    body.strain = strain;
    if (undrained_start) {
      const double effective = -(1 - undrained_share()) * load,
                   lateral = poisson / (1 - poisson) * effective;
      body.initial_stress = SymTensor{lateral, lateral, effective, 0, 0, 0};
      body.initial_pore_pressure = Varying(undrained_share() * load);
    }
    soil.bodies.push_back(body);
    const double q = load, t1 = ramp;
    soil.loads.push_back(
        {"load", ramp > 0 ? Varying(
                                [q, t1](const Point3&, double t) {
                                  return t >= t1 ? q : q * 0.5 * (1 - std::cos(pi * t / t1));
                                },
                                "ramp")
                          : Varying(load)});
    soil.water_bulk_modulus = bulk;
    soil.damping = damping;
    soil.courant = courant;
    soil.formulation = formulation;
    soil.mass_scaling = mass_scaling;
    return soil;
  }
};

inline double terzaghi(double depth, double time_factor) {
  double sum = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double m = (2 * i + 1) * pi / 2;
    sum += 2 / m * std::sin(m * depth) * std::exp(-m * m * time_factor);
  }
  return sum;
}

/// A column being run, in blocks of steps no longer than the stable one.
class ColumnRun {
 public:
  explicit ColumnRun(const Column& column) : grid_(column.grid()), soil_(grid_, column.options()) {
    soil_.initialise();
  }

  void until(double end) {
    while (time_ < end) {
      const double left = end - time_;
      const int steps = static_cast<int>(std::min(50.0, std::ceil(left / soil_.stable_step())));
      const double dt = steps < 50 ? left / steps : soil_.stable_step();
      soil_.begin_step(time_, steps * dt, nullptr);
      for (int i = 0; i < steps; ++i) soil_.advance(dt);
      time_ = steps < 50 ? end : time_ + steps * dt;
    }
  }
  void steps(int count) {
    const double dt = soil_.stable_step();
    for (int i = 0; i < count / 50; ++i, time_ += 50 * dt) {
      soil_.begin_step(time_, 50 * dt, nullptr);
      for (int k = 0; k < 50; ++k) soil_.advance(dt);
    }
  }
  const SoilParticles<2>& points() const { return soil_.points(0); }

  /// Settlement at the height z0 [m] at the start, linear between rows of points.
  double settlement(double z0) const {
    double below = -1e9, above = 1e9, low = 0.0, high = 0.0;
    for (std::size_t p = 0; p < points().size(); ++p) {
      const double start = points().start[1][p], settled = start - points().position[1][p];
      if (start <= z0 && start > below) below = start, low = settled;
      if (start > z0 && start < above) above = start, high = settled;
    }
    return above > 1e8 ? low * z0 / below : low + (high - low) * (z0 - below) / (above - below);
  }

 private:
  Grid<2> grid_;
  SoilSolver<2> soil_;
  double time_ = 0.0;
};

/// RMS error of pore pressure over depth and time factors 0.02 to 1, in shares of the load.
inline double isochrone_error(const Column& column) {
  ColumnRun run(column);
  double squares = 0.0;
  int samples = 0;
  for (const double target : {0.02, 0.05, 0.1, 0.2, 0.5, 1.0}) {
    run.until(target * column.height * column.height / column.diffusivity());
    const auto& points = run.points();
    for (std::size_t p = 0; p < points.size(); ++p, ++samples) {
      const double depth = 1.0 - points.position[1][p] / column.height;
      const double error = points.pore_pressure[p] / column.load -
                           column.undrained_share() * terzaghi(depth, target);
      squares += error * error;
    }
  }
  const double rms = std::sqrt(squares / samples);
  std::printf("Terzaghi: k = %g m/s, H = %g m, %d cells: RMS error %.5f of the load\n",
              column.conductivity, column.height, column.cells, rms);
  return rms;
}

}  // namespace mudlark::soil_column
