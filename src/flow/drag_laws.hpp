#pragma once
/// Laws of the pressure that water loses per length of porous ground: (A + B|w|) w, w = n (v -
/// v_s).
#include <concepts>

namespace mudlark {

/// A in [Pa s/m2], B in [Pa s2/m3].
struct DragCoefficients {
  double linear = 0.0, quadratic = 0.0;
};

/// A law gives the coefficients at a porosity n.
template <class Law>
concept DragLawOfPorosity = requires(const Law& law, double porosity) {
  { law(porosity) } -> std::same_as<DragCoefficients>;
};

/// Darcy (1856): A = mu / kappa.
struct Darcy {
  double viscosity;     ///< [Pa s]
  double permeability;  ///< intrinsic, kappa [m2]
  DragCoefficients operator()(double) const { return {viscosity / permeability, 0.0}; }
};

/// Forchheimer (1901): Darcy with a term of inertia whose factor is given.
struct DarcyForchheimer {
  double viscosity, permeability;
  double inertia;  ///< B [Pa s2/m3]
  DragCoefficients operator()(double) const { return {viscosity / permeability, inertia}; }
};

/// Ergun (1952), Chem. Eng. Prog. 48: A = 150 mu (1-n)^2/(n^3 d^2), B = 1.75 rho (1-n)/(n^3 d).
struct Ergun {
  double viscosity, density, grain;  ///< [Pa s], [kg/m3], [m]
  DragCoefficients operator()(double n) const {
    const double cube = n * n * n;
    return {150.0 * viscosity * (1.0 - n) * (1.0 - n) / (cube * grain * grain),
            1.75 * density * (1.0 - n) / (cube * grain)};
  }
};

/// van Gent (1995), Coastal Eng. 26: A = alpha mu (1-n)^2/(n^3 d^2), B = beta (1 + 7.5/KC) rho
/// (1-n)/(n^3 d); KC = 0 stands for steady flow without the term of oscillation.
struct VanGent {
  double viscosity, density, grain;  ///< [Pa s], [kg/m3], [m]
  double alpha, beta, keulegan_carpenter;
  DragCoefficients operator()(double n) const {
    const double cube = n * n * n;
    const double oscillation = keulegan_carpenter > 0.0 ? 1.0 + 7.5 / keulegan_carpenter : 1.0;
    return {alpha * viscosity * (1.0 - n) * (1.0 - n) / (cube * grain * grain),
            beta * oscillation * density * (1.0 - n) / (cube * grain)};
  }
};

/// CADMAS-SURF: R = 1/2 C_D/L (1 - n) |v| v per volume and density, with the interstitial v = w/n;
/// it equals n w B|w|, so B = C_D rho (1-n)/(2 L n^3).
struct Cadmas {
  double density;           ///< [kg/m3]
  double drag_coefficient;  ///< C_D [-]
  double length;            ///< L [m]: the cell size there
  DragCoefficients operator()(double n) const {
    return {0.0, 0.5 * drag_coefficient * density * (1.0 - n) / (length * n * n * n)};
  }
};

static_assert(DragLawOfPorosity<Darcy> && DragLawOfPorosity<DarcyForchheimer>);
static_assert(DragLawOfPorosity<Ergun> && DragLawOfPorosity<VanGent>);
static_assert(DragLawOfPorosity<Cadmas>);

}  // namespace mudlark
