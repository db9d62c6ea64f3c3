"""One-dimensional consolidation: Terzaghi's series, and the large-strain column.

Geometry of both: a saturated column of height H on a fixed, impermeable base, drained at the top (p = 0), loaded
there by a stress q on the grains. Compression is positive here. SI units.
"""
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_banded
from scipy.optimize import brentq

LAWS = ("log", "hencky", "objective", "small")


def constrained_modulus(young_modulus, poisson_ratio):
    """Stiffness against one-dimensional compression, M = E (1-nu) / ((1+nu) (1-2 nu)) [Pa]."""
    return young_modulus * (1 - poisson_ratio) / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))


# ------------------------------------------------------------------------------------------- small strain
@dataclass
class Terzaghi:
    """Terzaghi's (1923) consolidation with compressible pore water (K_w / n against M).

    The load meets the undrained column: the water takes p0 = q / (1 + n M / K_w) of it. From there the pressure
    diffuses with c_v = k / (gamma_w (1/M + n/K_w)).
    """

    height: float = 1.0                 # H [m]
    modulus: float = constrained_modulus(1e6, 0.3)  # M [Pa]
    porosity: float = 0.4               # n [-]
    conductivity: float = 1e-2          # k [m/s]
    load: float = 1e3                   # q [Pa]
    water_modulus: float = 2.15e7       # K_w [Pa]; None: incompressible
    unit_weight: float = 9810.0         # gamma_w [N/m3]
    terms: int = 400

    def __post_init__(self):
        storage = self.porosity / self.water_modulus if self.water_modulus else 0.0
        self.start_pressure = self.load / (1 + storage * self.modulus)
        self.diffusivity = self.conductivity / (self.unit_weight * (1 / self.modulus + storage))
        self.modes = np.pi * (np.arange(self.terms) + 0.5)

    def time_factor(self, time):
        """T = c_v t / H^2 [-]."""
        return self.diffusivity * np.asarray(time, float) / self.height**2

    def pressure(self, height_above_base, time):
        """Excess pore pressure [Pa]: p0 sum 2/m sin(m (1 - z/H)) exp(-m^2 T), m = pi (i + 1/2)."""
        depth = 1 - np.atleast_1d(height_above_base) / self.height
        m = self.modes
        decay = np.exp(-(m**2) * self.time_factor(time)) * 2 / m
        return self.start_pressure * np.sin(np.outer(depth, m)) @ decay

    def degree(self, time):
        """U = 1 - sum 2/m^2 exp(-m^2 T): the share of the pressure's mean that is gone."""
        factor = np.atleast_1d(self.time_factor(time))
        m = self.modes[:, None]
        return 1 - np.sum(2 / m**2 * np.exp(-(m**2) * factor), axis=0)

    def settlement(self, time):
        """Of the top [m]: mean effective stress over M, times H."""
        mean_pressure = self.start_pressure * (1 - self.degree(time))
        return (self.load - mean_pressure) * self.height / self.modulus


# ------------------------------------------------------------------------------------------- large strain
def effective_stress(law, modulus, stretch, start=0.0):
    """Vertical effective stress [Pa] at a stretch J = dz/dz0, from the stress `start` at J = 1.

    log        sigma' = s0 - M ln J            Cauchy stress linear in the logarithmic strain
    hencky     sigma' = (s0 - M ln J) / J      Kirchhoff stress linear in the logarithmic strain
    objective  sigma' = (s0 + M (1 - J)) / J   Hill's rate: d(sigma J) = -M dJ
    small      sigma' = s0 + M (1 - J)
    """
    if law == "log":
        return start - modulus * np.log(stretch)
    if law == "hencky":
        return (start - modulus * np.log(stretch)) / stretch
    if law == "objective":
        return (start + modulus * (1 - stretch)) / stretch
    if law == "small":
        return start + modulus * (1 - stretch)
    raise ValueError(f"no law is called {law!r}; there are {', '.join(LAWS)}")


def final_settlement(law, load=4e5, modulus=constrained_modulus(1e6, 0.3), height=1.0):
    """Exact settlement when the water has left [m], without self weight."""
    stretch = brentq(lambda j: effective_stress(law, modulus, j) - load, 1e-3, 1.0, xtol=1e-15)
    return height * (1 - stretch)


@dataclass
class History:
    """What the reference column did at the asked times."""

    time: np.ndarray           # [s]
    settlement: np.ndarray     # of the top [m]
    base_pressure: np.ndarray  # excess pore pressure in the lowest cell [Pa]
    start_height: np.ndarray   # of the cells' middles at the start [m]
    stretch: np.ndarray        # J, one row per time
    pressure: np.ndarray       # excess pore pressure [Pa], one row per time

    def settlement_of(self, height):
        """Downward way of the material that started at a height above the base [m], one value per time."""
        edges = self._edges
        below = np.concatenate([np.zeros((len(self.time), 1)), np.cumsum((1 - self.stretch) * np.diff(edges), axis=1)], axis=1)
        return np.array([np.interp(height, edges, row) for row in below])

    @property
    def _edges(self):
        edges = [0.0]
        for middle in self.start_height:
            edges.append(2 * middle - edges[-1])
        return np.array(edges)


@dataclass
class LargeStrainColumn:
    """Consolidation at large strain in material coordinates a = 0..H (Gibson, England & Hussey 1967).

    Unknown: the stretch J(a, t). Mass of water per start volume m = rho_w exp(p/K_w) (J - 1 + n0); Darcy's law with
    a constant intrinsic permeability, rho_w w = -(rho_w k / gamma_w) (1/J dp/da); dm/dt = -d(rho_w w)/da; pressure
    p = sigma - sigma'(J). With self weight p is the pressure in excess of the standing water and the column starts
    in rest under its buoyant weight. Finite volumes on a mesh that is finer towards the drained top; in time the
    two-stage, second-order, L-stable scheme of Alexander (1977), each stage by Newton's method.
    """

    law: str = "log"
    height: float = 1.0
    modulus: float = constrained_modulus(1e6, 0.3)
    porosity: float = 0.4
    conductivity: float = 1e-4
    load: float = 4e5
    ramp: float = 0.0              # the load comes over this time by half a cosine [s]
    water_modulus: float = 2.15e7  # None: incompressible
    water_density: float = 1000.0
    grain_density: float = 2650.0
    gravity: float = 9.81          # for gamma_w
    self_weight: bool = False
    cells: int = 160

    def __post_init__(self):
        # Cell edges crowd at the top, where the pressure falls within a thin layer at first.
        share = np.linspace(0, 1, self.cells + 1)
        self.edges = self.height * np.sin(0.5 * np.pi * share) ** 0.9
        self.width = np.diff(self.edges)
        self.middle = 0.5 * (self.edges[1:] + self.edges[:-1])
        self.solid = 1 - self.porosity
        buoyant = self.solid * (self.grain_density - self.water_density) * self.gravity
        self.start_stress = buoyant * (self.height - self.middle) if self.self_weight else 0 * self.middle
        self.compressibility = 1 / self.water_modulus if self.water_modulus else 0.0

    def load_at(self, time):
        if time >= self.ramp:
            return self.load
        return self.load * 0.5 * (1 - np.cos(np.pi * time / self.ramp))

    def pressure(self, stretch, time):
        stress = effective_stress(self.law, self.modulus, stretch, self.start_stress)
        return self.load_at(time) + self.start_stress - stress

    def water(self, stretch, time):
        """Water per start volume over the water's density at rest."""
        pressure = self.pressure(stretch, time)
        return np.exp(pressure * self.compressibility) * (stretch - self.solid)

    def inflow(self, stretch, time):
        """d(water)/dt of each cell [1/s]."""
        pressure = self.pressure(stretch, time)
        density = np.exp(pressure * self.compressibility)
        half = 0.5 * stretch * self.width  # present distance from a cell's middle to its edge
        flux = np.zeros(self.cells + 1)
        flux[1:-1] = -(pressure[1:] - pressure[:-1]) / (half[1:] + half[:-1]) * 0.5 * (density[1:] + density[:-1])
        flux[-1] = pressure[-1] / half[-1] * density[-1]
        return -np.diff(flux) / self.width * self.conductivity / (self.water_density * self.gravity)

    def _stage(self, guess, known, weight, time):
        """Solves water(J) - weight * inflow(J) = known by Newton's method; the Jacobian is tridiagonal."""
        def residual(stretch):
            return self.water(stretch, time) - weight * self.inflow(stretch, time) - known

        stretch = guess.copy()
        for _ in range(40):
            wrong = residual(stretch)
            bands = np.zeros((3, self.cells))
            small = 1e-7
            for colour in range(3):  # every third cell may be moved at once
                moved = stretch.copy()
                moved[colour::3] += small
                change = (residual(moved) - wrong) / small
                for cell in range(colour, self.cells, 3):
                    for row in range(max(0, cell - 1), min(self.cells, cell + 2)):
                        bands[1 + row - cell, cell] = change[row]
            correction = solve_banded((1, 1), bands, -wrong)
            stretch = np.maximum(stretch + correction, 0.5 * (stretch + self.solid))
            if np.max(np.abs(correction)) < 1e-12:
                return stretch
        raise RuntimeError(f"the reference column did not converge at t = {time} s")

    def _undrained(self, time):
        """The stretch that a sudden load leaves while no water has moved."""
        start = np.full(self.cells, self.porosity)
        return self._stage(np.full(self.cells, 1.0), start, 0.0, time)

    def solve(self, times, steps_per_decade=60):
        times = np.asarray(times, float)
        slow = self.water_density * self.gravity * self.height**2 / (self.conductivity * self.modulus)
        first = 1e-9 * slow
        grid = np.concatenate([[0.0], first * 10 ** np.arange(0, np.log10(max(times[-1], first * 10) / first) + 1e-9, 1 / steps_per_decade)])
        if self.ramp:
            grid = np.concatenate([grid, np.linspace(0, self.ramp, 41)])
        grid = np.unique(np.concatenate([grid[grid <= times[-1]], times]))
        gamma = 1 - np.sqrt(0.5)
        stretch = self._undrained(0.0) if not self.ramp else np.ones(self.cells)
        kept = {0.0: stretch}
        for begin, end in zip(grid[:-1], grid[1:]):
            step = end - begin
            water = self.water(stretch, begin)
            middle = self._stage(stretch, water, gamma * step, begin + gamma * step)
            rate = self.inflow(middle, begin + gamma * step)
            stretch = self._stage(middle, water + (1 - gamma) * step * rate, gamma * step, end)
            kept[end] = stretch
        rows = np.array([kept[t] for t in times])
        pressures = np.array([self.pressure(row, t) for row, t in zip(rows, times)])
        return History(times, (1 - rows) @ self.width, pressures[:, 0], self.middle, rows, pressures)


def time_of_settlement(history, share, final):
    """When the settlement passes a share of the final one [s]."""
    return float(np.interp(share * final, history.settlement, history.time))
