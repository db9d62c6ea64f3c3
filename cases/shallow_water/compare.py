#!/usr/bin/python3
"""Compares dam breaks on a dry and on a wet frictionless floor with the exact solutions of the shallow-water equations
(Ritter 1892, Stoker 1957).

    python3 cases/shallow_water/compare.py [--results results] [--picture FILE.png]

Tolerances at the end (t = 4 s): mean difference of depth over the disturbed reach 2 % of the initial depth, depth and
discharge at the dam 2 %, speed of the tenth of the depth on the dry floor and of the bore 4 %, depth behind the bore 4 %;
exits with 1 beyond.
"""
import argparse
import sys
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

ROOT = Path(__file__).resolve().parents[2]
if not (ROOT / "python/mudlark").is_dir():
    sys.exit("compare.py needs Mudlark's Python package: run it where it lies, in cases/ of Mudlark's source tree.")
sys.path.insert(0, str(ROOT / "python"))

import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from mudlark.results import Results  # noqa: E402

GRAVITY, DEEP, SHALLOW = 9.81, 1.0, 0.1
SPEED = np.sqrt(GRAVITY * DEEP)
TIMES = (2.0, 4.0)


def stoker_state():
    """Depth and velocity between the wave and the bore, and the bore's speed."""
    def mismatch(depth):
        return (2 * (SPEED - np.sqrt(GRAVITY * depth))
                - (depth - SHALLOW) * np.sqrt(GRAVITY * (depth + SHALLOW) / (2 * depth * SHALLOW)))
    depth = brentq(mismatch, SHALLOW * 1.0001, DEEP)
    velocity = 2 * (SPEED - np.sqrt(GRAVITY * depth))
    return depth, velocity, velocity * depth / (depth - SHALLOW)


def exact(x, time, wet):
    ray = x / time
    fan = np.where(ray < -SPEED, DEEP, (2 * SPEED - ray) ** 2 / (9 * GRAVITY))
    if not wet:
        return np.where(ray > 2 * SPEED, 0.0, fan)
    depth, velocity, bore = stoker_state()
    return np.where(ray < velocity - np.sqrt(GRAVITY * depth), fan, np.where(ray < bore, depth, SHALLOW))


def depth_of(results, time):
    state = results.field("water fraction", time=time)
    return state.centres(0), state.values.sum(axis=0) * state.spacing[1]


def travel(results, level):
    """Mean speed of the place where the depth first falls to a level, seen from the dam, between the two times [m/s]."""
    places = []
    for time in TIMES:
        x, depth = depth_of(results, time)
        first = np.flatnonzero((x > 0) & (depth <= level))[0]
        share = (depth[first - 1] - level) / (depth[first - 1] - depth[first])
        places.append(x[first - 1] + share * (x[first] - x[first - 1]))
    return (places[1] - places[0]) / (TIMES[1] - TIMES[0])


def compare(results, wet, panels):
    """Prints the differences; returns whether all are within their tolerances."""
    print("wet floor (Stoker), 1 m over 0.1 m" if wet else "dry floor (Ritter), 1 m deep")
    front_speed = stoker_state()[2] if wet else 2 * SPEED
    errors = {}
    for panel, time in zip(panels, TIMES):
        x, depth = depth_of(results, time)
        theory = exact(x, time, wet)
        reach = (x > -SPEED * time - 0.5) & (x < front_speed * time + 0.5)
        errors["profile"] = (np.abs(depth - theory)[reach].mean() / DEEP, 0.02)
        print(f"  t = {time:g} s: mean difference of depth {100 * errors['profile'][0]:.2f} % of the initial depth")
        panel.plot(x, theory, color="black", lw=1, label="shallow-water theory")
        panel.plot(x, depth, color="tab:blue", lw=1, label="computed")
        panel.set(title=f"{'wet' if wet else 'dry'} floor, t = {time:g} s", xlabel="x [m]", ylabel="depth [m]")
    at_dam = results.gauge("dam")["water level"][-1] / (4 / 9 * DEEP) - 1
    flux = results.gauge("discharge")["discharge"][-1] / (8 / 27 * DEEP * SPEED) - 1
    errors["depth at the dam"], errors["discharge at the dam"] = (at_dam, 0.02), (flux, 0.02)
    if wet:
        plateau, velocity, bore = stoker_state()
        errors["speed of the bore"] = (travel(results, 0.5 * (SHALLOW + plateau)) / bore - 1, 0.04)
        x, depth = depth_of(results, TIMES[1])
        level = (x > (velocity - np.sqrt(GRAVITY * plateau)) * TIMES[1] + 1.0) & (x < bore * TIMES[1] - 1.0)
        errors["depth behind the bore"] = (depth[level].mean() / plateau - 1, 0.04)
    else:
        ray = 2 * SPEED - 3 * np.sqrt(GRAVITY * SHALLOW)
        errors["speed of the depth 0.1 m"] = (travel(results, SHALLOW) / ray - 1, 0.04)
    for name, (error, tolerance) in errors.items():
        print(f"  {name}: {100 * error:+.2f} % (tolerance {100 * tolerance:g} %)")
    return all(abs(error) <= tolerance for error, tolerance in errors.values())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("shallow_water.png"))
    arguments = parser.parse_args()
    figure, panels = plt.subplots(2, 2, figsize=(11, 6), sharex=True, sharey=True, constrained_layout=True)
    good = compare(Results(arguments.results / "ritter"), False, panels[0])
    good &= compare(Results(arguments.results / "stoker"), True, panels[1])
    panels[0, 0].legend()
    figure.savefig(arguments.picture, dpi=90)
    print(f"picture: {arguments.picture}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
