#pragma once
/// Values written as expressions or as tables of times and values.
#include <string>
#include <vector>

#include "base/varying.hpp"

namespace mudlark {

/// Expression of x, y, z [m] and t [s] in muParser's grammar. Throws std::invalid_argument with the
/// reason when it has no meaning.
Varying parse_expression(const std::string& text);

/// Linear between the times, level before the first and after the last. `text` is what to call it.
Varying interpolate_in_time(std::vector<double> times, std::vector<double> values,
                            std::string text);

}  // namespace mudlark
