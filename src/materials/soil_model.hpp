#pragma once
/// Soil laws: pure functions of a batch of material points. No grid, no MPI, no dimension.
#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "base/vec.hpp"
#include "materials/options.hpp"

namespace mudlark {

/// All that a soil law may see or change. Stress [Pa] is effective and tension positive.
/// The law adds the effect of `strain_increment` to `stress`. What the pair means is the strain
/// measure's business (soil/kinematics.hpp): an increment over the step from the rotated old
/// stress, or the whole elastic strain from the stress-free state.
struct MaterialPoints {
  std::span<const SymTensor> strain_increment;  ///< [-], tensor shear components
  std::span<SymTensor> stress;                  ///< [Pa], in: old, rotated; out: new
  std::span<double> history;  ///< history_names().size() values per point, point after point
  double dt = 0.0;            ///< [s], for rate-dependent laws
  double time = 0.0;          ///< at the start of the step [s]
  double length = 1.0;        ///< cell size [m], over which softening localises
  /// Rotation of the step, rows first; the whole 3 x 3 matrix per point. Empty unless the law
  /// `wants_rotation()`.
  std::span<const std::array<double, 9>> rotation = {};
  /// A law sets failed[i] = 1 for a point that it could not integrate. Empty, or one per point.
  std::span<unsigned char> failed = {};
};

class SoilModel {
 public:
  virtual ~SoilModel() = default;
  virtual std::string_view name() const = 0;
  /// Names of the state variables of a point, with their unit in brackets; all of them can be
  /// written to the results.
  virtual std::span<const std::string_view> history_names() const = 0;
  /// Where in the history symmetric tensors start (six values, xx yy zz xy yz zx): they turn with
  /// the stress.
  virtual std::span<const std::size_t> history_tensors() const { return {}; }
  /// Gives the state variables of new points the values that belong to their initial effective
  /// stress [Pa] and porosity [-]. `history` is zero before.
  virtual void initialise_history(std::span<const SymTensor> stress, double porosity,
                                  std::span<double> history) const;
  /// Can this law be used with a strain measure? By default only with `jaumann`.
  virtual bool supports(StrainMeasure measure) const { return measure == StrainMeasure::jaumann; }
  /// Does stress stop following the elastic strain? Then the engine takes the elastic strain from
  /// the new stress after each step (measure `hencky`).
  virtual bool yields() const { return true; }
  virtual bool wants_rotation() const { return false; }
  /// Largest stiffness that a compression wave meets in any of these states [Pa] (the constrained
  /// modulus). Without points: the stiffness of the stress-free state.
  virtual double wave_modulus(std::span<const SymTensor> stress,
                              std::span<const double> history) const = 0;
  /// Viscosity that a compression wave meets, 4/3 mu + bulk viscosity [Pa s], of laws whose stress
  /// follows the rate of strain without delay: it shortens the stable step.
  virtual double wave_viscosity() const { return 0.0; }
  /// Elastic shear modulus in the stress-free state [Pa].
  virtual double shear_modulus() const = 0;
  /// Ratio of horizontal to vertical effective stress of soil laid down by its own weight [-].
  virtual double earth_pressure_at_rest() const = 0;
  /// Elastic strain [-] that belongs to a stress [Pa]. Only for laws that support more than
  /// `jaumann`; the others are never asked.
  virtual SymTensor elastic_strain(const SymTensor&) const { return {}; }
  /// Returns how many points could not be integrated; the caller names them and stops.
  virtual std::size_t update_stress(const MaterialPoints& points) const = 0;
};

inline void SoilModel::initialise_history(std::span<const SymTensor>, double,
                                          std::span<double>) const {}

}  // namespace mudlark
