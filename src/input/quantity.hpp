#pragma once
/// Physical quantities of a case file and their units (UDUNITS-2).
#include <memory>
#include <optional>
#include <string>
#include <string_view>

struct ut_system;

namespace mudlark {

struct Quantity {
  std::string_view name;     ///< with its article, for messages
  std::string_view unit;     ///< SI unit as UDUNITS-2 writes it
  std::string_view example;  ///< what a user may write
};

namespace quantity {
inline constexpr Quantity length{"a length", "m", "\"10 cm\""};
inline constexpr Quantity time{"a time", "s", "\"2 h\""};
inline constexpr Quantity pressure{"a pressure", "Pa", "\"400 kPa\""};
inline constexpr Quantity stress{"a stress", "Pa", "\"-10 kPa\""};
inline constexpr Quantity strength{"a stress", "Pa", "\"10 kPa\""};
inline constexpr Quantity stiffness{"a stiffness", "Pa", "\"10 MPa\""};
inline constexpr Quantity density{"a density", "kg/m3", "\"2.65 g/cm3\""};
inline constexpr Quantity viscosity{"a dynamic viscosity", "Pa s", "\"1.002e-3 Pa s\""};
inline constexpr Quantity velocity{"a velocity", "m/s", "\"1e-4 cm/s\""};
inline constexpr Quantity rate{"a rate", "1/s", "\"2 s-1\""};
inline constexpr Quantity discharge{"a discharge", "m3/s", "\"20 L/s\""};
inline constexpr Quantity discharge_in_plane{"a discharge per metre", "m2/s", "\"0.1 m2/s\""};
inline constexpr Quantity acceleration{"an acceleration", "m/s2", "\"9.81 m/s2\""};
inline constexpr Quantity specific_energy{"an energy per mass", "m2/s2", "\"1e-4 m2/s2\""};
inline constexpr Quantity permeability{"an intrinsic permeability", "m2", "\"1e-10 m2\""};
inline constexpr Quantity forchheimer{"a Forchheimer coefficient B of (A + B|w|) w", "kg/m4",
                                      "\"5e5 kg/m4\""};
inline constexpr Quantity mass{"a mass", "kg", "\"2 t\""};
inline constexpr Quantity inertia{"a moment of inertia", "kg m2", "\"100 kg m2\""};
inline constexpr Quantity force{"a force", "N", "\"10 kN\""};
inline constexpr Quantity moment{"a moment", "N m", "\"10 kN m\""};
inline constexpr Quantity rotation{"a rotation", "rad", "\"5 degree\""};
inline constexpr Quantity angular_velocity{"an angular velocity", "rad/s", "\"5 degree/s\""};
/// Plain numbers are degrees, as in every soil report; the readers turn them into radians.
inline constexpr Quantity angle{"an angle", "degree", "\"30 degree\""};
inline constexpr Quantity number{"a number without unit", "1", "0.4"};
}  // namespace quantity

/// The units of UDUNITS-2's database.
class Units {
 public:
  Units();

  struct Reading {
    std::optional<double> value;  ///< SI
    std::string problem;          ///< why there is no value
  };
  /// "400 kPa" to SI. Nothing at all when the text does not begin with a number followed by nothing
  /// or a word (then it may be an expression).
  std::optional<Reading> read(std::string_view text, const Quantity& quantity) const;

 private:
  std::unique_ptr<ut_system, void (*)(ut_system*)> system_;
};

/// For the command line. Throws InputError naming `name` when the text is not such a quantity.
double read_quantity(const std::string& name, const std::string& text, const Quantity& quantity);

}  // namespace mudlark
