#pragma once
/// Where the formulation u-p holds: Zienkiewicz, Chang & Bettess (1980), and its stability.
#include <memory>
#include <string>
#include <vector>

#include "materials/soil_model.hpp"
#include "soil/options.hpp"
#include "soil/particles.hpp"
#include "soil/transfer.hpp"

namespace mudlark {

/// A saturated elastic layer as linear theory sees it.
struct SaturatedLayer {
  double modulus;             ///< M, constrained, of the skeleton [Pa]
  double porosity;            ///< n [-]
  double grain_density;       ///< [kg/m3]
  double water_density;       ///< [kg/m3]
  double water_bulk_modulus;  ///< K_w [Pa]
  double mobility;            ///< kappa/mu [m2/(Pa s)]
  double height;              ///< L [m]

  double density() const { return (1.0 - porosity) * grain_density + porosity * water_density; }
  double stiffness() const { return water_bulk_modulus / porosity; }  ///< Q = K_w/n [Pa]
  /// V_c = sqrt((M + Q)/rho), the undrained wave [m/s].
  double undrained_wave() const;
  /// Angular frequency of the first undrained mode, free at the top [1/s]: (pi/2) V_c / L.
  double first_frequency() const;
};

/// Pi_1 = k V_c^2 / (g b omega L^2) and Pi_2 = omega^2 L^2 / V_c^2 with b = rho_w/rho [-]. Their
/// product k omega / (g b) does not depend on the height.
struct RegimeNumbers {
  double first = 0.0, second = 0.0;
};
RegimeNumbers regime_numbers(const SaturatedLayer& layer, double frequency);

/// Does u-p give pore pressure within 5 % of the full equations for loads of this frequency?
/// From the chart of harmonic solutions (n = 1/3, b = 1/3): Pi_1 Pi_2 below 0.06 up to Pi_2 = 1,
/// below 0.02 beyond it, where modes resonate, and not at all beyond Pi_2 = 30.
bool u_p_holds(const RegimeNumbers& numbers);

/// Rate [1/s] at which waves of a wave number [1/m] grow (positive) or fade in u-p with
/// (`inertia_in_darcy`) or without rho_w a_s in Darcy's law: the largest real part of the roots of
///   rho s^3 + Q m N^2 (rho - i rho_w) s^2 + (M + Q) N^2 s + Q m M N^4 = 0,  m = kappa/mu.
/// With the inertia all waves fade only if Q (rho - rho_w) > rho_w M, whatever the permeability.
double u_p_growth(const SaturatedLayer& layer, double wave_number, bool inertia_in_darcy);

/// What a user of u-p must know about these soils, one text per problem; the same on all ranks.
/// Collective.
template <int D>
std::vector<std::string> regime_warnings(const Grid<D>& grid, const SoilOptions& options,
                                         const std::vector<SoilParticles<D>>& bodies,
                                         const std::vector<BodyConstants>& constants,
                                         const std::vector<std::unique_ptr<SoilModel>>& laws);

}  // namespace mudlark
