#pragma once
/// The one list of soil laws: from options to a law.
#include <memory>

#include "materials/options.hpp"
#include "materials/soil_model.hpp"

namespace mudlark {

std::unique_ptr<SoilModel> make_soil_model(const SoilLawOptions& options);

}  // namespace mudlark
