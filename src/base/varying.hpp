#pragma once
/// A quantity that may vary in space and time.
#include <functional>
#include <string>
#include <vector>

#include "base/vec.hpp"

namespace mudlark {

/// Value in SI units as a function of position (x, y, z) [m] and time [s]. `text` is what the user
/// wrote.
struct Varying {
  std::function<double(const Point3&, double)> function;
  std::string text;
  bool in_space = true, in_time = true;  ///< may it vary with position, with time?
  std::vector<double> bends;             ///< ascending times at which a table bends [s]

  Varying() : Varying(0.0) {}
  explicit Varying(double value)
      : function([value](const Point3&, double) { return value; }),
        text(std::to_string(value)),
        in_space(false),
        in_time(false) {}
  Varying(std::function<double(const Point3&, double)> f, std::string written)
      : function(std::move(f)), text(std::move(written)) {}

  bool constant() const { return !in_space && !in_time; }

  double operator()(const Point3& position, double time) const { return function(position, time); }
};

}  // namespace mudlark
