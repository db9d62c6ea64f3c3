#pragma once
/// What became of a stage of the run.
#include <string>

namespace mudlark {

struct StageRecord {
  std::string name;
  double began = -1.0, ended = -1.0;  ///< [s]; negative: not yet
  double rested = -1.0;               ///< when the soil came to rest [s]; negative: it did not
  double excavated = 0.0;             ///< grains taken out at its start [kg]
  double placed = 0.0;                ///< grains placed at its start [kg]

  template <class Archive>
  void archive(Archive& a) {
    a.number("stage/" + name + "/began", began);
    a.number("stage/" + name + "/ended", ended);
    a.number("stage/" + name + "/rested", rested);
    a.number("stage/" + name + "/excavated", excavated);
    a.number("stage/" + name + "/placed", placed);
  }
};

}  // namespace mudlark
