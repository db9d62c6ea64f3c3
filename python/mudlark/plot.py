"""Pictures of a results folder.

    python3 -m mudlark.plot DIR                      gauges, and the state at several times
    python3 -m mudlark.plot DIR --field NAME         one field or point quantity at several times
    python3 -m mudlark.plot DIR --time 2.5           one time only
    python3 -m mudlark.plot DIR --gauge NAME ...     these gauges only
    python3 -m mudlark.plot DIR --y 0.1              in 3D the plane there; without it the one in the middle
    python3 -m mudlark.plot DIR --out FILE.png       into this file

Without --out the pictures go to DIR/plots. The paths are printed.
"""
import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from mudlark import drawing
from mudlark.results import Results, ResultsError

STYLE = {"axes.spines.top": False, "axes.spines.right": False, "axes.titlesize": 10, "font.size": 9,
         "legend.frameon": False, "figure.constrained_layout.use": True}
DOWNWARD = ("settlement",)


def chosen_times(times, time, panels=4):
    """The asked time, else the first, the last and some between, by growing distance."""
    if not times:
        raise ResultsError("there are no outputs yet")
    if time is not None:
        return [min(times, key=lambda t: abs(t - time))]
    if len(times) <= panels:
        return list(times)
    picks = np.unique(np.round((len(times) - 1) * np.linspace(0, 1, panels) ** 2).astype(int))
    return [times[i] for i in picks]


def scalars(values):
    """A vector's length, a tensor's mean normal part; scalars as they are."""
    if values.ndim == 1:
        return values, ""
    return (values[:, :3].mean(axis=1), ", mean") if values.shape[1] == 6 else (np.linalg.norm(values, axis=1), ", length")


def draw_columns(axis, gauge):
    """The columns of a gauge; those of a second unit have their own axis on the right."""
    lines = []
    for number, unit in enumerate(dict.fromkeys(gauge.units.values())):
        side = axis if number == 0 else axis.twinx()
        named = [name for name in gauge.columns if gauge.units[name] == unit]
        factor, shown_unit = drawing.unit_scale(unit, drawing.shared_norm([gauge.columns[name] for name in named]))
        for name in named:
            values = gauge.columns[name]
            few = len(values) < 15
            lines += side.plot(gauge.time, values * factor, "o-" if few else "-", ms=3, lw=1.6,
                               color=plt.cm.tab10(len(lines)), label=name)
        side.set_ylabel(f"{named[0] if len(named) == 1 else ''} [{shown_unit}]".strip())
        if number > 0:
            side.ticklabel_format(axis="y", useOffset=False)
    if len(lines) > 1:
        axis.legend(handles=lines)


def draw_gauges(results, names, path):
    gauges = [results.gauge(name) for name in names]
    gauges = [gauge for gauge in gauges if gauge.time.size]
    if not gauges:
        raise ResultsError("the gauges have no values yet")
    columns = min(3, len(gauges))
    rows = -(-len(gauges) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(4.6 * columns, 3.2 * rows), squeeze=False)
    for axis, gauge in zip(axes.flat, gauges):
        draw_columns(axis, gauge)
        first = next(iter(gauge.columns))
        axis.set(title=gauge.name, xlabel="time [s]")
        if gauge.time.size > 1:
            axis.set_xlim(gauge.time[0], gauge.time[-1])
        if first in DOWNWARD:
            axis.invert_yaxis()
        axis.grid(color="0.92", lw=0.6)
        axis.ticklabel_format(axis="y", useOffset=False)
    for axis in list(axes.flat)[len(gauges):]:
        axis.set_visible(False)
    return save(figure, path)


def panels_for(limits, count):
    wide, high = drawing.panel_size(limits)
    columns = count if high > wide else min(2, count)
    rows = -(-count // columns)
    return plt.subplots(rows, columns, figsize=(wide * columns + 1.0, high * rows + 0.5), squeeze=False, sharex=True, sharey=True)


def default_quantity(results):
    """What colours the soil: pore pressure where it has any, else the displacement."""
    if not results.point_times:
        return None
    last = results.points()
    if "pore pressure" in last and np.ptp(last["pore pressure"]) > 0:
        return "pore pressure"
    return "displacement" if "displacement" in last else None


def draw_states(results, times, path, quantity=None):
    """Water, ground, soil and rigid bodies; `quantity` colours the soil points."""
    quantity = quantity or default_quantity(results)
    points = [results.points(time) for time in times] if results.point_times else [None] * len(times)
    porosity = results.field("porosity", times[0]) if "porosity" in results.field_names else None
    grid = porosity or (results.field(results.field_names[0], times[0]) if results.field_names else None)
    limits = drawing.frame(results, [p for p in points if p is not None], grid)
    figure, axes = panels_for(limits, len(times))
    cuts = [None if p is None else drawing.points_in_cut(p, grid) for p in points]
    norm = label = None
    if quantity:
        values = [scalars(p[quantity]) for p in points]
        norm = drawing.shared_norm([v[0][cut] for v, cut in zip(values, cuts)])
        factor, unit = drawing.unit_scale(points[0].units[quantity], norm)
        norm = drawing.shared_norm([v[0][cut] * factor for v, cut in zip(values, cuts)])
        label = f"{quantity}{values[0][1]} [{unit}]" if unit != "1" else quantity
    squares = None
    for index, (axis, time) in enumerate(zip(axes.flat, times)):
        drawing.draw_ground(axis, results, time, points[index])
        drawing.draw_water(axis, results, time, points[index])
        if points[index] is not None:
            coloured = values[index][0] * factor if quantity else None
            squares = drawing.draw_points(axis, points[index], cuts[index], coloured, norm)
        drawing.draw_surface_in_ground(axis, results, time, points[index], "white")
        drawing.draw_solids(axis, results, time)
        finish_panel(axis, limits, time)
    if squares is not None and quantity:
        figure.colorbar(squares, ax=axes, label=label, shrink=0.8, pad=0.02)
    return save(figure, path, axes, len(times))


def draw_field(results, name, times, path):
    """A grid field in colours; a vector by its length."""
    states = [results.field(name, time) for time in times]
    cut = [state.plane for state in states]
    if states[0].values.ndim > len(states[0].lower):
        cut = [np.linalg.norm(values, axis=-1) for values in cut]
    if name == "velocity":
        cut = [drawing.only_in_water(results, state.time, values) for state, values in zip(states, cut)]
    norm = drawing.shared_norm(cut)
    factor, unit = drawing.unit_scale(states[0].unit, norm)
    norm = drawing.shared_norm([values * factor for values in cut])
    points = [results.points(time) for time in times] if results.point_times else []
    limits = drawing.frame(results, points, states[0])
    figure, axes = panels_for(limits, len(times))
    for axis, state, values in zip(axes.flat, states, cut):
        image = drawing.draw_cells(axis, state, values * factor, norm=norm, cmap="viridis")
        drawing.draw_surface(axis, results, state)
        drawing.draw_solids(axis, results, state.time)
        finish_panel(axis, limits, state.time)
    figure.colorbar(image, ax=axes, label=f"{name} [{unit}]" if unit != "1" else name, shrink=0.8, pad=0.02)
    return save(figure, path, axes, len(times))


def finish_panel(axis, limits, time):
    drawing.apply_frame(axis, limits)
    axis.label_outer()
    axis.set_title(f"t = {time:.4g} s", loc="left")


def save(figure, path, axes=None, used=None):
    if axes is not None:
        for index in range(used, axes.size):
            axes.flat[index].set_visible(False)
            above = axes.flat[index - axes.shape[1]]
            above.tick_params(labelbottom=True)
            above.set_xlabel("x [m]")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=150, bbox_inches="tight")  # equal axes push titles over the edge
    plt.close(figure)
    print(path)
    return path


def draw(arguments):
    if arguments.gauge and (arguments.field or arguments.time is not None):
        raise ResultsError("--gauge draws whole time series: leave --field and --time out, or draw them in a second call")
    results = Results(arguments.folder, arguments.y)
    plots = results.folder / "plots"
    with plt.rc_context(STYLE):
        if arguments.gauge:
            draw_gauges(results, arguments.gauge, arguments.out or plots / "gauges.png")
            return
        if arguments.field:
            times = chosen_times(results.times, arguments.time)
            path = arguments.out or plots / f"{arguments.field.replace(' ', '-')}.png"
            if arguments.field in results.field_names:
                draw_field(results, arguments.field, times, path)
            elif arguments.field in results.point_names:
                draw_states(results, times, path, arguments.field)
            else:
                known = ", ".join(sorted(set(results.field_names + results.point_names) - {"id", "position"}))
                raise ResultsError(f"{results.folder} has no quantity {arguments.field!r}; it has: {known or 'none'}")
            return
        drawn = False
        if results.times:
            draw_states(results, chosen_times(results.times, arguments.time), arguments.out or plots / "state.png")
            drawn = True
        names = [name for name in results.gauge_names if results.gauge(name).time.size]
        if names and not (arguments.out and drawn):
            draw_gauges(results, names, arguments.out or plots / "gauges.png")
            drawn = True
        if not drawn:
            raise ResultsError(f"{results.folder} has neither outputs nor gauges")


def main(words=None):
    parser = argparse.ArgumentParser(prog="mudlark plot", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--field", help="name of a grid field or of a quantity of the material points")
    parser.add_argument("--time", type=float, help="[s]; the nearest output is drawn")
    parser.add_argument("--y", type=float, help="[m] of the plane that is drawn of a state in 3D")
    parser.add_argument("--gauge", nargs="+", default=[])
    parser.add_argument("--out", type=Path)
    try:
        draw(parser.parse_args(words))
    except (ResultsError, OSError) as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
