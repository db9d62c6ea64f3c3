#pragma once
/// Any Abaqus UMAT as a soil law: stress 11 22 33 12 13 23, engineering shear, axes 1 2 3 = x y z.
#include <array>
#include <string>
#include <vector>

#include "materials/options.hpp"
#include "materials/soil_model.hpp"
#include "materials/umat_library.hpp"

namespace mudlark {

/// Largest stiffness that a compression wave meets in a material of tangent `ddsdde` (6 x 6,
/// columns first, engineering shear) [Pa]: largest eigenvalue of the acoustic tensor over 13
/// directions (axes, diagonals of the faces and of the space).
double largest_wave_modulus(const std::array<double, 36>& ddsdde);

class Umat final : public SoilModel {
 public:
  /// Throws InputError when the library cannot be used.
  explicit Umat(const UmatOptions& options);
  Umat(const Umat&) = delete;
  Umat& operator=(const Umat&) = delete;

  std::string_view name() const override { return "umat"; }
  /// STATEV, then the total strain that STRAN holds, then the largest wave modulus so far.
  std::span<const std::string_view> history_names() const override { return views_; }
  std::span<const std::size_t> history_tensors() const override { return tensors_; }
  void initialise_history(std::span<const SymTensor> stress, double porosity,
                          std::span<double> history) const override;
  bool wants_rotation() const override { return true; }
  double wave_modulus(std::span<const SymTensor> stress,
                      std::span<const double> history) const override;
  double shear_modulus() const override;
  double earth_pressure_at_rest() const override;
  std::size_t update_stress(const MaterialPoints& points) const override;

 private:
  struct Call;
  struct Tangent;
  std::array<double, 36> tangent(const SymTensor& stress, const double* state) const;
  void call(Call& call) const;
  bool update_point(const MaterialPoints& points, std::size_t i, Tangent& known) const;

  UmatOptions options_;
  UmatLibrary library_;
  std::size_t states_;
  std::vector<std::string> names_;
  std::vector<std::string_view> views_;
  std::array<std::size_t, 1> tensors_;
};

}  // namespace mudlark
