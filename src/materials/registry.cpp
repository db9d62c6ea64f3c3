#include "materials/registry.hpp"

#include "materials/drucker_prager.hpp"
#include "materials/linear_elastic.hpp"
#include "materials/modified_cam_clay.hpp"
#include "materials/mohr_coulomb.hpp"
#include "materials/mu_i.hpp"
#include "materials/mu_j.hpp"
#include "materials/newtonian.hpp"
#include "materials/sanisand.hpp"
#include "materials/sekiguchi_ohta.hpp"
#include "materials/tresca.hpp"
#include "materials/umat.hpp"
#include "materials/von_mises.hpp"

namespace mudlark {
namespace {

struct Maker {
  std::unique_ptr<SoilModel> operator()(const LinearElasticOptions& options) const {
    return std::make_unique<LinearElastic>(options);
  }
  std::unique_ptr<SoilModel> operator()(const ModifiedCamClayOptions& options) const {
    return std::make_unique<ModifiedCamClay>(options);
  }
  std::unique_ptr<SoilModel> operator()(const SekiguchiOhtaOptions& options) const {
    return std::make_unique<SekiguchiOhta>(options);
  }
  std::unique_ptr<SoilModel> operator()(const SanisandOptions& options) const {
    return std::make_unique<Sanisand>(options);
  }
  std::unique_ptr<SoilModel> operator()(const UmatOptions& options) const {
    return std::make_unique<Umat>(options);
  }
  std::unique_ptr<SoilModel> operator()(const MohrCoulombOptions& options) const {
    return std::make_unique<MohrCoulomb>(options);
  }
  std::unique_ptr<SoilModel> operator()(const TrescaOptions& options) const {
    return std::make_unique<Tresca>(options);
  }
  std::unique_ptr<SoilModel> operator()(const VonMisesOptions& options) const {
    return std::make_unique<VonMises>(options);
  }
  std::unique_ptr<SoilModel> operator()(const DruckerPragerOptions& options) const {
    return std::make_unique<DruckerPrager>(options);
  }
  std::unique_ptr<SoilModel> operator()(const MuIOptions& options) const {
    return std::make_unique<MuI>(options);
  }
  std::unique_ptr<SoilModel> operator()(const MuJOptions& options) const {
    return std::make_unique<MuJ>(options);
  }
  std::unique_ptr<SoilModel> operator()(const NewtonianOptions& options) const {
    return std::make_unique<Newtonian>(options);
  }
};

}  // namespace

std::unique_ptr<SoilModel> make_soil_model(const SoilLawOptions& options) {
  return std::visit(Maker{}, options);
}

}  // namespace mudlark
