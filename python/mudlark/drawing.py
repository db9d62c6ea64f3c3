"""Drawing one state of a case into axes: water as blue shading, fixed porous ground as hatched stone, soil as
points that fill their share of space. 3D states are cut along a vertical plane, the one in the middle of y unless `Results` got another."""
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize

WATER = LinearSegmentedColormap.from_list("water", [(0.12, 0.45, 0.78, 0.0), (0.12, 0.45, 0.78, 0.75)])
GROUND = "#b9a68a"
SOIL = "#a9793f"
SOILS = (SOIL, "#d0a866", "#7a5230", "#9a9a62", "#c9bb9b", "#b5653f")  # of cases with several, in turn
SOLID = "#6b7178"
NARROW = 4.0  # domains that are higher or longer than this many times the other way are not drawn to scale


def extent(state):
    lower, upper = state.lower, state.upper
    return [lower[0], upper[0], lower[-1], upper[-1]]


def draw_cells(axes, state, values, **style):
    """Cells of the x-z plane in colours."""
    if not state.stretched:
        return axes.imshow(values, origin="lower", extent=extent(state), interpolation="nearest", aspect="auto",
                           **style)
    return axes.pcolormesh(state.faces(0), state.faces(len(state.lower) - 1), values, **style)


def points_in_cut(points, state):
    """Which points lie in the drawn layer of cells; all in 2D."""
    if state is None or len(state.lower) == 2:
        return np.ones(len(points), bool)
    low, high = state.faces(1)[state.layer:state.layer + 2]
    y = points["position"][:, 1]
    return (y >= low) & (y < high)


def draw_water(axes, results, time, points=None):
    """Blue where free water is; returns the state, None without water."""
    names = results.field_names
    name = next((n for n in ("saturation", "water fraction") if n in names), None)
    if name is None:
        return None
    state = results.field(name, time)
    shading = state.plane.copy()
    if points is not None and len(points):
        # No blue between the points; the cells at the surface of the soil keep theirs above it.
        soil = near_points(state, points, reach=0)
        soil[:-1] &= soil[1:]
        shading[soil] = 0.0
    draw_cells(axes, state, shading, cmap=WATER, norm=Normalize(0, 1), zorder=1)
    return state


def water_share(results, time):
    """Share of each cell's room that water fills, in the x-z plane; None without water."""
    name = next((n for n in ("saturation", "water fraction") if n in results.field_names), None)
    if name is None:
        return None
    state = results.field(name, time)
    return state.plane


def only_in_water(results, time, values):
    """NaN where no water is: beside a void the water's velocity is written some cells beyond its surface, too."""
    share = None if results.has_gas else water_share(results, time)
    return values if share is None else np.where(share > 0.02, values, np.nan)


def draw_surface(axes, results, state):
    """White line along the water's surface at the time of a state. Returns whether there is one."""
    share = water_share(results, state.time)
    if share is None or share.min() >= 0.5 or share.max() < 0.5:
        return False
    axes.contour(state.centres(0), state.centres(len(state.lower) - 1), share, levels=[0.5], colors=["white"],
                 linewidths=1.2, zorder=3)
    return True


def draw_surface_in_ground(axes, results, time, points, colour):
    """Line along the water's surface where it lies in soil or porous ground (phreatic line). Returns whether there is
    one."""
    share = water_share(results, time)
    if share is None or "porosity" not in results.field_names:
        return False
    state = results.field("porosity", time)
    ground = state.plane < 0.999
    if points is not None and len(points):
        ground = near_points(state, points, reach=0) | (ground & ~near_points(state, points, reach=2))
    shown = share[ground]
    if not shown.size or shown.min() >= 0.5 or shown.max() < 0.5:
        return False
    share = np.ma.array(share, mask=~ground)
    axes.contour(state.centres(0), state.centres(len(state.lower) - 1), share, levels=[0.5], colors=[colour],
                 linewidths=1.2, zorder=3.5)
    return True


def near_points(state, points, reach):
    """Cells of the drawn x-z plane with a soil point in them or within `reach` cells. In 3D points of other planes
    do not count: beside a slide the water is to be seen."""
    counts = (state.values.shape[0], state.values.shape[len(state.lower) - 1])
    near = np.zeros(counts, bool)
    position = points["position"][points_in_cut(points, state)]
    row = np.floor((position[:, 2] - state.lower[-1]) / state.spacing[-1]).astype(int)
    column = np.floor((position[:, 0] - state.lower[0]) / state.spacing[0]).astype(int)
    for up in range(-reach, reach + 1):
        for aside in range(-reach, reach + 1):
            near[np.clip(row + up, 0, counts[0] - 1), np.clip(column + aside, 0, counts[1] - 1)] = True
    return near


def draw_ground(axes, results, time, points):
    """Hatches cells that are porous without holding soil points."""
    if "porosity" not in results.field_names:
        return None
    state = results.field("porosity", time)
    solid = state.plane < 0.999
    if points is not None and len(points):
        solid &= ~near_points(state, points, reach=2)  # soil spreads its porosity over the neighbouring cells
    if solid.any():
        left, right, bottom, top = extent(state)
        x = np.concatenate([[left], state.centres(0), [right]])
        z = np.concatenate([[bottom], state.centres(len(state.lower) - 1), [top]])
        axes.contourf(x, z, np.pad(solid.astype(float), 1, mode="edge"), levels=[0.5, 2.0], colors=[GROUND],
                      hatches=["..."], alpha=0.6, zorder=2)
    return state


def draw_solids(axes, results, time):
    """Rigid bodies, up to where they fill half a cell. Returns whether there are any."""
    if "solid" not in results.field_names:
        return False
    state = results.field("solid", time)
    share = state.plane
    if share.max() < 0.5:
        return False
    left, right, bottom, top = extent(state)
    x = np.concatenate([[left], state.centres(0), [right]])
    z = np.concatenate([[bottom], state.centres(len(state.lower) - 1), [top]])
    share = np.pad(share, 1, mode="edge")
    axes.contourf(x, z, share, levels=[0.5, 2.0], colors=[SOLID], zorder=4)
    axes.contour(x, z, share, levels=[0.5], colors=["black"], linewidths=0.8, zorder=4)
    return True


def sides(points):
    """Width and height of the rectangle that each point fills [m]: the spacing at which the points were laid out,
    stretched as the whole body was, with the volume that the point has now."""
    volume = points["volume"] if "volume" in points else np.full(len(points), 1e-4)
    flat = not np.any(points["position"][:, 1])
    width = volume ** (1 / 2 if flat else 1 / 3)
    height = width.copy()
    if "initial position" not in points:
        return width, height
    soil = points["soil"] if "soil" in points else np.zeros(len(points))
    for body in np.unique(soil):
        chosen = soil == body
        start, now = points["initial position"][chosen], points["position"][chosen]
        step = []
        for axis in (0, 2):
            levels = np.unique(np.round(start[:, axis], 9))
            stretch = np.ptp(now[:, axis]) / np.ptp(levels) if len(levels) > 1 else 1.0
            step.append(np.median(np.diff(levels)) * np.clip(stretch, 0.5, 2.0) if len(levels) > 1 else np.nan)
        # Displacements that were reset count from places that are no lattice any more: points are squares then.
        lattice = np.all(np.isfinite(step)) and 0.25 < step[0] * step[1] / np.median(volume[chosen]) < 4.0
        if flat and lattice:
            # A body that keeps its width has points that keep theirs: all their volume goes from their height.
            confined = abs(np.ptp(now[:, 0]) / max(np.ptp(start[:, 0]), 1e-300) - 1) < 0.02
            width[chosen] = step[0] * (1.0 if confined else np.sqrt(volume[chosen] / (step[0] * step[1])))
            height[chosen] = volume[chosen] / width[chosen]
    return width, height


def draw_points(axes, points, chosen, values=None, norm=None, cmap="viridis"):
    """Rectangles of the points' size, coloured by `values`."""
    x, z = points["position"][chosen][:, 0], points["position"][chosen][:, 2]
    width, height = (0.5 * side[chosen] for side in sides(points))
    corners = np.stack([np.stack([x + sx * width, z + sz * height], axis=-1)
                        for sx, sz in ((-1, -1), (1, -1), (1, 1), (-1, 1))], axis=1)
    squares = PolyCollection(corners, zorder=3, linewidths=0.3, rasterized=len(x) > 20000)
    if values is None:
        squares.set_facecolor([SOILS[int(body) % len(SOILS)] for body in points["soil"][chosen]]
                              if "soil" in points else SOIL)
        squares.set_edgecolor("face")
    else:
        squares.set_array(values[chosen])
        squares.set_norm(norm)
        squares.set_cmap(cmap)
        squares.set_edgecolor("face")
    axes.add_collection(squares)
    return squares


def frame(results, all_points, grid):
    """Part of the x-z plane worth showing: the whole domain, or, when that is a thin strip, the soil with some room."""
    if grid is not None:
        left, right, bottom, top = extent(grid)
    else:
        positions = np.concatenate([points["position"] for points in all_points])
        left, _, bottom = positions.min(axis=0)
        right, _, top = positions.max(axis=0)
    thin = (top - bottom) > NARROW * (right - left)
    if thin and all_points and len(all_points[0]):
        z = np.concatenate([points["position"][:, 2] for points in all_points])
        room = 0.15 * (z.max() - z.min()) + 1e-12
        bottom, top = max(bottom, z.min() - room), min(top, z.max() + room)
    return left, right, bottom, top


def apply_frame(axes, limits):
    left, right, bottom, top = limits
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    wide, high = right - left, top - bottom
    if max(wide, high) <= NARROW * min(wide, high):
        axes.set_aspect("equal")
    else:
        axes.set_aspect("auto")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("z [m]")


def panel_size(limits):
    """Width and height of one panel in inches."""
    left, right, bottom, top = limits
    ratio = min(max((top - bottom) / (right - left), 0.28), 2.2)
    return (5.6, 5.6 * ratio) if ratio < 1 else (4.6 / ratio + 0.6, 4.6)


def shared_norm(states):
    values = np.concatenate([np.ravel(state) for state in states]) if states else np.array([0.0, 1.0])
    values = values[np.isfinite(values)]
    low, high = (values.min(), values.max()) if values.size else (0.0, 1.0)
    return Normalize(low, high if high > low else low + 1.0)


def unit_scale(unit, norm):
    """Factor and unit for axis labels that are easy to read: kPa for large pressures, mm for short ways."""
    largest = max(abs(norm.vmin), abs(norm.vmax))
    if unit == "Pa" and largest >= 2e3:
        return 1e-3, "kPa"
    if unit == "m" and largest < 0.1:
        return 1e3, "mm"
    return 1.0, unit
