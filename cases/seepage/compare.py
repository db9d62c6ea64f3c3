#!/usr/bin/python3
"""Compares pore pressure and displacement of the saturated column (Table 2 of the paper) with the exact modal solution,
and draws one figure per permeability.

    python3 cases/seepage/compare.py [--run MUDLARK] [--results results/seepage] [--picture FILE.png]

--run runs all combinations first with the given program: five permeabilities, heights of 0.1 and 1 m, loads on the
skeleton and on the water. Figures go to the results folder, one per permeability, and all of them to FILE.png.
Tolerance: the root mean square of the pore pressure's difference over four periods of the
slow wave, 2 % of the load; exits with 1 beyond.
"""
import argparse
import subprocess
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
from mudlark.reference.compression_waves import SaturatedColumn  # noqa: E402
from mudlark.reference.consolidation import constrained_modulus  # noqa: E402
from mudlark.results import Results, ResultsError  # noqa: E402

CASE = Path(__file__).resolve().parent / "seepage.toml"
CONDUCTIVITIES = {1e-9: "1e-7 cm/s", 1e-7: "1e-7 m/s", 1e-5: "1e-3 cm/s", 1e-3: "1e-3 m/s = 1e-1 cm/s", 1e-1: "1e-1 m/s"}
HEIGHTS = (0.1, 1.0)
LOADS = ("skeleton", "water")
LOAD = 1000.0      # [Pa]
PLACE = 0.05       # of the gauges above the base [m]
TOLERANCE = 0.02


def column(height, conductivity):
    return SaturatedColumn(height, constrained_modulus(1e9, 0.35), 0.4, conductivity)


def folder_of(results, height, load, conductivity):
    return results / f"{height:g}-{load}-{conductivity:g}"


def run_all(program, results):
    for height in HEIGHTS:
        for conductivity in CONDUCTIVITIES:
            for load in LOADS:
                period = column(height, conductivity).slow_period
                ramp = 0.25 * period
                width = height / 40
                command = [program, "run", CASE, "--quiet", "-o", folder_of(results, height, load, conductivity), "--set",
                           f"domain.upper=[{width}, {1.1 * height:.9g}]", f"soil.shape.box.upper=[{width}, {height}]",
                           f"soil.hydraulic_conductivity={conductivity}", f"time.end={4 * period:.9g}",
                           f"load.0.on={load}",
                           f"load.0.pressure={LOAD:g} * (t < {ramp:.9g} ? 0.5 * (1 - cos(pi * t / {ramp:.9g})) : 1)"]
                for gauge in (0, 1):
                    command += [f"gauge.{gauge}.at=[{0.5 * width}, {PLACE}]", f"gauge.{gauge}.every={period / 137.2:.9g}"]
                subprocess.run([str(word) for word in command], check=True)


def compare(folder, height, load, conductivity, *axes):
    """Prints the differences of one run, draws it; returns that of pressure as a share of the load."""
    results = Results(folder)
    pressure, way = results.gauge("pressure"), results.gauge("displacement")
    exact = column(height, conductivity)
    expected, expected_way = exact.response(PLACE, pressure.time, ramp=0.25 * exact.slow_period, **{load: LOAD})
    computed, computed_way = pressure["pore pressure"], way["settlement"]
    off = np.sqrt(np.mean((computed - expected) ** 2)) / LOAD
    off_way = np.sqrt(np.mean((computed_way - expected_way) ** 2)) / np.abs(expected_way).max()
    swings = "slow wave swings" if exact.slow_mode_swings() else "no swing of the slow wave"
    print(f"  H = {height:g} m, load on {load:8s}: pressure {100 * off:5.2f} % of the load, displacement {100 * off_way:5.2f} % "
          f"of its largest; {swings}, p up to {computed.max() / LOAD:.3f} q (exact {expected.max() / LOAD:.3f})")
    for panel in axes:
        panel.plot(1e3 * pressure.time, expected / LOAD, color="black", lw=1.0, label="exact")
        panel.plot(1e3 * pressure.time[::6], computed[::6] / LOAD, "o", ms=3, mfc="none", color="tab:blue", label="computed")
        panel.set(title=f"H = {height:g} m, load on the {load}", xlabel="time [ms]", ylabel="pore pressure / load")
    return off


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--run", metavar="MUDLARK")
    parser.add_argument("--results", type=Path, default=Path("results/seepage"))
    parser.add_argument("--picture", type=Path)
    arguments = parser.parse_args()
    if arguments.run:
        run_all(arguments.run, arguments.results)
    worst, compared = 0.0, 0
    overview = plt.figure(figsize=(15, 16), constrained_layout=True)
    rows = overview.subfigures(len(CONDUCTIVITIES), 1)
    for (conductivity, printed), part in zip(CONDUCTIVITIES.items(), rows):
        print(f"k = {printed}")
        figure, axes = plt.subplots(2, 2, figsize=(9, 6), constrained_layout=True)
        part.suptitle(f"k = {printed}")
        small = part.subplots(1, 4).reshape(2, 2)
        for row, height in enumerate(HEIGHTS):
            for place, load in enumerate(LOADS):
                folder = folder_of(arguments.results, height, load, conductivity)
                try:
                    worst = max(worst, compare(folder, height, load, conductivity, axes[row, place], small[row, place]))
                    compared += 1
                except ResultsError as error:
                    print(f"  not compared: {error}")
        axes[0, 0].legend(frameon=False)
        figure.suptitle(f"Pore pressure 0.05 m above the base, k = {printed}")
        path = arguments.results / f"seepage-{conductivity:g}.png"
        path.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, dpi=100)
        plt.close(figure)
        print(f"  picture: {path}")
    if arguments.picture:
        overview.savefig(arguments.picture, dpi=70)
        print(f"picture: {arguments.picture}")
    if not compared:
        return 1
    print(f"largest difference of pore pressure: {100 * worst:.2f} % of the load (tolerance {100 * TOLERANCE:g} %)")
    return 1 if worst > TOLERANCE else 0


if __name__ == "__main__":
    sys.exit(main())
