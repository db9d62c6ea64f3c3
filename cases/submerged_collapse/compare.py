#!/usr/bin/python3
"""Submerged columns of glass beads, loose and dense (Rondon, Pouliquen & Aussillous 2011); prints the findings and draws them.

    /usr/bin/python3 cases/submerged_collapse/compare.py --run build/release/bin/mudlark
                                                         [--results results/submerged_collapse] [--picture FILE.png]

- Pressure of the liquid at the bottom, 2 cm from the wall, above that of liquid at rest, mean over the first half second:
  positive where the beads are loose, negative where they are dense.
- Run-out of the loose column over that of the dense one: 1.6 to 2.5 ("about twice"). Run-out: x of 99.5 % of the beads
  over the column's width, less 1, at the end of each run. The dense column is still creeping then, so its run-out over
  the loose one's of the same time, and how much it grew in the last fifth of the run, are printed as well.
- Water and grains are kept to 1e-12.

Exits with 1 when a tolerance is missed.
"""
import argparse
import json
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

CASE = Path(__file__).resolve().parent
PACKAGE = CASE.parents[1] / "python"
if not (PACKAGE / "mudlark").is_dir():
    sys.exit("compare.py needs Mudlark's Python package: run it where it lies, in cases/ of Mudlark's source tree.")
sys.path.insert(0, str(PACKAGE))
from mudlark import drawing  # noqa: E402
from mudlark.results import Results  # noqa: E402

WIDTH, LEVEL, WEIGHT = 0.06, 0.078, 1010 * 9.81     # of the column [m]; of the liquid [m], [N/m3]
COLUMNS = ("loose", "dense")


def run_all(program, results):
    for name in COLUMNS:
        subprocess.run([program, "run", str(CASE / f"{name}.toml"), "-o", str(results / name), "--quiet"], check=True)


def excess(points):
    return points["pore pressure"] - WEIGHT * (LEVEL - points["position"][:, 2])


def bottom_pressure(points):
    """Excess pressure [Pa] at the bottom, 2 cm from the wall."""
    x = points["position"]
    there = (np.abs(x[:, 0] - 0.02) < 0.004) & (x[:, 2] < 0.004)
    return excess(points)[there].mean()


def run_out(points):
    return np.quantile(points["position"][:, 0], 0.995) / WIDTH - 1.0


def check(findings, text, value, good, tolerance):
    print(f"{text:<58}{value:10.3g}  ({tolerance}){'' if good else '  MISS'}")
    findings.append(good)


def draw_motion(run_, times, axes):
    largest = max(np.abs(excess(run_.points(times[0]))).max(), 1.0)
    for axis, time in zip(axes, times):
        points = run_.points(time)
        drawing.draw_water(axis, run_, points.time)
        shown = axis.scatter(points["position"][:, 0], points["position"][:, 2], c=excess(points), s=0.8,
                             cmap="coolwarm", vmin=-largest, vmax=largest)
        axis.set_title(f"{points.time:.2g} s", fontsize=8, loc="left")
    return shown


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--run", metavar="PROGRAM", help="run the cases with this program first")
    parser.add_argument("--results", type=Path, default=Path("results/submerged_collapse"))
    parser.add_argument("--picture", type=Path, default=Path("submerged_collapse.png"))
    arguments = parser.parse_args()
    if arguments.run:
        run_all(arguments.run, arguments.results)
    findings, out = [], {}
    figure, axes = plt.subplot_mosaic([["a", "b", "p"], ["c", "d", "p"], ["e", "f", "r"], ["g", "h", "r"]],
                                      figsize=(13, 6.4), width_ratios=(1.5, 1.5, 1), layout="constrained")
    for name, letters, colour in zip(COLUMNS, ("aceg", "bdfh"), ("C3", "C0")):
        run_ = Results(arguments.results / name)
        times = [t for t in run_.point_times if t > 0.0]
        pressure = [bottom_pressure(run_.points(t)) for t in times]
        axes["p"].plot(times, pressure, colour, label=name)
        axes["r"].plot(times, [run_out(run_.points(t)) for t in times], colour, label=name)
        out[name] = run_out(run_.points(times[-1]))
        sign = 1.0 if name == "loose" else -1.0
        first = np.mean([p for t, p in zip(times, pressure) if t < 0.55])
        check(findings, f"{name}: excess pressure at the bottom, first 0.5 s [Pa]", first, sign * first > 0.0,
              "positive" if sign > 0 else "negative")
        print(f"{name}: {pressure[0]:.2g} Pa after {times[0]:.2g} s, farthest from 0 {max(pressure, key=abs):.3g} Pa")
        print(f"{name}: run-out after {times[-1]:.3g} s {out[name]:.3g}, in the last fifth of the time "
              f"{out[name] - run_out(run_.points(times[len(times) * 4 // 5])):.2g}")
        errors = json.loads((arguments.results / name / "summary.json").read_text())["conservation errors"]
        for what in ("water", "grains"):
            check(findings, f"{name}: {what} lost or gained", errors[what], errors[what] <= 1e-12, "tolerance 1e-12")
        shown = draw_motion(run_, [0.1, 0.4, 1.0, times[-1]], [axes[letter] for letter in letters])
        axes[letters[0]].set_title(f"{name}, 0.1 s", fontsize=8, loc="left")
        figure.colorbar(shown, ax=[axes[letter] for letter in letters], label="excess pressure [Pa]", shrink=0.6)
    ratio = out["loose"] / out["dense"]
    check(findings, "run-out, loose over dense, at the end of each run", ratio, 1.6 <= ratio <= 2.5, "1.6 to 2.5")
    loose, dense = (Results(arguments.results / name) for name in COLUMNS)
    same = loose.point_times[-1]
    print(f"the same after {same:.3g} s of both: {out['loose'] / run_out(dense.points(same)):.3g}")
    for letter in "abcdefgh":
        axes[letter].set_aspect("equal")
        axes[letter].set_xlim(0, 0.24)
        axes[letter].set_ylim(0, 0.052)
        axes[letter].tick_params(labelsize=7)
    axes["p"].axhline(0.0, color="0.6", lw=0.6)
    axes["p"].set_ylabel("excess pressure at the bottom [Pa]")
    axes["r"].set_ylabel("run-out [-]")
    axes["r"].set_xlabel("time [s]")
    axes["p"].legend(frameon=False)
    arguments.picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(arguments.picture, dpi=130)
    print(f"picture: {arguments.picture}")
    return 0 if all(findings) else 1


if __name__ == "__main__":
    sys.exit(main())
