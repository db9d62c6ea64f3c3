#!/usr/bin/python3
"""Compares the dam break with the experiment of Martin & Moyce (1952): draws front and height against time, prints
the differences.

    python3 cases/dam_break/compare.py [--results results] [--picture FILE.png] [--data FILE.csv]

The measured front is read from FILE.csv (columns T = t sqrt(2 g / a), Z = front / a), by default from the validation
data that lie beside a checkout; without it only the computed curves are drawn. Tolerance: 5 % of the front after
Z > 1.5, the experiment taken 0.1 in T late for its gate; exits with 1 when a point is beyond it.
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
GATE_DELAY = 0.1    # in T: the water is slower than the gate's opening suggests
TOLERANCE = 0.05
DATA = ROOT.parent / "shared/validation/data/martin_moyce1952_front_n2_2_a2.25in.csv"


def measured_front(path):
    """Rows (T, Z) of the experiment, or None when the file is not there."""
    if not path.exists():
        return None
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return np.array([[float(value) for value in line.split(",")[:2]] for line in lines[1:]])


def compare_front(time, front, measured):
    """Prints the differences point by point; returns the largest after Z > 1.5."""
    worst = 0.0
    for when, where in measured:
        if when > time[-1]:
            continue
        early = np.interp(when, time, front) / where - 1
        late = np.interp(when - GATE_DELAY, time, front) / where - 1
        print(f"  T = {when:5.2f}: measured Z = {where:6.3f}, computed {100 * early:+5.1f} %, "
              f"with the gate's delay {100 * late:+5.1f} %")
        if where > 1.5:
            worst = max(worst, abs(late))
    return worst


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
    worst = 0.0
    if measured is None:
        print(f"  not compared: {arguments.data.name} is not there")
    else:
        worst = compare_front(time, position, measured)
        print(f"  largest difference after Z > 1.5: {100 * worst:.1f} %  (tolerance {100 * TOLERANCE:g} %)")
    draw(time, position, measured, (height.time, levels), arguments.picture)
    return 1 if worst > TOLERANCE else 0


if __name__ == "__main__":
    sys.exit(main())
