#!/usr/bin/python3
"""Compares factors of safety by strength reduction with published ones: slopes of Griffiths & Lane (1999), examples 1 and
3, and a vertical cut in clay. Prints them, draws them, and exits with 1 when one is outside its tolerance of 5 %.

    python3 cases/slopes/compare.py --run PROGRAM [--results results] [--picture FILE.png]
    python3 cases/slopes/compare.py [--results results] [--picture FILE.png]

With --run PROGRAM the searches are run first; without it those that lie in the results folder are compared.
"""
import argparse
import json
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = Path(__file__).resolve().parent
TOLERANCE = 0.05
# Example 3, cu2/cu1: factor of safety by finite elements, to the nearest 0.05. 1: 1.45 and 1.50 (Figs 10 and 7; by
# Taylor's stability number 1.47).
WEAK_LAYER = {1.0: (1.45, 1.50), 0.8: (1.45, 1.45), 0.6: (1.40, 1.40), 0.5: (1.25, 1.25), 0.4: (1.05, 1.05),
              0.2: (0.60, 0.60)}
STRENGTH = 50.0       # cu1 [kPa]
VERTICAL_CUT = (3.7764, 3.7776)  # gamma H / su, bounds of limit analysis
VERTICAL_CUT_LOAD = 2.5          # gamma H / su of the case


class Search:
    def __init__(self, name, case, published, bounds, settings=(), displacement=0.2, tolerance=0.02):
        self.name, self.case, self.published, self.bounds = name, case, published, bounds
        self.settings, self.displacement, self.tolerance = settings, displacement, tolerance

    def run(self, program, results):
        command = [program, "strength-reduction", HERE / self.case, "-o", results / self.name, "--lower", self.bounds[0],
                   "--upper", self.bounds[1], "--tolerance", self.tolerance, "--largest-displacement", self.displacement]
        if self.settings:
            command += ["--set", *self.settings]
        subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL)

    def found(self, results):
        file = results / self.name / "strength_reduction.json"
        return json.loads(file.read_text()) if file.exists() else None


def searches():
    yield Search("griffiths_lane_1", "griffiths_lane_1.toml", (1.38, 1.40), (1.2, 1.6), displacement=0.05)
    yield Search("vertical_cut", "vertical_cut.toml", tuple(bound / VERTICAL_CUT_LOAD for bound in VERTICAL_CUT),
                 (1.3, 1.7), displacement=0.01)
    for ratio, published in WEAK_LAYER.items():
        strength = f'soil.1.law.undrained_strength="{ratio * STRENGTH:g} kPa"'
        yield Search(f"griffiths_lane_3_{ratio:g}", "griffiths_lane_3.toml", published,
                     (round(0.85 * published[0], 2), round(1.2 * published[1], 2)), (strength,), tolerance=0.03)


def judge(search, found):
    print(search.name)
    for trial in found["trials"]:
        print(f"  F = {trial['factor']:<8.6g} {trial['verdict']}, {trial['largest displacement [m]']:.4f} m")
    factor = found["factor of safety"]
    if factor is None:
        print("  no factor of safety was found  MISSED")
        return False
    low, high = search.published
    error = factor / min(max(factor, low), high) - 1
    missed = abs(error) > TOLERANCE
    published = f"{low:.3g}" if low == high else f"{low:.3f}-{high:.3f}"
    print(f"  factor of safety {factor:.3f}, published {published}: {100 * error:+.1f} % "
          f"(tolerance {100 * TOLERANCE:g} %){'  MISSED' if missed else ''}")
    return not missed


def draw(all_found, picture):
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.2), layout="constrained")
    first = all_found.get("griffiths_lane_1")
    for stands, colour, label in ((True, "tab:blue", "stands"), (False, "tab:red", "fails")):
        trials = [trial for trial in first["trials"] if trial["stands"] == stands] if first else []
        left.semilogy([trial["factor"] for trial in trials], [trial["largest displacement [m]"] for trial in trials], "o",
                      color=colour, label=label)
    left.axvspan(1.38, 1.40, color="0.8", label="Griffiths & Lane (1999)")
    left.set(xlabel="strength reduced by F", ylabel="largest displacement [m]", title="Example 1: 2:1 slope")
    left.legend(frameon=False)
    for ratio, (low, high) in WEAK_LAYER.items():
        right.plot([ratio, ratio], [low, high], "_-", color="black", lw=1.2, ms=14, label="published" if ratio == 1.0 else None)
        found = all_found.get(f"griffiths_lane_3_{ratio:g}")
        if found and found["factor of safety"]:
            right.plot(ratio, found["factor of safety"], "o", color="#c0562f", label="computed" if ratio == 1.0 else None)
    right.set(xlabel="strength of the weak layer cu2/cu1", ylabel="factor of safety", title="Example 3: weak layer", ylim=0)
    right.legend(frameon=False)
    picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(picture, dpi=150)
    print(f"picture: {picture}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--run", metavar="PROGRAM")
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("slopes.png"))
    arguments = parser.parse_args()
    all_found, misses = {}, 0
    for search in searches():
        if arguments.run:
            search.run(arguments.run, arguments.results)
        found = search.found(arguments.results)
        if found is None:
            print(f"{search.name}: no results")
            continue
        all_found[search.name] = found
        misses += not judge(search, found)
    if not all_found:
        print(f"nothing to compare in {arguments.results}: run with --run mudlark")
        return 1
    draw(all_found, arguments.picture)
    print(f"{misses} factors are beyond their tolerance" if misses else "every factor is within its tolerance")
    return 1 if misses else 0


if __name__ == "__main__":
    sys.exit(main())
