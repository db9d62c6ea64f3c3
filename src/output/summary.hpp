#pragma once
/// summary.json: what a run did, for people, scripts and `mudlark info`.
#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "output/gauge_writer.hpp"

namespace mudlark {

struct GaugeSummary {
  std::string name;
  std::vector<std::string> columns;  ///< with units, "settlement [m]"
  std::optional<GaugeExtremes> extremes;
};

/// Where a rigid body is and what it feels: titles with units, values per axis.
struct SolidSummary {
  std::string name;
  std::vector<std::pair<std::string, std::vector<double>>> values;
};

/// A stage of the run that has begun.
struct StageSummary {
  std::string name;
  double began, ended;           ///< [s]; `ended`: so far
  std::optional<double> rested;  ///< when the soil came to rest [s]
  double excavated, placed;      ///< grains at its start [kg]
};

/// A number that is not known (NaN) is written as null.
struct Summary {
  std::string status = "running";  ///< running | done | diverged | interrupted | failed
  std::string message;             ///< why it ended, when not done
  std::string title, version, commit;
  int dimension = 2, ranks = 1;
  bool resumed = false;
  std::int64_t cells = 0, points = 0;
  std::int64_t steps = 0, soil_steps = 0;
  double time = 0.0, end_time = 0.0;               ///< simulated, reached and asked for [s]
  double smallest_step = 0.0, largest_step = 0.0;  ///< [s]
  double wall_seconds = 0.0, cpu_seconds = 0.0;    ///< CPU: all ranks together
  std::vector<std::pair<std::string, double>> phase_seconds;  ///< wall-clock per phase
  std::vector<std::pair<std::string, double>> flow_effort;    ///< time of its parts, and counts
  std::vector<std::pair<std::string, double>> conservation_errors;  ///< relative to the start
  std::vector<std::pair<std::string, double>> soil_energy;          ///< work of the soil [J]
  std::vector<std::pair<std::string, double>> soil_statics;         ///< how far from rest, shares
  std::vector<SolidSummary> solids;
  std::vector<StageSummary> stages;
  std::vector<std::pair<std::string, double>> implicit_effort;  ///< counts of implicit steps
  std::vector<GaugeSummary> gauges;
  double peak_memory_bytes = 0.0;  ///< all ranks together
};

std::string to_json(const Summary& summary);

/// Replaces FOLDER/summary.json as a whole. Call it at the start too (status "running").
/// Collective; rank 0's summary is written.
void write_summary(const std::filesystem::path& folder, const Summary& summary, MPI_Comm comm);
/// Says of the last summary that the run has failed since. Of one rank, the others may be gone.
void mark_failed(const std::filesystem::path& folder, const std::string& message);

/// Largest memory in use so far, summed over ranks [bytes]. Collective.
double peak_memory(MPI_Comm comm);
/// CPU time of all ranks since their start [s]. Collective.
double cpu_seconds(MPI_Comm comm);

}  // namespace mudlark
