#!/usr/bin/python3
"""Compares the factor of safety of the slope with Griffiths & Lane (1999), prints the trials and draws them.

    mudlark strength-reduction cases/slopes/griffiths_lane_1.toml
    python3 cases/slopes/compare.py [--run PROGRAM] [--results results] [--picture FILE.png]

With --run PROGRAM the trials are run first. Exits with 1 when the factor is more than 5 % outside the published 1.38-1.40.
"""
import argparse
import json
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

PUBLISHED = (1.38, 1.40)   # chart of Bishop & Morgenstern, finite elements of Griffiths & Lane
TOLERANCE = 0.05


def draw(found, picture):
    figure, axes = plt.subplots(figsize=(6, 4.2))
    for stands, colour, label in ((True, "tab:blue", "stands"), (False, "tab:red", "fails")):
        trials = [trial for trial in found["trials"] if trial["stands"] == stands]
        axes.semilogy([trial["factor"] for trial in trials],
                      [trial["largest displacement [m]"] for trial in trials], "o", color=colour, label=label)
    axes.axvspan(*PUBLISHED, color="0.8", label="Griffiths & Lane (1999)")
    axes.set(xlabel="strength reduced by F", ylabel="largest displacement [m]")
    axes.legend()
    figure.tight_layout()
    figure.savefig(picture, dpi=100)
    print(f"picture: {picture}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--run", metavar="PROGRAM")
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("slopes.png"))
    arguments = parser.parse_args()
    folder = arguments.results / "griffiths_lane_1"
    if arguments.run:
        case = Path(__file__).resolve().parent / "griffiths_lane_1.toml"
        subprocess.run([arguments.run, "strength-reduction", case, "-o", folder], check=True, stdout=subprocess.DEVNULL)
    file = folder / "strength_reduction.json"
    if not file.exists():
        sys.exit(f"{file} is not there: first mudlark strength-reduction griffiths_lane_1.toml")
    found = json.loads(file.read_text())
    for trial in found["trials"]:
        print(f"  F = {trial['factor']:<8.6g} {trial['verdict']}, {trial['largest displacement [m]']:.4f} m")
    factor = found["factor of safety"]
    if factor is None:
        sys.exit("no factor of safety was found")
    nearest = min(max(factor, PUBLISHED[0]), PUBLISHED[1])
    print(f"factor of safety {factor:.3f}, published {PUBLISHED[0]:.2f}-{PUBLISHED[1]:.2f}: "
          f"{100 * (factor / nearest - 1):+.1f} % (tolerance {100 * TOLERANCE:g} %)")
    draw(found, arguments.picture)
    return 0 if abs(factor / nearest - 1) <= TOLERANCE else 1


if __name__ == "__main__":
    sys.exit(main())
