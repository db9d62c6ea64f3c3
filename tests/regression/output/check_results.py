"""Called by python_reads_results_test.cpp: reads with mudlark.results what the C++ writers left, checks that both
XDMF files are well-formed and name what is there, and draws every kind of picture."""
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import h5py
import numpy as np

from mudlark import drawing, picture, plot, report
from mudlark.results import FieldState, Points, Results, ResultsError

dimension, folder = int(sys.argv[1]), Path(sys.argv[2])
results = Results(folder)
assert results.times == [0.0, 0.5, 1.0] and results.point_times == results.times
assert sorted(results.field_names) == ["porosity", "saturation", "velocity"]
state = results.field("saturation", 0.6)
assert state.time == 0.5
cells = (10, 12) if dimension == 2 else (8, 10, 12)
assert state.values.shape == cells
heights = state.centres(dimension - 1)
assert np.array_equal(state.values.reshape(cells[0], -1)[:, 0], (heights < 2.0).astype(float))
velocity = results.field("velocity")
assert velocity.unit == "m/s" and velocity.values.shape == cells + (dimension,)
assert np.allclose(velocity.values[..., 0], velocity.centres(0))
shown = drawing.only_in_water(results, 1.0, velocity.plane[..., 0])
assert np.isfinite(shown[heights < 2.0]).all() and np.isnan(shown[heights > 2.0]).all()
if dimension == 3:  # pictures show the middle, or the layer of cells at the given y
    faces = velocity.faces(1)
    assert velocity.layer == 5
    for y, layer in ((-1e9, 0), (faces[2] + 1e-6, 2), (1e9, 9)):
        assert Results(folder, y).field("velocity").layer == layer
points = results.points(1.0)
assert list(points["id"]) == [10, 20, 30] and list(points["pore pressure"]) == [1002.0, 2000.0, 3000.0]
assert points["position"].shape == (3, 3) and np.isclose(points["position"][2, 2], 2.5)
gauge = results.gauge("top")
assert list(gauge["settlement"]) == [0.0, 0.1, 0.2] and gauge.units["pore pressure"] == "Pa"
assert results.summary["status"] == "running" and results.summary["title"] == "a title"
try:
    results.field("nonsense")
    raise SystemExit("a wrong name was accepted")
except ResultsError as error:
    assert "saturation" in str(error)

# Points of 0.1 by 0.1 m; places that have moved from the lattice by some micrometres are as good a start.
x, z = np.meshgrid(np.arange(6) * 0.1, np.arange(4) * 0.1)
place = np.stack([x.ravel(), 0 * x.ravel(), z.ravel()], axis=1)
moved = place + 1e-5 * np.random.default_rng(1).random(place.shape) * [1, 0, 1]
for start in (place, moved):
    width, height = drawing.sides({"position": place, "initial position": start, "volume": np.full(24, 0.01),
                                    "soil": np.zeros(24)})
    assert np.allclose(width, 0.1, rtol=0.01) and np.allclose(height, 0.1, rtol=0.01), (width, height)

# A dam of two soils from x = 2 to 8 m in 3D, in the layer y = 1 to 2 m only, under water that falls from 6 to 2 m: the
# line of its surface is drawn in the dam and nowhere else, and points beside the drawn layer hide no water.
class Dam:
    field_names = ["porosity", "saturation"]

    def field(self, name, time=None):
        x = np.arange(10) + 0.5
        values = np.ones((8, 3, 10))
        if name == "porosity":
            values[:, :, 2:8] = 0.4
        else:
            level = np.interp(x, [2, 8], [6, 2])
            values = np.clip(level[None, None, :] - np.arange(8)[:, None, None], 0, 1) * np.ones((1, 3, 1))
        return FieldState(name, "1", 0.0, values, np.zeros(3), np.ones(3), {}, self.y)


def lines_and_blue(y):
    dam = Dam()
    dam.y = y
    places = np.array([[x, 1.5, z] for x in np.arange(2.25, 8, 0.5) for z in np.arange(0.25, 8, 0.5)])
    dam_points = Points(0.0, {"id": np.arange(len(places)), "position": places, "soil": places[:, 0] // 5})
    figure, axes = plt.subplots()
    with_line = drawing.draw_surface_in_ground(axes, dam, 0.0, dam_points, "white")
    line = axes.collections[-1].get_paths()[0].vertices
    drawing.draw_water(axes, dam, 0.0, dam_points)
    blue = axes.images[-1].get_array()
    squares = drawing.draw_points(axes, dam_points, drawing.points_in_cut(dam_points, dam.field("porosity")))
    colours = {tuple(colour) for colour in squares.get_facecolor()}
    plt.close(figure)
    return with_line, line, blue, colours


plt = plot.plt
with_line, line, blue, colours = lines_and_blue(1.5)
assert with_line and line[:, 0].min() >= 2.0 and line[:, 0].max() <= 8.0
assert np.abs(line[:, 1] - np.interp(line[:, 0], [2, 8], [6, 2])).max() < 0.5
assert blue[1, 4] == 0.0 and blue[1, 0] == 1.0 and len(colours) == 2
assert lines_and_blue(0.5)[2][1, 4] == 1.0

for name in ("fields", "points"):
    root = ElementTree.parse(folder / f"{name}.xdmf").getroot()
    grids = root.findall("Domain/Grid/Grid")
    assert [float(grid.find("Time").get("Value")) for grid in grids] == [0.0, 0.5, 1.0]
    with h5py.File(folder / f"{name}.h5") as file:
        for item in root.iter("DataItem"):
            if item.get("Format") == "HDF":
                data = file[item.text.split(":")[1]]
                assert data.shape == tuple(int(n) for n in item.get("Dimensions").split()), item.text

assert plot.main([str(folder)]) == 0
assert plot.main([str(folder), "--field", "velocity", "--time", "0.5", "--out", str(folder / "one.png")]) == 0
assert plot.main([str(folder), "--gauge", "top", "--out", str(folder / "two.png")]) == 0
assert plot.main([str(folder), "--field", "nonsense"]) == 1
assert plot.main([str(folder), "--field", "velocity", "--gauge", "top"]) == 1
assert report.main([str(folder)]) == 0
page = (folder / "report.html").read_text()
assert page.count("data:image/png;base64,") >= 3 and "<h2>Gauges</h2>" in page
assert report.main([str(folder / "plots")]) == 1
assert picture.main([str(folder), str(folder / "three.png")]) == 0
for file in ("plots/state.png", "plots/gauges.png", "one.png", "two.png", "three.png"):
    assert (folder / file).read_bytes()[:8] == b"\x89PNG\r\n\x1a\n", file
