#include "input/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace mudlark {
namespace {

/// muParser's parser reads its variables through pointers; they live beside it.
struct Program {
  double x = 0.0, y = 0.0, z = 0.0, t = 0.0;
  mu::Parser parser;

  explicit Program(const std::string& text) {
    parser.DefineVar("x", &x);
    parser.DefineVar("y", &y);
    parser.DefineVar("z", &z);
    parser.DefineVar("t", &t);
    parser.DefineConst("pi", std::numbers::pi);
    parser.SetExpr(text);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  double operator()(const Point3& position, double time) {
    x = position[0], y = position[1], z = position[2], t = time;
    return parser.Eval();
  }
};

}  // namespace

Varying parse_expression(const std::string& text) {
  try {
    const auto program = std::make_shared<Program>(text);
    const double value = (*program)({}, 0.0);
    if (program->parser.GetNumResults() != 1)
      throw std::invalid_argument("the expression has more than one result");
    if (program->parser.GetUsedVar().empty()) {
      if (!std::isfinite(value)) throw std::invalid_argument("its value is not a finite number");
      Varying constant(value);
      constant.text = text;
      return constant;
    }
    Varying varying(
        [program](const Point3& position, double time) { return (*program)(position, time); },
        text);
    const auto& used = program->parser.GetUsedVar();
    varying.in_time = used.count("t") > 0;
    varying.in_space = used.size() > (varying.in_time ? 1u : 0u);
    return varying;
  } catch (const mu::Parser::exception_type& error) {
    throw std::invalid_argument(error.GetMsg());
  }
}

namespace {

/// Times at which straight lines between the values change their slope.
std::vector<double> bends_of(const std::vector<double>& times, const std::vector<double>& values) {
  constexpr double straight = 1e-9;
  std::vector<double> bends;
  double before = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const bool last = i + 1 == times.size();
    const double after = last ? 0.0 : (values[i + 1] - values[i]) / (times[i + 1] - times[i]);
    if (std::abs(after - before) > straight * (std::abs(after) + std::abs(before)))
      bends.push_back(times[i]);
    before = after;
  }
  return bends;
}

}  // namespace

Varying interpolate_in_time(std::vector<double> times, std::vector<double> values,
                            std::string text) {
  std::vector<double> bends = bends_of(times, values);
  const auto at = [times = std::move(times), values = std::move(values)](const Point3&, double t) {
    const auto after = std::upper_bound(times.begin(), times.end(), t);
    if (after == times.begin()) return values.front();
    if (after == times.end()) return values.back();
    const auto i = static_cast<std::size_t>(after - times.begin());
    const double share = (t - times[i - 1]) / (times[i] - times[i - 1]);
    return values[i - 1] + share * (values[i] - values[i - 1]);
  };
  Varying varying(at, std::move(text));
  varying.in_space = false;
  varying.bends = std::move(bends);
  return varying;
}

}  // namespace mudlark
