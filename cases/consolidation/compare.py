#!/usr/bin/env python3
"""Compares the consolidation runs with theory: draws settlement against time (the paper's Fig. 3) and Terzaghi's
isochrones, prints the errors, and exits with 1 when one is beyond its tolerance.

    python3 cases/consolidation/compare.py [FOLDER ...] [--results results] [--picture FILE.png]

Without folders it takes every results folder of these cases under --results; what is missing is said, not counted
as a failure. Tolerances: 1 % of the final settlement for settlements, 1 % of the load for Terzaghi's pressures.
"""
import argparse
import re
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

PACKAGE = Path(__file__).resolve().parents[2] / "python"
if not (PACKAGE / "mudlark").is_dir():
    sys.exit("compare.py needs Mudlark's Python package: run it where it lies, in cases/ of Mudlark's source tree.")
sys.path.insert(0, str(PACKAGE))
from mudlark.reference.consolidation import LargeStrainColumn, Terzaghi, constrained_modulus, final_settlement
from mudlark.results import Results

TOLERANCE = 0.01
KINDS = {"terzaghi": "small strain, Terzaghi", "mpm": "soil alone", "coupled": "water and soil", "tutorial": "tutorial"}
COLOURS = {"mpm": "#c0562f", "coupled": "#1f6fb2", "tutorial": "#5b8c3a"}


@dataclass
class Run:
    """One results folder, with what its resolved case file says."""

    name: str
    results: Results
    kind: str
    law: str
    load: float       # [Pa]
    ramp: float       # [s]
    modulus: float    # [Pa]
    porosity: float
    conductivity: float
    water_modulus: float
    height: float
    gravity: float
    geostatic: bool

    @property
    def settlement(self):
        gauge = self.results.gauge("settlement")
        return gauge.time, gauge["settlement"]

    def column(self):
        return LargeStrainColumn(law=self.law, height=self.height, modulus=self.modulus, porosity=self.porosity,
                                 conductivity=self.conductivity, load=self.load, ramp=self.ramp,
                                 water_modulus=self.water_modulus, self_weight=self.geostatic)


def load_of(case, gravity, height):
    """Load [Pa] and the time over which it comes [s]."""
    bodies = case["water"].get("body", [])
    if bodies:
        top = max(body["shape"]["box"]["upper"][1] for body in bodies)
        return case["water"]["density"] * gravity * (top - height), case["coupling"].get("ramp", 0.0)
    pressure = case["load"][0]["pressure"]
    if isinstance(pressure, str):  # "400000 * (t < 0.036 ? 0.5 * (1 - cos(pi * t / 0.036)) : 1)"
        ramp = re.search(r"t\s*<\s*([0-9.eE+-]+)", pressure)
        return float(re.match(r"[0-9.eE+-]+", pressure)[0]), float(ramp[1]) if ramp else 0.0
    return float(pressure), 0.0


def read_run(folder):
    results = Results(folder)
    case = tomllib.loads((Path(folder) / "case.toml").read_text())
    soil, water = case["soil"][0], case["water"]
    gravity = abs(case["domain"]["gravity"][-1])
    height = soil["shape"]["box"]["upper"][1]
    load, ramp = load_of(case, gravity, height)
    law = soil["law"]
    start = {gauge["name"]: gauge["at"][-1] for gauge in case["gauge"] if gauge.get("quantity") == "settlement"}
    if water.get("body"):
        kind = "coupled"
    elif soil.get("initial_pore_pressure"):
        kind = "terzaghi"
    else:
        kind = "mpm" if start["settlement"] == height else "tutorial"
    conductivity = soil["intrinsic_permeability"] * water["density"] * 9.81 / water["viscosity"]
    return Run(Path(folder).name, results, kind, law["strain"], load, ramp,
               constrained_modulus(law["young_modulus"], law["poisson_ratio"]), soil["porosity"], conductivity,
               water["bulk_modulus"], height, gravity, soil.get("initial_stress") == "geostatic" and gravity > 0)


class Findings:
    """Prints each number beside its tolerance and remembers misses."""

    def __init__(self):
        self.misses = 0

    def gate(self, text, error, tolerance=TOLERANCE):
        missed = not abs(error) < tolerance
        self.misses += missed
        print(f"  {text}: {100 * error:+.3f} %  (tolerance {100 * tolerance:g} %){'  MISSED' if missed else ''}")

    def ended(self, run):
        """Has the run anything to judge? One that is not complete is a miss all the same."""
        status = run.results.summary.get("status", "unknown")
        print(f"{run.name} ({KINDS[run.kind]}, law {run.law}, k = {run.conductivity:.3g} m/s)")
        if status != "done":
            self.misses += 1
            print(f"  the run is not complete: {status}  MISSED")
        return run.settlement[0].size > 1


def judge_settlement(run, findings, axes):
    """Large-strain runs against the reference column of the same law, load and permeability."""
    if not findings.ended(run):
        return
    time, settlement = run.settlement
    asked = time[time > 0]
    reference = run.column().solve(asked)
    exact = final_settlement(run.law, run.load, run.modulus, run.height)
    computed = settlement[time > 0]
    print(f"  settlement at t = {time[-1]:g} s: {settlement[-1]:.5f} m; theory then {reference.settlement[-1]:.5f} m, "
          f"at the end of all time {exact:.5f} m")
    finished = reference.settlement[-1] > 0.995 * exact
    findings.gate("final settlement against the exact one" if finished else "settlement at the last time against theory",
                  settlement[-1] / (exact if finished else reference.settlement[-1]) - 1)
    difference = (computed - reference.settlement) / exact
    worst = np.argmax(np.abs(difference))
    findings.gate(f"largest difference from the reference at any time (t = {asked[worst]:g} s), of the final settlement",
                  difference[worst])
    for share in (0.5, 0.9):
        ours, theirs = (np.interp(share * exact, s, asked) for s in (computed, reference.settlement))
        print(f"  t{100 * share:.0f} = {ours:.2f} s, reference {theirs:.2f} s")
    shown = asked * run.conductivity / 1e-4  # consolidation takes its time as 1/k
    axes.plot(shown, reference.settlement, color="black", lw=1.2, zorder=1)
    axes.axhline(exact, color="0.6", lw=0.8, ls=":", zorder=0)
    axes.annotate(f"{run.law}: {exact:.4f} m", (shown[-1], exact), xytext=(-4, -4), textcoords="offset points", ha="right",
                  va="top", fontsize=8, color="0.4")
    every = max(1, len(asked) // 40)
    first = every // 2 if run.kind == "coupled" else 0  # so that the two runs' marks do not hide each other
    axes.plot(shown[first::every], computed[first::every], "o" if run.kind == "mpm" else "s", ms=4.5, mew=1.2,
              mfc="none", color=COLOURS[run.kind], label=f"{KINDS[run.kind]} ({run.law}, k = {run.conductivity:.0e} m/s)",
              zorder=2)


def judge_pair(coupled, mpm, findings):
    """The same column under the same load, once as the weight of water."""
    time, settlement = coupled.settlement
    other = np.interp(time, *mpm.settlement)
    final = final_settlement(mpm.law, mpm.load, mpm.modulus, mpm.height)
    if time.size < 2:
        return
    within = time <= mpm.settlement[0][-1]
    difference = ((settlement - other) / final)[within]
    worst = np.argmax(np.abs(difference))
    print(f"{coupled.name} against {mpm.name}")
    findings.gate(f"largest difference in settlement (t = {time[within][worst]:g} s)", difference[worst])


def judge_tutorial(run, findings, axes):
    """The point that starts at 0.983 m goes down by that share of the column's settlement."""
    if not findings.ended(run):
        return
    time, settlement = run.settlement
    exact = 0.983 * final_settlement(run.law, run.load, run.modulus, run.height)
    print(f"  settlement of the point from 0.983 m at t = {time[-1]:g} s: {settlement[-1]:.4f} m, theory {exact:.4f} m")
    findings.gate("settlement against theory", settlement[-1] / exact - 1)
    asked = time[time > 0]
    reference = run.column().solve(asked)
    axes.plot(asked, reference.settlement_of(0.983), color="black", lw=1.2, label="theory")
    axes.plot(time, settlement, color=COLOURS["tutorial"], lw=1.6, label="computed")
    axes.set(xlabel="time [s]", ylabel="settlement [m]", title="Tutorial oedometer, point from 0.983 m")
    axes.invert_yaxis()
    axes.legend(frameon=False)


def judge_terzaghi(run, findings, axes):
    """Isochrones of the pore pressure at the material points."""
    findings.ended(run)
    theory = Terzaghi(run.height, run.modulus, run.porosity, run.conductivity, run.load, run.water_modulus)
    heights = np.linspace(0, run.height, 201)
    squares = []
    for time in run.results.point_times:
        factor = float(theory.time_factor(time))
        if not 0.0199 <= factor <= 1.001:
            continue
        points = run.results.points(time)
        height, pressure = points["initial position"][:, 2], points["pore pressure"]
        error = (pressure - theory.pressure(height, time)) / run.load
        squares.append(np.mean(error**2))
        findings.gate(f"T = {factor:.3f}: root mean square over the height, of the load", np.sqrt(squares[-1]))
        colour = plt.cm.viridis(0.9 * np.sqrt(factor))
        axes.plot(theory.pressure(heights, time) / run.load, heights / run.height, color="black", lw=0.9)
        axes.plot(pressure / run.load, height / run.height, ".", ms=3.5, color=colour, label=f"T = {factor:.2g}")
    if squares:
        findings.gate("all times together", np.sqrt(np.mean(squares)))
    else:
        print("  no output between T = 0.02 and T = 1: nothing to compare")
    time, settlement = run.settlement
    asked = theory.time_factor(time) >= 0.02
    if asked.any():
        difference = (settlement - theory.settlement(time)) / (run.load * run.height / run.modulus)
        # The run starts from the undrained column, whose settlement under the sudden load the gauge does not see.
        difference += theory.settlement(0.0)[0] / (run.load * run.height / run.modulus)
        worst = np.argmax(np.abs(difference[asked]))
        findings.gate("settlement from T = 0.02 on, largest difference of the final one", difference[asked][worst])
    axes.set(xlabel="pore pressure / load", ylabel="height / H", title=f"Isochrones, k = {run.conductivity:.2g} m/s",
             xlim=(0, 1.05), ylim=(0, 1))
    axes.legend(fontsize=8, frameon=False, markerscale=2)


def folders_of(arguments):
    if arguments.folders:
        return arguments.folders
    return sorted(case.parent for case in arguments.results.glob("*/case.toml")
                  if "onsolidation" in case.read_text().split("\n")[0] or "oedometer" in case.read_text().split("\n")[0])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="*", type=Path)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=None)
    arguments = parser.parse_args()
    runs = [read_run(folder) for folder in folders_of(arguments)]
    of = {kind: [run for run in runs if run.kind == kind] for kind in KINDS}
    missing = [kind for kind in KINDS if not of[kind]]
    if not runs:
        print(f"nothing to compare: there are no results of these cases in {arguments.results}")
        return 1

    panels = [bool(of["mpm"] or of["coupled"]), bool(of["terzaghi"]), bool(of["tutorial"])]
    figure, axes = plt.subplots(1, sum(panels), figsize=(1.5 + 5.2 * sum(panels), 4.8), layout="constrained", squeeze=False)
    free = list(axes[0])
    findings = Findings()
    if panels[0]:
        main_axes = free.pop(0)
        for run in of["mpm"] + of["coupled"]:
            judge_settlement(run, findings, main_axes)
        for coupled in of["coupled"]:
            for mpm in of["mpm"]:
                if mpm.law == coupled.law and np.isclose(mpm.conductivity, coupled.conductivity, rtol=1e-6):
                    judge_pair(coupled, mpm, findings)
        main_axes.plot([], [], color="black", lw=1.2, label="reference of the same law")
        main_axes.set(xlabel="time times k / (1e-4 m/s) [s]", ylabel="settlement of the top [m]", title="Column of 1 m under 400 kPa")
        main_axes.set_xlim(left=0)
        main_axes.set_ylim(bottom=0)
        main_axes.invert_yaxis()
        main_axes.legend(frameon=False)
    if panels[1]:
        isochrone_axes = free.pop(0)
        for index, run in enumerate(of["terzaghi"]):
            judge_terzaghi(run, findings, isochrone_axes if index == 0 else plt.figure().gca())
    for index, run in enumerate(of["tutorial"]):
        judge_tutorial(run, findings, free[0] if index == 0 else plt.figure().gca())
    for axis in axes[0]:
        axis.grid(color="0.92", lw=0.6)
        axis.set_axisbelow(True)
        axis.spines[["top", "right"]].set_visible(False)
    if missing:
        print(f"not compared, because there are no results of them: {', '.join(missing)}")
    picture = arguments.picture or (arguments.folders[0].parent if arguments.folders else arguments.results) / "consolidation.png"
    picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(picture, dpi=150)
    print(f"picture: {picture}")
    print("every number is within its tolerance" if not findings.misses else f"{findings.misses} numbers are beyond their tolerance")
    return 1 if findings.misses else 0


if __name__ == "__main__":
    sys.exit(main())
