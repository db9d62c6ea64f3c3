#include "run/ledger.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "run/world.hpp"

namespace mudlark {
namespace {

template <int D>
struct Motion {
  Vec<D> momentum{};
  double mass = 0.0, energy = 0.0;
};

/// Momentum of the water of the flow: faces carry the mean of their cells' water. Where soil lies
/// in the water, the pore water belongs to the soil's points and is left out here.
template <int D>
Motion<D> motion_of_water(World<D>& world) {
  Motion<D> motion;
  FlowSolver<D>& flow = *world.flow();
  const Grid<D>& grid = world.grid();
  for (int axis = 0; axis < D; ++axis) {
    double sum = 0.0;
    for_each(grid.owned_faces(axis), [&](const Index<D>& face) {
      const double water =
          0.5 * (flow.water_fraction()[face.shifted(axis, -1)] + flow.water_fraction()[face]);
      sum += flow.density() * water * grid.cell_volume() * flow.velocity()[axis][face];
    });
    motion.momentum[axis] = sum_over_ranks(grid, sum);
  }
  motion.mass = flow.density() * flow.ledger().present;
  motion.energy = flow.kinetic_energy();
  return motion;
}

template <int D>
Motion<D> motion_of(World<D>& world) {
  Motion<D> motion;
  if (world.flow()) motion = motion_of_water(world);
  if (!world.soil()) return motion;
  const auto totals = world.soil()->totals();
  motion.momentum += totals.momentum;
  motion.mass += totals.grain_mass + totals.water_mass;
  motion.energy += totals.kinetic_energy;
  for (const Solid& solid : world.soil()->solids()) {
    const auto momentum = solid.momentum();
    for (int a = 0; a < D; ++a) motion.momentum[a] += momentum[D == 2 && a == 1 ? 2 : a];
    motion.mass += solid.mass();
    motion.energy += solid.kinetic_energy();
  }
  return motion;
}

/// Does anything but the soil push or hold a rigid body along this axis of space?
bool is_led(const Solid& solid, std::size_t axis) {
  const auto* motion = std::get_if<FreeSolid>(&solid.options().motion);
  if (!motion || motion->locked[axis]) return true;
  const Varying& force = motion->force[axis];
  return !force.constant() || force({}, 0.0) != 0.0;
}

template <int D>
bool acted_upon(World<D>& world, int axis) {
  if (!world.grid().periodic(axis) || world.grid().gravity()[axis] != 0.0) return true;
  if (const auto& flow = world.options().flow;
      flow && (flow->body_acceleration || !flow->porous.empty()))
    return true;
  if (!world.soil()) return false;
  const auto& solids = world.soil()->solids();
  return std::any_of(solids.begin(), solids.end(), [&](const Solid& solid) {
    return is_led(solid, static_cast<std::size_t>(D == 2 && axis == 1 ? 2 : axis));
  });
}

}  // namespace

template <int D>
Ledger<D> open_ledger(World<D>& world) {
  Ledger<D> ledger;
  const Motion<D> motion = motion_of(world);
  ledger.momentum = motion.momentum;
  ledger.momentum_scale = std::sqrt(2.0 * motion.mass * motion.energy);
  if (world.soil()) ledger.grain_mass = world.soil()->totals().grain_mass;
  return ledger;
}

template <int D>
std::vector<std::pair<std::string, double>> conservation_errors(World<D>& world) {
  std::vector<std::pair<std::string, double>> errors;
  if (world.flow()) {
    const WaterLedger water = world.flow()->ledger();
    errors.emplace_back("water",
                        std::abs(water.initial - water.outflow - water.present) / water.initial);
  }
  const Ledger<D>& start = world.ledger();
  if (world.soil()) {
    const auto totals = world.soil()->totals();
    errors.emplace_back("grains", std::abs(start.grain_mass + totals.placed_grain_mass -
                                           totals.excavated_grain_mass - totals.removed_grain_mass -
                                           totals.grain_mass) /
                                      start.grain_mass);
  }
  double worst = std::numeric_limits<double>::quiet_NaN();
  const Motion<D> motion = motion_of(world);
  for (int axis = 0; axis < D; ++axis) {
    if (acted_upon(world, axis) || start.momentum_scale == 0.0) continue;
    const double error =
        std::abs(motion.momentum[axis] - start.momentum[axis]) / start.momentum_scale;
    worst = std::isnan(worst) ? error : std::max(worst, error);
  }
  errors.emplace_back("momentum", worst);
  return errors;
}

template Ledger<2> open_ledger(World<2>&);
template Ledger<3> open_ledger(World<3>&);
template std::vector<std::pair<std::string, double>> conservation_errors(World<2>&);
template std::vector<std::pair<std::string, double>> conservation_errors(World<3>&);

}  // namespace mudlark
