#pragma once
/// The largest stable step of the explicit soil engine.
#include <memory>
#include <vector>

#include "materials/soil_model.hpp"
#include "soil/options.hpp"
#include "soil/particles.hpp"
#include "soil/transfer.hpp"

namespace mudlark {

/// courant * limit of the kernel * h / (c + |v|) [s], c the undrained or the drag-free compression
/// wave, whichever is faster, from the tangents of the laws. Permeability does not enter. The same
/// on all ranks; collective.
template <int D>
double stable_step(const Grid<D>& grid, const SoilOptions& options,
                   const std::vector<SoilParticles<D>>& bodies,
                   const std::vector<BodyConstants>& constants,
                   const std::vector<std::unique_ptr<SoilModel>>& laws);

/// Constrained tangent modulus of the stiffest of this rank's points [Pa].
template <int D>
double largest_wave_modulus(const SoilParticles<D>& points, const SoilModel& law);

}  // namespace mudlark
