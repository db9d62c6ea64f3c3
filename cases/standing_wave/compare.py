#!/usr/bin/python3
"""Compares a standing wave with linear theory: period and decay.

    mudlark run cases/standing_wave/standing.toml
    /usr/bin/python3 cases/standing_wave/compare.py [--results results] [--picture FILE.png]

Tolerances: 0.5 % of the period, 1 % of the height lost (or won) per period, volume to 1e-12; exits with 1 beyond.
"""
import argparse
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
if not (ROOT / "python/mudlark").is_dir():
    sys.exit("compare.py needs Mudlark's Python package: run it where it lies, in cases/ of Mudlark's source tree.")
sys.path.insert(0, str(ROOT / "python"))

import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from mudlark.results import Results  # noqa: E402
from scipy.optimize import curve_fit  # noqa: E402

DEPTH, LENGTH, AMPLITUDE = 0.5, 1.0, 0.01
PERIOD = 2 * np.pi / np.sqrt(9.81 * np.pi / LENGTH * np.tanh(np.pi * DEPTH / LENGTH))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("standing_wave.png"))
    arguments = parser.parse_args()
    results = Results(arguments.results / "standing")
    gauge = results.gauge("level at the wall")
    level = next(iter(gauge.columns.values())) - DEPTH
    swing = lambda t, a, decay, w, phase, mean: a * np.exp(-decay * t) * np.cos(w * t + phase) + mean
    fit = curve_fit(swing, gauge.time, level, p0=[AMPLITUDE, 0.0, 2 * np.pi / PERIOD, 0.0, 0.0])[0]
    period, loss = 2 * np.pi / fit[2], 1 - np.exp(-fit[1] * PERIOD)
    water = results.summary["conservation errors"]["water"]
    print(f"period {period:.5f} s, exact {PERIOD:.5f} s: {100 * (period / PERIOD - 1):+.2f} % (tolerance 0.5 %)")
    print(f"height lost per period {100 * loss:+.2f} % (tolerance 1 %)")
    print(f"volume error {water:.1e} (tolerance 1e-12)")
    figure, axis = plt.subplots(figsize=(9, 3.5), constrained_layout=True)
    axis.plot(gauge.time, 1e3 * level, lw=1, label="measured at the wall")
    axis.plot(gauge.time, 1e3 * AMPLITUDE * np.cos(2 * np.pi * gauge.time / PERIOD), "k--", lw=0.7, label="linear theory")
    axis.set(xlabel="time [s]", ylabel="level [mm]", title="Standing wave, 40 cells over the length of the box")
    axis.legend(loc="upper right")
    figure.savefig(arguments.picture, dpi=90)
    print(f"picture: {arguments.picture}")
    return 0 if abs(period / PERIOD - 1) <= 0.005 and abs(loss) <= 0.01 and water <= 1e-12 else 1


if __name__ == "__main__":
    sys.exit(main())
