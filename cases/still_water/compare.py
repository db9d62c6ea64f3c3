#!/usr/bin/python3
"""Checks that water and soil at rest stay at rest.

    python3 cases/still_water/compare.py [--results results] [--picture FILE.png]

Tolerances: pond with a step of porosity, largest speed 1e-12 m/s after 1000 steps; submerged bed, settlement after 60 s
1e-3 of gamma' H^2 / (2 M), what its own submerged weight would settle it from a stress-free start.
Exits with 1 when one is beyond its tolerance.
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
from mudlark.reference.consolidation import constrained_modulus  # noqa: E402
from mudlark.results import Results  # noqa: E402


def values(results, name):
    gauge = results.gauge(name)
    return gauge.time, next(iter(gauge.columns.values()))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("still_water.png"))
    arguments = parser.parse_args()
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.2))

    time, speed = values(Results(arguments.results / "pond"), "largest speed")
    print(f"pond: largest speed at the end {speed[-1]:.2e} m/s, ever {np.max(speed):.2e} m/s  (tolerance 1e-12)")
    left.semilogy(time, np.maximum(speed, 1e-18))
    left.set(xlabel="time [s]", ylabel="largest speed [m/s]", title="pond with a step of porosity")

    weight = (1 - 0.4) * (2650 - 1000) * 9.81                      # submerged unit weight [N/m3], bed of 1 m
    own = weight * 1.0**2 / (2 * constrained_modulus(1e6, 0.3))    # [m]
    time, settlement = values(Results(arguments.results / "submerged_bed"), "settlement")
    share = np.max(np.abs(settlement)) / own
    print(f"submerged bed: largest settlement {np.max(np.abs(settlement)):.2e} m, {share:.1e} of the self-weight value "
          f"{own:.3e} m  (tolerance 1e-3)")
    right.plot(time, settlement / own)
    right.set(xlabel="time [s]", ylabel="settlement / self-weight value", title="submerged bed")
    figure.tight_layout()
    figure.savefig(arguments.picture, dpi=100)
    print(f"picture: {arguments.picture}")
    return 1 if speed[-1] > 1e-12 or share > 1e-3 else 0


if __name__ == "__main__":
    sys.exit(main())
