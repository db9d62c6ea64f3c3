#pragma once
/// A material point in words, for messages.
#include <string>

#include "soil/particles.hpp"

namespace mudlark {

/// "(x, y, z) m" of a point.
template <int D>
std::string place_of(const SoilParticles<D>& points, std::size_t p);
/// "point 17: effective stress xx ..., yy ..., zz ..., zx ... Pa, state variables".
template <int D>
std::string state_of(const SoilParticles<D>& points, std::size_t p);

extern template std::string place_of(const SoilParticles<2>&, std::size_t);
extern template std::string place_of(const SoilParticles<3>&, std::size_t);
extern template std::string state_of(const SoilParticles<2>&, std::size_t);
extern template std::string state_of(const SoilParticles<3>&, std::size_t);

}  // namespace mudlark
