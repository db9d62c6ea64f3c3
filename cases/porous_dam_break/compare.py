#!/usr/bin/python3
"""Compares the water's surface in and around a block of crushed rock with the experiment of Liu et al. (1999).

    python3 cases/porous_dam_break/compare.py [--results results] [--picture FILE.png] [--data FOLDER]

The measured surfaces (x, eta) are read from FOLDER/liu1999_cr35_tN.csv, by default from the validation data that lie
beside a checkout; without them only the computed ones are drawn. Tolerance: 15 mm root mean square at every of the
five times; exits with 1 beyond.
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

TIMES = ("0.35", "0.75", "1.15", "1.55", "1.95")  # [s]
BLOCK = (0.30, 0.59, 0.37)  # [m] from, to, height
TOLERANCE = 0.015  # [m]
DATA = ROOT.parent / "shared/validation/data"


def measured(folder, time):
    """Columns x, eta of one time, or None when the file is not there."""
    path = folder / f"liu1999_cr35_t{time}.csv"
    if not path.exists():
        return None
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return np.array([[float(value) for value in line.split(",")] for line in lines[1:]])


def surface(results, time):
    """Height of the topmost surface in every column of cells [m]."""
    state = results.field("saturation", time=time)
    h, alpha = state.spacing[1], np.clip(state.values, 0.0, 1.0)
    heights = np.zeros(alpha.shape[1])
    for column in range(alpha.shape[1]):
        wet = np.flatnonzero(alpha[:, column] >= 0.5)
        if wet.size:
            top = wet[-1]
            beyond = alpha[top + 1, column] if top + 1 < alpha.shape[0] else 0.0
            heights[column] = (top + alpha[top, column] + beyond) * h
    return state.centres(0), heights


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("porous_dam_break.png"))
    parser.add_argument("--data", type=Path, default=DATA)
    arguments = parser.parse_args()
    results = Results(arguments.results / "crushed_rock")
    figure, panels = plt.subplots(len(TIMES), 1, figsize=(7, 11), sharex=True, constrained_layout=True)
    good, all_errors = True, []
    print("Liu et al. (1999), crushed rock, water 0.35 m deep: surface against measured")
    for panel, time in zip(panels, TIMES):
        x, heights = surface(results, float(time))
        panel.axvspan(BLOCK[0], BLOCK[1], ymax=BLOCK[2] / 0.4, color="0.9")
        panel.plot(x, heights, color="tab:blue", label="computed")
        panel.set(title=f"t = {time} s", ylabel="z [m]", ylim=(0, 0.4))
        points = measured(arguments.data, time)
        if points is None:
            print(f"  t = {time} s: not compared, the measurements are not there")
            continue
        panel.plot(points[:, 0], points[:, 1], "o", ms=3, color="black", label="Liu et al. (1999)")
        points = points[points[:, 0] <= x[-1]]
        errors = np.interp(points[:, 0], x, heights) - points[:, 1]
        all_errors.append(errors)
        error = np.sqrt(np.mean(errors**2))
        good &= error <= TOLERANCE
        print(f"  t = {time} s: root mean square {1e3 * error:.1f} mm, mean {1e3 * errors.mean():+.1f} mm, "
              f"largest {1e3 * np.abs(errors).max():.1f} mm (tolerance {1e3 * TOLERANCE:g} mm)")
    if all_errors:
        print(f"  all times: {1e3 * np.sqrt(np.mean(np.concatenate(all_errors)**2)):.1f} mm")
    panels[0].legend()
    panels[-1].set_xlabel("x [m]")
    figure.savefig(arguments.picture, dpi=90)
    print(f"picture: {arguments.picture}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
