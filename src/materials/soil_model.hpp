#pragma once
/// Soil laws: pure functions of a batch of material points. No grid, no MPI, no dimension.
#include <cstddef>
#include <span>
#include <string_view>

#include "base/vec.hpp"

namespace mudlark {

/// All that a soil law may see or change. Stress [Pa] is effective and tension positive.
/// The law adds the effect of `strain_increment` to `stress`. What the pair means is the strain
/// measure's business (soil/kinematics.hpp): an increment over the step from the rotated old
/// stress, or the whole elastic strain from the stress-free state.
struct MaterialPoints {
  std::span<const SymTensor> strain_increment;  ///< [-], tensor shear components
  std::span<SymTensor> stress;                  ///< [Pa], in: old, rotated; out: new
  std::span<double> history;                    ///< history_names().size() values per point
  double dt = 0.0;                              ///< [s], for rate-dependent laws
};

class SoilModel {
 public:
  virtual ~SoilModel() = default;
  virtual std::string_view name() const = 0;
  virtual std::span<const std::string_view> history_names() const = 0;
  /// Largest stiffness that a compression wave meets in this state [Pa] (the constrained modulus).
  virtual double wave_modulus(std::span<const SymTensor> stress,
                              std::span<const double> history) const = 0;
  /// Elastic shear modulus in the stress-free state [Pa].
  virtual double shear_modulus() const = 0;
  /// Elastic strain [-] that belongs to a stress [Pa]; the engine starts from initial stresses with
  /// it.
  virtual SymTensor elastic_strain(const SymTensor& stress) const = 0;
  /// Returns how many points failed to converge; the caller names them and stops.
  virtual std::size_t update_stress(const MaterialPoints& points) const = 0;
};

}  // namespace mudlark
