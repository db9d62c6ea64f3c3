#!/usr/bin/python3
"""Compares dam breaks with experiments: fronts of Martin & Moyce (1952) and Koshizuka & Oka (1996), and the pressures
of Lobovsky et al. (2014) on the wall that the water runs against.

    python3 cases/dam_break/compare.py [--results results] [--picture FILE.png] [--data FOLDER]

The measurements are read from the validation data that lie beside a checkout, or from FOLDER; without them only the
computed curves are drawn. When the water was released is not known in an experiment whose diaphragm takes time to open,
so one lag in T is fitted to all points of a front with Z > 1.5; the pressures are compared without one.
Tolerances: a lag of at most 0.3 in T, and then 5 % of Z on the root mean square; the first impact at P1 within 3 %;
pressures within 0.2 rho g H on the root mean square up to t sqrt(g / H) = 6. Exits with 1 beyond.
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
from mudlark.results import Results  # noqa: E402

GRAVITY = 9.81      # [m/s2]
LARGEST_LAG = 0.3   # in T
TOLERANCE = 0.05
DATA = ROOT.parent / "shared/validation/data"
# name, results, width a of the column [m], file of the measurements
FRONTS = (("Martin & Moyce (1952)", "martin_moyce", 0.05715, "martin_moyce1952_front_n2_2_a2.25in.csv"),
          ("Koshizuka & Oka (1996)", "koshizuka_oka", 0.146, "koshizuka_oka1996_front.csv"))
DEPTH, DENSITY = 0.3, 997.0  # of Lobovsky's water [m], [kg/m3]
IMPACT, LARGEST_ERROR = 0.03, 0.2  # of the time; root mean square of p / (rho g H)


def measured(path):
    """Rows of two numbers of the experiment, or None when the file is not there."""
    if not path.exists():
        return None
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return np.array([[float(value) for value in line.split(",")[:2]] for line in lines[1:]])


def fitted_lag(time, front, measured):
    """Lag in T of the experiment that brings the computed front nearest, least squares of Z / Z_measured - 1."""
    lags = np.linspace(0.0, 0.6, 601)
    errors = [np.sum((np.interp(measured[:, 0] - lag, time, front) / measured[:, 1] - 1) ** 2) for lag in lags]
    return lags[int(np.argmin(errors))]


def compare_front(time, front, measured):
    """Prints the differences point by point; returns the lag and the root mean square after it."""
    measured = measured[(measured[:, 0] <= time[-1]) & (measured[:, 1] > 1.5) & (measured[:, 1] < 0.99 * front.max())]
    lag = fitted_lag(time, front, measured)
    for when, where in measured:
        lead = when - np.interp(where, front, time)
        late = np.interp(when - lag, time, front) / where - 1
        print(f"  T = {when:5.2f}: measured Z = {where:6.3f}, computed {lead:.2f} earlier, with the lag {100 * late:+5.1f} %")
    differences = np.interp(measured[:, 0] - lag, time, front) / measured[:, 1] - 1
    return lag, np.sqrt(np.mean(differences**2))


def compare_fronts(arguments, panel):
    good = True
    for (name, folder, width, file), colour in zip(FRONTS, ("tab:blue", "tab:orange")):
        gauge = Results(arguments.results / folder).gauge("front")
        time, front = gauge.time * np.sqrt(2 * GRAVITY / width), gauge["front"] / width
        panel.plot(time, front, color=colour, label=f"computed, {name}")
        points = measured(arguments.data / file)
        print(f"{name}: front along the floor")
        if points is None:
            print(f"  not compared: {file} is not there")
            continue
        lag, spread = compare_front(time, front, points)
        good &= lag <= LARGEST_LAG and spread <= TOLERANCE
        print(f"  fitted lag of the experiment: {lag:.2f} in T, {lag * np.sqrt(width / 2 / GRAVITY) * 1e3:.0f} ms "
              f"(at most {LARGEST_LAG:g})")
        print(f"  root mean square with it: {100 * spread:.1f} % of Z (tolerance {100 * TOLERANCE:g} %)")
        panel.plot(points[:, 0], points[:, 1], "o", color=colour, mec="black", label=name)
    panel.set(xlabel="T = t sqrt(2 g / a)", ylabel="front Z = x / a", ylim=(1, 14))
    panel.legend()
    return good


def compare_pressures(arguments, panels):
    results, good = Results(arguments.results / "lobovsky"), True
    print("Lobovsky et al. (2014): pressure on the wall, in rho g H")
    for panel, sensor in zip(panels, ("P1", "P3", "P4")):
        gauge = results.gauge(sensor)
        time = gauge.time * np.sqrt(GRAVITY / DEPTH)
        pressure = gauge["pressure"] / (DENSITY * GRAVITY * DEPTH)
        panel.plot(time, pressure, color="tab:blue", lw=1, label="computed")
        panel.set(title=sensor, xlabel="t sqrt(g / H)", ylabel="p / (rho g H)", xlim=(2.2, 6.3), ylim=(-0.2, 3.2))
        points = measured(arguments.data / f"lobovsky2014_{sensor.lower()}.csv")
        if points is None:
            print(f"  {sensor}: not compared, the measurements are not there")
            continue
        points = points[np.argsort(points[:, 0], kind="stable")]
        panel.plot(points[:, 0], points[:, 1], "o", ms=3, color="black", label="Lobovsky et al. (2014)")
        begin, begun = time[np.argmax(pressure > 0.1)], points[np.argmax(points[:, 1] > 0.1), 0]
        range_ = np.arange(2.6, 6.0, 0.02)
        error = np.sqrt(np.mean((np.interp(range_, time, pressure) - np.interp(range_, *points.T)) ** 2))
        print(f"  {sensor}: first above 0.1 at {begin:.3f}, measured {begun:.3f} ({100 * (begin / begun - 1):+.1f} %); "
              f"largest {pressure[time < 5].max():.2f}, measured {points[points[:, 0] < 5, 1].max():.2f}; "
              f"root mean square from 2.6 to 6: {error:.2f} (tolerance {LARGEST_ERROR:g})")
        good &= error <= LARGEST_ERROR and (sensor != "P1" or abs(begin / begun - 1) <= IMPACT)
    panels[0].legend()
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("dam_break.png"))
    parser.add_argument("--data", type=Path, default=DATA)
    arguments = parser.parse_args()
    figure, panels = plt.subplots(2, 2, figsize=(11, 8), constrained_layout=True)
    good = compare_fronts(arguments, panels[0, 0])
    good &= compare_pressures(arguments, (panels[0, 1], panels[1, 0], panels[1, 1]))
    figure.savefig(arguments.picture, dpi=90)
    print(f"picture: {arguments.picture}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
