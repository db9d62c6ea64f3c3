/// Cost of the soil laws per point, without kinematics: batches of 128 points, all elastic or all
/// yielding, in plane strain (2) or in space (3).
#include <benchmark/benchmark.h>

#include <array>
#include <memory>
#include <vector>

#include "materials/registry.hpp"
#include "stream.hpp"

namespace mudlark {
namespace {

enum class Path { elastic, yielding };

SoilLawOptions mohr_coulomb() {
  MohrCoulombOptions options;
  options.young_modulus = 2e7, options.poisson_ratio = 0.3;
  options.cohesion = 5e3, options.friction_angle = 0.5, options.dilatancy_angle = 0.1;
  return options;
}
SoilLawOptions softening_mohr_coulomb() {
  auto options = std::get<MohrCoulombOptions>(mohr_coulomb());
  options.residual = MohrCoulombOptions::Residual{1e3, 0.4, 0.0, {0.05, 0.0}};
  return options;
}

void law_batch(benchmark::State& state, int dimension, SoilLawOptions (*options)(), Path path) {
  constexpr std::size_t size = 128;
  const auto law = make_soil_model(options());
  const double shear = path == Path::elastic ? 1e-6 : 2e-3;
  std::vector<SymTensor> strain(size), start(size), stress(size);
  for (std::size_t i = 0; i < size; ++i) {
    const double part = 0.5 + 0.5 * static_cast<double>(i) / size;
    start[i] = {-40e3 * part, -42e3 * part, -60e3 * part, 0, 0, 3e3 * part};
    strain[i] = {0.3 * shear * part, 0, -shear * part, 0, 0, shear};
    if (dimension == 3) {
      start[i].xy = 2e3 * part, start[i].yz = -1e3 * part;
      strain[i].xy = 0.3 * shear, strain[i].yz = 0.2 * shear;
    }
  }
  std::vector<double> history(size * law->history_names().size());
  for (auto _ : state) {
    stress = start;
    MaterialPoints points{strain, stress, history};
    points.dt = 1e-4;
    benchmark::DoNotOptimize(law->update_stress(points));
    benchmark::DoNotOptimize(stress.data());
  }
  set_counters(state, size, 18.0 * sizeof(double));
}

SoilLawOptions tresca() { return TrescaOptions{2e7, 0.45, 1.5e4, {}}; }
SoilLawOptions von_mises() { return VonMisesOptions{2e7, 0.45, 1.5e4, {}}; }
SoilLawOptions drucker_prager() {
  DruckerPragerOptions options;
  options.young_modulus = 2e7, options.poisson_ratio = 0.3;
  options.cohesion = 5e3, options.friction_angle = 0.5, options.dilatancy_angle = 0.1;
  return options;
}
SoilLawOptions mu_i() {
  MuIOptions options;
  options.young_modulus = 2e7, options.poisson_ratio = 0.3, options.grain_diameter = 1e-3;
  return options;
}
SoilLawOptions newtonian() { return NewtonianOptions{2e7, 1e-3, 0.0}; }

// clang-format off
BENCHMARK_CAPTURE(law_batch, mohr_coulomb_2d_elastic, 2, &mohr_coulomb, Path::elastic);
BENCHMARK_CAPTURE(law_batch, mohr_coulomb_2d_yielding, 2, &mohr_coulomb, Path::yielding);
BENCHMARK_CAPTURE(law_batch, mohr_coulomb_3d_elastic, 3, &mohr_coulomb, Path::elastic);
BENCHMARK_CAPTURE(law_batch, mohr_coulomb_3d_yielding, 3, &mohr_coulomb, Path::yielding);
BENCHMARK_CAPTURE(law_batch, softening_mohr_coulomb_2d_yielding, 2, &softening_mohr_coulomb, Path::yielding);
BENCHMARK_CAPTURE(law_batch, softening_mohr_coulomb_3d_yielding, 3, &softening_mohr_coulomb, Path::yielding);
BENCHMARK_CAPTURE(law_batch, tresca_2d_elastic, 2, &tresca, Path::elastic);
BENCHMARK_CAPTURE(law_batch, tresca_2d_yielding, 2, &tresca, Path::yielding);
BENCHMARK_CAPTURE(law_batch, tresca_3d_elastic, 3, &tresca, Path::elastic);
BENCHMARK_CAPTURE(law_batch, tresca_3d_yielding, 3, &tresca, Path::yielding);
BENCHMARK_CAPTURE(law_batch, von_mises_2d_elastic, 2, &von_mises, Path::elastic);
BENCHMARK_CAPTURE(law_batch, von_mises_2d_yielding, 2, &von_mises, Path::yielding);
BENCHMARK_CAPTURE(law_batch, von_mises_3d_elastic, 3, &von_mises, Path::elastic);
BENCHMARK_CAPTURE(law_batch, von_mises_3d_yielding, 3, &von_mises, Path::yielding);
BENCHMARK_CAPTURE(law_batch, drucker_prager_2d_elastic, 2, &drucker_prager, Path::elastic);
BENCHMARK_CAPTURE(law_batch, drucker_prager_2d_yielding, 2, &drucker_prager, Path::yielding);
BENCHMARK_CAPTURE(law_batch, drucker_prager_3d_elastic, 3, &drucker_prager, Path::elastic);
BENCHMARK_CAPTURE(law_batch, drucker_prager_3d_yielding, 3, &drucker_prager, Path::yielding);
BENCHMARK_CAPTURE(law_batch, mu_i_2d_elastic, 2, &mu_i, Path::elastic);
BENCHMARK_CAPTURE(law_batch, mu_i_2d_yielding, 2, &mu_i, Path::yielding);
BENCHMARK_CAPTURE(law_batch, mu_i_3d_elastic, 3, &mu_i, Path::elastic);
BENCHMARK_CAPTURE(law_batch, mu_i_3d_yielding, 3, &mu_i, Path::yielding);
BENCHMARK_CAPTURE(law_batch, newtonian_3d, 3, &newtonian, Path::elastic);
// clang-format on

}  // namespace
}  // namespace mudlark
