#!/usr/bin/python3
"""Banks: seepage, capillary rise, infiltration, drainage, rest and drawdown; prints the findings and draws them.

    /usr/bin/python3 cases/bank/compare.py --run build/release/bin/mudlark [--results results/bank] [--picture FILE.png]

- dam.toml: q = k (h1^2 - h2^2)/(2 L), tolerance 1 %; the surface leaves the dam at 0.63446 of h1 (Polubarinova-Kochina
  1962), tolerance two cells.
- rise.toml: n dL/dt = k (psi - L)/(d + L), d the wet ground below the table, so t = n/k [-L - (psi + d) ln(1 - L/psi)];
  tolerance 2 % of psi, over time (RMS).
- infiltration.toml: Green & Ampt (1911) under a pond that falls, n dL/dt = k (H + psi + L)/L with H = H0 - n L;
  tolerance 2 % of the pond (RMS).
- drain.toml: a band with S = 0.3 drains by k_r = S^3 into dry ground: a front of speed k S^2/n, and the fan
  S = sqrt(n z/(3 k t)) below the top; tolerance 5 % of the band's water (mean error).
- rest.toml: settlement below 1e-3 of that under the bed's own weight; water below 1e-6 m/s; pressure in the fringe.
- drawdown.toml: water and grains are kept to 1e-12. There is no measurement; the picture shows the surface.

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
from mudlark.results import Results  # noqa: E402

K, POROSITY, SUCTION, WEIGHT = 1e-2, 0.4, 0.2, 9810.0   # [m/s], [-], [m], [N/m3]
CASES = ("dam", "rise", "infiltration", "drain", "rest", "drawdown")


def summary(folder):
    return json.loads((folder / "summary.json").read_text())


def check(findings, text, value, limit, unit="%"):
    good = value <= limit
    print(f"{text:<66}{value:10.3g} {unit}  (tolerance {limit:g}){'' if good else '  MISS'}")
    findings.append(good)


def check_dam(folder, findings, axis):
    results = Results(folder)
    exact = K * (1.0 - 0.2**2) / (2 * 0.5)
    for name in ("upstream", "downstream"):
        gauge = results.gauge(name)
        mean = gauge["discharge"][gauge.time > 6].mean()
        print(f"dam: discharge {name} {1e3 * mean:.4f}e-3 m2/s, exact {1e3 * exact:.4f}e-3")
        check(findings, f"dam: discharge {name}", 100 * abs(mean / exact - 1), 1.0)
    state = results.field("saturation")
    x, z, h = state.centres(0), state.centres(1), state.spacing[1]
    inside = np.where((x > 0) & (x < 0.5))[0][-1]          # the last column of whole cells of soil
    full = state.values[:, inside]
    exit_height = h * full[z < 1.0].sum()
    print(f"dam: exit at {exit_height:.4f} m, exact 0.6345")
    check(findings, "dam: exit point", abs(exit_height - 0.63446) / h, 2.0, "cells")
    pressure = results.field("pressure")
    axis.contour(x, z, np.where(state.values > 0.5, pressure.values / WEIGHT + z[:, None], np.nan),
                 levels=np.arange(0.25, 1, 0.05), linewidths=0.6)
    axis.contour(x, z, state.values, levels=[0.5], colors="tab:blue")
    axis.plot([0, 0, 0.5, 0.5], [0, 1.033, 1.033, 0], "k", lw=0.8)
    axis.plot([0.5], [0.63446], "r<", ms=4)
    axis.set_aspect("equal")
    axis.set_title("dam: surface, heads, exact exit ◂", fontsize=8, loc="left")


def check_rise(folder, findings, axis):
    gauge = Results(folder).gauge("level")
    L = np.linspace(0.002, 0.9999 * SUCTION, 4000)
    t = POROSITY / K * (-L - (SUCTION + 0.1) * np.log(1 - L / SUCTION))
    found, exact = gauge["water level"] - 0.1, np.interp(gauge.time, t, L)
    part = gauge.time > 0.2
    check(findings, "rise: RMS over the suction", 100 * np.sqrt(np.mean((found - exact)[part] ** 2)) / SUCTION, 2.0)
    check(findings, "rise: height at the end over the suction", 100 * abs(found[-1] / exact[-1] - 1), 2.0)
    axis.plot(gauge.time, found, label="rise")
    axis.plot(t, L, "k--", lw=0.8)


def check_infiltration(folder, findings, axis):
    gauge = Results(folder).gauge("pond")
    a, b, pond = 0.15 + SUCTION, 1 - POROSITY, 0.15
    L = np.linspace(0.001, 0.37, 4000)
    t = POROSITY / K * (L / b - a / b**2 * np.log(1 + b * L / a))
    found, exact = gauge["water level"] - 0.8, pond - POROSITY * np.interp(gauge.time, t, L)
    part = exact > 0.02
    error = np.sqrt(np.mean((found - exact)[part] ** 2)) / pond
    check(findings, "infiltration: RMS of the pond's depth over its depth", 100 * error, 2.0)
    axis.plot(gauge.time, (pond - found) / POROSITY, label="infiltration")
    axis.plot(t, L, "k--", lw=0.8, label="exact")
    axis.set(xlabel="t [s]", ylabel="front [m]", xlim=(0, 20), ylim=(0, 0.38))
    axis.set_title("capillary rise; a pond that sinks", fontsize=8, loc="left")
    axis.legend(fontsize=7, frameon=False)


def band(depth, t, full=0.3, thick=0.4, k=5e-2):
    """Saturation by kinematic waves: 3 k S^2/n is the speed of a value S, k S^2/n that of the front. What leaves the top
    first, S = full, catches up with the front; later the front lies where the fan holds all the water."""
    fan = np.sqrt(np.maximum(depth, 0) * POROSITY / (3 * k * t))
    front = thick + k * full**2 / POROSITY * t
    if 3 * k * full**2 / POROSITY * t > front:
        front = (full * thick * 1.5 * np.sqrt(3 * k * t / POROSITY)) ** (2 / 3)
    return np.where(depth < front, np.minimum(fan, full), 0.0)


def check_drain(folder, findings, axis):
    results = Results(folder)
    for time, colour in zip((8.0, 17.0, 35.0), plt.cm.viridis((0.0, 0.4, 0.8))):
        state = results.field("saturation", time=time)
        z, found = state.centres(1), state.values[:, 1]
        edges = 0.8 - np.linspace(0.0, 0.8, 10 * len(z) + 1)
        fine = band(0.5 * (edges[1:] + edges[:-1]), state.time)
        exact = fine.reshape(len(z), 10).mean(axis=1)
        axis.plot(found, z, "o", color=colour, ms=2.5)
        axis.plot(exact, z, color=colour, lw=0.8, label=f"{state.time:.0f} s")
        check(findings, f"drain: saturation at {state.time:.0f} s, mean error over the band's",
              100 * np.abs(found - exact).mean() / (0.3 * 0.5), 5.0)
    axis.set(xlabel="saturation [-]", ylabel="z [m]")
    axis.legend(fontsize=7, frameon=False)
    axis.set_title("a wet band drains (lines: exact)", fontsize=8, loc="left")


def check_rest(folder, findings):
    bed = Results(folder)
    own_weight = 0.5 * 0.6 * 2650 * 9.81 * 0.7**2 / (1e6 * 0.7 / (1.3 * 0.4))
    check(findings, "rest: settlement over that under the bed's own weight",
          np.abs(bed.gauge("settlement")["settlement"]).max() / own_weight, 1e-3, "-")
    check(findings, "rest: fastest water at the end", bed.gauge("speed")["largest speed"][-1], 1e-6, "m/s")
    pressure = bed.gauge("pore")["pressure"]
    check(findings, "rest: pressure in the bed less 0.1 m of suction", np.abs(pressure - (WEIGHT * 0.2 - 981)).max() / 10, 1.0,
          "cm")


def check_drawdown(folder, findings, axis):
    results = Results(folder)
    errors = summary(folder)["conservation errors"]
    check(findings, "drawdown: water lost or gained", errors["water"], 1e-12, "-")
    check(findings, "drawdown: grains lost or gained", errors["grains"], 1e-12, "-")
    for time, colour in zip((0.0, 2.0, 4.0, 8.0), plt.cm.viridis((0.0, 0.3, 0.6, 0.85))):
        state = results.field("saturation", time=time)
        axis.contour(state.centres(0), state.centres(1), state.values, levels=[0.5], colors=[colour])
        axis.plot([], [], color=colour, label=f"{state.time:.0f} s")
    points = results.points()
    axis.plot(points["position"][:, 0], points["position"][:, 2], ".", color="tan", ms=0.4, zorder=0)
    axis.set_aspect("equal")
    axis.legend(fontsize=7, frameon=False)
    axis.set_title("drawdown: the water's surface", fontsize=8, loc="left")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--run", metavar="PROGRAM", help="run the cases with this program first")
    parser.add_argument("--results", type=Path, default=Path("results/bank"))
    parser.add_argument("--picture", type=Path, default=Path("bank.png"))
    arguments = parser.parse_args()
    for case in CASES if arguments.run else ():
        subprocess.run([arguments.run, "run", str(CASE / f"{case}.toml"), "-o", str(arguments.results / case), "--quiet"],
                       check=True)
    findings = []
    figure, axes = plt.subplot_mosaic([["dam", "front", "drain"], ["down", "down", "drain"]], figsize=(11, 6.5),
                                      layout="constrained")
    check_dam(arguments.results / "dam", findings, axes["dam"])
    check_rise(arguments.results / "rise", findings, axes["front"])
    check_infiltration(arguments.results / "infiltration", findings, axes["front"])
    check_drain(arguments.results / "drain", findings, axes["drain"])
    check_rest(arguments.results / "rest", findings)
    check_drawdown(arguments.results / "drawdown", findings, axes["down"])
    arguments.picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(arguments.picture, dpi=110)
    print(f"picture: {arguments.picture}")
    return 0 if all(findings) else 1


if __name__ == "__main__":
    sys.exit(main())
