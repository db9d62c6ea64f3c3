#include "run/flow_meters.hpp"

#include <algorithm>

namespace mudlark {

template <int D>
FlowMeters<D>::FlowMeters(const Grid<D>& grid, const std::vector<GaugeOptions>& gauges)
    : grid_(&grid) {
  for (const GaugeOptions& gauge : gauges) {
    if (gauge.quantity != GaugeQuantity::section_flux &&
        gauge.quantity != GaugeQuantity::overtopping)
      continue;
    FlowSection<D> section;
    for (int a = 0; a < D; ++a) {
      const auto coordinate = static_cast<std::size_t>(D == 2 && a == 1 ? 2 : a);
      if (coordinate == gauge.range.axis) section.axis = a;
      section.from[a] = gauge.range.from[coordinate];
      section.to[a] = gauge.range.to[coordinate];
    }
    section.place = gauge.range.place;
    names_.push_back(gauge.name);
    sections_.push_back(section);
    signs_.push_back(gauge.range.sign);
  }
  passed_.resize(sections_.size());
  meters_.resize(sections_.size());
}

template <int D>
void FlowMeters<D>::read(const FlowSolver<D>& flow, double dt) {
  if (sections_.empty()) return;
  for (std::size_t m = 0; m < sections_.size(); ++m)
    passed_[m] = signs_[m] * own_water_through(*grid_, flow.water_flux(), sections_[m]);
  MPI_Allreduce(MPI_IN_PLACE, passed_.data(), static_cast<int>(passed_.size()), MPI_DOUBLE, MPI_SUM,
                grid_->comm());
  for (std::size_t m = 0; m < sections_.size(); ++m) {
    meters_[m].volume += passed_[m];
    meters_[m].discharge = passed_[m] / dt;
  }
}

template <int D>
const FlowMeter& FlowMeters<D>::of(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  return meters_[static_cast<std::size_t>(found - names_.begin())];
}

template class FlowMeters<2>;
template class FlowMeters<3>;

}  // namespace mudlark
