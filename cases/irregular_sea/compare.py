#!/usr/bin/python3
"""Compares an irregular sea where a structure would stand with the spectrum that it was made from (JONSWAP), and splits
it into the waves that come and those that the beach returns (Mansard & Funke 1980).

    python3 cases/irregular_sea/compare.py [--results results] [--picture FILE.png]

- sea.toml: H_m0 = 0.06 m. low.toml: the same waves half as high, on cells half as high around the level.
- long.toml: as sea.toml in a flume of 60 m. Levels of sea.toml less those of the long flume, 25 to 60 s, are what the beach
  returns, bound waves or free: no analysis that knows free waves alone stands between.

Tolerances: 5 % of H_m0 of the incident waves, 5 % of T_p (its estimate from the moments of f S^4, Young 1995), 5 %
reflection by Mansard & Funke, and of sea.toml by the long flume. Exits with 1 beyond.
"""
import argparse
import sys
import tomllib
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
from mudlark import reflection  # noqa: E402
from mudlark.findings import Findings  # noqa: E402
from mudlark.results import Results  # noqa: E402

HEIGHTS, PERIOD, DEPTH = {"sea": 0.06, "low": 0.03}, 1.5, 0.5  # [m], [s], [m]
FROM = 25.0  # [s]: the slowest waves of the sea have come to the beach
UNTIL = 60.0  # [s]: until then nothing comes back in the long flume


def jonswap(frequency, height):
    """[m2 s], scaled to H_m0 = height [m] over half to four times the peak frequency, where the sea has components."""
    ratio = frequency * PERIOD
    width = np.where(ratio <= 1, 0.07, 0.09)
    form = ratio**-5.0 * np.exp(-1.25 * ratio**-4.0) * 3.3 ** np.exp(-((ratio - 1) ** 2) / (2 * width**2))
    fine = np.linspace(0.5, 4, 2000) / PERIOD
    ratio_fine = fine * PERIOD
    width_fine = np.where(ratio_fine <= 1, 0.07, 0.09)
    form_fine = (ratio_fine**-5.0 * np.exp(-1.25 * ratio_fine**-4.0)
                 * 3.3 ** np.exp(-((ratio_fine - 1) ** 2) / (2 * width_fine**2)))
    return form * (height / 4) ** 2 / np.trapz(form_fine, fine)


def peak_period(frequency, density):
    """Integral of S^4 over that of f S^4 (Young 1995): steadier than the place of the largest value."""
    good = np.isfinite(density)
    return np.sum(density[good] ** 4) / np.sum(frequency[good] * density[good] ** 4)


def read(results, name, end=np.inf):
    """Places of the gauges, times and their levels [m] from FROM on."""
    places, levels = [], []
    for gauge in tomllib.loads((CASE / f"{name}.toml").read_text())["gauge"]:
        record = results.gauge(gauge["name"])
        late = (record.time >= FROM - 1e-9) & (record.time <= end + 1e-9)
        time = record.time[late]
        places.append(gauge["at"][0])
        levels.append(next(iter(record.columns.values()))[late] - DEPTH)
    return places, time, np.array(levels)


def compare(results, name, findings, panels):
    height = HEIGHTS[name]
    places, time, levels = read(results, name)
    sea = reflection.irregular(time, levels, places, DEPTH, PERIOD, bands=40)
    target = jonswap(sea.frequency, height)
    print(f"{name}: H_m0 = {height} m, T_p = {PERIOD} s on {DEPTH} m; {time[-1] - time[0]:.0f} s from t = {time[0]:g} s on, "
          f"{(time[-1] - time[0]) / PERIOD:.0f} waves")
    # What the target has within the bands that the gauges can tell apart.
    known = np.isfinite(sea.incident)
    wanted = 4 * np.sqrt(np.sum(target[known]) * (sea.frequency[1] - sea.frequency[0]))
    print(f"  H_m0 of the whole level: {' '.join(f'{4e3 * np.std(level):.1f}' for level in levels)} mm at the four gauges")
    findings.check(f"  incident H_m0 {1e3 * sea.incident_height:.1f} mm (target {1e3 * wanted:.1f})",
                   100 * (sea.incident_height / wanted - 1), 5)
    exact = peak_period(sea.frequency, target)
    found = peak_period(sea.frequency, sea.incident)
    findings.check(f"  T_p {found:.3f} s (target {exact:.3f})", 100 * (found / exact - 1), 5)
    findings.check("  reflection of the beach by Mansard & Funke", round(100 * sea.coefficient, 2), 5)
    for text, low, high in (("up to 1.5", 0.5, 1.5), ("above 1.5", 1.5, 3.0)):
        inside = known & (sea.frequency * PERIOD > low) & (sea.frequency * PERIOD <= high)
        incident, back = (np.sum(spectrum[inside]) for spectrum in (sea.incident, sea.reflected))
        print(f"    {text} times the peak's frequency: {100 * np.sqrt(back / incident):.1f} % "
              f"({100 * back / np.nansum(sea.reflected):.0f} % of what counts as reflected)")
    left, right = panels
    fine = np.linspace(0.3, 2.0, 400)
    left.plot(fine, 1e4 * jonswap(fine, height), color="black", lw=1, label="JONSWAP, the target")
    left.plot(sea.frequency, 1e4 * sea.incident, "o-", ms=3, lw=0.8, color="tab:blue", label="incident, at 9 to 10 m")
    left.plot(sea.frequency, 1e4 * sea.reflected, lw=0.8, color="tab:red", label="reflected")
    left.set(title=f"{name}: H_m0 = {height} m", xlabel="frequency [Hz]", ylabel="density [cm2 s]")
    left.legend(fontsize=8)
    right.plot(time, 1e3 * levels[0], lw=0.7)
    right.set(xlabel="time [s]", ylabel="level [mm]", xlim=(FROM, min(FROM + 60, time[-1])))


def compare_long(sea_results, long_results, findings, axis):
    places, time, levels = read(sea_results, "sea", UNTIL)
    _, long_time, alone = read(long_results, "long", UNTIL)
    if not np.allclose(time, long_time):
        sys.exit("compare.py needs sea.toml and long.toml with gauges at the same times.")
    back = levels - alone
    print(f"what the beach returns, sea less long, t = {FROM:g} to {UNTIL:g} s:")
    findings.check("  H_m0 of it, over that of the sea", 100 * np.std(back) / np.std(alone), 5)
    split, sea, short = (reflection.irregular(time, of, places, DEPTH, PERIOD, bands=40) for of in (back, alone, levels))
    total = np.nansum(sea.incident)
    print(f"    of it, waves that run back {100 * np.sqrt(np.nansum(split.reflected) / total):.1f} %, and forth (what differs "
          f"between the runs, and waves that the maker returns) {100 * np.sqrt(np.nansum(split.incident) / total):.1f} %")
    for text, low, high in (("up to 1.5", 0.5, 1.5), ("above 1.5", 1.5, 3.0)):
        inside = np.isfinite(sea.incident) & (sea.frequency * PERIOD > low) & (sea.frequency * PERIOD <= high)
        share = np.sqrt(np.sum(split.reflected[inside]) / np.sum(sea.incident[inside]))
        print(f"    run back {text} times the peak's frequency: {100 * share:.1f} %")
    print(f"  Mansard & Funke over these {UNTIL - FROM:g} s: {100 * short.coefficient:.1f} %; in the long flume, where nothing "
          f"comes back, they find {100 * sea.coefficient:.1f} %")
    axis.plot(time, 1e3 * back[0], color="tab:red", lw=0.7, label="less the level in the long flume")
    axis.legend(fontsize=8)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("irregular_sea.png"))
    arguments = parser.parse_args()
    findings = Findings()
    figure, axes = plt.subplots(2, 2, figsize=(11, 7), constrained_layout=True)
    for name, panels in zip(HEIGHTS, axes):
        compare(Results(arguments.results / name), name, findings, panels)
    compare_long(Results(arguments.results / "sea"), Results(arguments.results / "long"), findings, axes[0, 1])
    figure.savefig(arguments.picture, dpi=90)
    print(f"picture: {arguments.picture}")
    return findings.exit_code


if __name__ == "__main__":
    sys.exit(main())
