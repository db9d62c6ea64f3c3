#!/usr/bin/env python3
"""Compares the collapsed columns with experiments: draws the deposits and the scaling of run-out with aspect ratio,
prints the errors, and exits with 1 when one is beyond its tolerance.

    python3 cases/granular_collapse/compare.py [FOLDER ...] [--results results] [--picture FILE.png]

Without folders it takes every results folder of these cases under --results; what is missing is said, not counted
as a failure. Tolerance: 10 % of run-out and of height.
"""
import argparse
import sys
import tomllib
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

PACKAGE = Path(__file__).resolve().parents[2] / "python"
if not (PACKAGE / "mudlark").is_dir():
    sys.exit("compare.py needs Mudlark's Python package: run it where it lies, in cases/ of Mudlark's source tree.")
sys.path.insert(0, str(PACKAGE))
from mudlark.results import Results

TOLERANCE = 0.10
THICK = 0.002         # the deposit ends where it is thinner than two grains [m]: what lies beyond is scattered
BIN = 0.01            # [m]
BARS_FRONT = 0.43     # [m] from the wall, read off as 0.42-0.44 (Bui et al. 2008)


def run_out_law(aspect, round_column):
    """(d - d0)/d0, Lube et al.: of cylinders (2004), of planar columns (2005); None between the branches of the
    latter, where sources differ."""
    if round_column:
        return 1.24 * aspect if aspect < 1.7 else 1.6 * aspect**0.5
    return 1.2 * aspect if aspect < 1.5 else 1.9 * aspect ** (2 / 3) if aspect > 4 else None


def height_law(aspect, round_column):
    """h/d0 at the wall or the axis, Lube et al. (2004, 2005)."""
    if round_column:
        return min(aspect, 0.88 * max(aspect, 1.7) ** (1 / 6))
    return aspect if aspect < 1.15 else 0.65 * aspect**0.4


class Run:
    def __init__(self, folder):
        self.name = Path(folder).name
        self.results = Results(folder)
        case = tomllib.loads((Path(folder) / "case.toml").read_text())
        shape = case["soil"][0]["shape"]
        self.round = "polygon" in shape
        if self.round:
            self.width, self.height = max(corner[0] for corner in shape["polygon"]["corners"]), shape["polygon"]["top"]
        else:
            self.width, self.height = shape["box"]["upper"]
        self.bars = case["soil"][0]["name"] == "bars"
        self.law = case["soil"][0]["law"]["type"]
        self.aspect = self.height / self.width
        self.status = self.results.summary.get("status", "unknown")

    def deposit(self, time):
        """Places and thickness [m] of the deposit, from the points' volumes."""
        points = self.results.points(time)
        x, y = points["position"][:, 0], points["position"][:, 1]
        place = np.hypot(x, y) if self.round else x
        edges = np.arange(0, place.max() + 2 * BIN, BIN)
        volume, _ = np.histogram(place, edges, weights=points["volume"])
        area = 0.25 * np.pi * np.diff(edges**2) if self.round else BIN
        return 0.5 * (edges[1:] + edges[:-1]), volume / area

    def front(self, time):
        """Where the deposit first gets thinner than THICK [m]."""
        place, thickness = self.deposit(time)
        first = int(np.argmax(thickness < THICK))
        return float(np.interp(-THICK, -thickness[first - 1:first + 1], place[first - 1:first + 1]))

    def top(self, time):
        """Highest point within the cells beside the wall [m]; points stand for what is around them."""
        points = self.results.points(time)
        position = points["position"]
        beside = position[np.hypot(position[:, 0], position[:, 1]) < 2 * BIN]
        start = points["initial position"]
        return float(beside[:, 2].max() + self.height - start[:, 2].max())


class Findings:
    def __init__(self):
        self.misses = 0

    def gate(self, text, error):
        missed = not abs(error) < TOLERANCE
        self.misses += missed
        print(f"  {text}: {100 * error:+.1f} %  (tolerance {100 * TOLERANCE:g} %){'  MISSED' if missed else ''}")

    def ended(self, run):
        print(f"{run.name} (law {run.law}, aspect ratio {run.aspect:g})")
        if run.status != "done":
            self.misses += 1
            print(f"  the run is not complete: {run.status}  MISSED")
        return run.status == "done"


def judge(run, findings):
    if not findings.ended(run):
        return
    last = run.results.point_times[-1]
    front, top = run.front(last), run.top(last)
    if run.bars:
        print(f"  front at {front:.3f} m, experiment about {BARS_FRONT} m; top at the wall {top:.3f} m of {run.height:g} m")
        findings.gate("front", front / BARS_FRONT - 1)
        findings.gate("height at the wall, which stays", top / run.height - 1)
        return
    run.run_out = front / run.width - 1
    print(f"  run-out (d - d0)/d0 = {run.run_out:.2f}, height h/d0 = {top / run.width:.2f}")
    law = run_out_law(run.aspect, run.round)
    if law:
        findings.gate(f"run-out against {law:.2f}", run.run_out / law - 1)
    law = height_law(run.aspect, run.round)
    findings.gate(f"height against {law:.2f}", top / run.width / law - 1)


def draw(runs, picture):
    figure, (left, right) = plt.subplots(1, 2, figsize=(12, 4.2), layout="constrained")
    for run in runs:
        if run.bars:
            for time in (0.1, 0.2, 0.3, run.results.point_times[-1]):
                place, thickness = run.deposit(time)
                left.plot(place, thickness, label=f"{time:g} s")
            left.plot([0, 0.2, 0.2], [0.1, 0.1, 0], color="0.6", lw=0.8, ls=":")
            left.axvspan(0.42, 0.44, color="0.9", label="experiment's front")
        elif hasattr(run, "run_out"):
            right.loglog(run.aspect, run.run_out, "s" if run.round else "o", color="#5b8c3a" if run.round else "#c0562f")
    left.set(xlabel="x [m]", ylabel="thickness [m]", title="Bars of aluminium", xlim=0, ylim=0)
    left.legend(frameon=False, fontsize=8)
    low, high = np.linspace(0.4, 1.5), np.linspace(4, 8)
    right.loglog(low, 1.2 * low, color="black", lw=1.2, label="Lube et al. (2005): 1.2 a, 1.9 a$^{2/3}$")
    right.loglog(high, 1.9 * high ** (2 / 3), color="black", lw=1.2)
    right.loglog(low, 1.24 * low, color="#5b8c3a", lw=1.0, ls="--", label="cylinders, Lube et al. (2004): 1.24 a")
    right.plot([], [], "o", color="#c0562f", label="computed, planar")
    right.plot([], [], "s", color="#5b8c3a", label="computed, cylinder")
    right.set(xlabel="aspect ratio a = h0/d0", ylabel="(d - d0)/d0", title="Run-out of columns of sand")
    right.legend(frameon=False)
    for axis in (left, right):
        axis.grid(color="0.92", lw=0.6, which="both")
        axis.spines[["top", "right"]].set_visible(False)
    picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(picture, dpi=150)
    print(f"picture: {picture}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="*", type=Path)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=None)
    arguments = parser.parse_args()
    folders = arguments.folders or sorted(
        case.parent for case in arguments.results.glob("*/case.toml") if "Collapse of a" in case.read_text().split("\n")[0])
    runs = sorted((Run(folder) for folder in folders), key=lambda run: (not run.bars, run.aspect))
    if not runs:
        print(f"nothing to compare: there are no results of these cases in {arguments.results}")
        return 1
    findings = Findings()
    for run in runs:
        judge(run, findings)
    draw(runs, arguments.picture or (folders[0].parent if arguments.folders else arguments.results) / "granular_collapse.png")
    print("every number is within its tolerance" if not findings.misses else f"{findings.misses} numbers are beyond their tolerance")
    return 1 if findings.misses else 0


if __name__ == "__main__":
    sys.exit(main())
