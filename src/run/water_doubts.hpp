#pragma once
/// Doubts about flowing water: its units, waves, openings and levels.
#include <string>
#include <vector>

#include "run/options.hpp"

namespace mudlark {

/// Smallest cell along an axis of the domain [m].
double cell_size(const DomainOptions& domain, std::size_t axis);

/// Adds a sentence or two for each; only for cases with flowing water.
void doubt_water(const CaseOptions& options, std::vector<std::string>& found);

}  // namespace mudlark
