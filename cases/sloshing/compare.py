#!/usr/bin/python3
"""Checks that violently sloshing water keeps its volume and its senses over ten thousand steps.

    python3 cases/sloshing/compare.py [--results results] [--picture FILE.png]

Asked for: the run ended, at least 10 000 steps, volume to 1e-12, every gauge finite, the lid was hit; exits with 1
otherwise.
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

STEPS, TOLERANCE, LID = 10000, 1e-12, 0.6


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("sloshing.png"))
    arguments = parser.parse_args()
    results = Results(arguments.results / "sloshing")
    summary = results.summary
    water = results.gauge("total water")["water volume"]
    drift = np.abs(water / water[0] - 1).max()
    level, energy, speed = (results.gauge(name) for name in ("wall", "energy", "speed"))
    finite = all(np.isfinite(column).all() for gauge in (level, energy, speed) for column in gauge.columns.values())
    highest = level["water level"].max()
    print(f"{summary['steps']} steps, {summary['status']}; volume to {drift:.1e}; fastest water "
          f"{speed['largest speed'].max():.1f} m/s; highest level at the wall {highest:.3f} m (lid at {LID:g} m)")
    figure, panels = plt.subplots(2, 1, figsize=(9, 5), sharex=True, constrained_layout=True)
    panels[0].plot(level.time, level["water level"], lw=0.7)
    panels[0].set(ylabel="level at the wall [m]")
    panels[1].plot(energy.time, energy["kinetic energy"], lw=0.7)
    panels[1].set(ylabel="kinetic energy [J]", xlabel="time [s]")
    figure.savefig(arguments.picture, dpi=90)
    print(f"picture: {arguments.picture}")
    good = (summary["status"] == "done" and summary["steps"] >= STEPS and drift <= TOLERANCE and finite
            and highest > 0.95 * LID)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
