#!/usr/bin/python3
"""Compares reflection and transmission of a porous breakwater with theory (Sollitt & Cross 1972, Madsen 1974), its
resistance linearised after Lorentz: for waves of their length (progressive modes on both sides), and for long waves.

    python3 cases/porous_breakwater/compare.py [--results results] [--picture FILE.png]

Tolerance: 5 % of both coefficients for waves of their length, and for those of long.toml of the closed form for long
waves as well. Exits with 1 beyond.
"""
import argparse
import sys
from dataclasses import dataclass
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
from mudlark import reflection  # noqa: E402
from mudlark.results import Results  # noqa: E402

GRAVITY, DEPTH, WIDTH = 9.81, 0.4, 0.6
POROSITY, GRAIN, VISCOSITY = 0.45, 0.03, 1e-6
A = 1000 * (1 - POROSITY) ** 2 / POROSITY**3 * VISCOSITY / (GRAVITY * GRAIN**2)  # [s/m]
B = 1.1 * (1 - POROSITY) / POROSITY**3 / (GRAVITY * GRAIN)  # [s2/m2]
TOLERANCE = 0.05


@dataclass(frozen=True)
class Case:
    period: float  # [s]
    places: dict  # of the gauges [m]
    since: float  # [s]; whole periods until the end
    long: bool  # waves so long that the closed form for long ones holds

    @property
    def rate(self):
        return 2 * np.pi / self.period

    @property
    def number(self):
        """Wave number in open water [1/m]."""
        return brentq(lambda k: GRAVITY * k * np.tanh(k * DEPTH) - self.rate**2, 0.01, 100)


CASES = {
    "breakwater": Case(2.0, {"before": (5.0, 5.5, 6.2), "behind": (9.3, 9.8, 10.5)}, 14.0, False),
    "long": Case(5.5, {"before": (13.55, 15.05, 17.05), "behind": (22.55, 24.05, 26.05)}, 44.0, True),
}


def inner_number(case, q2):
    """Complex wave number in the pores: K tanh(K h) = w^2/g (1 - i f), Newton's method."""
    number = case.number * np.sqrt(q2)
    for _ in range(50):
        tanh = np.tanh(number * DEPTH)
        number -= (number * tanh - case.rate**2 / GRAVITY * q2) / (tanh + number * DEPTH * (1 - tanh**2))
    return number


def theory(case, height, long_waves):
    """|R|, |T| of waves of that height on the breakwater."""
    x, z = np.linspace(0, WIDTH, 201), np.linspace(0, DEPTH, 41)
    friction = 1.0
    for _ in range(800):
        q2 = 1 - 1j * friction
        outside = case.rate / np.sqrt(GRAVITY * DEPTH) if long_waves else case.number
        inside = outside * np.sqrt(q2) if long_waves else inner_number(case, q2)
        epsilon = POROSITY * inside / (q2 * outside)
        turn = np.exp(1j * inside * WIDTH)
        divisor = (1 + epsilon) ** 2 * turn - (1 - epsilon) ** 2 / turn
        transmitted = 4 * epsilon / divisor
        reflected = (1 - epsilon**2) * (turn - 1 / turn) / divisor
        forth, back = 2 * (1 + epsilon) * turn / divisor, -2 * (1 - epsilon) / turn / divisor
        speed = np.abs(0.5 * height * POROSITY * GRAVITY * inside / (case.rate * q2)
                       * (forth * np.exp(-1j * inside * x) - back * np.exp(1j * inside * x)))
        over_depth = np.ones_like(z) if long_waves else np.abs(np.cosh(inside * z) / np.cosh(inside * DEPTH))
        speed = speed[:, None] * over_depth
        mean = (speed**3).mean() / (speed**2).mean()
        friction = 0.5 * friction + 0.5 * POROSITY * GRAVITY / case.rate * (A + 8 / (3 * np.pi) * B * mean)
    return abs(reflected), abs(transmitted)


def both_ways(results, case, side):
    """Amplitudes of the waves to the right and to the left at three gauges (Mansard & Funke 1980)."""
    amplitudes = []
    for place in range(3):
        gauge = results.gauge(f"{side} {place + 1}")
        late = gauge.time >= case.since - 1e-9
        amplitudes.append(reflection.harmonic(gauge.time[late], gauge["water level"][late], case.period))
    return np.abs(reflection.split(np.array(amplitudes), np.array(case.places[side]), case.number)[:2])


def judge(name, results):
    """Prints both coefficients beside theory; says whether they are within the tolerance."""
    case = CASES[name]
    incident, returned = both_ways(results, case, "before")
    passed, from_beach = both_ways(results, case, "behind")
    good = True
    print(f"{name}: incident height {2e3 * incident:.2f} mm, k h = {case.number * DEPTH:.3f}; "
          f"the beach returns {100 * from_beach / passed:.1f} %")
    for letter, computed, exact, of_long in zip("RT", (returned / incident, passed / incident),
                                                theory(case, 2 * incident, False), theory(case, 2 * incident, True)):
        errors = [computed / exact - 1] + ([computed / of_long - 1] if case.long else [])
        good &= all(abs(error) <= TOLERANCE for error in errors)
        print(f"  {letter}: computed {computed:.3f}, theory {exact:.3f}, {100 * errors[0]:+.1f} % (tolerance "
              f"{100 * TOLERANCE:g} %); of long waves {of_long:.3f}, {100 * (computed / of_long - 1):+.1f} % "
              f"({f'tolerance {100 * TOLERANCE:g} %' if case.long else 'not judged: these waves are not long'})")
    return good


def draw(axes, name, results):
    case = CASES[name]
    gauges = [f"{side} {place}" for side in case.places for place in (1, 2, 3)]
    reach = max(np.abs(results.gauge(gauge)["water level"] - DEPTH).max() for gauge in gauges)
    for panel, title in zip(axes, gauges):
        gauge = results.gauge(title)
        panel.plot(gauge.time, 1e3 * (gauge["water level"] - DEPTH), lw=1)
        panel.axvline(case.since, color="black", lw=0.6, ls="--")
        panel.set(title=f"{name}.toml: {title}", ylabel="[mm]", ylim=(-1.1e3 * reach, 1.1e3 * reach))
    axes[-1].set_xlabel("time [s]")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("porous_breakwater.png"))
    arguments = parser.parse_args()
    figure, panels = plt.subplots(6, len(CASES), figsize=(14, 9), sharex="col", constrained_layout=True)
    good = True
    for column, name in enumerate(CASES):
        results = Results(arguments.results / name)
        good &= judge(name, results)
        draw(panels[:, column], name, results)
    figure.savefig(arguments.picture, dpi=80)
    print(f"picture: {arguments.picture}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
