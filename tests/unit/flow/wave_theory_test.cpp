#include "flow/wave_theory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "base/errors.hpp"
#include "flow/sea_components.hpp"
#include "flow/steady_wave.hpp"

namespace mudlark {
namespace {

constexpr double gravity = 9.81;
constexpr double pi = std::numbers::pi;

TEST(WaveTheory, WaveNumberSolvesTheDispersionRelation) {
  for (const double period : {0.5, 2.0, 8.0, 300.0})
    for (const double depth : {0.1, 1.0, 100.0})
      for (const double current : {0.0, 0.3, -0.1}) {
        const double k = wave_number(period, depth, gravity, current), w = 2.0 * pi / period;
        EXPECT_NEAR(gravity * k * std::tanh(k * depth), std::pow(w - k * current, 2.0),
                    1e-11 * w * w);
        if (current > 0.0) {
          EXPECT_LT(k, wave_number(period, depth, gravity));
        }
        if (current < 0.0) {
          EXPECT_GT(k, wave_number(period, depth, gravity));
        }
      }
  // In deep water waves stop where the current exceeds a quarter of their speed g/w.
  const double limit = 0.25 * gravity / (2.0 * pi);
  EXPECT_FALSE(std::isnan(wave_number(1.0, 100.0, gravity, -0.99 * limit)));
  EXPECT_TRUE(std::isnan(wave_number(1.0, 100.0, gravity, -1.01 * limit)));
}

double elevation(const SteadyWave& wave, double phase) {
  double sum = 0.0;
  for (std::size_t j = 0; j < wave.elevation.size(); ++j)
    sum += wave.elevation[j] * std::cos(static_cast<double>(j + 1) * phase);
  return sum;
}

// Figures of an independent Fourier solution (SciPy least squares, 16 modes): H = 2 m, T = 8 s on
// 10 m; H = 0.1 m, T = 2 s on 0.5 m.
TEST(SteadyWave, AgreesWithAnIndependentSolution) {
  const SteadyWave high = stream_function_wave(2.0, 8.0, 10.0, gravity);
  EXPECT_NEAR(2.0 * pi / high.wave_number, 71.9488896, 1e-5);
  EXPECT_NEAR(elevation(high, 0.0), 1.15471124, 1e-6);
  EXPECT_NEAR(elevation(high, 1.0), 0.44008137, 1e-6);
  EXPECT_NEAR(elevation(high, pi), -0.84528876, 1e-6);
  const auto motion = make_wave(RegularWave{2.0, 8.0}, {.depth = 10.0});
  const double along = 1.0 / high.wave_number;  // a phase of 1
  EXPECT_NEAR(motion->velocity({}, 0.0, 0.0)[0], 1.22747765, 2e-6);
  EXPECT_NEAR(motion->velocity({along, 0.0}, -3.0, 0.0)[0], 0.44595794, 2e-6);
  EXPECT_NEAR(motion->velocity({along, 0.0}, -3.0, 0.0)[2], 0.48746795, 2e-6);
  const SteadyWave flume = stream_function_wave(0.1, 2.0, 0.5, gravity);
  EXPECT_NEAR(2.0 * pi / flume.wave_number, 4.11980998, 1e-6);
  EXPECT_NEAR(elevation(flume, 0.0), 0.05896826, 1e-7);
}

TEST(SteadyWave, RefusesAWaveThatIsTooHigh) {
  EXPECT_THROW(stream_function_wave(0.5, 2.0, 0.5, gravity), InputError);
  EXPECT_THROW(stokes_5_wave(0.1, 8.0, 0.5, gravity), InputError);  // far too long
  EXPECT_THROW(stream_function_wave(0.1, 1.0, 5.0, gravity, -0.6), InputError);
}

/// Largest difference of two waves over a period, in elevation over height.
double difference(const SteadyWave& one, const SteadyWave& other, double height) {
  double worst = 0.0;
  for (int i = 0; i <= 100; ++i) {
    const double phase = pi * i / 100.0;
    worst = std::max(worst, std::abs(elevation(one, phase) - elevation(other, phase)));
  }
  return worst / height;
}

// The remainder of the fifth-order series is of sixth order, as compared with the height of fifth.
TEST(SteadyWave, StokesFifthOrderNearsTheExactWaveWithTheFifthPowerOfItsHeight) {
  std::vector<double> elevations, speeds;
  for (const double height : {2.0, 1.0}) {
    const SteadyWave exact = stream_function_wave(height, 6.0, 10.0, gravity, 0.4);
    const SteadyWave stokes = stokes_5_wave(height, 6.0, 10.0, gravity, 0.4);
    elevations.push_back(difference(stokes, exact, height));
    double worst = 0.0;
    for (std::size_t j = 0; j < 5; ++j)
      worst = std::max(worst, std::abs(stokes.speed[j] - exact.speed[j]) / exact.speed[0]);
    speeds.push_back(worst);
    EXPECT_NEAR(stokes.wave_number, exact.wave_number, 2e-5 * exact.wave_number);
  }
  EXPECT_LT(elevations[0], 2e-4);
  EXPECT_LT(speeds[0], 2e-4);
  EXPECT_GT(std::log2(elevations[0] / elevations[1]), 4.6);
  EXPECT_GT(std::log2(speeds[0] / speeds[1]), 4.6);
}

/// sqrt(3 H/d) x/(2 d sqrt(m)) = F: the elevation of the cnoidal wave of first order (Korteweg &
/// de Vries 1895) with crest-to-trough height H, by integrating its own equation over half a wave.
struct FirstOrderCnoidal {
  double length = 0.0;
  std::vector<double> profile;  ///< above the trough over H, at 200 steps from crest to trough
};
/// `m`: parameter of the elliptic functions; d eta/dx from (eta')^2 = 3/(m d^3 H^0)...: cn by its
/// arithmetic-geometric mean.
FirstOrderCnoidal cnoidal(double height, double depth, double m) {
  // K(m) and cn(u|m) by the descending Landen transformation.
  std::vector<double> a{1.0}, c{std::sqrt(m)};
  double b = std::sqrt(1.0 - m);
  while (c.back() > 1e-15) {
    const double mean = 0.5 * (a.back() + b), half = 0.5 * (a.back() - b);
    b = std::sqrt(a.back() * b);
    a.push_back(mean);
    c.push_back(half);
  }
  const double quarter = pi / (2.0 * a.back());
  const auto cn = [&](double u) {
    const std::size_t n = a.size() - 1;
    double phi = std::ldexp(a[n] * u, static_cast<int>(n));
    for (std::size_t i = n; i > 0; --i) phi = 0.5 * (phi + std::asin(c[i] / a[i] * std::sin(phi)));
    return std::cos(phi);
  };
  FirstOrderCnoidal wave;
  wave.length = 2.0 * quarter * depth * std::sqrt(4.0 * m * depth / (3.0 * height));
  for (int i = 0; i <= 200; ++i) {
    const double value = cn(quarter * i / 200.0);
    wave.profile.push_back(value * value);
  }
  return wave;
}

// The first-order wave is off by about H/d; so must the exact one be from it.
TEST(SteadyWave, LongWavesAreCnoidal) {
  for (const double height : {0.1, 0.05}) {
    const double m = 0.999;  // H L^2/d^3 = 155
    const FirstOrderCnoidal expected = cnoidal(height, 1.0, m);
    // The period at which the exact wave has this length.
    double period = expected.length / std::sqrt(gravity);
    SteadyWave wave;
    for (int i = 0; i < 20; ++i) {
      wave = cnoidal_wave(height, period, 1.0, gravity);
      period *= expected.length * wave.wave_number / (2.0 * pi);
    }
    EXPECT_NEAR(2.0 * pi / wave.wave_number, expected.length, 1e-6 * expected.length);
    double worst = 0.0;
    const double trough = elevation(wave, pi);
    for (int i = 0; i <= 200; ++i)
      worst = std::max(worst, std::abs((elevation(wave, pi * i / 200.0) - trough) / height -
                                       expected.profile[static_cast<std::size_t>(i)]));
    EXPECT_LT(worst, 0.4 * height);
    EXPECT_LT(std::abs(wave.elevation.back()), 1e-7 * height);  // enough modes
  }
}

// H L^2/d^3 = 1600: crests like solitary waves, far apart.
TEST(SteadyWave, VeryLongWavesAreFound) {
  const SteadyWave wave = cnoidal_wave(0.3, 22.0, 1.0, gravity);
  EXPECT_NEAR(elevation(wave, 0.0) - elevation(wave, pi), 0.3, 1e-8);
  EXPECT_GT(2.0 * pi / wave.wave_number, 70.0);
  EXPECT_GT(elevation(wave, 0.0), 0.27);
}

/// Largest of |div v| and of |d eta/dt + v . grad eta - w| over a wave, in 1/s and m/s.
std::array<double, 2> misfits(const WaveMotion& wave, const WaveSetting& setting, double from,
                              double to) {
  std::array<double, 2> worst{};
  const double h = 1e-4, t = 0.3;
  for (int i = 0; i <= 40; ++i) {
    const double s = from + (to - from) * i / 40.0, z = -0.4 * setting.depth;
    const WavePlace here{s, 0.7}, before{s - h, 0.7}, after{s + h, 0.7}, left{s, 0.7 - h},
        right{s, 0.7 + h};
    const double divergence =
        (wave.velocity(after, z, t)[0] - wave.velocity(before, z, t)[0] +
         wave.velocity(right, z, t)[1] - wave.velocity(left, z, t)[1] +
         wave.velocity(here, z + h, t)[2] - wave.velocity(here, z - h, t)[2]) /
        (2 * h);
    auto v = wave.velocity(here, wave.elevation(here, t), t);
    v[0] += setting.current;
    const double surface = (wave.elevation(here, t + h) - wave.elevation(here, t - h)) / (2 * h) +
                           v[0] * (wave.elevation(after, t) - wave.elevation(before, t)) / (2 * h) +
                           v[1] * (wave.elevation(right, t) - wave.elevation(left, t)) / (2 * h) -
                           v[2];
    worst = {std::max(worst[0], std::abs(divergence)), std::max(worst[1], std::abs(surface))};
  }
  return worst;
}

TEST(WaveTheory, KeepsVolumeAndTheSurfaceIsMaterial) {
  const WaveSetting plain{.depth = 0.5}, oblique{.depth = 0.5, .direction = 0.6, .current = 0.2};
  for (const WaveSetting& setting : {plain, oblique}) {
    for (const RegularTheory theory : {RegularTheory::stream_function, RegularTheory::cnoidal}) {
      const auto steady = make_wave(RegularWave{0.1, 2.0, theory}, setting);
      const auto exact = misfits(*steady, setting, 0.0, steady->length());
      EXPECT_LT(exact[0], 2e-5);  // the depth functions are interpolated
      EXPECT_LT(exact[1], 1e-5);
    }
    const auto solitary = make_wave(SolitaryWave{0.05, 0.0}, setting);
    const auto third_order = misfits(*solitary, setting, -3.0, 3.0);
    EXPECT_LT(third_order[0], 5e-4);
    EXPECT_LT(third_order[1], 5e-4);
  }
  const auto solitary = make_wave(SolitaryWave{0.05, 0.0}, plain);
  EXPECT_NEAR(solitary->elevation({}, 0.0), 0.05, 1e-15);
  // Grimshaw's speed for H/d = 0.3, d = 1 m: 3.5633556 m/s
  EXPECT_NEAR(make_wave(SolitaryWave{0.3, 0.0}, {.depth = 1.0})->celerity(), 3.5633556, 1e-6);
}

TEST(WaveTheory, ASolitaryWaveIsOfThirdOrder) {
  std::vector<std::array<double, 2>> found;
  for (const double height : {0.1, 0.05}) {
    const WaveSetting setting{.depth = 1.0};
    found.push_back(misfits(*make_wave(SolitaryWave{height, 0.0}, setting), setting, 0.2, 6.0));
  }
  EXPECT_GT(std::log2(found[0][0] / found[1][0]), 3.9);
  EXPECT_GT(std::log2(found[0][1] / found[1][1]), 3.9);
}

TEST(WaveTheory, AnObliqueWaveIsTheSameWaveTurned) {
  const double angle = 0.5;
  const auto straight = make_wave(RegularWave{0.1, 2.0}, {.depth = 0.5});
  const auto oblique = make_wave(RegularWave{0.1, 2.0}, {.depth = 0.5, .direction = angle});
  const WavePlace place{1.3, 0.4};
  const double s = std::cos(angle) * 1.3 + std::sin(angle) * 0.4;
  EXPECT_NEAR(oblique->elevation(place, 0.7), straight->elevation({s, 0.0}, 0.7), 1e-14);
  const auto one = straight->velocity({s, 0.0}, -0.1, 0.7),
             two = oblique->velocity(place, -0.1, 0.7);
  EXPECT_NEAR(two[0], one[0] * std::cos(angle), 1e-14);
  EXPECT_NEAR(two[1], one[0] * std::sin(angle), 1e-14);
  EXPECT_NEAR(two[2], one[2], 1e-14);
}

IrregularSea jonswap_sea(SpectrumForm form, int components, std::uint64_t seed) {
  IrregularSea sea;
  sea.significant_height = 0.1;
  sea.sea.spectrum.form = form;
  sea.sea.spectrum.peak_period = 1.5;
  sea.sea.count = components;
  sea.sea.seed = seed;
  return sea;
}

TEST(WaveTheory, IrregularSeaHasItsSignificantHeightAndRepeatsWithItsSeed) {
  const IrregularSea sea = jonswap_sea(SpectrumForm::jonswap, 300, 7);
  const WaveSetting setting{.depth = 0.5};
  const auto one = make_wave(sea, setting), two = make_wave(sea, setting),
             other = make_wave(jonswap_sea(SpectrumForm::jonswap, 300, 8), setting);
  double sum = 0.0, apart = 0.0;
  const int count = 30000;
  for (int i = 0; i < count; ++i) {
    const double level = one->elevation({}, 0.05 * i);
    sum += level * level;
    EXPECT_EQ(level, two->elevation({}, 0.05 * i));
    apart = std::max(apart, std::abs(level - other->elevation({}, 0.05 * i)));
  }
  EXPECT_NEAR(4.0 * std::sqrt(sum / count), 0.1, 0.004);
  EXPECT_GT(apart, 0.05);
}

/// Variance of the components with frequencies in a band [Hz], over all.
double share_of_band(const std::vector<WaveComponent>& sea, double from, double to) {
  double inside = 0.0, all = 0.0;
  for (const WaveComponent& wave : sea) {
    const double f = wave.frequency / (2.0 * pi), energy = wave.elevation * wave.elevation;
    all += energy;
    if (f >= from && f < to) inside += energy;
  }
  return inside / all;
}

// Pierson & Moskowitz: the share of the variance below f is exp(-1.25 (f_p/f)^4), here between half
// and four times the peak.
TEST(Spectra, OfPiersonAndMoskowitzHasItsClosedFormIntegral) {
  const double peak = 1.0 / 1.5;
  const auto below = [&](double f) { return std::exp(-1.25 * std::pow(peak / f, 4.0)); };
  const auto sea =
      random_sea(jonswap_sea(SpectrumForm::pierson_moskowitz, 4000, 3), {.depth = 0.5});
  for (const double f : {0.8 * peak, peak, 1.3 * peak, 2.0 * peak})
    EXPECT_NEAR(share_of_band(sea, 0.0, f),
                (below(f) - below(0.5 * peak)) / (below(4.0 * peak) - below(0.5 * peak)), 2e-3);
}

TEST(Spectra, TmaIsJonswapInDeepWaterAndHalvesWithTheSquareOfTheFrequencyInShallow) {
  Spectrum jonswap, tma;
  jonswap.peak_period = tma.peak_period = 10.0;
  tma.form = SpectrumForm::tma;
  const auto ratio = [&](double f, double depth) {
    const WaveSetting setting{.depth = depth};
    return spectral_density(tma, f, setting) / spectral_density(jonswap, f, setting);
  };
  EXPECT_NEAR(ratio(0.4, 500.0), 1.0, 1e-9);
  // phi = w^2 d/(2 g) for w sqrt(d/g) << 1
  const double f = 0.05, depth = 0.5;
  EXPECT_NEAR(ratio(f, depth), std::pow(2.0 * pi * f, 2.0) * depth / (2.0 * gravity), 1e-4 * 0.01);
}

TEST(Spectra, AGivenTableIsFollowed) {
  IrregularSea sea;
  sea.sea.spectrum.form = SpectrumForm::given;
  sea.sea.spectrum.table = {{0.2, 0.0}, {0.5, 0.02}, {1.0, 0.0}};
  sea.sea.count = 2000;
  sea.significant_height = significant_height(sea.sea.spectrum);
  EXPECT_NEAR(sea.significant_height, 4.0 * std::sqrt(0.5 * 0.02 * 0.8), 1e-12);
  EXPECT_NEAR(peak_period(sea.sea.spectrum), 2.0, 1e-12);
  const auto waves = random_sea(sea, {.depth = 0.5});
  EXPECT_NEAR(share_of_band(waves, 0.0, 0.5), 0.3 / 0.8, 2e-3);
  double variance = 0.0;
  for (const WaveComponent& wave : waves) variance += 0.5 * wave.elevation * wave.elevation;
  EXPECT_NEAR(4.0 * std::sqrt(variance), sea.significant_height, 1e-12);
}

// The mean of exp(i theta) over cos^2s((theta - mean)/2) is s/(s+1).
TEST(Spectra, DirectionsSpreadAboutTheMeanAsStated) {
  IrregularSea sea = jonswap_sea(SpectrumForm::jonswap, 5000, 5);
  sea.sea.spreading = 12.0;
  const double mean = 0.2;
  std::complex<double> sum = 0.0;
  for (const WaveComponent& wave : random_sea(sea, {.depth = 0.5, .direction = mean}))
    sum += std::complex<double>(wave.way[0], wave.way[1]) / 5000.0;
  EXPECT_NEAR(std::abs(sum), 12.0 / 13.0, 5e-3);
  EXPECT_NEAR(std::arg(sum), mean, 0.02);
}

TEST(WaveTheory, AFocusedWaveHasItsCrestWhereAndWhenItIsSaid) {
  FocusedWave wave;
  wave.sea.spectrum.peak_period = 1.5;
  wave.sea.spreading = 20.0;
  wave.crest_height = 0.06;
  wave.focus = {7.0, 0.4};
  wave.time = 12.0;
  const auto motion = make_wave(wave, {.depth = 0.5, .direction = 0.2, .current = 0.1});
  EXPECT_NEAR(motion->elevation({7.0, 0.4}, 12.0), 0.06, 1e-12);
  for (const double off : {-3.0, -0.5, 0.5, 3.0}) {
    EXPECT_LT(motion->elevation({7.0 + off, 0.4}, 12.0), 0.05);
    EXPECT_LT(motion->elevation({7.0, 0.4}, 12.0 + off), 0.05);
  }
}

TEST(WaveTheory, AGivenLevelTravelsAsALongWave) {
  GivenWave wave;
  wave.level = Varying([](const Point3&, double t) { return 0.01 * std::sin(t); }, "sine");
  const WaveSetting setting{.depth = 0.4};
  const auto motion = make_wave(wave, setting);
  const double speed = std::sqrt(gravity * 0.4);
  EXPECT_NEAR(motion->elevation({2.0, 0.0}, 5.0), 0.01 * std::sin(5.0 - 2.0 / speed), 1e-12);
  EXPECT_LT(misfits(*motion, setting, 0.0, 0.5)[0], 1e-5);
}

// Volume: what comes in through a section changes the level behind it.
TEST(WaveTheory, WhatAWaveCarriesIsTheChangeOfTheLevelBeyond) {
  IrregularSea sea;
  sea.sea.spectrum.peak_period = 1.5;
  sea.sea.count = 20;
  sea.significant_height = 0.06;
  for (const WaveKind& kind : {WaveKind{RegularWave{0.1, 2.0, RegularTheory::stream_function}},
                               WaveKind{sea}, WaveKind{SolitaryWave{0.1, -1.0}}}) {
    const auto motion = make_wave(kind, {.depth = 0.5});
    const double h = 1e-4;
    for (const double time : {0.3, 0.9, 1.6}) {
      const double slope =
          (motion->carried({h, 0.0}, time) - motion->carried({-h, 0.0}, time)) / (2.0 * h);
      const double rise =
          (motion->elevation({}, time + h) - motion->elevation({}, time - h)) / (2.0 * h);
      EXPECT_NEAR(slope, -rise, 1e-5);
    }
  }
}

TEST(WaveTheory, APistonHasTheStrokeOfBiesel) {
  const double depth = 0.5, period = 2.0, kd = wave_number(period, depth, gravity) * depth;
  const auto motion = make_wave(RegularWave{0.04, period, RegularTheory::linear}, {.depth = depth});
  const double ratio = 2.0 * (std::cosh(2.0 * kd) - 1.0) / (std::sinh(2.0 * kd) + 2.0 * kd);
  EXPECT_NEAR(motion->piston(0.25 * period), 0.02 / ratio, 1e-12);  // foremost
  EXPECT_NEAR(motion->piston(0.75 * period), -0.02 / ratio, 1e-12);
  EXPECT_NEAR(motion->piston(0.5 * period), 0.0, 1e-12);
  // In shallow water the board moves with the water: X = integral of c eta/d.
  const auto longest = make_wave(RegularWave{0.01, 60.0, RegularTheory::linear}, {.depth = depth});
  const double rate = (longest->piston(0.01) - longest->piston(-0.01)) / 0.02;
  EXPECT_NEAR(rate, longest->celerity() * 0.005 / depth, 1e-3 * rate);
}

// Goring (1978): X' = c eta/(d + eta) where the board is.
TEST(WaveTheory, APistonFollowsTheSolitaryWaveThatItMakes) {
  const double depth = 0.5, height = 0.1, crest = -2.0;
  const auto motion = make_wave(SolitaryWave{height, crest}, {.depth = depth});
  const double k = std::sqrt(0.75 * height / depth) / depth;
  const double c = std::sqrt(gravity * (depth + height));
  for (const double time : {0.1, 0.7, 1.0, 1.5}) {
    const double x = motion->piston(time), h = 1e-5;
    const double speed = (motion->piston(time + h) - motion->piston(time - h)) / (2.0 * h);
    const double share = 1.0 / std::cosh(k * (c * time + crest - x));
    const double eta = height * share * share;
    EXPECT_NEAR(speed, c * eta / (depth + eta), 1e-6);
  }
  // All the water of the hump has been pushed: the board's way times the depth.
  EXPECT_NEAR(motion->piston(20.0) - motion->piston(-20.0), 2.0 * height / (k * depth), 1e-9);
}

}  // namespace
}  // namespace mudlark
