"""Incident and reflected waves from three or more gauges in a line: Mansard & Funke (1980), Proc. 17th Int. Conf. Coastal
Eng., by least squares.

    from mudlark.reflection import regular, irregular
    regular(time, levels, places, period=2.0, depth=0.5).coefficient
    irregular(time, levels, places, depth=0.5, peak_period=1.5).coefficient

    /usr/bin/python3 python/mudlark/reflection.py results/flume --depth 0.5 --period 2 --from 20 "gauge 1=8.2" "gauge 2=9.1" ...

`levels` has a row per gauge, `places` [m] are their positions along the way of the incident waves. Gauges should lie
between a tenth and nine tenths of half a wave apart, at unequal distances: frequencies at which they tell nothing are left out.
"""
import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np


def wave_number(period, depth, gravity=9.81):
    """k of w^2 = g k tanh(k d) [1/m], also for arrays of periods."""
    w2 = (2 * np.pi / np.asarray(period, dtype=float)) ** 2
    k = w2 / gravity / np.sqrt(np.tanh(w2 * depth / gravity))
    for _ in range(50):
        t = np.tanh(k * depth)
        k = k - (gravity * k * t - w2) / (gravity * (t + k * depth * (1 - t * t)))
    return k


@dataclass
class Regular:
    """Of the first harmonic; phases at place 0 and time 0 [rad]."""

    incident: float      # amplitude [m]
    reflected: float     # [m]
    coefficient: float   # reflected over incident
    phase: float         # of the incident wave, cos(k x - w t + phase)
    misfit: float        # of the two waves from what the gauges saw, over the incident amplitude


@dataclass
class Irregular:
    frequency: np.ndarray   # [Hz]
    incident: np.ndarray    # spectral density [m2 s]
    reflected: np.ndarray   # [m2 s]
    known: np.ndarray       # where the gauges tell the two apart
    incident_height: float  # H_m0 of the incident waves [m]
    coefficient: float      # square root of reflected over incident energy


def harmonic(time, level, period, orders=3):
    """Complex amplitude a of the first harmonic, level = mean + Re(a exp(-i w t)) + ..., by least squares."""
    w = 2 * np.pi / period
    columns = [np.ones_like(time)]
    for order in range(1, orders + 1):
        columns += [np.cos(order * w * time), np.sin(order * w * time)]
    fit = np.linalg.lstsq(np.column_stack(columns), level, rcond=None)[0]
    return fit[1] + 1j * fit[2]


def split(amplitudes, places, k):
    """Amplitudes of exp(i k x) and exp(-i k x) that come nearest to those of the gauges, and what is left."""
    matrix = np.column_stack([np.exp(1j * k * places), np.exp(-1j * k * places)])
    forth, back = np.linalg.lstsq(matrix, amplitudes, rcond=None)[0]
    return forth, back, np.abs(matrix @ [forth, back] - amplitudes).max()


def regular(time, levels, places, period, depth, length=None):
    """`length`: of the wave [m]; without it that of linear theory. The record should hold whole periods."""
    k = 2 * np.pi / length if length else float(wave_number(period, depth))
    places = np.asarray(places, dtype=float)
    amplitudes = np.array([harmonic(np.asarray(time), np.asarray(level), period) for level in levels])
    forth, back, left = split(amplitudes, places, k)
    return Regular(abs(forth), abs(back), abs(back) / abs(forth), float(np.angle(forth)), left / abs(forth))


def irregular(time, levels, places, depth, peak_period, bands=60):
    """Spectra between half and three times the peak frequency, means over equal bands. The record must be equally
    spaced in time."""
    time, places = np.asarray(time, dtype=float), np.asarray(places, dtype=float)
    step = (time[-1] - time[0]) / (len(time) - 1)
    if np.ptp(np.diff(time)) > 1e-3 * step:
        raise ValueError("the record is not equally spaced in time: give the gauges an `every`")
    window = np.hanning(len(time))
    levels = np.array([level - np.mean(level) for level in levels])
    transform = np.conj(np.fft.rfft(levels * window, axis=1))  # conj: level = Re(sum of a exp(-i w t))
    frequency = np.fft.rfftfreq(len(time), step)
    scale = 2 * step / np.sum(window**2)  # |transform|^2 to density
    inside = (frequency > 0.5 / peak_period) & (frequency < 3 / peak_period)
    frequency, transform = frequency[inside], transform[:, inside]
    forth, back = np.zeros(len(frequency)), np.zeros(len(frequency))
    known = np.zeros(len(frequency), dtype=bool)
    for i, k in enumerate(wave_number(1 / frequency, depth)):
        matrix = np.column_stack([np.exp(1j * k * places), np.exp(-1j * k * places)])
        known[i] = np.linalg.cond(matrix) < 3
        if known[i]:
            one, other = np.linalg.lstsq(matrix, transform[:, i], rcond=None)[0]
            forth[i], back[i] = scale * abs(one) ** 2, scale * abs(other) ** 2
    if not known.any():
        raise ValueError("these gauges cannot tell incident from reflected waves at any frequency of the sea")
    edges = np.linspace(0.5, 3, bands + 1) / peak_period
    band = np.digitize(frequency, edges) - 1
    mean = lambda values, which: np.array([values[which & (band == b)].mean() if (which & (band == b)).any() else np.nan
                                           for b in range(bands)])
    energy = [np.sum(values[known]) for values in (forth, back)]
    spectra = [mean(values, known) for values in (forth, back)]
    height = 4 * np.sqrt(np.nansum(spectra[0]) * (edges[1] - edges[0]))
    return Irregular(0.5 * (edges[1:] + edges[:-1]), *spectra, ~np.isnan(spectra[0]), height,
                     float(np.sqrt(energy[1] / energy[0])))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=Path)
    parser.add_argument("gauges", nargs="+", metavar="NAME=PLACE", help="a gauge of water_level and where it stands [m]")
    parser.add_argument("--depth", type=float, required=True, help="[m]")
    parser.add_argument("--period", type=float, required=True, help="of the wave, or of the peak of the spectrum [s]")
    parser.add_argument("--length", type=float, help="of a regular wave [m], if it is not linear")
    parser.add_argument("--from", dest="start", type=float, default=0.0, help="[s]")
    parser.add_argument("--irregular", action="store_true")
    arguments = parser.parse_args()
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
    from mudlark.results import Results
    results = Results(arguments.results)
    names, places = zip(*(text.rsplit("=", 1) for text in arguments.gauges))
    if len(names) < 3:
        sys.exit("Three gauges or more are needed.")
    gauges = [results.gauge(name) for name in names]
    late = gauges[0].time >= arguments.start - 1e-9
    levels = [next(iter(gauge.columns.values()))[late] for gauge in gauges]
    time, places = gauges[0].time[late], [float(place) for place in places]
    if arguments.irregular:
        found = irregular(time, levels, places, arguments.depth, arguments.period)
        print(f"incident H_m0 {found.incident_height:.4g} m, reflected {100 * found.coefficient:.1f} %")
    else:
        found = regular(time, levels, places, arguments.period, arguments.depth, arguments.length)
        print(f"incident amplitude {found.incident:.4g} m, reflected {100 * found.coefficient:.1f} %, "
              f"misfit {100 * found.misfit:.1f} %")


if __name__ == "__main__":
    main()
