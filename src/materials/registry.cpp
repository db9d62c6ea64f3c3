#include "materials/registry.hpp"

#include "materials/linear_elastic.hpp"

namespace mudlark {
namespace {

struct Maker {
  std::unique_ptr<SoilModel> operator()(const LinearElasticOptions& options) const {
    return std::make_unique<LinearElastic>(options);
  }
};

}  // namespace

std::unique_ptr<SoilModel> make_soil_model(const SoilLawOptions& options) {
  return std::visit(Maker{}, options);
}

}  // namespace mudlark
