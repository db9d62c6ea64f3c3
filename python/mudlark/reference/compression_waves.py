"""Compression waves in a saturated elastic column: the exact response to a load, mode by mode.

A column of height H stands on a fixed, impermeable base (x = 0) and is open at its top. Small strain, no gravity,
incompressible grains. With D = n^2 gamma_w / k, velocities v of the grains and w of the pore water (Biot 1956):

    (1-n) rho_s v' = d(sigma')/dx - (1-n) dp/dx + D (w - v)       sigma' = M du/dx
       n  rho_w w' =              -    n  dp/dx - D (w - v)       p = -(K_w/n) ((1-n) du/dx + n dU/dx)

At the top sigma' = -q_s and p = q_w, both brought on over `ramp`, linearly or by half a cosine. Displacements are expanded in sin(L x),
L = (m + 1/2) pi/H, about the state of rest under the full load; every mode is a linear system of four equations whose
exponential is exact. Compression of water and compressive stress are positive in what is returned. SI units.
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

    def response(self, height, times, skeleton=0.0, water=0.0, ramp=0.0, shape="cosine"):
        """Pore pressure [Pa] and downward displacement of the grains [m] at a height above the base, at all times."""
        times = np.atleast_1d(np.asarray(times, float))
        load = np.array([-skeleton - (1 - self.porosity) * water, -self.porosity * water])
        rest = np.linalg.solve(self.stiffness, load)  # du/dx and dU/dx when all is over
        signs = (-1.0) ** np.arange(self.modes)
        amplitudes = (2 / self.height) * (signs / self.wave_numbers**2)[:, None] * rest
        values, vectors = np.linalg.eig(self.systems(self.wave_numbers))
        start = np.zeros((self.modes, 4), complex)
        start[:, :2] = -amplitudes
        shares = np.linalg.solve(vectors, start[..., None])[..., 0]
        smoothing = np.sinc((np.arange(self.modes) + 0.5) / self.modes)  # Lanczos, against Gibbs' ripples
        strain_shape = np.cos(self.wave_numbers * height) * smoothing * self.wave_numbers
        way_shape = np.sin(self.wave_numbers * height) * smoothing
        pressure, displacement = np.zeros(len(times)), np.zeros(len(times))
        n = self.porosity
        for i, time in enumerate(times):
            if time <= 0:
                continue
            share, growth = _ramped(values, time, ramp, shape)
            deviation = np.einsum("mij,mj->mi", vectors, shares * growth).real[:, :2]
            strain = strain_shape @ deviation + share * rest
            pressure[i] = -self.water_modulus / n * ((1 - n) * strain[0] + n * strain[1])
            displacement[i] = -(way_shape @ deviation[:, 0] + share * height * rest[0])
        return pressure, displacement
