#!/usr/bin/python3
"""Compares pore pressure and displacement of the saturated column (Table 2 of the paper) with exact modal solutions, for
all three formulations, and draws one figure per permeability.

    python3 cases/seepage/compare.py [--run MUDLARK] [--results results/seepage] [--picture FILE.png]

--run runs all combinations first with the given program: five permeabilities, heights of 0.1 and 1 m, loads on the
skeleton and on the water, formulations u-w, u-w-p and u-p; and u-p with the inertia of the mixture in Darcy's law, which
fails, for the shorter column. Figures go to the results folder, one per permeability and one of the failures; pressures of
all of them go to FILE.png.
Tolerance: the root mean square of the pore pressure's difference over four periods of the slow wave, 2 % of the load,
against the solution of the equations that the formulation solves; exits with 1 beyond.
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
from mudlark.reference.compression_waves import SaturatedColumn, UpColumn  # noqa: E402
from mudlark.reference.consolidation import constrained_modulus  # noqa: E402
from mudlark.results import Results, ResultsError  # noqa: E402

CASE = Path(__file__).resolve().parent / "seepage.toml"
CONDUCTIVITIES = {1e-9: "1e-7 cm/s", 1e-7: "1e-7 m/s", 1e-5: "1e-3 cm/s", 1e-3: "1e-3 m/s = 1e-1 cm/s", 1e-1: "1e-1 m/s"}
HEIGHTS = (0.1, 1.0)
LOADS = ("skeleton", "water")
FORMULATIONS = {"u-w": ("o", "tab:blue"), "u-w-p": ("x", "tab:orange"), "u-p": ("+", "tab:green")}
LOAD = 1000.0      # [Pa]
PLACE = 0.05       # of the gauges above the base [m]
TOLERANCE = 0.02
CELLS = 80         # over the height
FINE_COURANT = 0.05  # of the runs that are to show growth: FLIP's own damping grows with the step


def column(height, conductivity, kind=SaturatedColumn, **more):
    return kind(height, constrained_modulus(1e9, 0.35), 0.4, conductivity, **more)


def folder_of(results, height, load, conductivity, formulation):
    return results / f"{height:g}-{load}-{conductivity:g}-{formulation}"


def run(program, folder, height, load, conductivity, formulation, every, settings=()):
    """Runs one combination for four periods of the slow wave; returns the program's exit code."""
    period = column(height, conductivity).slow_period
    ramp, width = 0.25 * period, height / CELLS
    command = [program, "run", CASE, "--quiet", "-o", folder, "--set", f"domain.upper=[{width}, {1.1 * height:.9g}]",
               f"soil.shape.box.upper=[{width}, {height}]", f"soil.hydraulic_conductivity={conductivity}",
               f"soil.formulation={formulation}", f"time.end={4 * period:.9g}", f"load.0.on={load}",
               f"load.0.pressure={LOAD:g} * (t < {ramp:.9g} ? 0.5 * (1 - cos(pi * t / {ramp:.9g})) : 1)", *settings]
    for gauge in (0, 1):
        command += [f"gauge.{gauge}.at=[{0.5 * width}, {PLACE}]", f"gauge.{gauge}.every={every:.9g}"]
    return subprocess.run([str(word) for word in command], stderr=subprocess.DEVNULL).returncode


def run_all(program, results):
    for height in HEIGHTS:
        for conductivity in CONDUCTIVITIES:
            for load in LOADS:
                for formulation in FORMULATIONS:
                    folder = folder_of(results, height, load, conductivity, formulation)
                    every = column(height, conductivity).slow_period / 137.2
                    if run(program, folder, height, load, conductivity, formulation, every):
                        sys.exit(f"{program} failed on {folder}: see its log.txt")
    for conductivity in CONDUCTIVITIES:
        folder = folder_of(results, HEIGHTS[0], "skeleton", conductivity, "u-p-inertia")
        growth, _ = fastest_growth(HEIGHTS[0], conductivity)
        every = min(column(HEIGHTS[0], conductivity).slow_period / 137.2, 0.3 / max(growth, 1.0))
        end = 4 * column(HEIGHTS[0], conductivity).slow_period
        if conductivity > 1e-2:  # it blows up without an end: steps shrink with what moves ever faster
            end = 2.5 / growth
        run(program, folder, HEIGHTS[0], "skeleton", conductivity, "u-p", every,
            ["soil_solver.inertia_in_darcy=true", f"soil_solver.courant={FINE_COURANT}", f"time.end={end:.9g}"])


def fastest_growth(height, conductivity):
    """Rate [1/s] and length [m] of the wave of the grid that grows fastest: linear theory, less what FLIP takes from a wave
    of frequency w, w^2 dt (1 - s)/2 with s = sinc(N h/2)^8 of points to faces and back."""
    exact = column(height, conductivity, UpColumn, inertia_in_darcy=True)
    spacing = height / CELLS
    step = FINE_COURANT * spacing / np.sqrt(exact.modulus / exact.mass.sum())
    best = (-np.inf, 0.0)
    for number in np.linspace(0.5 * np.pi / height, 2.0 / spacing, 400):
        values = np.linalg.eigvals(exact.systems(number)[0])
        wave = values[np.argmax(values.real)]
        damping = 0.5 * abs(wave) ** 2 * step * (1 - np.sinc(0.5 * number * spacing / np.pi) ** 8)
        best = max(best, (wave.real - damping, 2 * np.pi / number))
    return best


def difference(values, expected, scale):
    return np.sqrt(np.mean((values - expected) ** 2)) / scale


def compare(results, height, load, conductivity, pressures, ways):
    """Prints the differences of the runs of one combination, draws them; returns the largest of pressure as a share of the
    load, and how many runs there were."""
    full, up = column(height, conductivity), column(height, conductivity, UpColumn)
    ramp = 0.25 * full.slow_period
    swings = "slow wave swings" if full.slow_mode_swings() else "no swing of the slow wave"
    print(f"  H = {height:g} m, load on {load}: {swings}")
    worst, compared = 0.0, 0
    for formulation, (marker, colour) in FORMULATIONS.items():
        try:
            found = Results(folder_of(results, height, load, conductivity, formulation))
            pressure, way = found.gauge("pressure"), found.gauge("displacement")
        except ResultsError as error:
            print(f"    not compared: {error}")
            continue
        time = pressure.time
        values, displacement = pressure["pore pressure"], way["settlement"]
        exact, exact_way = full.response(PLACE, time, ramp=ramp, **{load: LOAD})
        own, own_way = exact, exact_way
        if formulation == "u-p":
            own, own_way = up.response(PLACE, time, ramp=ramp, **{load: LOAD})
        off = difference(values, own, LOAD)
        text = (f"    {formulation:5s}: pressure {100 * off:5.2f} % of the load, displacement "
                f"{100 * difference(displacement, own_way, np.abs(own_way).max()):5.2f} % of its largest; "
                f"p up to {values.max() / LOAD:.3f} q (exact {own.max() / LOAD:.3f})")
        if formulation == "u-p":
            text += f"; its equations are {100 * difference(own, exact, LOAD):.2f} % of the load off those of u-w"
        print(text)
        if compared == 0:
            for panel in pressures:
                panel.plot(1e3 * time, exact / LOAD, color="black", lw=1.2, label="exact")
            ways.plot(1e3 * time, 1e9 * exact_way, color="black", lw=1.2)
        if formulation == "u-p":
            for panel in pressures:
                panel.plot(1e3 * time, own / LOAD, color=colour, lw=0.8, ls="--", label="exact u-p")
            ways.plot(1e3 * time, 1e9 * own_way, color=colour, lw=0.8, ls="--")
        every = slice(4 * compared, None, 13)
        for panel in pressures:
            panel.plot(1e3 * time[every], values[every] / LOAD, marker, ms=4, mfc="none", color=colour, label=formulation)
        ways.plot(1e3 * time[every], 1e9 * displacement[every], marker, ms=4, mfc="none", color=colour)
        worst, compared = max(worst, off), compared + 1
    for panel in pressures:
        panel.set(title=f"H = {height:g} m, load on the {load}", xlabel="time [ms]", ylabel="pore pressure / load")
    ways.set(title=f"H = {height:g} m, load on the {load}", xlabel="time [ms]", ylabel="displacement [nm]")
    return worst, compared


def measured_growth(time, size):
    """Rate [1/s] of the last decades in which the envelope of a swing grows, or nothing."""
    envelope = np.maximum.accumulate(size)
    grown = (envelope > 3e-2) & (envelope < 0.1 * envelope[-1])
    return np.polyfit(time[grown], np.log(envelope[grown]), 1)[0] if np.sum(grown) > 4 else None


def show_failures(results):
    """What becomes of u-p with the inertia of the mixture in Darcy's law, and how fast."""
    height = HEIGHTS[0]
    print(f"u-p with the inertia of the mixture in Darcy's law, H = {height:g} m, load on skeleton, Courant number {FINE_COURANT}")
    figure, axes = plt.subplots(1, len(CONDUCTIVITIES), figsize=(16, 3.2), constrained_layout=True)
    for panel, (conductivity, printed) in zip(axes, CONDUCTIVITIES.items()):
        exact = column(height, conductivity, UpColumn, inertia_in_darcy=True)
        growth, length = fastest_growth(height, conductivity)
        try:
            found = Results(folder_of(results, height, "skeleton", conductivity, "u-p-inertia"))
            pressure = found.gauge("pressure")
        except ResultsError as error:
            print(f"  not compared: {error}")
            continue
        time, values = pressure.time, pressure["pore pressure"]
        ramp = 0.25 * exact.slow_period
        stable = column(height, conductivity, UpColumn).response(PLACE, time, skeleton=LOAD, ramp=ramp)[0]
        size = np.abs(values - stable) / LOAD
        fails = found.summary["status"] == "diverged"
        end = f"fails at t = {1e3 * found.summary['time [s]']:.3g} ms" if fails else f"runs to its end at {1e3 * time[-1]:.3g} ms"
        rate = measured_growth(time, size) if fails else None
        print(f"  k = {printed}: {end}; waves of 0.1 m grow at {exact.growth(np.pi / 0.05):.3g} 1/s, "
              f"the fastest of the grid ({1e3 * length:.2g} mm) at {growth:.3g} 1/s"
              + (f", measured {rate:.3g} 1/s" if rate else ""))
        panel.semilogy(1e3 * time, np.maximum(size, 1e-8), color="tab:green", lw=0.8)
        if fails and rate:
            panel.semilogy(1e3 * time, size[-1] * np.exp(growth * (time - time[-1])), color="black", ls="--", lw=1, label="theory")
            panel.set_ylim(1e-6, 10 * max(size.max(), 1.0))
            panel.legend(frameon=False)
        panel.set(title=f"k = {printed}", xlabel="time [ms]", ylabel="|p - p without inertia| / load")
    figure.suptitle("Formulation u-p with the inertia of the mixture in Darcy's law")
    path = results / "seepage-u-p-inertia.png"
    figure.savefig(path, dpi=100)
    plt.close(figure)
    print(f"  picture: {path}")


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
    arguments.results.mkdir(parents=True, exist_ok=True)
    for (conductivity, printed), part in zip(CONDUCTIVITIES.items(), overview.subfigures(len(CONDUCTIVITIES), 1)):
        print(f"k = {printed}")
        figure, axes = plt.subplots(2, 4, figsize=(17, 7), constrained_layout=True)
        part.suptitle(f"k = {printed}")
        small = part.subplots(1, 4)
        combinations = [(height, load) for height in HEIGHTS for load in LOADS]
        for place, (height, load) in enumerate(combinations):
            off, count = compare(arguments.results, height, load, conductivity, (axes[0, place], small[place]), axes[1, place])
            worst, compared = max(worst, off), compared + count
        for panel in (axes[0, 0], small[0]):
            panel.legend(frameon=False, fontsize="small")
        figure.suptitle(f"Pore pressure and displacement 0.05 m above the base, k = {printed}")
        path = arguments.results / f"seepage-{conductivity:g}.png"
        figure.savefig(path, dpi=100)
        plt.close(figure)
        print(f"  picture: {path}")
    show_failures(arguments.results)
    if arguments.picture:
        overview.savefig(arguments.picture, dpi=70)
        print(f"picture: {arguments.picture}")
    if not compared:
        return 1
    print(f"largest difference of pore pressure: {100 * worst:.2f} % of the load (tolerance {100 * TOLERANCE:g} %)")
    return 1 if worst > TOLERANCE else 0


if __name__ == "__main__":
    sys.exit(main())
