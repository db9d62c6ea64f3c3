#!/usr/bin/python3
"""One water: consolidation against Terzaghi (1943), rest, and what a slide keeps; prints the findings and draws them.

    /usr/bin/python3 cases/one_water/compare.py --run build/release/bin/mudlark [--results results/one_water]
                                                [--picture FILE.png]

- terzaghi.toml with k = 1e-2, 1e-3 and 1e-4 m/s, the step held at 0.14 ms: isochrones of the excess pore pressure at
  T = c_v t/H^2 = 0.05 to 1; tolerance 1 % of the load (RMS over the points). With 1e-6 and 1e-9 m/s water carries the
  load; tolerance 1 %.
- thrown.toml: momentum along the box over 10 000 steps, kept to 1e-9.
- rest.toml: ten minutes; settlement below 1e-3 of that under the bed's own weight, water below 1e-6 m/s.
- slide.toml, collapse.toml: dry sand into a pond, sand under water. Water and grains are kept to 1e-12. There is no
  measurement here to compare with; the picture shows what happens.

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

LOAD, HEIGHT, WEIGHT = 1000.0, 1.0, 9810.0          # [Pa], [m], [N/m3]
FACTORS = (0.05, 0.1, 0.2, 0.5, 1.0)                # T
DRAINING, TIGHT = ("1e-2", "1e-3", "1e-4"), ("1e-6", "1e-9")


def young_modulus(k):
    """[Pa]. A stiff metre of soil drains at 1e-2 m/s as fast as its water can be accelerated: inertia, not error."""
    return 1e6 if float(k) > 5e-3 else 10e6


def consolidation_coefficient(k):
    return float(k) * young_modulus(k) * 0.8 / (1.2 * 0.6) / WEIGHT


def isochrone(T, z):
    """Excess pore pressure over the load at z above the sealed base, drained at the top."""
    m = (np.arange(400) + 0.5)[:, None] * np.pi
    return (2 / m * np.sin(m) * np.cos(m * z) * np.exp(-m * m * T)).sum(axis=0)


def run(program, case, folder, *settings):
    command = [program, "run", str(CASE / f"{case}.toml"), "-o", str(folder), "--quiet"]
    for setting in settings:
        command += ["--set", setting]
    subprocess.run(command, check=True)


def run_all(program, results):
    for k in DRAINING:
        times = [T / consolidation_coefficient(k) for T in FACTORS]
        run(program, "terzaghi", results / f"terzaghi_{k}", f'soil.0.hydraulic_conductivity="{k} m/s"',
            f"soil.0.law.young_modulus={young_modulus(k)}", "time.max_step=1.4e-4", f"time.end={times[-1]}",
            f"time.output_at={times}")
    for k in TIGHT:
        run(program, "terzaghi", results / f"terzaghi_{k}", f'soil.0.hydraulic_conductivity="{k} m/s"',
            "time.end=0.05")
    for case in ("rest", "thrown", "slide", "collapse"):
        run(program, case, results / case)


def excess(points):
    z = points["initial position"][:, 2]
    return z, (points["pore pressure"] - WEIGHT * (1.1 - points["position"][:, 2])) / LOAD


def summary(folder):
    return json.loads((folder / "summary.json").read_text())


def check(findings, text, value, limit, unit="%"):
    good = value <= limit
    print(f"{text:<62}{value:10.3g} {unit}  (tolerance {limit:g}){'' if good else '  MISS'}")
    findings.append(good)


def check_consolidation(results, findings, axis):
    colours = plt.cm.viridis(np.linspace(0, 0.85, len(FACTORS)))
    for k, marker in zip(DRAINING, "os^"):
        folder = results / f"terzaghi_{k}"
        for T, colour in zip(FACTORS, colours):
            z, p = excess(Results(folder).points(T / consolidation_coefficient(k)))
            error = np.sqrt(np.mean((p - isochrone(T, z)) ** 2)) * 100
            check(findings, f"k = {k} m/s, T = {T}: RMS of the excess pressure", error, 1.0)
            axis.plot(p[::8], z[::8], marker, color=colour, ms=3, mfc="none", mew=0.7)
        step = summary(folder)["largest step [s]"]
        print(f"k = {k} m/s: largest step {step:.3g} s")
    z = np.linspace(0, HEIGHT, 200)
    for T, colour in zip(FACTORS, colours):
        axis.plot(isochrone(T, z), z, color=colour, label=f"T = {T}")
    axis.set_xlabel("excess pore pressure / load [-]")
    axis.set_ylabel("z [m]")
    axis.legend(fontsize=7, frameon=False)
    axis.set_title("Terzaghi (lines); k = 1e-2 o, 1e-3 □, 1e-4 △", fontsize=8, loc="left")
    for k in TIGHT:
        z, p = excess(Results(results / f"terzaghi_{k}").points())
        worst = np.abs(p[z < 0.7] - 1).max() * 100
        check(findings, f"k = {k} m/s: part of the load that water does not carry", worst, 1.0)
        steps = summary(results / f"terzaghi_{k}")
        print(f"k = {k} m/s: steps of {steps['smallest step [s]']:.3g} to {steps['largest step [s]']:.3g} s, as the program chose them")


def check_rest(results, findings):
    bed = Results(results / "rest")
    own_weight = 0.5 * 0.6 * 1650 * 9.81 * 0.5**2 / (1e6 * 0.7 / (1.3 * 0.4))
    check(findings, "rest: settlement over that under the bed's own weight",
          np.abs(bed.gauge("settlement")["settlement"]).max() / own_weight, 1e-3, "-")
    check(findings, "rest: fastest water at the end", bed.gauge("speed")["largest speed"][-1], 1e-6, "m/s")


def check_momentum(results, findings):
    momentum = Results(results / "thrown").gauge("momentum")["momentum x"]
    check(findings, f"thrown: drift of momentum in {summary(results / 'thrown')['steps']} steps",
          np.abs(momentum / momentum[0] - 1).max(), 1e-9, "-")


def draw_motion(results, case, axes):
    run_ = Results(results / case)
    for axis, time in zip(axes, (0.25, 1.5)):
        points = run_.points(time)
        drawing.draw_water(axis, run_, time)
        shown = axis.scatter(points["position"][:, 0], points["position"][:, 2], c=points["pore pressure"] / 1000, s=0.6,
                             cmap="viridis")
        axis.set_aspect("equal")
        axis.set_xlim(0, 1.2)
        axis.set_ylim(0, 0.4)
        axis.set_title(f"{case}, t = {points.time:.2g} s", fontsize=8, loc="left")
    return shown


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--run", metavar="PROGRAM", help="run the cases with this program first")
    parser.add_argument("--results", type=Path, default=Path("results/one_water"))
    parser.add_argument("--picture", type=Path, default=Path("one_water.png"))
    arguments = parser.parse_args()
    if arguments.run:
        run_all(arguments.run, arguments.results)
    findings = []
    figure, axes = plt.subplot_mosaic([["T", "a", "b"], ["T", "c", "d"]], figsize=(12, 4.4), width_ratios=(1, 1.5, 1.5),
                                      layout="constrained")
    check_consolidation(arguments.results, findings, axes["T"])
    check_rest(arguments.results, findings)
    check_momentum(arguments.results, findings)
    for case, pair in (("slide", "ab"), ("collapse", "cd")):
        errors = summary(arguments.results / case)["conservation errors"]
        check(findings, f"{case}: water lost or gained", errors["water"], 1e-12, "-")
        check(findings, f"{case}: grains lost or gained", errors["grains"], 1e-12, "-")
        shown = draw_motion(arguments.results, case, [axes[name] for name in pair])
        figure.colorbar(shown, ax=axes[pair[1]], label="pore pressure [kPa]", shrink=0.8)
    arguments.picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(arguments.picture, dpi=130)
    print(f"picture: {arguments.picture}")
    return 0 if all(findings) else 1


if __name__ == "__main__":
    sys.exit(main())
