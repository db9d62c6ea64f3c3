#pragma once
/// Strain measures: from the velocity gradient of a step to what a soil law sees, and back to
/// Cauchy stress.
#include <span>
#include <vector>

#include "materials/options.hpp"
#include "materials/soil_model.hpp"
#include "soil/particles.hpp"

namespace mudlark {

/// Half the natural logarithm of a symmetric positive tensor b [-]: the logarithmic strain of b = F
/// F^T.
SymTensor half_log(const SymTensor& b);
/// The same of b without shear out of the plane x-z, in closed form.
SymTensor half_log_plane(const SymTensor& b);
/// b = exp(2 strain), the inverse of half_log.
SymTensor exp_twice(const SymTensor& strain);

/// The step that stresses are updated over.
struct StressStep {
  double dt = 0.0, time = 0.0;  ///< length and start [s]
  double length = 1.0;          ///< cell size [m]
};
/// How many points a law could not integrate, and the first of them.
struct StressResult {
  std::size_t failed = 0, first_failed = 0;
};

/// Gives points their stress after a step, and updates their state variables.
/// Only the points of `range`; `gradient` holds D*D arrays of as many values one after another, row
/// by row: dt * dv_i/dx_j. Expects volumes to be updated already.
///   small:       sigma = law(sym(F) - I + eps_0)                        (reference configuration)
///   logarithmic: sigma = law(1/2 ln b_e)
///   hencky:      sigma = law(1/2 ln b_e) / J,  b_e <- f b_e f^T          (Simo 1992)
///   objective:   Hughes & Winget (1980) rotation, then Hill's rate: d sigma = law(d eps) - sigma
///   tr(d eps)
///   jaumann:     the same rotation, sigma = law(rotated sigma, d eps)
/// Of a law that yields, `hencky` takes the new elastic strain from the new stress.
template <int D>
StressResult update_stress(SoilParticles<D>& points, PointRange range,
                           std::span<const double> gradient, const SoilModel& law,
                           StrainMeasure measure, const StressStep& step);
/// The same for all points.
template <int D>
StressResult update_stress(SoilParticles<D>& points, std::span<const double> gradient,
                           const SoilModel& law, StrainMeasure measure, const StressStep& step) {
  return update_stress(points, PointRange{0, points.size()}, gradient, law, measure, step);
}

/// Prepares the elastic state and the state variables of new points, so that their initial stress
/// is in equilibrium with them. `porosity` [-] is the initial one.
template <int D>
void initialise_material_state(SoilParticles<D>& points, const SoilModel& law,
                               StrainMeasure measure, double porosity);

}  // namespace mudlark
