#pragma once
/// Factors of safety by strength reduction.
#include <mpi.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "run/options.hpp"

namespace mudlark {

struct StrengthReductionSettings {
  std::filesystem::path results;
  double lower = 1.0, upper = 3.0;  ///< factors between which the answer is sought [-]
  double tolerance = 0.02;          ///< width of the bracket at the end [-]
  /// Soil of which a point has moved further does not stand [m]; nothing: a tenth of the smallest
  /// cells. Sliding soil finds rest again once it lies flatter, so rest alone proves nothing.
  std::optional<double> largest_displacement;
  MPI_Comm comm = MPI_COMM_WORLD;
};

struct StrengthTrial {
  double factor = 0.0;  ///< F [-]
  bool stands = false;
  std::string verdict;        ///< in words
  double time = 0.0;          ///< simulated [s]
  double displacement = 0.0;  ///< largest of all points [m]
  /// The case's end came before rest and before the soil had moved further than allowed: it counts
  /// as failing, and a later end might show that it stands.
  bool undecided = false;
};

struct StrengthReductionResult {
  std::vector<StrengthTrial> trials;  ///< in the order of their runs
  std::optional<double> stands;       ///< largest factor at which the soil stands
  std::optional<double> fails;        ///< smallest factor at which it does not
  /// The trial at `fails`, where that is undecided: then the factor is a lower bound.
  const StrengthTrial* undecided() const;
  /// The factor of safety, middle of the bracket; nothing where that was not found.
  std::optional<double> factor() const {
    if (!stands || !fails) return std::nullopt;
    return (*stands + *fails) / 2.0;
  }
};

/// Bisection on the factor F by which the strength of every body is divided (reduced(), after
/// Griffiths & Lane 1999): the soil stands with F when it comes to rest before the case's end and
/// no point has moved further than allowed. First `lower`, then `upper`; the search ends there when
/// the answer does not lie between them. Each trial is a run in results/trials/F, and
/// results/strength_reduction.json has them all. `report` hears of each trial, on every rank.
/// Throws InputError when the case cannot tell (no soil, free water, no stop_when_static);
/// returns nothing when the user interrupts. Collective.
std::optional<StrengthReductionResult> reduce_strength(
    const CaseOptions& options, const StrengthReductionSettings& settings,
    const std::function<void(const StrengthTrial&)>& report);

}  // namespace mudlark
