#!/usr/bin/python3
"""Bodies in water against theory: the level of water that pushes a caisson away or tips it over, on a floor and on rubble
on sand, against the balance of forces and moments; the force on a wedge that enters water, against the similarity solution of Zhao & Faltinsen (1993). Draws
them, and exits with 1 when one is outside its tolerance: 1.5 % of the level, 5 % of the force's median, mean and impulse.

The one on rubble stays at 0.9 of the head and goes at 1.1.

    python3 cases/bodies_in_water/compare.py --run PROGRAM [--results results] [--picture FILE.png]
    python3 cases/bodies_in_water/compare.py [--results results] [--picture FILE.png]
"""
import argparse
import sys
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
from mudlark.drawing import draw_solids, draw_water  # noqa: E402
from mudlark.findings import Findings, run  # noqa: E402
from mudlark.results import Results  # noqa: E402

GRAVITY, DENSITY, LEE = 9.81, 1000.0, 0.3
SHARES = (0.97, 0.99, 1.01, 1.03)  # of the level that theory says
HEADS = (0.9, 0.97, 1.03, 1.1)     # of the head that theory says, on rubble
SEAT, SEAT_LEE = 0.4, 0.15         # height of the rubble, water over it in the lee [m]
COEFFICIENT = 14.139               # F/(rho V^3 t) at 30 degrees, Zhao & Faltinsen (1993), table 1
SPEED, TOUCH = 4.0, 0.005          # of the wedge [m/s]; its tip reaches the surface [s]


def sliding_level():
    """Of the water that friction of 0.5 on 576 kg/m just holds: 0.5 rho g (h^2 - h_lee^2) = mu m g."""
    return np.sqrt(2 * 0.5 * 576 / DENSITY + LEE**2)


def tipping_level():
    """rho g (h^3 - h_lee^3)/6 = m g b/2 about the heel of a caisson 0.3 m wide and 1 m high."""
    return (6 * 1800 / DENSITY * 0.3 * 0.15 + LEE**3) ** (1 / 3)


def sliding_head():
    """On rubble: 0.5 rho g (h^2 - h_lee^2) = mu (m g - U) on 288 kg/m, 0.4 m wide, h over the rubble. By symmetry of the
    seepage under it the uplift U is that of the mean of both levels, 0.5 rho g (h + h_lee) b."""
    mass, width, friction = 1200 * 0.4 * 0.6, 0.4, 0.5
    linear = 0.5 * friction * width
    constant = 0.5 * SEAT_LEE**2 + friction * mass / DENSITY - linear * SEAT_LEE
    return -linear + np.sqrt(linear**2 + 2 * constant) - SEAT_LEE


def on_sand(head):
    """Settings of on_sand.toml: the level, and the hand that holds the caisson against it at first."""
    over = SEAT_LEE + head
    push = 0.5 * DENSITY * GRAVITY * (over**2 - SEAT_LEE**2)
    return (f"water.body.0.shape.box.upper=[1.4, {SEAT + over:.6f}]",
            f"solid.motion.force=['-{push:.3f}*(1 - min(1, max(0, (t - 0.2)/0.3)))', 0]")


def level_name(case, share):
    return f"{case}_{share:g}"


def moved(folder):
    """Has the caisson gone more than a millimetre, or turned by more than a thousandth?"""
    results = Results(folder)
    return abs(results.gauge("way")["displacement x"][-1]) > 1e-3 or abs(results.gauge("turn")["rotation"][-1]) > 1e-3


def slid(folder):
    """On ground that gives way a little: has the caisson gone more than five millimetres?"""
    return abs(Results(folder).gauge("way")["displacement x"][-1]) > 5e-3


def judge_level(findings, case, theory, results, shares=SHARES, gone=moved, tolerance=1.5):
    stood, went = [], []
    for share in shares:
        (went if gone(results / level_name(case, share)) else stood).append(share)
    print(f"{case}: theory {theory:.3f} m; stands at {', '.join(f'{s:g}' for s in stood) or 'none'} of it, "
          f"goes at {', '.join(f'{s:g}' for s in went) or 'none'}")
    between = 0.5 * (max(stood) + min(went)) if stood and went and max(stood) < min(went) else np.nan
    findings.check(f"{case}: {'head' if case == 'on_sand' else 'level'} at which the caisson gives way",
                   100 * (between - 1), tolerance)


def judge_wedge(findings, results):
    force = results.gauge("force")
    time, values = force.time, force["force z"]
    late = time > TOUCH + 0.01
    share = values[late] / (DENSITY * SPEED**3 * (time[late] - TOUCH))
    steps = np.diff(time, prepend=0.0)[late]
    impulse = np.sum(values[late] * steps) / np.sum(DENSITY * SPEED**3 * (time[late] - TOUCH) * steps)
    for name, found in (("median of its force", np.median(share)), ("mean of its force", np.mean(share)),
                        ("its impulse", impulse)):
        findings.check(f"wedge: {name}", 100 * (found / COEFFICIENT - 1), 5)
    print(f"wedge: single steps {share.min():.1f} to {share.max():.1f}, theory {COEFFICIENT:.1f}, standard deviation "
          f"{100 * np.std(share) / COEFFICIENT:.0f} %")
    return time, values


def draw(axes, results, wedge):
    for axis, case, title in ((axes[0, 0], "slides", "1.03 of the level that slides"),
                              (axes[0, 1], "topples", "1.03 of the level that tips")):
        state = Results(results / level_name(case, SHARES[-1]))
        draw_water(axis, state, state.times[-1])
        draw_solids(axis, state, state.times[-1])
        axis.set(title=f"{title}, t = {state.times[-1]:g} s", xlabel="x [m]", ylabel="z [m]", aspect="equal")
    time, values = wedge
    axes[1, 0].plot(1e3 * time, 1e-3 * values, ".", ms=3, label="computed, every step")
    axes[1, 0].plot(1e3 * time, 1e-3 * COEFFICIENT * DENSITY * SPEED**3 * np.maximum(0, time - TOUCH), "k",
                    label="Zhao & Faltinsen (1993)")
    axes[1, 0].set(title="Wedge", xlabel="t [ms]", ylabel="force [kN/m]", ylim=(0, 150))
    axes[1, 0].legend(frameon=False)
    if (results / "debris").exists():
        state = Results(results / "debris")
        time = state.times[int(np.argmin(np.abs(np.asarray(state.times) - 1.75)))]
        draw_water(axes[1, 1], state, time)
        draw_solids(axes[1, 1], state, time)
        axes[1, 1].set(title=f"debris, t = {time:g} s", xlabel="x [m]", ylabel="z [m]", aspect="equal")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--run", metavar="PROGRAM")
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("bodies_in_water.png"))
    arguments = parser.parse_args()
    levels = {"slides": sliding_level(), "topples": tipping_level()}
    if arguments.run:
        for case, level in levels.items():
            for share in SHARES:
                run(arguments.run, CASE / f"{case}.toml", arguments.results / level_name(case, share),
                    f"water.body.0.shape.box.upper=[2.0, {share * level:.6f}]")
        for share in HEADS:
            run(arguments.run, CASE / "on_sand.toml", arguments.results / level_name("on_sand", share),
                *on_sand(share * sliding_head()))
        for case in ("wedge", "debris"):
            run(arguments.run, CASE / f"{case}.toml", arguments.results / case)
    findings = Findings()
    for case, level in levels.items():
        judge_level(findings, case, level, arguments.results)
    judge_level(findings, "on_sand", sliding_head(), arguments.results, HEADS, slid, 10)
    wedge = judge_wedge(findings, Results(arguments.results / "wedge"))
    figure, axes = plt.subplots(2, 2, figsize=(11, 6), layout="constrained")
    draw(axes, arguments.results, wedge)
    arguments.picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(arguments.picture, dpi=120)
    print(f"picture: {arguments.picture}")
    return findings.exit_code


if __name__ == "__main__":
    sys.exit(main())
