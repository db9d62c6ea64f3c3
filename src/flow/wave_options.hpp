#pragma once
/// What a case file says about waves, as plain data (SI units).
#include <array>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "base/varying.hpp"

namespace mudlark {

/// Steady periodic waves. stream_function and cnoidal are both the full nonlinear wave, the latter
/// with as many modes as waves much longer than the depth need.
enum class RegularTheory { linear, stokes_5, stream_function, cnoidal };

struct RegularWave {
  double height = 0.0;  ///< crest to trough [m]
  double period = 0.0;  ///< [s]
  RegularTheory theory = RegularTheory::stream_function;
};

/// One hump, third order (Grimshaw 1971).
struct SolitaryWave {
  double height = 0.0;  ///< [m]
  double crest = 0.0;   ///< where its crest is at time zero along the wave's way [m]
};

enum class SpectrumForm { jonswap, pierson_moskowitz, tma, given };

struct Spectrum {
  SpectrumForm form = SpectrumForm::jonswap;
  double peak_period = 0.0;                  ///< T_p [s]; not for given ones
  double peak_enhancement = 3.3;             ///< gamma of JONSWAP and TMA [-]
  std::vector<std::array<double, 2>> table;  ///< frequency [Hz], density [m2 s]; linear between
};

/// Linear components that stand for a spectrum.
struct SeaComponents {
  Spectrum spectrum;
  int count = 200;
  std::uint64_t seed = 1;
  std::optional<double> spreading;  ///< s of cos^2s((theta - mean)/2); without: long-crested
};

/// Linear waves of random phase.
struct IrregularSea {
  SeaComponents sea;
  double significant_height = 0.0;  ///< H_m0 [m]
};

/// NewWave (Tromans, Anaturk & Hagemeijer 1991): the likeliest form of a sea around a high crest.
struct FocusedWave {
  SeaComponents sea;
  double crest_height = 0.0;      ///< above still water, where and when all crests meet [m]
  std::array<double, 2> focus{};  ///< from the zone's outer end inwards, and across [m]
  double time = 0.0;              ///< [s]
};

/// A long wave given as level and velocity over time where it comes in.
struct GivenWave {
  Varying level;     ///< above still water [m], function of t
  Varying velocity;  ///< [m/s]; used when `has_velocity`, else level * sqrt(g/d) / (1 + level/d)
  bool has_velocity = false;
};

struct StillWater {};

using WaveKind =
    std::variant<StillWater, RegularWave, SolitaryWave, IrregularSea, FocusedWave, GivenWave>;

}  // namespace mudlark
