"""Compression waves in a saturated elastic column: the exact response to a load, mode by mode.

A column of height H stands on a fixed, impermeable base (x = 0) and is open at its top. Small strain, no gravity,
incompressible grains. With D = n^2 gamma_w / k, velocities v of the grains and w of the pore water (Biot 1956):

    (1-n) rho_s v' = d(sigma')/dx - (1-n) dp/dx + D (w - v)       sigma' = M du/dx
       n  rho_w w' =              -    n  dp/dx - D (w - v)       p = -(K_w/n) ((1-n) du/dx + n dU/dx)

At the top sigma' = -q_s and p = q_w, both brought on over `ramp`, linearly or by half a cosine. Displacements are expanded in sin(L x),
L = (m + 1/2) pi/H, about the state of rest under the full load; every mode is a linear system of four equations whose
exponential is exact. Compression of water and compressive stress are positive in what is returned. SI units.

`UpColumn` solves the same column in the u-p formulation (Zienkiewicz, Chang & Bettess 1980), which leaves out the
acceleration of the water against the grains, with K = k/(rho_w g) and f = 1 or 0, with or without the inertia of the
mixture in Darcy's law:

    rho u" = M d2u/dx2 - dp/dx      w = -K (dp/dx + f rho_w u")      p' = -(K_w/n) (du'/dx + dw/dx)
"""
from dataclasses import dataclass

import numpy as np


def _ramped(values, time, ramp, shape):
    """Share of the load that is there, and the mean of exp(values (t - s)) over the steps at s that brought it."""
    if ramp <= 0:
        return 1.0, np.exp(values * time)
    on = min(time, ramp)
    late = np.exp(values * (time - on))
    if shape == "linear":
        return on / ramp, (np.exp(values * time) - late) / (values * ramp)
    if shape == "cosine":
        rate = np.pi / ramp
        turned = values * np.sin(rate * on) + rate * np.cos(rate * on)
        return 0.5 * (1 - np.cos(rate * on)), 0.5 * rate * (rate * np.exp(values * time) - late * turned) / (values**2 + rate**2)
    raise ValueError(f"no ramp is called {shape!r}; there are linear and cosine")


@dataclass
class SaturatedColumn:
    height: float               # H [m]
    modulus: float              # M, constrained [Pa]
    porosity: float             # n [-]
    conductivity: float         # k [m/s]
    grain_density: float = 2650.0
    water_density: float = 1000.0
    water_modulus: float = 2.15e7
    gravity: float = 9.81       # in gamma_w
    modes: int = 800

    def __post_init__(self):
        n, water = self.porosity, self.water_modulus
        self.mass = np.array([(1 - n) * self.grain_density, n * self.water_density])
        self.stiffness = np.array([[self.modulus + (1 - n) ** 2 * water / n, (1 - n) * water], [(1 - n) * water, n * water]])
        self.drag = n**2 * self.water_density * self.gravity / self.conductivity
        self.wave_numbers = (np.arange(self.modes) + 0.5) * np.pi / self.height

    @property
    def speeds(self):
        """Undrained wave (k -> 0), and fast and slow wave without drag [m/s]."""
        undrained = np.sqrt((self.modulus + self.water_modulus / self.porosity) / self.mass.sum())
        squares = np.sort(np.linalg.eigvals(self.stiffness / self.mass[:, None]).real)
        return undrained, np.sqrt(squares[1]), np.sqrt(squares[0])

    @property
    def slow_period(self):
        """4 H / c_slow [s]."""
        return 4 * self.height / self.speeds[2]

    def systems(self, wave_numbers):
        """Matrices of d(u, U, v, w)/dt, one per wave number."""
        wave_numbers = np.atleast_1d(wave_numbers)
        matrices = np.zeros((len(wave_numbers), 4, 4))
        matrices[:, 0, 2] = matrices[:, 1, 3] = 1
        matrices[:, 2:, :2] = -wave_numbers[:, None, None] ** 2 * (self.stiffness / self.mass[:, None])
        matrices[:, 2:, 2:] = -self.drag * np.array([[1, -1], [-1, 1]]) / self.mass[:, None]
        return matrices

    def slow_mode_swings(self):
        """Does the first mode's slow wave oscillate (True) or creep (False)?"""
        values = np.linalg.eigvals(self.systems(self.wave_numbers[:1])[0])
        return int(np.sum(np.abs(values.imag) > 1e-6 * np.abs(values).max())) == 4

    def _modes(self, skeleton, water):
        """Of every mode: matrix, state at the start (less rest under the full load), and what it adds to the strain-like
        quantity behind the pressure and to the displacement. Then pressure and strain at rest."""
        load = np.array([-skeleton - (1 - self.porosity) * water, -self.porosity * water])
        rest = np.linalg.solve(self.stiffness, load)  # du/dx and dU/dx when all is over
        signs = (-1.0) ** np.arange(self.modes)
        start = np.zeros((self.modes, 4))
        start[:, :2] = -(2 / self.height) * (signs / self.wave_numbers**2)[:, None] * rest
        n = self.porosity
        pressure = np.zeros((self.modes, 4))
        pressure[:, 0] = -self.water_modulus / n * (1 - n) * self.wave_numbers
        pressure[:, 1] = -self.water_modulus * self.wave_numbers
        return self.systems(self.wave_numbers), start, pressure, water, rest[0]

    def response(self, height, times, skeleton=0.0, water=0.0, ramp=0.0, shape="cosine"):
        """Pore pressure [Pa] and downward displacement of the grains [m] at a height above the base, at all times."""
        times = np.atleast_1d(np.asarray(times, float))
        matrices, start, pressure_of, pressure_at_rest, strain_at_rest = self._modes(skeleton, water)
        values, vectors = np.linalg.eig(matrices)
        shares = np.linalg.solve(vectors, start[..., None].astype(complex))[..., 0]
        smoothing = np.sinc((np.arange(self.modes) + 0.5) / self.modes)  # Lanczos, against Gibbs' ripples
        cosines = np.cos(self.wave_numbers * height) * smoothing
        sines = np.sin(self.wave_numbers * height) * smoothing
        pressure, displacement = np.zeros(len(times)), np.zeros(len(times))
        for i, time in enumerate(times):
            if time <= 0:
                continue
            share, growth = _ramped(values, time, ramp, shape)
            deviation = np.einsum("mij,mj->mi", vectors, shares * growth).real
            pressure[i] = cosines @ np.sum(pressure_of * deviation, axis=1) + share * pressure_at_rest
            displacement[i] = -(sines @ deviation[:, 0] + share * height * strain_at_rest)
        return pressure, displacement


@dataclass
class UpColumn(SaturatedColumn):
    """The same column in the formulation u-p."""

    inertia_in_darcy: bool = False

    def systems(self, wave_numbers):
        """Matrices of d(u, v, p)/dt, one per wave number."""
        numbers = np.atleast_1d(wave_numbers)
        density, stiffness = self.mass.sum(), self.water_modulus / self.porosity
        mobility = self.conductivity / (self.water_density * self.gravity)
        lost = self.water_density * self.inertia_in_darcy
        matrices = np.zeros((len(numbers), 3, 3))
        matrices[:, 0, 1] = 1
        matrices[:, 1, 0] = -self.modulus * numbers**2 / density
        matrices[:, 1, 2] = numbers / density
        matrices[:, 2, 0] = -stiffness * mobility * lost * self.modulus * numbers**3 / density
        matrices[:, 2, 1] = -stiffness * numbers
        matrices[:, 2, 2] = -stiffness * mobility * numbers**2 * (1 - lost / density)
        return matrices

    def _modes(self, skeleton, water):
        signs = (-1.0) ** np.arange(self.modes)
        start = np.zeros((self.modes, 3))
        start[:, 0] = (2 / self.height) * signs / self.wave_numbers**2 * skeleton / self.modulus
        start[:, 2] = -(2 / self.height) * signs / self.wave_numbers * water
        pressure = np.zeros((self.modes, 3))
        pressure[:, 2] = 1
        return self.systems(self.wave_numbers), start, pressure, water, -skeleton / self.modulus

    def growth(self, wave_number):
        """Rate [1/s] at which waves of a wave number [1/m] grow (positive) or fade."""
        return float(np.linalg.eigvals(self.systems(wave_number)[0]).real.max())

    @property
    def well_posed(self):
        """Do waves of all lengths fade?"""
        density = self.mass.sum()
        return not self.inertia_in_darcy or self.water_modulus / self.porosity * (density - self.water_density) > (
            self.water_density * self.modulus)
