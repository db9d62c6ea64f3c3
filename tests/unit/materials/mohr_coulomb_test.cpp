// Mohr-Coulomb: failure stresses, dilatancy, corners against a search over all active planes,
// softening, separation.
#include "materials/mohr_coulomb.hpp"

#include <algorithm>
#include <numbers>
#include <random>

#include "unit/materials/strain_paths.hpp"

namespace mudlark {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double young = 20e6, poisson = 0.3;

MohrCoulombOptions soil(double cohesion, double friction, double dilatancy) {
  MohrCoulombOptions options;
  options.young_modulus = young, options.poisson_ratio = poisson;
  options.cohesion = cohesion;
  options.friction_angle = friction * degree, options.dilatancy_angle = dilatancy * degree;
  return options;
}

TEST(MohrCoulomb, FailsInTriaxialCompressionAndExtensionAtRankinesStresses) {
  const MohrCoulomb law(soil(5e3, 30.0, 10.0));
  const double k = 3.0, q = 2.0 * 5e3 * std::sqrt(3.0);
  TestPoint compression(law, -50e3 * SymTensor::identity());
  for (int i = 0; i < 60; ++i) compression.triaxial(-5e-4);
  EXPECT_NEAR(compression.stress.zz, -(k * 50e3 + q), 1.0);
  EXPECT_NEAR(compression.stress.xx, -50e3, 1e-1);
  TestPoint extension(law, -50e3 * SymTensor::identity());
  for (int i = 0; i < 60; ++i) extension.triaxial(5e-4);
  EXPECT_NEAR(extension.stress.zz, -(50e3 - q) / k, 1.0);
}

TEST(MohrCoulomb, DilatesAtFailureByItsAngle) {
  for (const double angle : {0.0, 7.5, 30.0}) {
    const MohrCoulomb law(soil(5e3, 30.0, angle));
    TestPoint point(law, -50e3 * SymTensor::identity());
    double horizontal = 0.0;
    for (int i = 0; i < 60; ++i) horizontal = point.triaxial(-5e-4);
    const double sine = std::sin(angle * degree);
    EXPECT_NEAR(2.0 * horizontal / 5e-4, (1.0 + sine) / (1.0 - sine), 1e-4) << angle;
  }
}

TEST(MohrCoulomb, InPlaneStrainCarriesCoulombsCircleWithTheInPlaneMeanStress) {
  const double c = 5e3, phi = 25.0 * degree;
  const MohrCoulomb law(soil(c, 25.0, 0.0));
  TestPoint point(law, {-50e3, -40e3, -60e3, 0, 0, 0});
  point.strain({2e-3, 0, -3e-3, 0, 0, 8e-3}, 40);
  const SymTensor& s = point.stress;
  const double mean = 0.5 * (s.xx + s.zz), radius = std::hypot(0.5 * (s.xx - s.zz), s.zx);
  EXPECT_NEAR(radius, -mean * std::sin(phi) + c * std::cos(phi), 1e-6);
  EXPECT_GT(point.history[0], 5e-3);
}

TEST(MohrCoulomb, SimpleShearWithoutFrictionAngleHoldsTheCohesion) {
  const MohrCoulomb law(soil(12e3, 0.0, 0.0));
  TestPoint point(law, {});
  point.strain({0, 0, 0, 0, 0, 0.05}, 3);
  EXPECT_LT(largest_difference(point.stress, {0, 0, 0, 0, 0, 12e3}), 1e-6);
  EXPECT_NEAR(point.history[0], 0.1 - 12e3 / law.shear_modulus(), 1e-12);
}

TEST(MohrCoulomb, PullsToItsApexOrItsCutoffAndHoldsThere) {
  MohrCoulombOptions options = soil(5e3, 30.0, 0.0);
  const double tip = 5e3 / std::tan(30.0 * degree);
  {
    const MohrCoulomb law(options);
    TestPoint point(law, {});
    point.strain(0.01 * SymTensor::identity(), 7);
    EXPECT_LT(largest_difference(point.stress, tip * SymTensor::identity()), 1e-8);
  }
  options.tension_cutoff = 2e3;
  const MohrCoulomb law(options);
  TestPoint point(law, {});
  point.strain(0.01 * SymTensor::identity(), 7);
  EXPECT_LT(largest_difference(point.stress, 2e3 * SymTensor::identity()), 1e-8);
  TestPoint one_way(law, {});  // only one principal stress is cut off
  one_way.strain({0, 0, 1.2e-4, 0, 0, 0});
  const double lateral = poisson / (1.0 - poisson) * 2e3;
  EXPECT_LT(largest_difference(one_way.stress, {lateral, lateral, 2e3, 0, 0, 0}), 1e-8);
}

// ---- corners against all combinations of active planes ----------------------------------------

struct Plane {
  PrincipalValues normal, flow;
  double strength;
};

/// The six Mohr-Coulomb planes and three cut-offs, for stresses in any order.
std::vector<Plane> all_planes(const MohrCoulombSurface& s) {
  std::vector<Plane> planes;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      if (i == j) continue;
      Plane plane{{}, {}, s.strength};
      plane.normal[i] = s.slope, plane.normal[j] = -1.0;
      plane.flow[i] = s.flow, plane.flow[j] = -1.0;
      planes.push_back(plane);
    }
  for (std::size_t i = 0; i < 3; ++i) {
    Plane plane{{}, {}, s.tension};
    plane.normal[i] = plane.flow[i] = 1.0;
    planes.push_back(plane);
  }
  return planes;
}

double dot(const PrincipalValues& a, const PrincipalValues& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
PrincipalValues stiff(const Elasticity& e, const PrincipalValues& b) {
  const double even = e.lame * (b[0] + b[1] + b[2]), g = 2.0 * e.shear;
  return {even + g * b[0], even + g * b[1], even + g * b[2]};
}

/// Stress after the flow of the chosen planes; false when they depend on each other, or one of them
/// would flow backwards, or another plane is violated.
bool flows(const std::vector<Plane>& all, const std::vector<std::size_t>& chosen,
           const Elasticity& e, const PrincipalValues& trial, PrincipalValues& stress) {
  const std::size_t n = chosen.size();
  std::array<std::array<double, 4>, 3> a{};
  for (std::size_t r = 0; r < n; ++r) {
    for (std::size_t c = 0; c < n; ++c)
      a[r][c] = dot(all[chosen[r]].normal, stiff(e, all[chosen[c]].flow)) / young;
    a[r][3] = (dot(all[chosen[r]].normal, trial) - all[chosen[r]].strength) / young;
  }
  for (std::size_t p = 0; p < n; ++p) {  // Gauss-Jordan with pivots
    std::size_t best = p;
    for (std::size_t r = p; r < n; ++r)
      if (std::abs(a[r][p]) > std::abs(a[best][p])) best = r;
    std::swap(a[p], a[best]);
    if (std::abs(a[p][p]) < 1e-9) return false;
    for (std::size_t r = 0; r < n; ++r) {
      if (r == p) continue;
      const double factor = a[r][p] / a[p][p];
      for (std::size_t c = p; c < 4; ++c) a[r][c] -= factor * a[p][c];
    }
  }
  stress = trial;
  for (std::size_t p = 0; p < n; ++p) {
    const double multiplier = a[p][3] / a[p][p];
    if (multiplier < -1e-12) return false;
    const PrincipalValues taken = stiff(e, all[chosen[p]].flow);
    for (std::size_t i = 0; i < 3; ++i) stress[i] -= multiplier * taken[i];
  }
  return std::all_of(all.begin(), all.end(), [&](const Plane& plane) {
    return dot(plane.normal, stress) - plane.strength < 1e-6;
  });
}

double nearest_solution(const MohrCoulombSurface& surface, const Elasticity& e,
                        const PrincipalValues& trial, const PrincipalValues& found) {
  const auto planes = all_planes(surface);
  double nearest = 1e300;
  const auto consider = [&](const std::vector<std::size_t>& chosen) {
    PrincipalValues s;
    if (!flows(planes, chosen, e, trial, s)) return;
    double distance = 0.0;
    for (std::size_t i = 0; i < 3; ++i) distance = std::max(distance, std::abs(s[i] - found[i]));
    nearest = std::min(nearest, distance);
  };
  for (std::size_t i = 0; i < planes.size(); ++i) {
    consider({i});
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      consider({i, j});
      for (std::size_t k = j + 1; k < planes.size(); ++k) consider({i, j, k});
    }
  }
  return nearest;
}

TEST(MohrCoulombSurface, ReturnsWhereKoitersRuleSaysFromAnywhere) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Elasticity elasticity = Elasticity::from(young, poisson);
  for (const double friction : {0.0, 20.0, 45.0})
    for (const double dilatancy : {0.0, 15.0, 45.0})
      for (const double cut : {0.0, 3e3, 1e12}) {
        if (dilatancy > friction) continue;
        const auto surface = MohrCoulombSurface::from(5e3, std::tan(friction * degree),
                                                      std::tan(dilatancy * degree), cut);
        int outside = 0;
        for (int i = 0; i < 400; ++i) {
          const double mean = 4e4 * unit(generator), size = 6e4;
          PrincipalValues trial{mean + size * unit(generator), mean + size * unit(generator),
                                mean + size * unit(generator)};
          if (i % 4 == 0) trial[1] = trial[0] + 1e3 * unit(generator);  // near an edge
          if (i % 4 == 1) trial[1] = trial[2] + 1e3 * unit(generator);
          std::sort(trial.rbegin(), trial.rend());
          if (surface.admits(trial)) continue;
          ++outside;
          const PrincipalValues s = returned(surface, elasticity, trial);
          EXPECT_LT(surface.slope * s[0] - s[2] - surface.strength, 1e-6);
          EXPECT_LT(s[0] - surface.tension, 1e-6);
          ASSERT_LT(nearest_solution(surface, elasticity, trial, s), 1e-5)
              << friction << " " << dilatancy << " " << cut << ": " << trial[0] << " " << trial[1]
              << " " << trial[2] << " -> " << s[0] << " " << s[1] << " " << s[2];
        }
        EXPECT_GT(outside, 100);
      }
}

TEST(MohrCoulombSurface, LeavesAStressThatLiesOnItWhereItIs) {
  const Elasticity elasticity = Elasticity::from(young, poisson);
  const auto surface = MohrCoulombSurface::from(5e3, 0.6, 0.1, 2e3);
  const PrincipalValues on{-3e3, -5e3, surface.slope * -3e3 - surface.strength};
  for (const double inwards : {0.0, 1e-9, 10.0}) {
    const PrincipalValues trial{on[0] - inwards, on[1], on[2]};
    const PrincipalValues s = returned(surface, elasticity, trial);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(s[i], trial[i], 1e-8);
  }
}

TEST(MohrCoulombSurface, KnowsElasticStatesWithoutTheirPrincipalStresses) {
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto surface = MohrCoulombSurface::from(5e3, 0.6, 0.1, 2e3);
  int inside = 0;
  for (int i = 0; i < 4000; ++i) {
    SymTensor s{unit(generator), unit(generator), unit(generator),
                unit(generator), unit(generator), unit(generator)};
    s = 8e3 * s + -1.2e4 * SymTensor::identity();
    if (i % 2) s.xy = s.yz = 0.0;
    const bool admitted = surface.admits(s);
    inside += admitted;
    EXPECT_EQ(admitted, surface.admits(PrincipalAxes(s).values()));
  }
  EXPECT_GT(inside, 500);
  EXPECT_LT(inside, 3500);
}

TEST(MohrCoulomb, OneStepIsAsGoodAsAHundredAlongAProportionalPath) {
  for (const SymTensor& strain : {SymTensor{0, 0, -2e-3, 0, 0, 0}, SymTensor{0, 0, 0, 0, 0, 4e-3},
                                  SymTensor{3e-4, 3e-4, 3e-4, 0, 0, 0}}) {
    const MohrCoulomb law(soil(5e3, 30.0, 30.0));
    TestPoint once(law, {}), often(law, {});
    once.strain(strain);
    often.strain(strain, 100);
    EXPECT_LT(largest_difference(once.stress, often.stress), 30.0) << strain.zz << strain.zx;
  }
}

// ---- softening --------------------------------------------------------------------------------

MohrCoulombOptions softening_soil(double length) {
  MohrCoulombOptions options = soil(12e3, 0.0, 0.0);
  options.residual = MohrCoulombOptions::Residual{4e3, 0.0, 0.0, {0.05, length}};
  return options;
}

TEST(MohrCoulomb, SoftensAlongTheExponentialWhateverTheStep) {
  const MohrCoulomb law(softening_soil(0.0));
  for (const int steps : {1, 10, 1000}) {
    TestPoint point(law, {});
    point.strain({0, 0, 0, 0, 0, 0.04}, steps);
    const double g = point.history[0], left = 4e3 + 8e3 * std::exp(-g / 0.05);
    EXPECT_NEAR(point.stress.zx, left, 1e-3);
    EXPECT_NEAR(g, 0.08 - left / law.shear_modulus(), 1e-8);  // tensor shear 0.04 is 0.08
  }
}

TEST(MohrCoulomb, SpendsTheSameWorkAcrossABandWhateverItsWidth) {
  const double band = 0.1;
  const MohrCoulomb law(softening_soil(band));
  for (const double cell : {0.05, 0.1, 0.4}) {
    TestPoint point(law, {});
    point.length = cell;
    double work = 0.0;
    const int steps = 4000;
    const double shear = 15.0 * 0.05 * band / cell / steps;  // until nothing is left to lose
    for (int i = 0; i < steps; ++i) {
      const double before = point.stress.zx, plastic = point.history[0];
      point.strain({0, 0, 0, 0, 0, 0.5 * shear});
      work += cell * (0.5 * (before + point.stress.zx) - 4e3) * (point.history[0] - plastic);
    }
    EXPECT_NEAR(work, 8e3 * 0.05 * band, 2e-3 * 8e3 * 0.05 * band) << cell;
  }
}

TEST(MohrCoulomb, LosesFrictionAndDilatancyToo) {
  MohrCoulombOptions options = soil(1e3, 40.0, 15.0);
  options.residual = MohrCoulombOptions::Residual{0.0, 32.0 * degree, 0.0, {0.02, 0.0}};
  const MohrCoulomb law(options);
  TestPoint point(law, -50e3 * SymTensor::identity());
  double highest = 0.0, horizontal = 0.0;
  for (int i = 0; i < 300; ++i) {
    horizontal = point.triaxial(-1e-3);
    highest = std::max(highest, point.stress.zz / point.stress.xx);
  }
  EXPECT_NEAR(point.stress.zz / point.stress.xx,
              (1 + std::sin(32 * degree)) / (1 - std::sin(32 * degree)), 1e-3);
  EXPECT_GT(highest, 4.0);
  EXPECT_NEAR(2.0 * horizontal, 1e-3, 1e-7);
}

// ---- grains without cohesion ------------------------------------------------------------------

TEST(MohrCoulomb, ComeApartAndCarryNothingUntilTheGapHasClosed) {
  const MohrCoulomb law(soil(0.0, 33.0, 0.0));
  TestPoint point(law, -100.0 * SymTensor::identity());
  const double bulk = young / (3.0 * (1.0 - 2.0 * poisson));
  point.strain(0.01 * SymTensor::identity(), 3);
  EXPECT_EQ(point.stress, SymTensor{});
  EXPECT_NEAR(point.history[1], 0.03 - 100.0 / bulk, 1e-12);
  point.strain({0, 0, -0.02, 0, 0, 0.3}, 4);
  EXPECT_EQ(point.stress, SymTensor{});
  point.strain(-0.01 * SymTensor::identity(), 5);
  EXPECT_EQ(point.history[1], 0.0);
  EXPECT_NEAR(point.stress.trace() / 3.0, -bulk * (0.02 + 100.0 / bulk), 1e-6);
}

TEST(MohrCoulomb, SaysWhichPointIsNoNumber) {
  const MohrCoulomb law(soil(5e3, 30.0, 0.0));
  std::array<SymTensor, 3> strain{}, stress{};
  std::array<double, 6> history{};
  std::array<unsigned char, 3> failed{};
  strain[1].zz = std::nan("");
  MaterialPoints points{strain, stress, history};
  points.failed = failed;
  EXPECT_EQ(law.update_stress(points), 1u);
  EXPECT_EQ(failed, (std::array<unsigned char, 3>{0, 1, 0}));
}

TEST(MohrCoulomb, StartsFromJakysRatioAndKnowsItsModuli) {
  const MohrCoulomb law(soil(0.0, 30.0, 0.0)), clay(soil(1e3, 0.0, 0.0));
  EXPECT_NEAR(law.earth_pressure_at_rest(), 0.5, 1e-15);
  EXPECT_NEAR(clay.earth_pressure_at_rest(), poisson / (1.0 - poisson), 1e-15);
  EXPECT_NEAR(law.wave_modulus({}, {}), young * 0.7 / (1.3 * 0.4), 1e-6);
  EXPECT_TRUE(law.supports(StrainMeasure::hencky));
  EXPECT_FALSE(law.supports(StrainMeasure::small));
}

}  // namespace
}  // namespace mudlark
