#!/usr/bin/python3
"""Compares the valley with what its survey says: volumes of the layers, stress in them, the volume of the fill, and
the force that the ground carries at rest.

    mudlark run cases/valley/valley.toml
    python3 cases/valley/compare.py [--results results] [--picture FILE.png]

Exits with 1 when a number misses its tolerance.
"""
import argparse
import json
import sys
from pathlib import Path

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = Path(__file__).resolve().parent
WIDTH, DEPTH, SPACING = 24.0, 16.0, 0.5                       # [m]; of points
NAMES = ("gravel", "clay", "sand", "fill")
UNIT_WEIGHT = (1 - np.array([0.3, 0.5, 0.4, 0.35])) * 2650 * 9.81   # [N/m3]
VOLUME_TOLERANCE, FORCE_TOLERANCE = 0.01, 0.01


def bilinear(x, y, heights):
    """Interpolation on a lattice, level beyond its edges: (x, y) -> z."""
    def height(at_x, at_y):
        def spot(places, value):
            value = np.clip(value, places[0], places[-1])
            i = np.clip(np.searchsorted(places, value, side="right") - 1, 0, len(places) - 2)
            return i, (value - places[i]) / (places[i + 1] - places[i])
        (i, u), (j, v) = spot(x, at_x), spot(y, at_y)
        low = heights[j, i] * (1 - u) + heights[j, i + 1] * u
        return low * (1 - v) + (heights[j + 1, i] * (1 - u) + heights[j + 1, i + 1] * u) * v
    return height


def read_survey():
    """Surface of the ground and of the gravel, as the program is told to read them."""
    rows = np.loadtxt(HERE / "surface.asc", skiprows=6)[::-1]
    surface = bilinear(2.0 * np.arange(rows.shape[1]), 2.0 * np.arange(rows.shape[0]), rows)
    table = np.loadtxt(HERE / "gravel.csv", delimiter=",", skiprows=1)
    x, y = np.unique(table[:, 0]), np.unique(table[:, 1])
    gravel = bilinear(x, y, 0.01 * table[:, 2].reshape(len(x), len(y)).T)
    return surface, gravel


def dam(x):
    """Top of the fill."""
    return np.interp(x, [0, 1, 10, 14, 23, 24], [4, 4.5, 9, 9, 4.5, 4])


def tops(surface, gravel, x, y):
    ground = surface(x, y)
    return np.array([gravel(x, y), gravel(x, y) + 1, ground, np.maximum(ground, dam(x))])


def states(folder):
    with h5py.File(folder / "points.h5") as file:
        for key in sorted(key for key in file if key.isdigit()):
            yield {name: np.array(data) for name, data in file[key].items()}


def check(what, found, exact, tolerance, unit):
    error = found / exact - 1
    miss = abs(error) > tolerance
    print(f"  {what:32s} {found:10.2f} {unit}, exact {exact:10.2f} {unit}: {100 * error:+.2f} % "
          f"(tolerance {100 * tolerance:g} %){'  MISSED' if miss else ''}")
    return int(miss)


def compare_volumes(first, summary, thickness):
    print("volumes at the start, and of the fill when it is placed")
    placed = summary["stages"][1]["grains placed [kg]"] * 9.81 / UNIT_WEIGHT[3]
    found = [first["volume"][first["soil"] == body].sum() for body in range(3)] + [placed]
    exact = thickness.mean(axis=(1, 2)) * WIDTH * DEPTH
    return sum(check(name, *pair, VOLUME_TOLERANCE, "m3") for name, *pair in zip(NAMES, found, exact))


def compare_stress(first, surface, gravel):
    """Vertical stress of the start along every column of points: the weight of the layers above."""
    print("vertical stress of the start, all points")
    place = first["position"]
    edges = tops(surface, gravel, place[:, 0], place[:, 1])[:3]
    below, exact = place[:, 2], np.zeros(len(place))
    for body, top in enumerate(edges):
        exact -= UNIT_WEIGHT[body] * np.clip(top - np.maximum(below, edges[body - 1] if body else 0), 0, None)
    error = np.sqrt(np.mean((first["effective_stress"][:, 2] - exact) ** 2))
    # Points meet an edge within half their spacing, evenly spread: a jump of unit weight there counts SPACING/sqrt(12).
    jumps = np.diff(UNIT_WEIGHT[:3], append=0)
    allowed = SPACING / np.sqrt(12) * np.sqrt((jumps**2).sum())
    miss = error > allowed
    print(f"  root mean square difference {1e-3 * error:.2f} kPa, largest stress {1e-3 * np.abs(exact).max():.1f} kPa "
          f"(tolerance {1e-3 * allowed:.2f} kPa, what the spacing of points explains){'  MISSED' if miss else ''}")
    return int(miss)


def spline(r):
    """Quadratic B-spline, the weight with which a cell's centre sees points."""
    r = np.abs(r)
    return np.where(r < 0.5, 0.75 - r**2, np.where(r < 1.5, 0.5 * (1.5 - r) ** 2, 0))


def compare_force(last):
    """At rest a level carries what stands on it: mean stress there, as the cells around it see it."""
    print("vertical force at rest, 1.5 m above the base")
    height, volume = last["position"][:, 2], last["volume"]
    weight = (1 - last["porosity"]) * 2650 * 9.81 * volume
    mean = np.average(last["effective_stress"][:, 2], weights=volume * spline(height - 1.5))
    return check("force", -1e-6 * mean * WIDTH * DEPTH, 1e-6 * weight[height > 1.5].sum(), FORCE_TOLERANCE, "MN")


def draw(last, surface, gravel, picture):
    figure, axes = plt.subplots(1, 2, figsize=(13, 3.6))
    place = last["position"]
    along = np.abs(place[:, 1] - 8.25) < 0.3
    x = np.linspace(0, WIDTH, 200)
    lines = tops(surface, gravel, x, np.full_like(x, 8.25))
    for colours, axis, label in ((last["soil"], axes[0], None),
                                 (-1e-3 * last["effective_stress"][:, 2], axes[1], "vertical stress [kPa]")):
        dots = axis.scatter(place[along, 0], place[along, 2], c=colours[along], s=6,
                            cmap="viridis" if label else "tab10", **({} if label else {"vmin": 0, "vmax": 9}))
        if label:
            figure.colorbar(dots, ax=axis, label=label)
        axis.plot(x, lines.T, "k", lw=0.7)
        axis.set(xlabel="x [m]", ylabel="z [m]", aspect="equal", ylim=(0, 10))
    axes[0].set_title("soils at y = 8.25 m (lines: the survey and the plan)")
    figure.tight_layout()
    figure.savefig(picture, dpi=100)
    print(f"picture: {picture}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("valley.png"))
    arguments = parser.parse_args()
    folder = arguments.results / "valley"
    if not (folder / "summary.json").exists():
        sys.exit(f"{folder} is not there: run the command at the head of this file first")
    summary = json.loads((folder / "summary.json").read_text())
    surface, gravel = read_survey()
    x, y = np.meshgrid((np.arange(1200) + 0.5) * WIDTH / 1200, (np.arange(800) + 0.5) * DEPTH / 800)
    levels = tops(surface, gravel, x, y)
    thickness = np.diff(levels, axis=0, prepend=0)
    first, *_, last = states(folder)
    misses = compare_volumes(first, summary, thickness)
    misses += compare_stress(first, surface, gravel)
    misses += compare_force(last)
    at_rest = all(stage["at rest [s]"] is not None for stage in summary["stages"])
    settled = summary["gauges"]["under_crest"]["settlement [m]"]["last"]
    print(f"both stages {'came to rest' if at_rest else 'DID NOT COME to rest'}; the ground under the crest settled by "
          f"{1000 * settled:.1f} mm")
    draw(last, surface, gravel, arguments.picture)
    misses += not at_rest
    print("all within their tolerances" if misses == 0 else f"{misses} numbers are beyond their tolerance")
    return 0 if misses == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
