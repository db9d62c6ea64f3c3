#include "materials/registry.hpp"

#include "materials/linear_elastic.hpp"
#include "materials/modified_cam_clay.hpp"
#include "materials/mohr_coulomb.hpp"

namespace mudlark {
namespace {

struct Maker {
  std::unique_ptr<SoilModel> operator()(const LinearElasticOptions& options) const {
    return std::make_unique<LinearElastic>(options);
  }
  std::unique_ptr<SoilModel> operator()(const ModifiedCamClayOptions& options) const {
    return std::make_unique<ModifiedCamClay>(options);
  }
  std::unique_ptr<SoilModel> operator()(const MohrCoulombOptions& options) const {
    return std::make_unique<MohrCoulomb>(options);
  }
};

}  // namespace

std::unique_ptr<SoilModel> make_soil_model(const SoilLawOptions& options) {
  return std::visit(Maker{}, options);
}

}  // namespace mudlark
