#pragma once
/// Spectra of the sea, and the linear waves that stand for them.
#include <vector>

#include "flow/fourier_wave.hpp"

namespace mudlark {

/// S(f) up to a constant factor, except for given tables [m2 s]: JONSWAP (Hasselmann et al. 1973),
/// that of Pierson & Moskowitz (1964), JONSWAP times the depth function of Kitaigorodskii (TMA,
/// Bouws et al. 1985), or a table.
double spectral_density(const Spectrum& spectrum, double frequency, const WaveSetting& setting);

/// Where the density is largest [s].
double peak_period(const Spectrum& spectrum);

/// H_m0 = 4 sqrt(area) of a given table [m].
double significant_height(const Spectrum& spectrum);

/// Frequencies at random in equal bands, so that the record does not repeat; phases at random.
std::vector<WaveComponent> random_sea(const IrregularSea& wave, const WaveSetting& setting);

/// Amplitudes in proportion to S(f) df; all crests meet at the focus.
std::vector<WaveComponent> focused_sea(const FocusedWave& wave, const WaveSetting& setting);

}  // namespace mudlark
