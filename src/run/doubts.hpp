#pragma once
/// Values of a case that are possible, but hardly what was meant: a slipped unit, a key forgotten.
#include <string>
#include <vector>

#include "run/options.hpp"

namespace mudlark {

/// One sentence or two for each, with what to write instead. Nothing is refused.
std::vector<std::string> doubts(const CaseOptions& options);

}  // namespace mudlark
