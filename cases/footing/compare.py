#!/usr/bin/python3
"""Compares the bearing capacity of strip footings with the exact theory of plasticity, prints and draws it.

    mudlark run cases/footing/clay.toml        (and clay_rough.toml, clay_implicit.toml, sand.toml)
    /usr/bin/python3 cases/footing/compare.py [--results results] [--picture FILE.png]

- clay, smooth and rough, and smooth in implicit steps: q = N_c s_u, N_c = 2 + pi (Prandtl 1921); tolerance 3 %.
- sand, smooth, phi = 30 degrees, no cohesion, no surcharge: q = gamma B N_gamma / 2, N_gamma = 7.653 (Martin 2005);
  tolerance 8 %.

The load at the end counts; a curve that still climbs by more than 2 % over the last quarter of the settlement is a miss
too (locking). Exits with 1 when a tolerance is missed.
"""
import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

PACKAGE = Path(__file__).resolve().parents[2] / "python"
if not (PACKAGE / "mudlark").is_dir():
    sys.exit("compare.py needs Mudlark's Python package: run it where it lies, in cases/ of Mudlark's source tree.")
sys.path.insert(0, str(PACKAGE))
from mudlark.results import Results  # noqa: E402

HALF_WIDTH = 1.0                                   # [m]
STRENGTH = 10e3                                    # s_u [Pa]
WEIGHT = (1 - 0.4) * 2650 * 9.81                   # gamma of the dry sand [N/m3]
CASES = {"clay": ("N_c, smooth", 2 + np.pi, STRENGTH, 0.03),
         "clay_rough": ("N_c, rough", 2 + np.pi, STRENGTH, 0.03),
         "clay_implicit": ("N_c, implicit", 2 + np.pi, STRENGTH, 0.03),
         "sand": ("N_gamma, smooth", 7.653, WEIGHT * HALF_WIDTH, 0.08)}
MOST_CLIMB = 0.02


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("footing.png"))
    arguments = parser.parse_args()
    figure, axes = plt.subplots(1, 2, figsize=(10, 4))
    missed = 0
    for name, (title, exact, unit, tolerance) in CASES.items():
        folder = arguments.results / name
        if not folder.is_dir():
            print(f"{name}: {folder} is not there; first run cases/footing/{name}.toml")
            continue
        results = Results(folder)
        force, way = results.gauge("force"), results.gauge("settlement")
        factor = force["force z"] / HALF_WIDTH / unit     # half a footing: force per half width
        settlement = -np.interp(force.time, way.time, way["displacement z"]) / (2 * HALF_WIDTH)
        late = settlement > 0.75 * settlement[-1]
        found = np.mean(factor[settlement > 0.95 * settlement[-1]])
        climb = np.polyval(np.polyfit(settlement[late], factor[late], 1), settlement[[-1]])[0] \
            / np.polyval(np.polyfit(settlement[late], factor[late], 1), 0.75 * settlement[-1]) - 1
        hit = abs(found / exact - 1) <= tolerance and abs(climb) <= MOST_CLIMB
        missed += not hit
        print(f"{title:16s} {found:7.3f}  exact {exact:6.3f}  {100 * (found / exact - 1):+5.1f} % (tolerance "
              f"{100 * tolerance:g} %), climbs by {100 * climb:+.1f} % over the last quarter" + ("" if hit else "  MISSED"))
        axis = axes[1] if name == "sand" else axes[0]
        axis.plot(100 * settlement, factor, label=title)
        axis.axhline(exact, color="k", linestyle="--", linewidth=0.8)
    for axis, label in ((axes[0], "q / s_u"), (axes[1], "2 q / (gamma B)")):
        axis.set(xlabel="settlement / B [%]", ylabel=label, ylim=(0, None))
        axis.legend()
    figure.tight_layout()
    figure.savefig(arguments.picture, dpi=100)
    print(f"picture: {arguments.picture}")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
