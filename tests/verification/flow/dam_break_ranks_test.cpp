// ranks: 2 3 4
#include <gtest/gtest.h>

#include <cmath>

#include "verification/flow/flow_setup.hpp"

namespace mudlark {
namespace {

/// Gauges of a run on the given ranks.
template <int D>
std::vector<double> gauges(MPI_Comm comm, const FlowOptions& options, int steps) {
  FlowRun<D> run(tank<D>(D == 2 ? 8 : 6), options, comm);
  for (int step = 0; step < steps; ++step) run.step(run.flow.stable_step(run.medium));
  Vec<D> inside, column;
  for (int a = 0; a < D; ++a) inside[a] = 0.06;
  column[0] = 0.33;
  std::vector<double> values{run.time,
                             run.flow.front(),
                             run.flow.kinetic_energy(),
                             run.flow.ledger().present,
                             run.flow.pressure_at(inside),
                             run.flow.surface_height(inside),
                             run.flow.surface_height(column)};
  for (int a = 0; a < D; ++a) values.push_back(run.flow.velocity_at(inside)[a]);
  return values;
}

template <int D>
void same_on_any_ranks(const FlowOptions& options, int steps) {
  const std::vector<double> together = gauges<D>(MPI_COMM_WORLD, options, steps);
  const std::vector<double> alone = gauges<D>(MPI_COMM_SELF, options, steps);
  for (std::size_t i = 0; i < alone.size(); ++i)
    EXPECT_NEAR(together[i], alone[i], 1e-10 * std::max(std::abs(alone[i]), 1e-2)) << "gauge " << i;
}

TEST(DamBreak, IsTheSameOnAnyNumberOfRanksIn2D) { same_on_any_ranks<2>(column_and_mound<2>(), 60); }

/// 30 steps go through the first spray at the mound.
TEST(DamBreak, IsTheSameOnAnyNumberOfRanksIn3D) { same_on_any_ranks<3>(column_and_mound<3>(), 30); }

}  // namespace
}  // namespace mudlark
