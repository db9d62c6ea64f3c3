#!/usr/bin/env python3
"""Proves that ParaView opens what Mudlark writes: loads fields.xdmf and points.xdmf with ParaView's own reader,
compares every number at the last time with the HDF5 files, and renders one PNG without a screen.

    /usr/bin/python3 scripts/check_paraview.py PROGRAM [--out FOLDER]     a small 2D and a small 3D case are run
    /usr/bin/python3 scripts/check_paraview.py --results DIR [--out FOLDER]

Needs Debian's packages python3-paraview, xvfb, xauth and libgl1-mesa-dri (not in packages.txt: nothing else uses
them) besides python3-h5py.
Exits with 1 when something differs.
"""
import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

CASE = """
title = "A pond over a bed, for ParaView"
[domain]
dimension = {dimension}
lower = {lower}
upper = {upper}
cells = {cells}
gravity = 9.81
[time]
end = 0.02
output_every = 0.01
[water]
bulk_modulus = 2.15e7
[[water.body]]
shape = {{ box = {{ lower = {lower}, upper = {water} }} }}
[[soil]]
name = "bed"
shape = {{ box = {{ lower = {lower}, upper = {bed} }} }}
grain_density = 2650.0
porosity = 0.4
hydraulic_conductivity = 1e-3
points_per_cell = {points}
pore_water = "two-phase"
law = {{ type = "linear-elastic", young_modulus = 1e6, poisson_ratio = 0.3 }}
initial_stress = "geostatic"
[coupling]
mode = "surface"
mudline = "consistent"
"""
SIZES = {
    2: dict(dimension=2, lower=[0.0, 0.0], upper=[2.0, 1.0], cells=[20, 10], water=[1.0, 0.8], bed=[2.0, 0.3], points=4),
    3: dict(dimension=3, lower=[0.0, 0.0, 0.0], upper=[2.0, 1.2, 1.0], cells=[20, 12, 10], water=[1.0, 1.2, 0.8],
            bed=[2.0, 1.2, 0.3], points=8),
}


def text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def label(name, unit):
    return name if unit in ("", "1") else f"{name} [{unit}]"


def last_group(file):
    return max(file.values(), key=lambda group: group.attrs["time"])


def arrays_in(data, association):
    from vtkmodules.util.numpy_support import vtk_to_numpy

    attributes = data.GetCellData() if association == "cell" else data.GetPointData()
    return {attributes.GetArrayName(i): vtk_to_numpy(attributes.GetArray(i))
            for i in range(attributes.GetNumberOfArrays())}


def load(path):
    """ParaView's reader at the last time: the reader, its times and the data set."""
    from paraview import servermanager, simple

    reader = simple.XDMFReader(FileNames=[str(path)])
    reader.UpdatePipelineInformation()
    times = list(reader.TimestepValues)
    simple.UpdatePipeline(times[-1], reader)
    data = servermanager.Fetch(reader)
    while data.IsA("vtkMultiBlockDataSet"):
        data = data.GetBlock(0)
    return reader, times, data


def compare(folder, kind):
    """Problems found in fields or points of one results folder."""
    reader, times, data = load(folder / f"{kind}.xdmf")
    problems = []
    with h5py.File(folder / f"{kind}.h5") as file:
        written = sorted(group.attrs["time"] for group in file.values())
        if not np.allclose(times, written, rtol=1e-12, atol=1e-15):
            problems.append(f"times {times} instead of {written}")
        group = last_group(file)
        shown = arrays_in(data, "cell" if kind == "fields" else "point")
        for stored in group.values():
            name, unit = text(stored.attrs["name"]), text(stored.attrs["unit"])
            components = int(stored.attrs["components"])
            values = stored[()].reshape(-1, components)
            if name == "position":
                points = np.array([data.GetPoint(i) for i in range(data.GetNumberOfPoints())])
                if points.shape != values.shape or not np.allclose(points, values, rtol=1e-6):
                    problems.append("positions differ")
                continue
            if components == 6:
                wanted = {label(f"{name} {part}", unit): values[:, i]
                          for i, part in enumerate(("xx", "yy", "zz", "xy", "yz", "zx"))}
            else:
                wanted = {label(name, unit): values if components > 1 else values[:, 0]}
            for title, expected in wanted.items():
                if title not in shown:
                    problems.append(f"{title} is not shown; there are {sorted(shown)}")
                elif shown[title].shape != expected.shape or not np.array_equal(shown[title], expected):
                    problems.append(f"{title} differs")
        if kind == "fields":
            lower, spacing = group.attrs["lower"], group.attrs["spacing"]
            bounds = np.array(data.GetBounds()).reshape(3, 2)
            axes = [0, 2] if len(lower) == 2 else [0, 1, 2]
            cells = np.array(next(iter(group.values())).shape[2::-1])[axes]
            if not np.allclose(bounds[axes, 0], lower) or not np.allclose(bounds[axes, 1], lower + spacing * cells):
                problems.append(f"the grid lies in {bounds.tolist()}")
    return reader, times, data, [f"{folder}/{kind}.xdmf: {problem}" for problem in problems]


def render(fields, points, three_dimensional, picture):
    from paraview import simple

    view = simple.CreateRenderView(ViewSize=[1200, 700])
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 1
    if fields:
        reader, times, data = fields
        view.ViewTime = times[-1]
        names = arrays_in(data, "cell")
        if "water fraction" in names:
            wet = simple.Threshold(Input=reader, Scalars=["CELLS", "water fraction"])
            wet.LowerThreshold, wet.UpperThreshold, wet.ThresholdMethod = 0.5, 2.0, "Between"
            shown = simple.Show(wet, view)
            simple.ColorBy(shown, ("CELLS", "water fraction"))
            shown.Opacity = 0.5 if three_dimensional else 1.0
        simple.Show(reader, view).Representation = "Outline" if three_dimensional else "Wireframe"
    if points:
        reader, times, data = points
        view.ViewTime = times[-1]
        shown = simple.Show(reader, view)
        shown.Representation = "Points"
        shown.PointSize = 6
        if "pore pressure [Pa]" in arrays_in(data, "point"):
            simple.ColorBy(shown, ("POINTS", "pore pressure [Pa]"))
            shown.RescaleTransferFunctionToDataRange()
            shown.SetScalarBarVisibility(view, True)
    view.ResetCamera()
    camera = view.GetActiveCamera()
    if three_dimensional:
        camera.Azimuth(0)
        view.CameraViewUp = [0, 0, 1]
        centre = np.array(view.CameraFocalPoint)
        view.CameraPosition = list(centre + np.array([1.5, -4.0, 2.0]))
    else:
        centre = np.array(view.CameraFocalPoint)
        view.CameraViewUp = [0, 0, 1]
        view.CameraPosition = list(centre + np.array([0, -10, 0]))
    view.ResetCamera()
    simple.SaveScreenshot(str(picture), view)
    simple.Delete(view)


def check(folder, picture):
    problems, fields, points, three_dimensional = [], None, None, False
    if (folder / "fields.xdmf").exists():
        *fields, found = compare(folder, "fields")
        problems += found
        with h5py.File(folder / "fields.h5") as file:
            three_dimensional = len(last_group(file).attrs["lower"]) == 3
    if (folder / "points.xdmf").exists():
        *points, found = compare(folder, "points")
        problems += found
    render(fields, points, three_dimensional, picture)
    print(f"{folder}: {'; '.join(problems) if problems else 'every number is as written'}; picture {picture}")
    return problems


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", help="the mudlark program")
    parser.add_argument("--results", type=Path, action="append", default=[])
    parser.add_argument("--out", type=Path, default=Path("."))
    arguments = parser.parse_args()
    if not os.environ.get("DISPLAY") and shutil.which("xvfb-run"):
        os.execvp("xvfb-run", ["xvfb-run", "-a", "--wait=8", sys.executable, *sys.argv])
    arguments.out.mkdir(parents=True, exist_ok=True)
    problems = []
    with tempfile.TemporaryDirectory() as scratch:
        folders = list(arguments.results)
        for dimension, sizes in SIZES.items() if arguments.program else ():
            case = Path(scratch) / f"pond-{dimension}d.toml"
            case.write_text(CASE.format(**sizes))
            folder = Path(scratch) / f"pond-{dimension}d"
            subprocess.run([arguments.program, "run", str(case), "-o", str(folder), "--quiet"], check=True)
            folders.append(folder)
        for folder in folders:
            problems += check(folder, arguments.out / f"paraview-{folder.name}.png")
    return 1 if problems or not folders else 0


if __name__ == "__main__":
    sys.exit(main())
