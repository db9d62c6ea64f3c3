// ranks: 1
#include "numerics/plic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mudlark {
namespace {

template <int D>
Vec<D> random_normal(std::mt19937& generator, bool stretched) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Vec<D> normal;
  for (int a = 0; a < D; ++a) {
    normal[a] = uniform(generator);
    if (stretched)
      normal[a] = std::copysign(std::pow(10.0, 8.0 * std::abs(normal[a]) - 8.0), normal[a]);
  }
  return normal;
}

template <int D>
double worst_round_trip(bool stretched) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  double worst = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const Vec<D> normal = random_normal<D>(generator, stretched);
    const double volume = uniform(generator);
    worst = std::max(worst, std::abs(volume_below(plane_of_volume<D>(normal, volume)) - volume));
  }
  return worst;
}

TEST(Plic, PlaneOfAVolumeCutsOffThatVolume) {
  EXPECT_LT(worst_round_trip<2>(false), 1e-12);
  EXPECT_LT(worst_round_trip<3>(false), 1e-12);
}

TEST(Plic, RoundTripHoldsForNormalsWithTinyComponents) {
  EXPECT_LT(worst_round_trip<2>(true), 1e-12);
  EXPECT_LT(worst_round_trip<3>(true), 1e-12);
}

TEST(Plic, VolumeBelowAPlaneIsTheExactOne) {
  // Triangle with legs 1/2 and 1/4; tetrahedron with edges 1/2, 1/4, 1/8; the cube without a
  // corner.
  EXPECT_NEAR(volume_below<2>({Vec<2>{{2.0, 4.0}}, 1.0}), 0.5 * 0.5 * 0.25, 1e-15);
  EXPECT_NEAR(volume_below<3>({Vec<3>{{2.0, 4.0, 8.0}}, 1.0}), 0.5 * 0.25 * 0.125 / 6.0, 1e-15);
  EXPECT_NEAR(volume_below<3>({Vec<3>{{1.0, 1.0, 1.0}}, 1.5}), 0.5, 1e-15);
  EXPECT_NEAR(volume_below<3>({Vec<3>{{-1.0, 1.0, 0.0}}, 0.0}), 0.5, 1e-15);
}

template <int D>
void slabs_add_up() {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const Plane<D> plane =
        plane_of_volume<D>(random_normal<D>(generator, i % 2 == 0), uniform(generator));
    for (int axis = 0; axis < D; ++axis) {
      const double first = 0.5 * uniform(generator), second = 0.5 + 0.5 * uniform(generator);
      const double sum = water_in_slab(plane, axis, 0.0, first) +
                         water_in_slab(plane, axis, first, second - first) +
                         water_in_slab(plane, axis, second, 1.0 - second);
      ASSERT_NEAR(sum, volume_below(plane), 1e-12);
    }
  }
}

TEST(Plic, WaterInSlabsAddsUpToTheCells) {
  slabs_add_up<2>();
  slabs_add_up<3>();
}

/// Saturations of a 3^D block under a plane through its middle cell.
template <int D>
Vec<D> normal_from_plane(const Vec<D>& exact, double constant) {
  constexpr int size = D == 2 ? 9 : 27;
  double alpha[27];
  for (int i = 0; i < size; ++i) {
    Plane<D> plane{exact, constant};
    int rest = i;
    for (int a = 0; a < D; ++a, rest /= 3) plane.constant -= exact[a] * (rest % 3 - 1);
    alpha[i] = volume_below(plane);
  }
  const std::ptrdiff_t stride[3] = {1, 3, 9};
  return interface_normal<D>(alpha + size / 2, stride);
}

TEST(Plic, MixedYoungsCentredNormalIsExactForPlanesThatCutColumnsCleanly) {
  const Vec<2> flat = normal_from_plane<2>(Vec<2>{{0.2, 0.8}}, 0.5);
  EXPECT_NEAR(flat[0], 0.2, 1e-14);
  const Vec<3> solid = normal_from_plane<3>(Vec<3>{{-0.1, 0.15, -0.75}}, -0.35);
  EXPECT_NEAR(solid[0], -0.1, 1e-14);
  EXPECT_NEAR(solid[1], 0.15, 1e-14);
}

TEST(Plic, MixedYoungsCentredNormalIsCloseForEveryPlane) {
  std::mt19937 generator(3);
  double worst = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const Vec<3> exact = random_normal<3>(generator, false);
    const Vec<3> found = normal_from_plane<3>(exact, plane_of_volume<3>(exact, 0.5).constant);
    worst =
        std::max(worst, std::acos(std::min(1.0, dot(exact, found) / norm(exact) / norm(found))));
  }
  EXPECT_LT(worst, 0.2);  // radians
}

}  // namespace
}  // namespace mudlark
