#!/usr/bin/python3
"""Compares the flow through a permeameter with Forchheimer's law in closed form: start and steady discharge under a
constant gradient, discharge under a falling head.

    python3 cases/permeameter/compare.py [--results results] [--picture FILE.png]

Tolerances: 0.5 % of the steady discharge and of that under the falling head (after the start), 1 % of the steady
discharge at all times of the start; exits with 1 beyond.
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

POROSITY, VISCOSITY, GRAVITY = 0.45, 1e-6, 9.81
WIDTH = 0.04  # [m] of both models
GRADIENT, COARSE = 0.1, 0.02  # start_up; grain [m]
LENGTH, FINE = 0.5, 0.005  # [m] of the gravel, its grain, falling_head
C = (1 + 0.34 * (1 - POROSITY) / POROSITY) / (POROSITY * GRAVITY)  # [s2/m]
TOLERANCES = {"steady": 0.005, "start": 0.01, "falling": 0.005}


def coefficients(grain):
    """a [s/m], b [s2/m2] of I = a w + b w^2, van Gent (1995)."""
    return (1000 * (1 - POROSITY) ** 2 / POROSITY**3 * VISCOSITY / (GRAVITY * grain**2),
            1.1 * (1 - POROSITY) / POROSITY**3 / (GRAVITY * grain))


def steady(gradient, grain):
    a, b = coefficients(grain)
    return 2 * gradient / (a + np.sqrt(a**2 + 4 * b * gradient))


def starting(time):
    a, b = coefficients(COARSE)
    root = np.sqrt(a**2 + 4 * b * GRADIENT)
    decay = np.exp(-root * time / C)
    return steady(GRADIENT, COARSE) * (1 - decay) / (1 + 4 * b * GRADIENT / (a + root) ** 2 * decay)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("permeameter.png"))
    arguments = parser.parse_args()
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.2), constrained_layout=True)

    gauge = Results(arguments.results / "start_up").gauge("discharge")
    time, computed = gauge.time, gauge["discharge"] / WIDTH
    exact = starting(time)
    start = np.abs(computed - exact).max() / steady(GRADIENT, COARSE)
    end = computed[-1] / steady(GRADIENT, COARSE) - 1
    print(f"start under I = {GRADIENT:g}: at most {100 * start:.2f} % of the steady discharge from the closed form")
    print(f"  steady: {1e3 * computed[-1]:.3f} mm/s, exact {1e3 * steady(GRADIENT, COARSE):.3f} mm/s, {100 * end:+.3f} %")
    left.plot(time, 1e3 * exact, color="black", label="closed form")
    left.plot(time[::4], 1e3 * computed[::4], "o", ms=3, color="tab:blue", label="computed")
    left.set(xlabel="time [s]", ylabel="discharge [mm/s]", title=f"start, I = {GRADIENT:g}")
    left.legend()

    results = Results(arguments.results / "falling_head")
    level, discharge = results.gauge("level"), results.gauge("discharge")
    height, computed = level["water level"], discharge["discharge"] / WIDTH
    above = (height > LENGTH + 0.02) & (level.time > 0.2)
    within = (height < LENGTH - 0.02) & (height > 0.27)
    law = steady(np.maximum(height, LENGTH) / LENGTH, FINE)
    falling = np.abs(computed / law - 1)[above].max()
    draining = np.abs(computed / steady(1.0, FINE) - 1)[within].max()
    linear, quadratic = coefficients(FINE)
    first = steady(height[0] / LENGTH, FINE)
    last = steady(height[above][-1] / LENGTH, FINE)
    exact_time = LENGTH * (linear * np.log(first / last) + 2 * quadratic * (first - last))
    lag = level.time[above][-1] - exact_time
    print(f"falling head over the gravel: at most {100 * falling:.2f} % from w(h); h = {height[above][-1]:.3f} m is "
          f"reached {1e3 * lag:+.0f} ms after the quasi-steady time ({exact_time:.3f} s)")
    print(f"  level in the gravel: at most {100 * draining:.2f} % from w(1) = {1e3 * steady(1.0, FINE):.2f} mm/s")
    right.plot(height[above], 1e3 * law[above], color="black", label="Forchheimer")
    right.plot(height[within], 1e3 * law[within], color="black")
    right.plot(height, 1e3 * computed, ".", ms=3, color="tab:blue", label="computed")
    right.axvspan(0, LENGTH, color="0.92")
    right.set(xlabel="level over the outlet [m]", ylabel="discharge [mm/s]", title="falling head", xlim=(0.25, 1.15))
    right.legend()
    figure.savefig(arguments.picture, dpi=90)
    print(f"picture: {arguments.picture}")
    good = (abs(end) <= TOLERANCES["steady"] and start <= TOLERANCES["start"]
            and max(falling, draining) <= TOLERANCES["falling"])
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
