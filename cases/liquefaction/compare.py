#!/usr/bin/env python3
"""Compares the shaken column with what is known of it: pore pressure takes over the weight of the grains while it is
shaken, and afterwards a front of settled sand rises from the base at the speed of solidification theory. Draws pressures
and front, prints the errors, and exits with 1 when one is beyond its tolerance.

    /usr/bin/python3 cases/liquefaction/compare.py [--results results] [--picture FILE.png]

--results: with the folders column and one_water of the two cases.
"""
import argparse
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
from mudlark.results import Results

CASES = {"column": "pore water of the points", "one_water": "one water"}
WATER, GRAINS, GRAVITY = 1000.0, 2650.0, 9.81
PRESSURE_TAKES_OVER = 0.95     # share of the initial vertical effective stress
FRONT_SPEED, DURATION, SETTLEMENT, BASE_PRESSURE = 0.05, 0.05, 0.03, 0.05  # tolerances; pressure as a share of its start


@dataclass
class Solidification:
    """Liquefied sand of porosity `loose` settles to `dense` (Florin & Ivanov 1961; Scott 1986): grains above the front
    sink as fast as water passes them under the gradient of their own weight, and lie still below it."""

    height: float        # [m]
    loose: float
    dense: float
    conductivity: float  # [m/s]

    @property
    def weight(self):    # submerged, above the front [N/m3]
        return (1 - self.loose) * (GRAINS - WATER) * GRAVITY

    @property
    def sinking(self):   # of the surface [m/s]
        return self.conductivity * self.weight / (WATER * GRAVITY)

    @property
    def front(self):     # speed [m/s]
        return self.sinking * (1 - self.loose) / (self.loose - self.dense)

    @property
    def last_height(self):
        return self.height * (1 - self.loose) / (1 - self.dense)

    @property
    def duration(self):  # [s]
        return self.last_height / self.front

    def base_pressure(self, time):
        """Excess over the hydrostatic pressure below the surface [Pa]."""
        return self.weight * np.maximum(self.height - (self.sinking + self.front) * time, 0.0)


class Column:
    def __init__(self, folder):
        self.results = Results(folder)
        case = tomllib.loads((Path(folder) / "case.toml").read_text())
        soil = case["soil"][0]
        self.width = soil["shape"]["box"]["upper"][0]
        settled = soil["law"]["settled_void_ratio"]
        # The resolved case has kappa = k mu / (rho_w 9.81).
        viscosity = case["water"]["viscosity"]
        conductivity = soil.get("hydraulic_conductivity") or soil["intrinsic_permeability"] * WATER * GRAVITY / viscosity
        self.theory = Solidification(soil["shape"]["box"]["upper"][1], soil["porosity"], settled / (1 + settled), conductivity)
        self.gauges = {gauge["name"]: gauge["at"][1] for gauge in case["gauge"] if gauge["quantity"] == "pore_pressure"}
        surface = next(gauge for gauge in case["gauge"] if gauge["name"] == "surface")
        self.surface_share = surface["at"][1] / self.theory.height  # settled strain is the same at all heights
        # With one water its surface stays; pore water of the points drains at their own surface.
        bodies = case["water"].get("body", [])
        self.level = bodies[0]["shape"]["box"]["upper"][1] if bodies else None
        self.status = self.results.summary.get("status", "unknown")

    def share_of_weight(self, name):
        """Excess pore pressure over the initial vertical effective stress, in time, early on."""
        gauge = self.results.gauge(name)
        pressure = gauge["pore pressure"]
        return gauge.time, (pressure - pressure[0]) / (self.theory.weight * (self.theory.height - self.gauges[name]))

    def excess_at_base(self):
        gauge, surface = self.results.gauge("p_base"), self.results.gauge("surface")
        sunk = np.interp(gauge.time, surface.time, surface["settlement"])
        depth = (self.level or self.theory.height - sunk) - self.gauges["p_base"]
        return gauge.time, gauge["pore pressure"] - WATER * GRAVITY * depth

    def front(self):
        """Height of the sand whose porosity is nearer to that of settled sand than to the loose one [m], in time."""
        times, heights = [], []
        middle = 0.5 * (self.theory.loose + self.theory.dense)
        for time in self.results.point_times:
            points = self.results.points(time)
            settled = points["porosity"] < middle
            times.append(time)
            heights.append(float(points["volume"][settled].sum() / self.width))
        return np.array(times), np.array(heights)


class Findings:
    def __init__(self):
        self.misses = 0

    def gate(self, text, error, tolerance):
        missed = not abs(error) <= tolerance
        self.misses += missed
        print(f"  {text}: {100 * error:+.1f} %  (tolerance {100 * tolerance:g} %){'  MISSED' if missed else ''}")


def judge(column, findings):
    theory = column.theory
    print(f"porosity {theory.loose:.3f} to {theory.dense:.3f}, k = {theory.conductivity:.3g} m/s, {theory.height:g} m")
    for name in column.gauges:
        time, share = column.share_of_weight(name)
        reached = share[(time > 0.8) & (time < 1.8)].mean()  # over five cycles: the pressure rings, too
        missed = reached < PRESSURE_TAKES_OVER
        findings.misses += missed
        print(f"  {name}: excess pressure takes over {reached:.3f} of the vertical effective stress "
              f"(at least {PRESSURE_TAKES_OVER:g}){'  MISSED' if missed else ''}")
    times, heights = column.front()
    rising = (heights > 0.15 * theory.last_height) & (heights < 0.9 * theory.last_height)
    speed, offset = np.polyfit(times[rising], heights[rising], 1)
    print(f"  front {speed:.4e} m/s, theory {theory.front:.4e} m/s")
    findings.gate("speed of the front", speed / theory.front - 1, FRONT_SPEED)
    end = (theory.last_height - offset) / speed
    print(f"  settled after {end:.0f} s, theory {theory.duration:.0f} s")
    findings.gate("duration", end / theory.duration - 1, DURATION)
    surface = column.results.gauge("surface")
    sunk, expected = surface["settlement"][-1], column.surface_share * (theory.height - theory.last_height)
    print(f"  settlement {1e3 * sunk:.2f} mm, theory {1e3 * expected:.2f} mm")
    findings.gate("settlement", sunk / expected - 1, SETTLEMENT)
    time, excess = column.excess_at_base()
    late = time > 0.05 * theory.duration
    start = theory.base_pressure(0.0)
    difference = (excess[late] - theory.base_pressure(time[late])) / start
    print(f"  excess pressure at the base: largest difference {100 * np.abs(difference).max():.1f} % of its start")
    findings.gate("excess pressure at the base, root mean square", np.sqrt((difference**2).mean()), BASE_PRESSURE)


def draw(column, axes):
    left, middle, right = axes
    theory = column.theory
    for name, height in column.gauges.items():
        time, share = column.share_of_weight(name)
        left.plot(time[time < 3], share[time < 3], lw=0.9, label=f"z = {height:g} m")
    left.axhline(1, color="black", lw=0.8, ls=":")
    left.set(xlabel="t [s]", ylabel="excess pore pressure / vertical effective stress", title="Shaking")
    times, heights = column.front()
    surface = column.results.gauge("surface")
    line = np.array([0.0, theory.duration])
    middle.plot(line, theory.front * line, color="black", lw=1.2, label="solidification theory")
    middle.plot(line, theory.height - theory.sinking * line, color="black", lw=1.2)
    middle.plot(times, heights, "o", ms=3, color="#c0562f", label="front")
    middle.plot(surface.time, theory.height - surface["settlement"], color="#3b6ea5", label="surface")
    middle.set(xlabel="t [s]", ylabel="z [m]", title="Front and surface", xlim=0, ylim=0)
    time, excess = column.excess_at_base()
    every = max(1, len(time) // 2000)
    right.plot(line, theory.base_pressure(line), color="black", lw=1.2, label="solidification theory")
    right.plot(time[::every], excess[::every], color="#c0562f", lw=0.9, label="computed")
    right.set(xlabel="t [s]", ylabel="excess pore pressure at the base [Pa]", title="Base")
    for axis in (left, middle, right):
        axis.legend(frameon=False, fontsize=8)
        axis.grid(color="0.92", lw=0.6)
        axis.spines[["top", "right"]].set_visible(False)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("liquefaction.png"))
    arguments = parser.parse_args()
    findings = Findings()
    figure, axes = plt.subplots(len(CASES), 3, figsize=(14, 8), layout="constrained")
    for row, (name, title) in zip(axes, CASES.items()):
        column = Column(arguments.results / name)
        print(f"{name}.toml: {title}")
        if column.status != "done":
            findings.misses += 1
            print(f"  the run is not complete: {column.status}  MISSED")
        judge(column, findings)
        draw(column, row)
        row[0].set_ylabel(f"{title}\nexcess pore pressure / vertical effective stress")
    arguments.picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(arguments.picture, dpi=110)
    print(f"picture: {arguments.picture}")
    print("every number is within its tolerance" if not findings.misses else f"{findings.misses} numbers are beyond their tolerance")
    return 1 if findings.misses else 0


if __name__ == "__main__":
    sys.exit(main())
