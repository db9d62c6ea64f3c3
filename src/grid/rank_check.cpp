#include "grid/rank_check.hpp"

#include "grid/grid.hpp"
#include "parallel/process_grid.hpp"

namespace mudlark {

void check_ranks(const DomainOptions& domain, int ranks) {
  const auto& cells = domain.cells;
  if (domain.dimension == 2)
    choose_processes<2>(ranks, {{cells[0], cells[1]}}, ghost_layers);
  else
    choose_processes<3>(ranks, {{cells[0], cells[1], cells[2]}}, ghost_layers);
}

}  // namespace mudlark
