#!/usr/bin/python3
"""A sheet pile whose toe boils: heave and seepage against the head; prints the findings and draws them.

    /usr/bin/python3 cases/sheet_pile/compare.py --run build/release/bin/mudlark [--results results/sheet_pile]
                                                 [--picture FILE.png]

The sand beside a pile that reaches D deep is lifted when the seepage under it carries the weight under water of a prism
D/2 wide: at a head of about 2.82 D (gamma'/gamma_w) in deep ground (Terzaghi 1943, with the mean excess head at the toe's
level of the flow net). Right at the pile the exit gradient is critical at pi D (gamma'/gamma_w) (Harr 1962, deep ground).
Friction in the sand holds the prism back, Terzaghi's head is a lower bound.

- At 0.8 times Terzaghi's head the prism has risen by less than 0.2 mm after 2 s, at 1.4 times by more than 3 mm and goes on.
- Seepage is proportional to the head as long as the sand stands, within 2 %.

Exits with 1 when one of these fails.
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

DEPTH, LOW = 0.4, 1.1                                   # of the pile; level of the lower water [m]
CONDUCTIVITY = 2e-3                                     # [m/s]
BUOYANT = 0.58 * 1650 / 1000                            # gamma' / gamma_w
PRISM, EXIT = 2.82 * DEPTH * BUOYANT, np.pi * DEPTH * BUOYANT
HEADS = (0.6, 0.9, 1.2, 1.5)                            # [m]


def run(program, folder, head):
    subprocess.run([program, "run", str(CASE / "boils.toml"), "-o", str(folder), "--quiet", "--set",
                    f"water.body.0.shape.box.upper=[2.0, {LOW + head}]"], check=True)


def check(findings, text, good):
    print(f"{text}{'' if good else '  MISS'}")
    findings.append(bool(good))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--run", metavar="PROGRAM", help="run the case with this program first")
    parser.add_argument("--results", type=Path, default=Path("results/sheet_pile"))
    parser.add_argument("--picture", type=Path, default=Path("sheet_pile.png"))
    arguments = parser.parse_args()
    folders = {head: arguments.results / f"{head:g}" for head in HEADS}
    if arguments.run:
        for head, folder in folders.items():
            run(arguments.run, folder, head)
    print(f"critical heads of deep ground: prism {PRISM:.2f} m, exit gradient {EXIT:.2f} m")
    findings, heave, late, flow = [], {}, {}, {}
    figure, axes = plt.subplots(1, 3, figsize=(13, 3.8), layout="constrained")
    for head, folder in folders.items():
        results = Results(folder)
        gauge, seepage = results.gauge("heave"), results.gauge("seepage")
        up = gauge["displacement z"] * 1000
        heave[head], late[head] = up[-1], up[-1] - np.interp(1.5, gauge.time, up)
        flow[head] = seepage["discharge"][seepage.time > 1.5].mean() / (CONDUCTIVITY * head)
        print(f"head {head:g} m: prism lifted by {heave[head]:+.3f} mm, {late[head]:+.3f} mm of it in the last half second; "
              f"seepage {flow[head]:.4f} k H")
        axes[0].plot(gauge.time, up, label=f"head {head:g} m")
        water = json.loads((folder / "summary.json").read_text())["conservation errors"]["water"]
        check(findings, f"head {head:g} m: water lost or gained {water:.1e} (tolerance 1e-12)", water <= 1e-12)
    check(findings, f"at {0.9 / PRISM:.2f} times Terzaghi's head the sand stands", abs(heave[0.9]) < 0.2)
    check(findings, f"at {1.5 / PRISM:.2f} times Terzaghi's head it boils", heave[1.5] > 3.0 and late[1.5] > 0.3)
    spread = abs(flow[0.9] / flow[0.6] - 1) * 100
    check(findings, f"seepage per head differs by {spread:.2f} % while the sand stands (tolerance 2)", spread < 2.0)
    axes[0].set_xlabel("time [s]")
    axes[0].set_ylabel("heave beside the pile [mm]")
    axes[0].legend(frameon=False)
    for axis, head in zip(axes[1:], (0.9, 1.5)):
        results = Results(folders[head])
        points = results.points()
        drawing.draw_water(axis, results, points.time)
        up = points["displacement"][:, 2] * 1000
        shown = axis.scatter(points["position"][:, 0], points["position"][:, 2], c=up, s=3, cmap="coolwarm", vmin=-6, vmax=6)
        drawing.draw_solids(axis, results, points.time)
        axis.set_aspect("equal")
        axis.set_xlim(1, 3)
        axis.set_ylim(0, 1.8)
        axis.set_title(f"head {head:g} m, t = {points.time:.2g} s", fontsize=8, loc="left")
    figure.colorbar(shown, ax=axes[2], label="lifted by [mm]", shrink=0.8)
    arguments.picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(arguments.picture, dpi=130)
    print(f"picture: {arguments.picture}")
    return 0 if all(findings) else 1


if __name__ == "__main__":
    sys.exit(main())
