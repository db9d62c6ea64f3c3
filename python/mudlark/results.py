"""Reading a results folder.

    from mudlark.results import Results
    results = Results("results/mpm")
    settlement = results.gauge("settlement")
    settlement.time, settlement["settlement"]
    results.field("water fraction", time=2.0).values      # [z, x] in 2D, [z, y, x] in 3D
    results.points(time=2.0)["pore pressure"]              # sorted by id
"""
import csv
import json
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np


class ResultsError(Exception):
    """The folder does not hold what was asked for; the message says what it holds."""


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def _split_title(title):
    """'settlement [m]' -> ('settlement', 'm')."""
    name, bracket, unit = title.rpartition(" [")
    return (name, unit.rstrip("]")) if bracket else (title, "")


@dataclass
class Gauge:
    """A time series: `gauge[name]` is the column of that name."""

    name: str
    time: np.ndarray
    columns: dict
    units: dict

    def __getitem__(self, column):
        return self.columns[column]


@dataclass
class FieldState:
    """One quantity on the grid at one time."""

    name: str
    unit: str
    time: float
    values: np.ndarray   # [z, x] or [z, y, x]; vectors with their components (x, z or x, y, z) last
    lower: np.ndarray    # corner of the domain, per axis [m]
    spacing: np.ndarray  # cell size per axis [m], the mean one of stretched axes
    stretched: dict      # positions of the faces [m] of stretched axes, by axis
    y: float = None      # of the plane that pictures show [m], in 3D; None: the middle

    @property
    def layer(self):
        """Index along y of the cells in the plane that pictures show."""
        if self.y is None:
            return self.values.shape[1] // 2
        return int(np.clip(np.searchsorted(self.faces(1), self.y, "right") - 1, 0, self.values.shape[1] - 1))

    @property
    def plane(self):
        """Values in the x-z plane that pictures show."""
        return self.values if len(self.spacing) == 2 else self.values[:, self.layer]

    @property
    def upper(self):
        return np.array([self.faces(axis)[-1] for axis in range(len(self.spacing))])

    def faces(self, axis):
        """Positions of the cells' ends along an axis [m]."""
        if axis in self.stretched:
            return self.stretched[axis]
        count = self.values.shape[len(self.spacing) - 1 - axis]
        return self.lower[axis] + np.arange(count + 1) * self.spacing[axis]

    def centres(self, axis):
        faces = self.faces(axis)
        return 0.5 * (faces[1:] + faces[:-1])


@dataclass
class Points:
    """Material points at one time, sorted by id. `points["position"]` has three columns, x y z."""

    time: float
    arrays: dict
    units: dict = field(default_factory=dict)

    def __getitem__(self, name):
        return self.arrays[name]

    def __contains__(self, name):
        return name in self.arrays

    def __len__(self):
        return len(self.arrays["id"])


class Results:
    def __init__(self, folder, y=None):
        """`y`: of the plane that pictures show in 3D [m]; without it the one in the middle."""
        self.folder, self.y = Path(folder), y
        if not self.folder.is_dir():
            raise ResultsError(f"{self.folder}: there is no such folder")

    @property
    def summary(self):
        path = self.folder / "summary.json"
        return json.loads(path.read_text()) if path.exists() else {}

    @property
    def has_gas(self):
        """Does air with mass flow beside the water?"""
        path = self.folder / "case.toml"
        return path.exists() and any(line.split("#")[0].replace(" ", "").startswith('air="gas"')
                                     for line in path.read_text().splitlines())

    @property
    def soil_names(self):
        """Names of the soils; "soil" of a point counts them from 0."""
        path = self.folder / "case.toml"
        case = tomllib.loads(path.read_text()) if path.exists() else {}
        return [soil["name"] for soil in case.get("soil", [])]

    # ------------------------------------------------------------------------------------------- gauges
    @property
    def gauge_names(self):
        return sorted(path.stem for path in (self.folder / "gauges").glob("*.csv"))

    def gauge(self, name):
        path = self.folder / "gauges" / f"{name}.csv"
        if not path.exists():
            raise ResultsError(f"{self.folder} has no gauge {name!r}; it has: {', '.join(self.gauge_names) or 'none'}")
        with path.open(newline="") as stream:
            titles = next(csv.reader([stream.readline()]))
            # A run that is under way may have written part of its last row.
            rows = [row.split(",") for row in stream.read().split("\n")[:-1]]
        table = np.array([[float(cell) for cell in row] for row in rows if len(row) == len(titles)])
        table = table.reshape(-1, len(titles))
        names = [_split_title(title) for title in titles[1:]]
        columns = {column: table[:, i + 1] for i, (column, _) in enumerate(names)}
        return Gauge(name, table[:, 0], columns, dict(names))

    # ------------------------------------------------------------------------------- fields and points
    def _outputs(self, kind):
        """Times and HDF5 groups of fields.h5 or points.h5."""
        path = self.folder / f"{kind}.h5"
        if not path.exists():
            return []
        with h5py.File(path, "r") as file:
            return sorted((float(group.attrs["time"]), name) for name, group in file.items() if "count" in group.attrs)

    def _group_at(self, kind, time):
        outputs = self._outputs(kind)
        if not outputs:
            raise ResultsError(f"{self.folder} has no {kind}")
        if time is None:
            return outputs[-1]
        return min(outputs, key=lambda output: abs(output[0] - time))

    @property
    def times(self):
        """Of the grid fields, else of the points [s]."""
        return [time for time, _ in self._outputs("fields")] or self.point_times

    @property
    def point_times(self):
        return [time for time, _ in self._outputs("points")]

    def _names(self, kind):
        outputs = self._outputs(kind)
        if not outputs:
            return []
        with h5py.File(self.folder / f"{kind}.h5", "r") as file:
            return [_text(data.attrs["name"]) for data in file[outputs[-1][1]].values()]

    @property
    def field_names(self):
        return self._names("fields")

    @property
    def point_names(self):
        return self._names("points")

    def field(self, name, time=None):
        """The state nearest to `time`; the last one without."""
        if name not in self.field_names:
            raise ResultsError(f"{self.folder} has no field {name!r}; it has: {', '.join(self.field_names) or 'none'}")
        at, group_name = self._group_at("fields", time)
        with h5py.File(self.folder / "fields.h5", "r") as file:
            group = file[group_name]
            data = next(d for d in group.values() if _text(d.attrs["name"]) == name)
            lower, spacing = group.attrs["lower"], group.attrs["spacing"]
            names = "xz" if len(spacing) == 2 else "xyz"
            stretched = {axis: group.attrs[f"faces_{name}"] for axis, name in enumerate(names)
                         if f"faces_{name}" in group.attrs}
            values = data[()]
            if len(spacing) == 2:  # stored with one layer along y
                values = values[:, 0]
                if int(data.attrs["components"]) == 3:
                    values = values[..., [0, 2]]
            return FieldState(name, _text(data.attrs["unit"]), at, values, lower, spacing, stretched,
                              self.y)

    def points(self, time=None):
        """The state nearest to `time`; the last one without."""
        at, group_name = self._group_at("points", time)
        with h5py.File(self.folder / "points.h5", "r") as file:
            datasets = list(file[group_name].values())
            arrays = {_text(data.attrs["name"]): data[()] for data in datasets}
            units = {_text(data.attrs["name"]): _text(data.attrs["unit"]) for data in datasets}
        order = np.argsort(arrays["id"], kind="stable")
        return Points(at, {name: values[order] for name, values in arrays.items()}, units)
