#pragma once
/// One material point of a soil law, driven along paths of strain and stress.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "materials/soil_model.hpp"

namespace mudlark {

struct TestPoint {
  const SoilModel& law;
  SymTensor stress{};
  double length = 1.0, dt = 1.0;
  std::vector<double> history = {};

  TestPoint(const SoilModel& soil, const SymTensor& start) : law(soil), stress(start) {
    history.assign(law.history_names().size(), 0.0);
    law.initialise_history({&stress, 1}, 0.4, history);
  }
  void strain(const SymTensor& increment, int steps = 1) {
    const SymTensor part = (1.0 / steps) * increment;
    for (int i = 0; i < steps; ++i) {
      MaterialPoints points{{&part, 1}, {&stress, 1}, history};
      points.dt = dt, points.length = length;
      ASSERT_EQ(law.update_stress(points), 0u);
    }
  }
  /// Vertical strain at constant horizontal stress (triaxial cell): finds the horizontal strain by
  /// bisection. Returns the horizontal strain.
  double triaxial(double vertical, double tolerance = 1e-9) {
    const double held = stress.xx;
    double lower = -2.0 * std::abs(vertical), upper = 2.0 * std::abs(vertical);
    for (int i = 0; i < 80; ++i) {
      const double middle = 0.5 * (lower + upper);
      TestPoint trial = *this;
      trial.strain({middle, middle, vertical, 0, 0, 0});
      (trial.stress.xx < held ? lower : upper) = middle;
      if (upper - lower < tolerance * std::abs(vertical)) break;
    }
    const double horizontal = 0.5 * (lower + upper);
    strain({horizontal, horizontal, vertical, 0, 0, 0});
    return horizontal;
  }
  TestPoint& operator=(const TestPoint&) = delete;
  TestPoint(const TestPoint&) = default;
};

inline double largest_difference(const SymTensor& a, const SymTensor& b) {
  double largest = 0.0;
  for (int row = 0; row < 3; ++row)
    for (int column = row; column < 3; ++column)
      largest = std::max(largest, std::abs(a.between<3>(row, column) - b.between<3>(row, column)));
  return largest;
}

}  // namespace mudlark
