#pragma once
/// Time series: what a gauge is called in its file, and its value now.
#include <string>
#include <vector>

#include "output/summary.hpp"
#include "run/world.hpp"

namespace mudlark {

/// Column titles with units, time left out: "settlement [m]", "velocity x [m/s]", ...
std::vector<std::string> gauge_columns(const GaugeOptions& gauge, int dimension);

/// Present values, one per column. Collective; the same on all ranks.
/// Throws InputError when a material gauge lies where no soil started.
template <int D>
std::vector<double> read_gauge(World<D>& world, const GaugeOptions& gauge);

/// Place, rotation, velocity, force and moment of the rigid bodies.
template <int D>
std::vector<SolidSummary> describe_solids(World<D>& world);

}  // namespace mudlark
