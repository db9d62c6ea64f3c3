#!/usr/bin/python3
"""Compares excavation with theory: an elastic column that is loaded, dug and filled, and a vertical cut in clay.

    mudlark run cases/excavation/heave.toml -o results/heave
    mudlark run cases/excavation/cut.toml -o results/cut
    mudlark run cases/excavation/cut.toml -o results/cut_weak --set soil.law.undrained_strength=15e3
    mudlark strength-reduction cases/excavation/cut.toml -o results/cut_safety --lower 1 --upper 1.6 \\
        --largest-displacement 0.05
    python3 cases/excavation/compare.py [--run PROGRAM] [--results results] [--picture FILE.png]

With --run PROGRAM the four commands above are run first. Exits with 1 when a number misses its tolerance.
"""
import argparse
import csv
import json
import subprocess
import sys
from pathlib import Path

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = Path(__file__).resolve().parent
UNIT_WEIGHT = (1 - 0.4) * 2650 * 9.81                          # [N/m3]
MODULUS = 20e6 * (1 - 0.3) / ((1 + 0.3) * (1 - 2 * 0.3))       # E_c [Pa]
LOAD, FORMATION, DUG = 50e3, 6.0, 4.0                          # [Pa], [m], [m]
STABILITY = 3.776                                              # gamma H/s_u of a vertical cut at failure
HEAVE_TOLERANCE, SAFETY_TOLERANCE = 0.01, 0.10


def gauge(folder, name):
    with open(folder / "gauges" / f"{name}.csv") as file:
        rows = list(csv.reader(file))[1:]
    return np.array(rows, dtype=float)


def column_states():
    """Settlement of the formation level at the end of each stage [m]: q z/E_c, and heave gamma d z/E_c."""
    loaded, heave = LOAD * FORMATION / MODULUS, UNIT_WEIGHT * DUG * FORMATION / MODULUS
    return {"weight": 0.0, "load": loaded, "relief": 0.0, "dig": -heave, "fill": 0.0}


def compare_column(folder, axes):
    history, misses = gauge(folder, "formation"), 0
    stages = json.loads((folder / "summary.json").read_text())["stages"]
    scale = UNIT_WEIGHT * DUG * FORMATION / MODULUS
    print("column: settlement of the formation level, 6 m above the base")
    for stage in stages:
        exact = column_states()[stage["name"]]
        found = history[history[:, 0] <= stage["ended [s]"] * (1 + 1e-12)][-1, 1]
        miss = abs(found - exact) > HEAVE_TOLERANCE * scale
        misses += miss
        print(f"  {stage['name']:7s} {1000 * found:8.3f} mm, exact {1000 * exact:8.3f} mm"
              f"{'  MISSED' if miss else ''}")
        axes.plot([stage["began [s]"], stage["ended [s]"]], [1000 * exact] * 2, color="0.7", lw=4)
        axes.text(stage["began [s]"] + 0.3, (1.05 if stage["name"] == "weight" else 0.9) * 1000 * scale,
                  stage["name"], fontsize=8)
    axes.plot(history[:, 0], 1000 * history[:, 1], "tab:blue")
    axes.set(xlabel="time [s]", ylabel="settlement [mm]", title="column: load, dig, fill (grey: exact)")
    return misses


def draw_cut(folder, axes, title):
    with h5py.File(folder / "points.h5") as file:
        last = file[sorted(key for key in file if key.isdigit())[-1]]
        place, moved = np.array(last["position"]), np.array(last["displacement"])
    size = np.hypot(moved[:, 0], moved[:, 2])
    dots = axes.scatter(place[:, 0], place[:, 2], c=1000 * size, s=1.5, cmap="viridis")
    axes.figure.colorbar(dots, ax=axes, label="displacement [mm]", shrink=0.6)
    axes.set(title=title, aspect="equal", xlim=(0, 12), ylim=(0, 8.2))


def compare_cut(results, axes):
    misses = 0
    for name, strength, should_stand in (("cut", 20e3, True), ("cut_weak", 15e3, False)):
        folder = results / name
        last = json.loads((folder / "summary.json").read_text())["stages"][-1]
        stands = last["name"] == "second lift" and last["at rest [s]"] is not None
        crest = gauge(folder, "crest")[-1]
        number = UNIT_WEIGHT * 4 / strength
        miss = stands != should_stand
        misses += miss
        print(f"cut, gamma H/s_u = {number:.2f}: {'stands' if stands else 'does not stand'}, crest moved "
              f"{1000 * np.hypot(crest[1], crest[2]):.1f} mm (theory: {'stands' if should_stand else 'fails'} "
              f"at {STABILITY}){'  MISSED' if miss else ''}")
        draw_cut(folder, axes[0 if name == "cut" else 1], f"gamma H/s_u = {number:.2f}")
    found = json.loads((results / "cut_safety" / "strength_reduction.json").read_text())
    factor, exact = found["factor of safety"], STABILITY * 20e3 / (UNIT_WEIGHT * 4)
    miss = factor is None or abs(factor / exact - 1) > SAFETY_TOLERANCE
    print(f"cut: factor of safety {factor:.3f} (stands at {found['stands at']:.3f}, fails at {found['fails at']:.3f}), "
          f"theory {exact:.3f}: {100 * (factor / exact - 1):+.1f} % (tolerance {100 * SAFETY_TOLERANCE:g} %)"
          f"{'  MISSED' if miss else ''}")
    return misses + miss


def run(program, results):
    runs = [("run", "heave", "heave", []), ("run", "cut", "cut", []),
            ("run", "cut", "cut_weak", ["--set", "soil.law.undrained_strength=15e3"]),
            ("strength-reduction", "cut", "cut_safety",
             ["--lower", "1", "--upper", "1.6", "--largest-displacement", "0.05"])]
    for command, case, into, more in runs:
        quiet = ["--quiet"] if command == "run" else []
        subprocess.run([program, command, HERE / f"{case}.toml", "-o", results / into, *quiet, *more],
                       check=True, stdout=subprocess.DEVNULL)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--run", metavar="PROGRAM")
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("excavation.png"))
    arguments = parser.parse_args()
    if arguments.run:
        run(arguments.run, arguments.results)
    if not (arguments.results / "heave" / "summary.json").exists():
        sys.exit(f"{arguments.results / 'heave'} is not there: run the commands at the head of this file first")
    figure, axes = plt.subplots(1, 3, figsize=(14, 3.8))
    misses = compare_column(arguments.results / "heave", axes[0])
    misses += compare_cut(arguments.results, axes[1:])
    figure.tight_layout()
    figure.savefig(arguments.picture, dpi=100)
    print(f"picture: {arguments.picture}")
    print("all within their tolerances" if misses == 0 else f"{misses} numbers are beyond their tolerance")
    return 0 if misses == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
