#!/usr/bin/python3
"""A dam breaks over a saturated bed: what is kept, and how far wave and grains get; prints the findings and draws them.

    /usr/bin/python3 cases/erodible_dam_break/compare.py --run build/release/bin/mudlark
                                                         [--results results/erodible_dam_break] [--picture FILE.png]

- Water and grains are kept to 1e-12.
- Deepest scour and highest heap of the bed at the end of the run; no measurement to compare with.

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

BED = 0.1  # [m]


def bed_height(points):
    """Volume of grains per width in strips of 5 cm, as height of a bed as dense as at first [m]."""
    x = points["position"][:, 0]
    grains = points["volume"] * (1 - points["porosity"])
    strips = np.arange(0, 3.001, 0.05)
    return np.histogram(x, strips, weights=grains)[0] / 0.05 / 0.58


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--run", metavar="PROGRAM", help="run the case with this program first")
    parser.add_argument("--results", type=Path, default=Path("results/erodible_dam_break"))
    parser.add_argument("--picture", type=Path, default=Path("erodible_dam_break.png"))
    arguments = parser.parse_args()
    folder = arguments.results / "dam_break"
    if arguments.run:
        subprocess.run([arguments.run, "run", str(CASE / "dam_break.toml"), "-o", str(folder), "--quiet"], check=True)
    errors = json.loads((folder / "summary.json").read_text())["conservation errors"]
    good = True
    for what in ("water", "grains"):
        kept = errors[what] <= 1e-12
        print(f"{what} lost or gained: {errors[what]:.3g} (tolerance 1e-12){'' if kept else '  MISS'}")
        good = good and kept
    run_ = Results(folder)
    times = [0.2, 0.5, 0.8, run_.point_times[-1]]
    height = bed_height(run_.points(times[-1]))
    print(f"bed of {BED} m after {times[-1]:.3g} s: at the least {height.min():.3f} m, at the most {height.max():.3f} m")
    figure, axes = plt.subplots(len(times), 1, figsize=(9, 8), sharex=True, layout="constrained")
    for axis, time in zip(axes, times):
        points = run_.points(time)
        drawing.draw_water(axis, run_, points.time)
        x = points["position"]
        shown = axis.scatter(x[:, 0], x[:, 2], c=np.linalg.norm(points["velocity"], axis=1), s=0.8, cmap="viridis", vmin=0,
                             vmax=1.5)
        axis.set_aspect("equal")
        axis.set_xlim(0, 3)
        axis.set_ylim(0, 0.45)
        axis.set_title(f"{points.time:.2g} s", fontsize=8, loc="left")
    figure.colorbar(shown, ax=axes, label="speed of the grains [m/s]", shrink=0.5)
    arguments.picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(arguments.picture, dpi=110)
    print(f"picture: {arguments.picture}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
