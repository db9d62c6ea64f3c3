#!/usr/bin/python3
"""Compares the force of a wave that stands on a caisson on a rubble mound with linear theory, and the section in the plane
with the same one cell thick; a row of caissons in space, on the bed and on a mound, with the exact one on the bed; draws
the histories.

    python3 cases/caisson/compare.py [--results results] [--picture FILE.png]

- plane.toml: first harmonic of the horizontal force against the pressure of the standing wave over the wall above the
  mound, rho g a cosh k(z+d)/cosh kd, a the level's amplitude at the wall, less that of the level behind: 5 %. The incident and
  reflected waves (three gauges, Mansard & Funke 1980) and Goda's (1974) force of the crest are printed.
- slice.toml: force as in the plane, to 1e-8 of its amplitude in the first 2.4 s.
- row.toml: reflection, transmission, first harmonics of force and overturning moment against the exact ones of the incident
  wave that the gauges see (row_theory.py): 5 %. The phase of the force is printed.
- head.toml: the force as in plane.toml, from the mean levels over the front and the lee of the caisson: 5 %. No theory knows
  the mound and the gaps; how far the figures are from those of the row without a mound is printed, and the uplift beside the
  mean of the pressures at the four sides of the foot (what a thin layer under a square foot gives, by symmetry).

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
from row_theory import row as exact_row  # noqa: E402

HEIGHT, PERIOD, DEPTH, FOOT, WEIGHT = 0.03, 1.6, 0.5, 0.15, 9810.0
LENGTH = {"plane": 1.0, "slice": 0.05}  # of caisson [m]; in the plane forces are per metre
PLACES = {"before 1": 4.025, "before 2": 4.525, "before 3": 5.225}
BEHIND = {"behind 1": 8.225, "behind 2": 8.525, "behind 3": 9.225}
FRONT, WIDTH, HALF, HALF_GAP = 6.4, 0.6, 0.3, 0.3  # of the row's caissons [m]
ROWS = {"row": 0.0, "head": FOOT}  # height of the foot above the bed [m]
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


def force_per_level(foot):
    """Of a progressive or standing wave on a wall from `foot` to the level [N/m2], per metre of wall."""
    return WEIGHT * (np.sinh(K * DEPTH) - np.sinh(K * foot)) / (K * np.cosh(K * DEPTH))


def pressure_per_level(height):
    return WEIGHT * np.cosh(K * height) / np.cosh(K * DEPTH)


def moment_per_level(foot):
    """Of a level that stands higher before the caisson than behind, about the middle of its foot [N/m], per metre of length.
    On a mound the pressure under the foot falls in a line from front to lee."""
    over = lambda z: (z - foot) * np.sinh(K * z) / K - np.cosh(K * z) / K**2  # integral of (z - foot) cosh Kz
    under = pressure_per_level(foot) * WIDTH**2 / 12 if foot else 0.0
    return WEIGHT * (over(DEPTH) - over(foot)) / np.cosh(K * DEPTH) + under


def compare_plane(results, findings):
    per_level = force_per_level(FOOT)
    wall, lee, force = (amplitude(results, name) for name in ("at the wall", "behind", "force"))
    both = split(results, PLACES)
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
          f"{0.5 * WIDTH * pressure_per_level(FOOT) * abs(wall):.2f} N/m")
    return abs(force)


def split(results, places):
    records = [record(results, name) for name in places]
    time = records[0][0]
    late = time > time[-1] - PERIODS * PERIOD + 1e-9
    return reflection.regular(time[late], [level[late] - DEPTH for _, level in records], list(places.values()), PERIOD, DEPTH)


def of_caisson(results, foot):
    """Histories of force and moment about the middle of its foot, of a whole caisson [N, N m]."""
    time, force = record(results, "force")
    moment = record(results, "moment", 1)[1]
    height = 0.5 * (foot + 0.9) - foot if foot else 0.0  # of its centre above its foot
    return time, 2 * force, 2 * (moment + height * force)


def late_harmonic(time, values):
    late = time > time[-1] - PERIODS * PERIOD + 1e-9
    return reflection.harmonic(time[late], values[late], PERIOD)


def mean_level(results, where):
    return np.mean([amplitude(results, f"{where} {i}") for i in range(1, 7)])


def compare_row(results, name, foot, findings):
    """Figures of a row in space beside the exact ones of the row on the bed. Returns the exact force and moment, complex."""
    exact = exact_row(K, HALF + HALF_GAP, HALF_GAP, WIDTH)
    before, behind = split(results, PLACES), split(results, BEHIND)
    come = before.incident * np.exp(1j * (K * FRONT + before.phase))  # at the front
    time, force, moment = of_caisson(results, foot)
    force, moment = late_harmonic(time, force), late_harmonic(time, moment)
    front, lee = mean_level(results, "front"), mean_level(results, "lee")
    pull = 2 * HALF * (exact.front - exact.lee) * come
    exact_force, exact_moment = force_per_level(foot) * pull, moment_per_level(foot) * pull
    print(f"{name}: incident height {2e3 * before.incident:.2f} mm; behind, {100 * behind.coefficient:.1f} % come back from the "
          "beach")
    rows = [("reflection", before.coefficient, abs(exact.reflection)),
            ("transmission", behind.incident / before.incident, abs(exact.transmission)),
            ("mean level over the front, over the incident", abs(front / come), abs(exact.front)),
            ("mean level over the lee, over the incident", abs(lee / come), abs(exact.lee)),
            ("force on a caisson [N]", abs(force), abs(exact_force)),
            ("moment about its foot [N m]", abs(moment), abs(exact_moment))]
    checked = ("reflection", "transmission", "force on a caisson [N]", "moment about its foot [N m]")
    for text, found, wanted in rows:
        line = f"  {text}: {found:.4g}, exact without a mound {wanted:.4g}"
        if foot == 0 and text in checked:
            findings.check(line, 100 * (found / wanted - 1), 5)
        else:
            print(f"{line}: {100 * (found / wanted - 1):+.1f} %")
    print(f"  the force comes {np.degrees(np.angle(force / exact_force)):+.1f} degrees after the exact one")
    for text, found, per_level in (("force", force, force_per_level), ("moment", moment, moment_per_level)):
        linear = abs(2 * HALF * per_level(foot) * (front - lee))
        text = f"  {text} against linear theory from the levels at front and lee ({linear:.4g})"
        if foot and found is force:
            findings.check(text, 100 * (abs(found) / linear - 1), 5)
        else:
            print(f"{text}: {100 * (abs(found) / linear - 1):+.1f} %")
    if foot:
        uplift = 2 * abs(amplitude(results, "force", 2))
        around = abs(front + lee + 2 * amplitude(results, "in the gap")) / 4  # four sides of a square
        print(f"  uplift on a caisson: amplitude {uplift:.3g} N; the mean of the pressures around its foot over it "
              f"{2 * HALF * WIDTH * pressure_per_level(foot) * around:.3g} N")
    return exact_force, exact_moment


def compare_space(runs, findings, axes, plane_force):
    for axis, (name, foot) in zip(axes, ROWS.items()):
        exact_force, exact_moment = compare_row(runs[name], name, foot, findings)
        time, force, moment = of_caisson(runs[name], foot)
        late = time > time[-1] - PERIODS * PERIOD - PERIOD
        turn = np.exp(-2j * np.pi * time[late] / PERIOD)
        beside = "exact" if foot == 0 else "exact without a mound, over this height"
        axis.plot(time, force - force[0], lw=1, label="computed")
        axis.plot(time[late], (exact_force * turn).real, lw=1, ls="--", color="black", label=beside)
        axis.set(title=f"row of caissons, {'on the bed' if foot == 0 else 'on a mound'}", ylabel="force on one [N]")
        axis.legend(fontsize=8, loc="upper left")
        axes[2].plot(time, moment - moment[0], lw=1, label="on the bed" if foot == 0 else "on a mound")
        axes[2].plot(time[late], (exact_moment * turn).real, lw=1, ls="--", color="black")
    axes[2].set(ylabel="moment about the foot [N m]", xlabel="time [s]")
    axes[2].legend(fontsize=8, loc="upper left")
    force = abs(late_harmonic(*of_caisson(runs["head"], FOOT)[:2]))
    print(f"head: force per metre of caisson {force / (2 * HALF):.1f} N/m, in the plane, with no gaps, {plane_force:.1f} N/m")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("caisson.png"))
    arguments = parser.parse_args()
    runs = {name: Results(arguments.results / name) for name in (*LENGTH, *ROWS)}
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
    figure, axes = plt.subplots(3, 2, figsize=(13, 8), sharex="col", constrained_layout=True)
    for axis, gauge in zip(axes[:, 0], ("force", "moment", "at the wall")):
        time, values = record(runs["plane"], gauge)
        axis.plot(time, values if gauge != "at the wall" else 1e3 * (values - DEPTH), lw=1, label="in the plane")
    axes[0, 0].plot(slice_time, slice_force / LENGTH["slice"], ls="--", lw=1, label="one cell thick")
    axes[0, 0].set(title="caisson on a mound, plane section", ylabel="force [N/m]")
    axes[1, 0].set(ylabel="moment about the centre [N]")
    axes[2, 0].set(ylabel="level at the wall [mm]", xlabel="time [s]")
    axes[0, 0].legend(fontsize=8)
    compare_space(runs, findings, axes[:, 1], found)
    figure.savefig(arguments.picture, dpi=90)
    print(f"picture: {arguments.picture}")
    return findings.exit_code


if __name__ == "__main__":
    sys.exit(main())
