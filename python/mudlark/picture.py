"""One picture of the first state: python3 -m mudlark.picture RESULTS OUT.png"""
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from mudlark import drawing
from mudlark.plot import STYLE
from mudlark.results import Results, ResultsError

SURFACE = "#0b2f66"


def draw_start(folder, path):
    """Water, soil, rigid bodies and fixed porous ground at the first output."""
    results = Results(folder)
    if not results.times:
        raise ResultsError(f"{folder} has no outputs")
    time = results.times[0]
    points = results.points(time) if results.point_times else None
    grid = results.field(results.field_names[0], time) if results.field_names else None
    limits = drawing.frame(results, [points] if points is not None else [], grid)
    wide, high = drawing.panel_size(limits)
    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(figsize=(1.3 * wide + 1.6, 1.3 * high + 0.6))
        drawing.draw_ground(axes, results, time, points)
        legend = []
        water = drawing.draw_water(axes, results, time, points)
        if water is not None and (water.values > 0).any():
            legend.append(Patch(color=drawing.WATER(1.0), label="water"))
        if points is not None:
            drawing.draw_points(axes, points, drawing.points_in_cut(points, grid))
            names = results.soil_names
            legend += [Patch(color=drawing.SOILS[index % len(drawing.SOILS)], label=name)
                       for index, name in enumerate(names if len(names) > 1 else ["soil"])]
        if any(collection.get_zorder() == 2 for collection in axes.collections):
            legend.append(Patch(facecolor=drawing.GROUND, hatch="...", alpha=0.6, label="porous ground"))
        if drawing.draw_surface_in_ground(axes, results, time, points, SURFACE):
            legend.append(Line2D([], [], color=SURFACE, lw=1.2, label="water's surface in the ground"))
        if drawing.draw_solids(axes, results, time):
            legend.append(Patch(color=drawing.SOLID, label="rigid body"))
        drawing.apply_frame(axes, limits)
        cut = ", cut through the middle" if grid is not None and len(grid.lower) == 3 else ""
        axes.set_title(f"t = {time:.4g} s{cut}", loc="left")
        if legend:
            axes.legend(handles=legend, loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, dpi=150)
        plt.close(figure)


def main(words=None):
    words = sys.argv[1:] if words is None else words
    if len(words) != 2:
        print(__doc__, file=sys.stderr)
        return 1
    try:
        draw_start(*words)
    except (ResultsError, OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
