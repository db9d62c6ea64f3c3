#pragma once
/// Grains that have come apart carry nothing until their gap has closed (NUMERICS A4).
#include "base/vec.hpp"

namespace mudlark {

/// Volumetric strain [-] by which soil without tensile strength has opened beyond its stress-free
/// state is a state variable. Takes a step's strain increment into account; true while grains are
/// apart. When the gap closes within the step, `strain` becomes the part of it that comes after.
inline bool still_apart(double& separation, SymTensor& strain) {
  if (separation <= 0.0) return false;
  const double change = strain.trace();
  separation += change;
  if (separation > 0.0) return true;
  strain = (separation / change) * strain;
  separation = 0.0;
  return false;
}

}  // namespace mudlark
