#!/usr/bin/python3
"""Compares the run-up of solitary waves on a plane beach with Synolakis (1987): the law for the largest run-up, his
measurements beside it, and the analytical profiles of the water at six times.

    python3 cases/run_up/compare.py [--results results] [--data FOLDER] [--picture FILE.png]

Tolerances: 5 % of the law's run-up; root mean square of the profiles 5 % of the run-up. Exits with 1 beyond.
"""
import argparse
import sys
import tomllib
from pathlib import Path

import numpy as np

CASE = Path(__file__).resolve().parent
ROOT = CASE.parents[1]
if not (ROOT / "python/mudlark").is_dir():
    sys.exit("compare.py needs Mudlark's Python package: run it where it lies, in cases/ of Mudlark's source tree.")
sys.path.insert(0, str(ROOT / "python"))

import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from mudlark.findings import Findings  # noqa: E402
from mudlark.results import Results  # noqa: E402

SLOPE, SHORE, STILL, GRAVITY = 1 / 19.85, 60.0, 1.0, 9.81
RATE = np.sqrt(GRAVITY / STILL)  # times count in sqrt(d/g)


def law(height):
    """Largest run-up over the depth of waves that do not break."""
    return 2.831 * np.sqrt(1 / SLOPE) * height**1.25


def read_case(name):
    """Height of the wave over the depth, and when its crest would stand half a wave before the toe [s]."""
    wave = tomllib.loads((CASE / f"{name}.toml").read_text())["wave"][0]
    height = wave["height"] / STILL
    half = np.arccosh(np.sqrt(20)) / np.sqrt(0.75 * height)
    left = tomllib.loads((CASE / f"{name}.toml").read_text())["domain"]["lower"][0]
    way = (SHORE - 19.85 - half) - (left + wave["crest"])
    return height, way / np.sqrt(GRAVITY * STILL * (1 + height))


def surface(results, time):
    """Places and heights of the water's surface over still water, per column; NaN where it is dry."""
    state = results.field("saturation", time)
    z, alpha = state.faces(1), state.values
    x = state.centres(0)
    heights = np.full(len(x), np.nan)
    for i, column in enumerate(alpha.T):
        wet = np.flatnonzero(column >= 0.5)
        if len(wet):
            k = wet[-1]
            above = column[k + 1] * (z[k + 2] - z[k + 1]) if k + 1 < len(column) else 0.0
            heights[i] = z[k] + column[k] * (z[k + 1] - z[k]) + above
    return x, heights - STILL


def read_profiles(folder):
    """Times and, per time, x/d (positive out to sea) and the level over d."""
    path = folder / "synolakis_analytic_canonical_profiles.csv"
    if not path.exists():
        return {}
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    times = [float(title.split("=")[1]) for title in lines[0].split(",")[1:]]
    table = np.array([[float(v) for v in line.split(",")] for line in lines[1:]])
    return {time: (table[:, 0], table[:, 1 + n]) for n, time in enumerate(times)}


def draw_law(axis, folder, computed):
    path = folder / "synolakis1987_runup.csv"
    if path.exists():
        measured = np.array([[float(v) for v in line.split(",")] for line in path.read_text().splitlines()
                             if line[0].isdigit()])
        axis.loglog(measured[:, 0], measured[:, 1], ".", color="0.6", label="measured, Synolakis (1987)")
    heights = np.geomspace(0.005, 0.04)
    axis.loglog(heights, law(heights), color="black", lw=1, label="law")
    axis.loglog(*zip(*computed), "o", color="tab:blue", label="Mudlark")
    axis.set(xlabel="H / d", ylabel="R / d", xlim=(0.004, 0.06), ylim=(0.012, 0.3))
    axis.legend(fontsize=7)


def compare_profiles(results, start, profiles, axes, findings, run_up):
    squares = []
    for axis, (time, (place, exact)) in zip(axes, profiles.items()):
        x, eta = surface(results, start + time / RATE)
        offshore, known = SHORE - x, np.isfinite(eta)
        order = np.argsort(offshore[known])
        both = np.isfinite(exact) & (place > offshore[known].min())
        misses = np.interp(place[both], offshore[known][order], eta[known][order]) - exact[both]
        squares.append(misses**2)
        print(f"  t sqrt(g/d) = {time:.0f}: root mean square {1e3 * np.sqrt(np.mean(misses**2)):.2f} mm")
        axis.plot(place, exact, color="black", lw=1, label="Synolakis (1987), analytical")
        axis.plot(offshore, eta, color="tab:blue", lw=1, ls="--", label="Mudlark")
        axis.plot([-2, 20], [2 * SLOPE, -20 * SLOPE], color="tab:brown", lw=0.8)
        axis.set_title(f"t sqrt(g/d) = {time:.0f}", fontsize=8, loc="left")
        axis.set(xlim=(-2.2, 20), ylim=(-0.05, 0.11))
    axes[0].legend(fontsize=7)
    findings.check("profiles: root mean square over the run-up",
                   100 * np.sqrt(np.mean(np.concatenate(squares))) / run_up, 5)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--data", type=Path, default=ROOT.parent / "shared/validation/data")
    parser.add_argument("--picture", type=Path, default=Path("run_up.png"))
    arguments = parser.parse_args()
    findings, computed = Findings(), []
    figure, axes = plt.subplots(4, 2, figsize=(10, 10), constrained_layout=True)
    for name in sorted(path.stem for path in CASE.glob("h*.toml")):
        height, start = read_case(name)
        results = Results(arguments.results / name)
        gauge = results.gauge("run-up")
        level = next(iter(gauge.columns.values())) - STILL
        highest, when = np.nanmax(level), gauge.time[np.nanargmax(level)]
        computed.append((height, highest))
        crest = results.gauge("at the toe")
        wave = (next(iter(crest.columns.values())) - STILL)[crest.time < start + 25 / RATE].max()
        print(f"{name}: {wave:.4f} m high at the toe; run-up {highest:.4f} m at t sqrt(g/d) = "
              f"{(when - start) * RATE:.1f}, law {law(height):.4f} m")
        findings.check(f"{name}: run-up against the law", 100 * (highest / law(height) - 1), 5)
        axes[3, 1].plot((gauge.time - start) * RATE, level, lw=1, label=f"H/d = {height:g}")
    axes[3, 1].set(xlabel="t sqrt(g/d)", ylabel="run-up / d", xlim=(20, 62))
    axes[3, 1].legend(fontsize=7)
    draw_law(axes[3, 0], arguments.data, computed)
    height, start = read_case("h019")
    profiles = {time: both for time, both in read_profiles(arguments.data).items() if time <= 60}
    if profiles:
        compare_profiles(Results(arguments.results / "h019"), start, profiles, axes.ravel()[:6], findings, law(height))
    else:
        print(f"no profiles in {arguments.data}: only the law is compared")
    axes[2, 0].set(xlabel="x / d out to sea", ylabel="level / d")
    figure.savefig(arguments.picture, dpi=90)
    print(f"picture: {arguments.picture}")
    return findings.exit_code


if __name__ == "__main__":
    sys.exit(main())
