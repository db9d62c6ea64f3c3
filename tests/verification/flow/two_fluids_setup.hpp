#pragma once
/// What the tests of two fluids share.
#include <vector>

#include "verification/flow/flow_setup.hpp"

namespace mudlark {

inline FlowOptions with_gas() {
  FlowOptions options;
  options.gas.emplace();
  options.gas->density = 1.0;
  return options;
}

/// Puts exact water fractions in place of those of a shape, which are sampled.
template <int D, class Fraction>
struct WaterSetter {
  const Grid<D>& grid;
  Fraction fraction;  ///< of a cell

  void number(const std::string&, double&) {}
  void integer(const std::string&, std::int64_t&) {}
  void faces(const std::string&, FaceVector<D>&) {}
  void cells(const std::string& name, CellField<D>& field) {
    if (name == "water fraction")
      for_each(grid.owned(), [&](const Index<D>& cell) { field[cell] = fraction(cell); });
  }
};

template <int D>
FlowOptions column_under_gas() {
  FlowOptions options = column_and_mound<D>();
  options.gas.emplace();
  return options;
}

/// Some readings of a dam break after a number of steps.
template <int D>
std::vector<double> gauges(MPI_Comm comm, const DomainOptions& domain, int steps, double dt) {
  FlowRun<D> run(domain, column_under_gas<2>(), comm);
  for (int step = 0; step < steps; ++step) run.step(dt);
  Vec<D> inside, column;
  for (int a = 0; a < D; ++a) inside[a] = 0.06;
  column[0] = 0.33;
  if (D == 3) inside[1] = column[1] = 0.005;
  return {run.flow.front(), run.flow.pressure_at(inside), run.flow.velocity_at(inside)[0],
          run.flow.velocity_at(column)[D - 1], run.flow.surface_height(inside)};
}

inline void expect_same(const std::vector<double>& left, const std::vector<double>& right,
                        double tolerance) {
  for (std::size_t i = 0; i < left.size(); ++i)
    EXPECT_NEAR(left[i], right[i], tolerance * std::max(std::abs(right[i]), 1e-2)) << "gauge " << i;
}

}  // namespace mudlark
