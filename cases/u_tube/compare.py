#!/usr/bin/python3
"""Compares the levels in a U-tube with a plug of sand with h = h_0 exp(-2 k t/L).

    python3 cases/u_tube/compare.py [--results results] [--picture FILE.png]

Tolerances: 0.5 % of h_0 for the level difference on the root mean square, 1 % of the rate of decay; exits with 1 beyond.
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

START, CONDUCTIVITY, LENGTH = 0.2, 0.01, 0.2  # h_0 [m], k [m/s], L [m]
WIDTH, HEIGHT = 0.2, 0.2  # [m] of an arm, of the plug
TOLERANCES = {"levels": 0.005, "rate": 0.01}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("u_tube.png"))
    arguments = parser.parse_args()
    results = Results(arguments.results / "u_tube")
    left, right = results.gauge("left"), results.gauge("right")
    time = left.time
    difference = left["water level"] - right["water level"]
    exact = START * np.exp(-2 * CONDUCTIVITY * HEIGHT / WIDTH * time / LENGTH)
    error = np.sqrt(np.mean((difference - exact) ** 2)) / START
    flux = results.gauge("through the plug")["discharge"]
    late = (time > 0.5) & (flux > 0)
    rate = -np.polyfit(time[late], np.log(flux[late]), 1)[0]
    rate_error = rate / (2 * CONDUCTIVITY / LENGTH) - 1
    print(f"level difference: {100 * error:.2f} % of h_0 on the root mean square")
    print(f"rate of decay of the discharge: {rate:.5f} 1/s, exact {2 * CONDUCTIVITY / LENGTH:.5f} 1/s, "
          f"{100 * rate_error:+.2f} %")
    figure, panel = plt.subplots(figsize=(7, 4.2), constrained_layout=True)
    panel.semilogy(time, exact, color="black", label="h_0 exp(-2 k t/L)")
    panel.semilogy(time[::5], difference[::5], "o", ms=3, color="tab:blue", label="levels")
    panel.semilogy(time[1:], flux[1:] * LENGTH / CONDUCTIVITY / HEIGHT, color="tab:orange", lw=1,
                   label="discharge L/(k height)")
    panel.set(xlabel="time [s]", ylabel="difference of the levels [m]")
    panel.legend()
    figure.savefig(arguments.picture, dpi=90)
    print(f"picture: {arguments.picture}")
    return 0 if error <= TOLERANCES["levels"] and abs(rate_error) <= TOLERANCES["rate"] else 1


if __name__ == "__main__":
    sys.exit(main())
