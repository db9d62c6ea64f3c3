#pragma once
/// Whether ranks fit a grid, before any of them is started.
#include "grid/domain_options.hpp"

namespace mudlark {

/// Throws InputError when a grid of this domain cannot be shared by so many ranks.
void check_ranks(const DomainOptions& domain, int ranks);

}  // namespace mudlark
