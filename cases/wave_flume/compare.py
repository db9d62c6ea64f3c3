#!/usr/bin/python3
"""Compares a regular wave in a flume with the steady wave of the stream function: height and phase at five gauges, and
what comes back from the beach.

    python3 cases/wave_flume/compare.py [--results results] [--picture FILE.png]

Tolerances: 2 % of the height and 1 degree of phase at every gauge, 3 % reflection; exits with 1 beyond.
"""
import argparse
import sys
import tomllib
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
if not (ROOT / "python/mudlark").is_dir():
    sys.exit("compare.py needs Mudlark's Python package: run it where it lies, in cases/ of Mudlark's source tree.")
sys.path.insert(0, str(ROOT / "python"))

import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from mudlark import reflection  # noqa: E402
from mudlark.results import Results  # noqa: E402

LENGTH, PERIOD, HEIGHT, CREST, STILL = 4.11981, 2.0, 0.1, 0.058968, 0.5
FROM = 36.0  # [s]; whole periods until the end
TOLERANCES = {"height": 0.02, "phase": 1.0, "reflection": 0.03}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("wave_flume.png"))
    arguments = parser.parse_args()
    results = Results(arguments.results / "regular")
    figure, axes = plt.subplots(len(results.gauge_names), 1, figsize=(9, 9), sharex=True, constrained_layout=True)
    places, first, good = [], [], True
    case = tomllib.loads((Path(__file__).resolve().parent / "regular.toml").read_text())
    cell = case["domain"]["upper"][0] / case["domain"]["cells"][0]
    stands = {gauge["name"]: gauge["at"][0] for gauge in case["gauge"]}
    print(f"regular wave, H = {HEIGHT} m, T = {PERIOD} s on {STILL} m; from t = {FROM:g} s on")
    for panel, name in zip(axes, sorted(stands, key=stands.get)):
        gauge = results.gauge(name)
        level = next(iter(gauge.columns.values())) - STILL
        # A level is that of the column of cells that a gauge stands in: at its middle.
        place = (np.floor(stands[name] / cell + 1e-9) + 0.5) * cell
        late = gauge.time >= FROM - 1e-9
        mean = level[late][:-1].mean()  # whole periods
        amplitude = reflection.harmonic(gauge.time[late], level[late], PERIOD)
        phase = np.degrees(np.angle(amplitude * np.exp(-2j * np.pi * place / LENGTH)))
        periods = (gauge.time[late] - FROM) // PERIOD
        heights = [np.ptp(level[late][periods == n]) for n in range(int(periods.max()))]
        height = np.mean(heights) / HEIGHT - 1
        print(f"  after {name}: crest {level[late].max():.4f} m (exact {CREST:.4f}), height {100 * height:+.1f} %, "
              f"phase {phase:+.1f} degrees, mean level {1e3 * mean:+.1f} mm")
        good &= abs(height) <= TOLERANCES["height"] and abs(phase) <= TOLERANCES["phase"]
        places.append(place)
        first.append(amplitude)
        panel.plot(gauge.time, level, color="tab:blue", lw=1)
        for bound in (CREST, CREST - HEIGHT):
            panel.axhline(bound, color="black", lw=0.6, ls="--")
        panel.set(title=f"after {name}", ylabel="level [m]")
    forth, back, _ = reflection.split(np.array(first), np.array(places), 2 * np.pi / LENGTH)
    back = abs(back) / abs(forth)
    good &= back <= TOLERANCES["reflection"]
    print(f"  reflected by the beach: {100 * back:.1f} % of the wave")
    axes[-1].set_xlabel("time [s]")
    figure.savefig(arguments.picture, dpi=90)
    print(f"picture: {arguments.picture}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
