#!/usr/bin/python3
"""Compares the dam break with the experiment of Martin & Moyce (1952): draws front and height against time, prints
the differences.

    python3 cases/dam_break/compare.py [--results results] [--picture FILE.png] [--data FILE.csv]

The measured front is read from FILE.csv (columns T = t sqrt(2 g / a), Z = front / a), by default from the validation
data that lie beside a checkout; without it only the computed curves are drawn. When the water was released is not
known in an experiment whose diaphragm takes time to open, so one lag in T is fitted to all points with Z > 1.5.
Tolerances: a lag of at most 0.3 (16 ms), and then 5 % of Z on the root mean square; exits with 1 beyond.
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

WIDTH = 0.05715     # a [m]
GRAVITY = 9.81      # [m/s2]
LARGEST_LAG = 0.3   # in T
TOLERANCE = 0.05
DATA = ROOT.parent / "shared/validation/data/martin_moyce1952_front_n2_2_a2.25in.csv"


def measured_front(path):
    """Rows (T, Z) of the experiment, or None when the file is not there."""
    if not path.exists():
        return None
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return np.array([[float(value) for value in line.split(",")[:2]] for line in lines[1:]])


def fitted_lag(time, front, measured):
    """Lag in T of the experiment that brings the computed front nearest, least squares of Z / Z_measured - 1."""
    lags = np.linspace(0.0, 0.6, 601)
    errors = [np.sum((np.interp(measured[:, 0] - lag, time, front) / measured[:, 1] - 1) ** 2) for lag in lags]
    return lags[int(np.argmin(errors))]


def compare_front(time, front, measured):
    """Prints the differences point by point; returns the lag and the root mean square after it."""
    measured = measured[(measured[:, 0] <= time[-1]) & (measured[:, 1] > 1.5)]
    lag = fitted_lag(time, front, measured)
    for when, where in measured:
        lead = when - np.interp(where, front, time)
        late = np.interp(when - lag, time, front) / where - 1
        print(f"  T = {when:5.2f}: measured Z = {where:6.3f}, computed {lead:.2f} earlier, with the lag {100 * late:+5.1f} %")
    differences = np.interp(measured[:, 0] - lag, time, front) / measured[:, 1] - 1
    return lag, np.sqrt(np.mean(differences**2))


def draw(time, front, measured, height, picture):
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.2))
    left.plot(time, front, color="tab:blue", label="computed")
    if measured is not None:
        left.plot(measured[:, 0], measured[:, 1], "o", color="black", label="Martin & Moyce (1952)")
    left.set(xlabel="T = t sqrt(2 g / a)", ylabel="front Z = x / a", xlim=(0, time[-1]))
    left.legend()
    right.plot(height[0] * np.sqrt(GRAVITY / WIDTH), height[1] / (2 * WIDTH), color="tab:blue")
    right.set(xlabel="t sqrt(g / a)", ylabel="height at the wall / (2 a)")
    figure.tight_layout()
    figure.savefig(picture, dpi=100)
    print(f"picture: {picture}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("dam_break.png"))
    parser.add_argument("--data", type=Path, default=DATA)
    arguments = parser.parse_args()
    results = Results(arguments.results / "martin_moyce")
    front, height = results.gauge("front"), results.gauge("height")
    time = front.time * np.sqrt(2 * GRAVITY / WIDTH)
    position = next(iter(front.columns.values())) / WIDTH
    levels = next(iter(height.columns.values()))
    measured = measured_front(arguments.data)
    print("Martin & Moyce (1952), n^2 = 2, a = 0.05715 m: front along the floor")
    good = True
    if measured is None:
        print(f"  not compared: {arguments.data.name} is not there")
    else:
        lag, spread = compare_front(time, position, measured)
        good = lag <= LARGEST_LAG and spread <= TOLERANCE
        print(f"  fitted lag of the experiment: {lag:.2f} in T, {lag * np.sqrt(WIDTH / 2 / GRAVITY) * 1e3:.0f} ms "
              f"(at most {LARGEST_LAG:g})")
        print(f"  root mean square with it: {100 * spread:.1f} % of Z (tolerance {100 * TOLERANCE:g} %)")
    draw(time, position, measured, (height.time, levels), arguments.picture)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
