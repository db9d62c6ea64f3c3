#!/usr/bin/python3
"""An embankment overtops, seeps and breaches: what 10 000 steps keep, what they cost; prints the findings and draws them.

    /usr/bin/python3 cases/breach/compare.py --run build/release/bin/mudlark [--results results/breach]
                                             [--picture FILE.png]

- 10 000 steps at least, to the end of the run. Water and grains are kept to 1e-12.
- CPU time per simulated second, and by phase.

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

CASE = Path(__file__).resolve().parent
PACKAGE = CASE.parents[1] / "python"
if not (PACKAGE / "mudlark").is_dir():
    sys.exit("compare.py needs Mudlark's Python package: run it where it lies, in cases/ of Mudlark's source tree.")
sys.path.insert(0, str(PACKAGE))
from mudlark import drawing  # noqa: E402
from mudlark.results import Results  # noqa: E402


def check(findings, text, value, good, tolerance):
    print(f"{text:<46}{value:10.3g}  ({tolerance}){'' if good else '  MISS'}")
    findings.append(good)


def crest(points):
    """Height [m] of the highest grain between the shoulders of the crest."""
    x = points["position"]
    return x[(x[:, 0] > 1.9) & (x[:, 0] < 2.0), 2].max()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--run", metavar="PROGRAM", help="run the case with this program first")
    parser.add_argument("--results", type=Path, default=Path("results/breach"))
    parser.add_argument("--picture", type=Path, default=Path("breach.png"))
    arguments = parser.parse_args()
    folder = arguments.results / "breach"
    if arguments.run:
        subprocess.run([arguments.run, "run", str(CASE / "breach.toml"), "-o", str(folder), "--quiet"], check=True)
    summary = json.loads((folder / "summary.json").read_text())
    findings = []
    check(findings, "steps", summary["steps"], summary["steps"] >= 10000 and summary["status"] == "done", "10 000 at least")
    for what in ("water", "grains"):
        error = summary["conservation errors"][what]
        check(findings, f"{what} lost or gained", error, error <= 1e-12, "tolerance 1e-12")
    per_second = summary["CPU time [s]"] / summary["time [s]"]
    print(f"{summary['cells']} cells, {summary['points']} points: {per_second:.3g} s of CPU time per simulated second")
    phases = summary["time per phase [s]"]
    print("  " + ", ".join(f"{name} {value / sum(phases.values()) * 100:.0f} %" for name, value in phases.items()))
    run_ = Results(folder)
    times = [0.5, 1.5, 3.0, run_.point_times[-1]]
    print(f"crest: {crest(run_.points(0.0)):.3f} m at first, {crest(run_.points(times[-1])):.3f} m after {times[-1]:.3g} s")
    figure, axes = plt.subplots(len(times), 1, figsize=(9, 8), sharex=True, layout="constrained")
    for axis, time in zip(axes, times):
        points = run_.points(time)
        drawing.draw_water(axis, run_, points.time)
        x = points["position"]
        shown = axis.scatter(x[:, 0], x[:, 2], c=points["pore pressure"] / 1000, s=0.8, cmap="viridis", vmin=0, vmax=3.5)
        axis.set_aspect("equal")
        axis.set_xlim(0.8, 3.4)
        axis.set_ylim(0, 0.46)
        axis.set_title(f"{points.time:.2g} s", fontsize=8, loc="left")
    figure.colorbar(shown, ax=axes, label="pore pressure [kPa]", shrink=0.5)
    arguments.picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(arguments.picture, dpi=110)
    print(f"picture: {arguments.picture}")
    return 0 if all(findings) else 1


if __name__ == "__main__":
    sys.exit(main())
