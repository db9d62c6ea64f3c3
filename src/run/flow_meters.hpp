#pragma once
/// Gauges that add up water step by step: through sections and over crests.
#include <string>
#include <vector>

#include "flow/flow_gauges.hpp"
#include "flow/flow_solver.hpp"
#include "run/options.hpp"

namespace mudlark {

struct FlowMeter {
  double volume = 0.0;     ///< since the start [m^D]
  double discharge = 0.0;  ///< mean over the last step [m^D/s]
};

template <int D>
class FlowMeters {
 public:
  FlowMeters() = default;
  FlowMeters(const Grid<D>& grid, const std::vector<GaugeOptions>& gauges);

  /// Adds what passed in the flow's last step of dt [s]. Collective.
  void read(const FlowSolver<D>& flow, double dt);
  /// The meter of a gauge of quantity section_flux or overtopping.
  const FlowMeter& of(const std::string& name) const;

  /// A gauge may be added when a run is resumed: then it counts from there.
  template <class Archive>
  void archive(Archive& a) {
    for (std::size_t m = 0; m < meters_.size(); ++m) {
      a.number_if_known("volume of meter " + names_[m], meters_[m].volume);
      a.number_if_known("discharge of meter " + names_[m], meters_[m].discharge);
    }
  }

 private:
  const Grid<D>* grid_ = nullptr;
  std::vector<std::string> names_;
  std::vector<FlowSection<D>> sections_;
  std::vector<double> signs_, passed_;
  std::vector<FlowMeter> meters_;
};

extern template class FlowMeters<2>;
extern template class FlowMeters<3>;

}  // namespace mudlark
