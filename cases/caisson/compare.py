#!/usr/bin/python3
"""Compares the force of a wave that stands on a caisson on a rubble mound with linear theory, and the section in the plane
with the same one cell thick; draws its history.

    python3 cases/caisson/compare.py [--results results] [--picture FILE.png]

- plane.toml: first harmonic of the horizontal force against the pressure of the standing wave over the wall above the
  mound, rho g a cosh k(z+d)/cosh kd, a the level's amplitude at the wall, less that of the level behind: 5 %. The incident and
  reflected waves (three gauges, Mansard & Funke 1980) and Goda's (1974) force of the crest are printed.
- slice.toml: force as in the plane, to 1e-8 of its amplitude in the first 2.4 s.

Exits with 1 beyond.
"""
import argparse
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
from mudlark import reflection  # noqa: E402
from mudlark.findings import Findings  # noqa: E402
from mudlark.results import Results  # noqa: E402

HEIGHT, PERIOD, DEPTH, FOOT, WEIGHT = 0.03, 1.6, 0.5, 0.15, 9810.0
LENGTH = {"plane": 1.0, "slice": 0.05}  # of caisson [m]; in the plane forces are per metre
PLACES = {"before 1": 4.025, "before 2": 4.525, "before 3": 5.225}
PERIODS = 4  # at the end of a run
SAME_UNTIL = 2.4  # [s]: the wave stands on the caisson
K = float(reflection.wave_number(PERIOD, DEPTH))


def record(results, name, column=0):
    gauge = results.gauge(name)
    return gauge.time, list(gauge.columns.values())[column]


def amplitude(results, name, column=0):
    time, values = record(results, name, column)
    late = time > time[-1] - PERIODS * PERIOD + 1e-9
    return reflection.harmonic(time[late], values[late], PERIOD)


def goda_crest():
    """Goda (1974): horizontal force of the crest on the wall above the mound, no overtopping, no breaking [N/m]."""
    kd, wall = K * DEPTH, DEPTH - FOOT
    alpha_1 = 0.6 + 0.5 * (2 * kd / np.sinh(2 * kd)) ** 2
    alpha_2 = min((DEPTH - wall) / (3 * DEPTH) * (HEIGHT / wall) ** 2, 2 * wall / HEIGHT)
    alpha_3 = 1 - wall / DEPTH * (1 - 1 / np.cosh(kd))
    p_1 = (alpha_1 + alpha_2) * WEIGHT * HEIGHT
    return 0.5 * (1 + alpha_3) * p_1 * wall + 0.5 * p_1 * 1.5 * HEIGHT


def compare_plane(results, findings):
    per_level = WEIGHT * (np.sinh(K * DEPTH) - np.sinh(K * FOOT)) / (K * np.cosh(K * DEPTH))  # [N/m2]
    wall, lee, force = (amplitude(results, name) for name in ("at the wall", "behind", "force"))
    both = reflection.regular(*before(results), PERIOD, DEPTH)
    theory = abs(per_level * (wall - lee))
    print(f"incident height {2e3 * both.incident:.2f} mm (made: {1e3 * HEIGHT:g}), reflected "
          f"{100 * both.coefficient:.1f} % (their crests together {2e3 * (both.incident + both.reflected):.2f} mm), at the "
          f"wall {2e3 * abs(wall):.2f} mm, behind {2e3 * abs(lee):.2f} mm")
    print(f"horizontal force: amplitude {abs(force):.2f} N/m, linear theory {theory:.2f} N/m")
    findings.check("horizontal force against linear theory", 100 * (abs(force) / theory - 1), 5)
    time, values = record(results, "force")
    late = time > time[-1] - PERIODS * PERIOD
    crest = values[late].max() - values[late].mean()
    print(f"force of the crest {crest:.1f} N/m, Goda {goda_crest():.1f} N/m for a reflected wave of full height")
    uplift = amplitude(results, "force", 1)
    print(f"uplift: amplitude {abs(uplift):.2f} N/m; a triangle under the caisson of the wave's pressure at its foot "
          f"{0.5 * 0.6 * WEIGHT * abs(wall) * np.cosh(K * FOOT) / np.cosh(K * DEPTH):.2f} N/m")
    return abs(force)


def before(results):
    records = [record(results, name) for name in PLACES]
    time = records[0][0]
    late = time > time[-1] - PERIODS * PERIOD + 1e-9
    return time[late], [level[late] - DEPTH for _, level in records], list(PLACES.values())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("caisson.png"))
    arguments = parser.parse_args()
    runs = {name: Results(arguments.results / name) for name in LENGTH}
    findings = Findings()
    found = compare_plane(runs["plane"], findings)
    time, plane = record(runs["plane"], "force")
    slice_time, slice_force = record(runs["slice"], "force")
    difference = np.abs(slice_force / LENGTH["slice"] - plane[: len(slice_force)]) / found
    early = slice_time < SAME_UNTIL + 1e-9
    findings.check(f"one cell thick against the plane, to t = {SAME_UNTIL:g} s", difference[early].max(), 1e-8,
                   "of the amplitude")
    print(f"  (round-off grows, as in any two runs that differ in the last digit: {difference.max():.1g} at t = "
          f"{slice_time[-1]:g} s)")
    figure, axes = plt.subplots(3, 1, figsize=(9, 8), sharex=True, constrained_layout=True)
    for axis, gauge in zip(axes, ("force", "moment", "at the wall")):
        time, values = record(runs["plane"], gauge)
        axis.plot(time, values if gauge != "at the wall" else 1e3 * (values - DEPTH), lw=1, label="in the plane")
    axes[0].plot(slice_time, slice_force / LENGTH["slice"], ls="--", lw=1, label="one cell thick")
    axes[0].set(ylabel="force [N/m]")
    axes[1].set(ylabel="moment about the centre [N]")
    axes[2].set(ylabel="level at the wall [mm]", xlabel="time [s]")
    axes[0].legend(fontsize=8)
    figure.savefig(arguments.picture, dpi=90)
    print(f"picture: {arguments.picture}")
    return findings.exit_code


if __name__ == "__main__":
    sys.exit(main())
