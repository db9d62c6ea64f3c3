#pragma once
/// Soil with less strength, for factors of safety by strength reduction.
#include "materials/options.hpp"

namespace mudlark {

/// The law with cohesion c/F and friction tan(phi)/F, or undrained strength s_u/F, residual ones
/// included, F = `factor` > 0 (Zienkiewicz, Humpheson & Lewis 1975; Griffiths & Lane 1999). The
/// angle of dilatancy stays, but not above that of friction; elasticity and tension cut-off stay.
/// Throws InputError for laws that have no such strength.
SoilLawOptions reduced(const SoilLawOptions& options, double factor);

}  // namespace mudlark
