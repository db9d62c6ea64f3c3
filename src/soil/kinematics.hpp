#pragma once
/// Strain measures: from the velocity gradient of a step to what a soil law sees, and back to
/// Cauchy stress.
#include <Eigen/Core>
#include <span>
#include <vector>

#include "materials/options.hpp"
#include "materials/soil_model.hpp"
#include "soil/particles.hpp"

namespace mudlark {

/// Half the natural logarithm of a symmetric positive tensor b [-]: the logarithmic strain of b = F
/// F^T.
SymTensor half_log(const SymTensor& b);
/// b = exp(2 strain), the inverse of half_log.
SymTensor exp_twice(const SymTensor& strain);

/// Gives points their stress after a step of duration dt [s].
/// `gradient` holds D*D values per point of the batch [first, first + count): dt * dv_i/dx_j, row
/// i. Expects volumes to be updated already. Returns how many points the law could not integrate.
///   small:       sigma = law(sym(F) - I + eps_0)                        (reference configuration)
///   logarithmic: sigma = law(1/2 ln b_e)
///   hencky:      sigma = law(1/2 ln b_e) / J,  b_e <- f b_e f^T          (Simo 1992)
///   objective:   Hughes & Winget (1980) rotation, then Hill's rate: d sigma = law(d eps) - sigma
///   tr(d eps)
template <int D>
std::size_t update_stress(SoilParticles<D>& points, std::size_t first, std::size_t count,
                          std::span<const double> gradient, const SoilModel& law,
                          StrainMeasure measure, double dt);

/// Prepares the elastic state of new points so that their initial stress is in equilibrium with it.
template <int D>
void initialise_elastic_state(SoilParticles<D>& points, const SoilModel& law,
                              StrainMeasure measure);

}  // namespace mudlark
