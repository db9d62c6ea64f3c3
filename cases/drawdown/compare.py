#!/usr/bin/python3
"""A bank before which the water falls: which strength holds it, against limit equilibrium; prints and draws it.

    /usr/bin/python3 cases/drawdown/compare.py --run build/release/bin/mudlark [--results results/drawdown]
        [--picture FILE.png]

- still.toml: under water at rest the bank stands, though its strength is what fast.toml fails with.
- fast.toml: it slips. The cohesion with which it starts to is found by halving, and compared with that of Bishop's
  simplified method on the worst circle (limit_equilibrium.py), tolerance 10 %, with u of B-bar = 1: the water in the
  pores as before, its load on the slope gone (Bishop 1954, Morgenstern 1963). Two more pressures show what that means:
  those that the program itself has at the end, and the flow net of rigid ground with its surface at zero pressure.
- slow.toml: coarse grains and a slow fall, it stands; with the fall of fast.toml it slips.

It has slipped when a point on the face has moved by a twentieth of the bank's height. Exits with 1 when a tolerance is
missed.
"""
import argparse
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
sys.path[:0] = [str(PACKAGE), str(CASE)]
from limit_equilibrium import Bank, pressure_field  # noqa: E402
from mudlark.results import Results  # noqa: E402

HEIGHT, FRICTION, COHESION = 0.5, 30.0, 300.0       # [m], [degree], [Pa] of the case files
LINE = [(0, HEIGHT), (0.7, HEIGHT), (1.7, 0), (2.2, 0)]
WEIGHT = (0.6 * 2650 + 0.4 * 1000) * 9.81           # [N/m3]
MOST = 0.05 * HEIGHT                                # displacement of a bank that stands [m]
TOLERANCE, CLOSE = 0.10, 10.0                       # of the cohesion; how closely it is found [Pa]
FALL = "opening.level.time=[0, 0.2, 3.2]"


class Runs:
    def __init__(self, program, results):
        self.program, self.results = program, results

    def folder(self, case, name, *settings):
        """Results of a case with other settings; run first where a program is given."""
        folder = self.results / name
        if self.program:
            more = ["--set", *settings] if settings else []
            subprocess.run([self.program, "run", str(CASE / f"{case}.toml"), "-o", str(folder), "--quiet", *more],
                           check=True)
        return folder

    def moved(self, case, name, *settings):
        """Largest displacement of the face [m]."""
        gauge = Results(self.folder(case, name, *settings)).gauge("face")
        return float(np.hypot(gauge["displacement x"], gauge["displacement z"]).max())


def verdict(findings, text, good):
    print(f"{text}{'' if good else '  MISS'}")
    findings.append(good)


def stands_or_slips(findings, runs):
    for case, name, settings, stands, text in (
            ("still", "still", (), True, "no fall"),
            ("fast", "fast", (), False, "0.41 mm, falls in 3 s"),
            ("slow", "slow_fast", (FALL, "time.end=5"), False, "3 mm, falls in 3 s"),
            ("slow", "slow", (), True, "3 mm, falls in 8 s")):
        moved = runs.moved(case, name, *settings)
        verdict(findings, f"c = {COHESION:.0f} Pa, {text:22s} moved by {1e3 * moved:7.2f} mm: "
                f"{'stands' if moved < MOST else 'slips'}, should {'stand' if stands else 'slip'}",
                (moved < MOST) == stands)


def strength_at_failure(runs):
    """Cohesion with which the bank just moves by MOST, and the largest one tried that stood, with its results."""
    low, high = COHESION, 2 * COHESION - 40
    tried = []
    while high - low > CLOSE:
        middle = round(0.5 * (low + high))
        name = f"fast_{middle}"
        moved = runs.moved("fast", name, f"soil.law.cohesion={middle}")
        tried.append((middle, moved))
        print(f"fast: c = {middle:.0f} Pa, moved by {1e3 * moved:7.2f} mm")
        low, high = (low, middle) if moved < MOST else (middle, high)
    if all(moved >= MOST for _, moved in tried):
        sys.exit(f"fast: it slips with {tried[-1][0]} Pa too")
    return 0.5 * (low + high), f"fast_{high}", tried


def compare_strength(findings, runs, axis):
    found, standing, tried = strength_at_failure(runs)
    bank = Bank(LINE, WEIGHT, FRICTION, (0.0, 1.0), (1.3, 1.7))
    final = Results(runs.results / standing).field("pressure")
    own = pressure_field(final.centres(0), final.centres(1), final.values.T)
    print(f"fast: slips below c = {found:.0f} Pa, c/(gamma H) = {found / (WEIGHT * HEIGHT):.4f}")
    circles = {}
    for name, pressure in (("B-bar = 1", bank.undrained), ("pore pressure of the program", own),
                           ("flow net of rigid ground", bank.flow_net(0.0125))):
        cohesion, circles[name] = bank.cohesion_at_failure(pressure, 2000.0)
        text = f"limit equilibrium, {name:30s} c = {cohesion:4.0f} Pa: found {100 * (found / cohesion - 1):+5.1f} %"
        if name == "B-bar = 1":
            verdict(findings, f"{text}  (tolerance {100 * TOLERANCE:.0f} %)", abs(found / cohesion - 1) <= TOLERANCE)
        else:
            print(text)
    cohesions, ways = np.array(sorted(tried)).T
    axis.semilogy(cohesions, 1e3 * ways, "o-", ms=3)
    axis.axhline(1e3 * MOST, color="k", lw=0.6)
    for name, (style, colour) in {"B-bar = 1": ("--", "tab:red"),
                                  "pore pressure of the program": ("-.", "tab:blue"),
                                  "flow net of rigid ground": (":", "tab:green")}.items():
        pressure = {"B-bar = 1": bank.undrained, "pore pressure of the program": own}.get(name)
        cohesion = bank.cohesion_at_failure(pressure or bank.flow_net(0.0125), 2000.0)[0]
        axis.axvline(cohesion, color=colour, ls=style, lw=0.9, label=f"Bishop, {name}")
    axis.set(xlabel="cohesion [Pa]", ylabel="way of the face [mm]")
    axis.legend(fontsize=6, frameon=False)
    return bank, circles["B-bar = 1"]


def draw_state(folder, time, axis, title):
    results = Results(folder)
    water, points = results.field("saturation", time=time), results.points(time=time)
    axis.contourf(water.centres(0), water.centres(1), water.values, levels=[0.5, 1.1], colors=["#cfe3f5"])
    pressure = results.field("pressure", time=time)
    axis.contour(pressure.centres(0), pressure.centres(1), pressure.values / 9810, levels=np.arange(0, 0.5, 0.05),
                 colors="tab:blue", linewidths=0.4)
    place, way = points["position"], points["displacement"]
    dots = axis.scatter(place[:, 0], place[:, 2], c=np.hypot(way[:, 0], way[:, 2]), s=1, cmap="viridis")
    plt.colorbar(dots, ax=axis, label="way [m]", shrink=0.7)
    axis.set_aspect("equal")
    axis.set_title(title, fontsize=8, loc="left")


def draw_circle(bank, circle, axis):
    """The arc of a circle (upper, lower, sagitta)."""
    bank.circles = [np.array([value]) for value in circle]
    x, z = bank.slices()[:2]
    ends = [circle[0], *x[0], circle[1]], [bank.surface(circle[0]), *z[0], bank.surface(circle[1])]
    axis.plot(*ends, "r--", lw=0.9)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--run", metavar="PROGRAM", help="run the cases with this program first")
    parser.add_argument("--results", type=Path, default=Path("results/drawdown"))
    parser.add_argument("--picture", type=Path, default=Path("drawdown.png"))
    arguments = parser.parse_args()
    runs, findings = Runs(arguments.run, arguments.results), []
    figure, axes = plt.subplots(2, 2, figsize=(11, 5.5), layout="constrained")
    stands_or_slips(findings, runs)
    bank, circle = compare_strength(findings, runs, axes[1, 1])
    draw_state(arguments.results / "fast", 3.0, axes[0, 0], "fast, 3 s; red: worst circle of Bishop's, B-bar = 1")
    draw_circle(bank, circle, axes[0, 0])
    draw_state(arguments.results / "fast", 5.0, axes[0, 1], "fast, 5 s")
    draw_state(arguments.results / "slow", 10.0, axes[1, 0], "slow, 10 s")
    arguments.picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(arguments.picture, dpi=110)
    print(f"picture: {arguments.picture}")
    return 0 if all(findings) else 1


if __name__ == "__main__":
    sys.exit(main())
