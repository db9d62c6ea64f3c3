#!/usr/bin/python3
"""Compares reflection and transmission of a porous breakwater with theory (Sollitt & Cross 1972, Madsen 1974), its
resistance linearised after Lorentz: for waves of this length (progressive modes on both sides), and for long waves.

    python3 cases/porous_breakwater/compare.py [--results results] [--picture FILE.png]

Tolerance: 5 % of both coefficients for waves of this length; the long-wave values stand beside them. Exits with 1 beyond.
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
from mudlark import reflection  # noqa: E402
from mudlark.results import Results  # noqa: E402

GRAVITY, DEPTH, PERIOD, WIDTH = 9.81, 0.4, 2.0, 0.6
POROSITY, GRAIN, VISCOSITY = 0.45, 0.03, 1e-6
A = 1000 * (1 - POROSITY) ** 2 / POROSITY**3 * VISCOSITY / (GRAVITY * GRAIN**2)  # [s/m]
B = 1.1 * (1 - POROSITY) / POROSITY**3 / (GRAVITY * GRAIN)  # [s2/m2]
PLACES = {"before": (5.0, 5.5, 6.2), "behind": (9.3, 9.8, 10.5)}
FROM = 14.0  # [s]; whole periods until the end
TOLERANCE = 0.05


RATE = 2 * np.pi / PERIOD
NUMBER = brentq(lambda k: GRAVITY * k * np.tanh(k * DEPTH) - RATE**2, 0.1, 100)  # of the wave [1/m]


def inner_number(q2):
    """Complex wave number in the pores: K tanh(K h) = w^2/g (1 - i f), Newton's method."""
    number = NUMBER * np.sqrt(q2)
    for _ in range(50):
        tanh = np.tanh(number * DEPTH)
        number -= (number * tanh - RATE**2 / GRAVITY * q2) / (tanh + number * DEPTH * (1 - tanh**2))
    return number


def theory(height, long_waves):
    """|R|, |T| of waves of that height on the breakwater."""
    x, z = np.linspace(0, WIDTH, 201), np.linspace(0, DEPTH, 41)
    friction = 1.0
    for _ in range(800):
        q2 = 1 - 1j * friction
        outside = RATE / np.sqrt(GRAVITY * DEPTH) if long_waves else NUMBER
        inside = outside * np.sqrt(q2) if long_waves else inner_number(q2)
        epsilon = POROSITY * inside / (q2 * outside)
        turn = np.exp(1j * inside * WIDTH)
        divisor = (1 + epsilon) ** 2 * turn - (1 - epsilon) ** 2 / turn
        transmitted = 4 * epsilon / divisor
        reflected = (1 - epsilon**2) * (turn - 1 / turn) / divisor
        forth, back = 2 * (1 + epsilon) * turn / divisor, -2 * (1 - epsilon) / turn / divisor
        speed = np.abs(0.5 * height * POROSITY * GRAVITY * inside / (RATE * q2)
                       * (forth * np.exp(-1j * inside * x) - back * np.exp(1j * inside * x)))
        over_depth = np.ones_like(z) if long_waves else np.abs(np.cosh(inside * z) / np.cosh(inside * DEPTH))
        speed = speed[:, None] * over_depth
        mean = (speed**3).mean() / (speed**2).mean()
        friction = 0.5 * friction + 0.5 * POROSITY * GRAVITY / RATE * (A + 8 / (3 * np.pi) * B * mean)
    return abs(reflected), abs(transmitted)


def both_ways(results, side, number):
    """Amplitudes of the waves to the right and to the left at three gauges (Mansard & Funke 1980)."""
    amplitudes = []
    for place in range(3):
        gauge = results.gauge(f"{side} {place + 1}")
        late = gauge.time >= FROM - 1e-9
        amplitudes.append(reflection.harmonic(gauge.time[late], gauge["water level"][late], PERIOD))
    return np.abs(reflection.split(np.array(amplitudes), np.array(PLACES[side]), number)[:2])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("porous_breakwater.png"))
    arguments = parser.parse_args()
    results = Results(arguments.results / "breakwater")
    incident, returned = both_ways(results, "before", NUMBER)
    passed, from_beach = both_ways(results, "behind", NUMBER)
    good = True
    print(f"incident height {2e3 * incident:.1f} mm, k h = {NUMBER * DEPTH:.3f}; "
          f"the beach returns {100 * from_beach / passed:.1f} %")
    for name, computed, exact, of_long in zip("RT", (returned / incident, passed / incident),
                                              theory(2 * incident, False), theory(2 * incident, True)):
        error = computed / exact - 1
        good &= abs(error) <= TOLERANCE
        print(f"  {name}: computed {computed:.3f}, theory {exact:.3f}, {100 * error:+.1f} % "
              f"(tolerance {100 * TOLERANCE:g} %); of long waves {of_long:.3f}, {100 * (computed / of_long - 1):+.1f} %")
    figure, panels = plt.subplots(6, 1, figsize=(9, 9), sharex=True, constrained_layout=True)
    for panel, name in zip(panels, [f"{side} {place}" for side in PLACES for place in (1, 2, 3)]):
        gauge = results.gauge(name)
        panel.plot(gauge.time, 1e3 * (gauge["water level"] - DEPTH), lw=1)
        panel.axvline(FROM, color="black", lw=0.6, ls="--")
        panel.set(title=name, ylabel="[mm]", ylim=(-55, 55))
    panels[-1].set_xlabel("time [s]")
    figure.savefig(arguments.picture, dpi=80)
    print(f"picture: {arguments.picture}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
