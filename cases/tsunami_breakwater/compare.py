#!/usr/bin/python3
"""Tsunami over a caisson breakwater: force on the caisson against the design formula; prints the findings and draws.

    /usr/bin/python3 cases/tsunami_breakwater/compare.py --run build/release/bin/mudlark
                                                         [--results results/tsunami_breakwater] [--picture FILE.png]

- Mean horizontal force on the caisson of coarse.toml from 0.5 s on, against the hydrostatic formula for overflow of the
  Japanese design guideline (MLIT, Guideline for tsunami-resistant design of breakwaters, 2013): pressure 1.05 rho g times
  the depth under the sea's level in front, 0.9 rho g times that under the harbour's level behind. Levels are those that
  the run has. It is a design formula, not a measurement; tolerance 10 %.
- coarse.toml and head.toml: water is kept to 1e-12, grains exactly.

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

WEIGHT = 9810.0                               # of water [N/m3]
BOTTOM, CREST, WIDTH, LENGTH = 0.55, 1.05, 0.5, 1.6  # of the caisson [m]; length of the half of it in head.toml
CONCRETE, FRICTION = 2300.0, 0.6              # mean density of a filled caisson [kg/m3], on rubble


def design_force(sea, harbour):
    """Horizontal force per metre [N/m] with levels z [m]; the sea may stand above the crest, the harbour below."""
    front_bottom = 1.05 * WEIGHT * (sea - BOTTOM)
    front_crest = front_bottom * np.maximum(sea - CREST, 0.0) / (sea - BOTTOM)
    height = np.minimum(sea, CREST) - BOTTOM
    return 0.5 * (front_bottom + front_crest) * height - 0.5 * 0.9 * WEIGHT * (harbour - BOTTOM) ** 2


def check_force(results, findings, axis):
    force = results.gauge("caisson force")
    time, along, up = force.time, force["force x"], force["force z"]
    sea, harbour = (results.gauge(name)["water level"] for name in ("sea level", "harbour level"))
    design = design_force(sea, harbour)
    late = time >= 0.5
    error = abs(along[late].mean() / design[late].mean() - 1) * 100
    good = error <= 10.0
    print(f"horizontal force from 0.5 s on: {along[late].mean():.0f} N/m, design formula {design[late].mean():.0f} N/m: "
          f"{along[late].mean() / design[late].mean() * 100 - 100:+.1f} % (tolerance 10){'' if good else '  MISS'}")
    findings.append(good)
    carried = CONCRETE * 9.81 * WIDTH * (CREST - BOTTOM) - np.median(up[late])
    print(f"a caisson of {CONCRETE:.0f} kg/m3 would press with {carried:.0f} N/m on the mound: safety against sliding "
          f"{FRICTION * carried / along[late].mean():.2f} with a friction of {FRICTION}")
    axis.plot(time, along, lw=0.8, label="horizontal")
    axis.plot(time, up, lw=0.8, label="upwards")
    axis.plot(time, design, "k--", lw=1, label="horizontal, design formula")
    axis.set_ylim(0, 3500)
    axis.set_xlabel("time [s]")
    axis.set_ylabel("force on the caisson [N/m]")
    axis.legend(fontsize=7, frameon=False)


def check_conservation(folder, findings):
    errors = json.loads((folder / "summary.json").read_text())["conservation errors"]
    good = errors["water"] <= 1e-12 and errors["grains"] == 0.0
    print(f"{folder.name}: water lost or gained {errors['water']:.1e}, grains {errors['grains']:.1e} "
          f"(tolerance 1e-12, 0){'' if good else '  MISS'}")
    findings.append(good)


def tell_head(results):
    through = results.gauge("through the gap")["discharge"]
    over = results.gauge("overflow")
    push = results.gauge("caisson force")["force x"]
    late = over.time >= 0.5
    print(f"head: {over['discharge'][late].mean():.3f} m3/s over the caisson, {through[late].mean():.3f} m3/s past its "
          f"head; force per metre of its length {push[late].mean() / LENGTH:.0f} N/m")
    moved = results.points()
    far = np.linalg.norm(moved["displacement"], axis=1)
    print(f"head: farthest way of a point of soil {far.max():.2f} m; {np.mean(far > 0.05) * 100:.1f} % of the points moved by "
          "more than 5 cm")


def draw_state(results, time, axis):
    points = results.points(time)
    drawing.draw_water(axis, results, time)
    shown = axis.scatter(points["position"][:, 0], points["position"][:, 2], c=points["pore pressure"] / 1000, s=0.8,
                         cmap="viridis", vmin=0, vmax=12)
    drawing.draw_solids(axis, results, time)
    axis.set_aspect("equal")
    axis.set_xlim(1, 5.5)
    axis.set_ylim(0, 1.5)
    axis.set_title(f"t = {points.time:.2g} s", fontsize=8, loc="left")
    return shown


def draw_plan(results, axis):
    """Seen from above: how far the uppermost grains went."""
    points = results.points()
    place, far = points["position"], np.linalg.norm(points["displacement"], axis=1)
    top = points["initial position"][:, 2] > np.where(np.abs(points["initial position"][:, 0] - 3) < 1, 0.4, 0.33)
    shown = axis.scatter(place[top, 0], place[top, 1], c=far[top] * 100, s=2, cmap="magma_r", vmin=0, vmax=20)
    axis.add_patch(plt.Rectangle((2.75, 0), 0.5, LENGTH, color="0.4"))
    axis.set_aspect("equal")
    axis.set_xlim(1, 5.5)
    axis.set_title(f"head of the breakwater from above, t = {points.time:.2g} s", fontsize=8, loc="left")
    return shown


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--run", metavar="PROGRAM", help="run the cases with this program first")
    parser.add_argument("--results", type=Path, default=Path("results/tsunami_breakwater"))
    parser.add_argument("--picture", type=Path, default=Path("tsunami_breakwater.png"))
    arguments = parser.parse_args()
    if arguments.run:
        for name in ("coarse", "head"):
            subprocess.run([arguments.run, "run", str(CASE / f"{name}.toml"), "-o", str(arguments.results / name), "--quiet"],
                           check=True)
    coarse, head = Results(arguments.results / "coarse"), Results(arguments.results / "head")
    findings = []
    figure, axes = plt.subplot_mosaic([["a", "b"], ["c", "F"], ["P", "F"]], figsize=(11, 7), layout="constrained")
    check_force(coarse, findings, axes["F"])
    for name, time in (("a", 0.25), ("b", 1.0), ("c", 3.0)):
        shown = draw_state(coarse, time, axes[name])
    figure.colorbar(shown, ax=axes["b"], label="pore pressure [kPa]", shrink=0.8)
    figure.colorbar(draw_plan(head, axes["P"]), ax=axes["P"], label="way of the grains [cm]", shrink=0.8)
    tell_head(head)
    for results in ("coarse", "head"):
        check_conservation(arguments.results / results, findings)
    arguments.picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(arguments.picture, dpi=130)
    print(f"picture: {arguments.picture}")
    return 0 if all(findings) else 1


if __name__ == "__main__":
    sys.exit(main())
