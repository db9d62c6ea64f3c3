#!/usr/bin/python3
"""A wave over an elastic bed: pore pressure in depth against the exact solution; prints the findings and draws them.

    /usr/bin/python3 cases/wave_over_bed/compare.py --run build/release/bin/mudlark [--results results/wave_over_bed]
                                                    [--picture FILE.png]

A layer of poroelastic soil with incompressible water and grains on rigid, rough, sealed ground (Biot 1941; as Yamamoto et
al. 1978 and Hsu & Jeng 1994 have it for compressible water) answers to a pressure cos(K x) exp(-i w t) on its surface
with displacements and pore pressure of the same wave number: six constants of an ordinary differential equation in
depth, found here from its eigenvectors. The inertia of the mixture is kept, drag follows Darcy.

Amplitude and phase of eight pressure gauges, over that in the water just above the bed; largest difference of the complex
amplitudes at most 2 % of the pressure at the surface.

Exits with 1 when the tolerance is missed.
"""
import argparse
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

CASE = Path(__file__).resolve().parent
PACKAGE = CASE.parents[1] / "python"
if not (PACKAGE / "mudlark").is_dir():
    sys.exit("compare.py needs Mudlark's Python package: run it where it lies, in cases/ of Mudlark's source tree.")
sys.path.insert(0, str(PACKAGE))
from mudlark.results import Results  # noqa: E402

BED, WATER, WAVE_NUMBER = 0.5, 0.3, np.pi                # [m], [m], [1/m]
WEIGHT, CONDUCTIVITY = 9810.0, 1e-3                      # [N/m3], [m/s]
YOUNG, POISSON, DENSITY = 1e6, 0.3, 0.6 * 2650 + 0.4 * 1000
SHEAR = YOUNG / 2 / (1 + POISSON)
CONFINED = YOUNG * (1 - POISSON) / (1 + POISSON) / (1 - 2 * POISSON)
LAME = CONFINED - 2 * SHEAR
HEIGHTS = (0.4625, 0.4125, 0.3625, 0.2875, 0.2125, 0.1375, 0.0625, 0.0125)
TOLERANCE = 2.0                                          # [% of the pressure at the surface]
START = 1.3                                              # the first period belongs to the start [s]


def pore_pressure(omega, heights):
    """Complex amplitude over that at the bed's surface, for exp(-i omega t), at heights z above the ground."""
    k = WAVE_NUMBER
    inertia = DENSITY * omega**2
    storage = -1j * omega * WEIGHT / CONDUCTIVITY
    matrix = np.zeros((6, 6), complex)                   # of u sin(kx), w cos(kx), p cos(kx), u', w', p'
    matrix[:3, 3:] = np.eye(3)
    matrix[3, [0, 2, 4]] = (CONFINED * k**2 - inertia) / SHEAR, -k / SHEAR, (LAME + SHEAR) * k / SHEAR
    matrix[4, [1, 3, 5]] = (SHEAR * k**2 - inertia) / CONFINED, -(LAME + SHEAR) * k / CONFINED, 1 / CONFINED
    matrix[5, [0, 2, 4]] = storage * k, k**2, storage
    values, vectors = np.linalg.eig(matrix)
    scale = np.exp(np.where(values.real < 0, -values.real, 0) * BED)   # largest of each within the bed
    profile = lambda z: vectors * (np.exp(values * (z - BED)) / scale)  # noqa: E731
    top, ground = profile(BED), profile(0.0)
    conditions = np.array([top[2], CONFINED * top[4] + LAME * k * top[0], top[3] - k * top[1], ground[0], ground[1], ground[5]])
    constants = np.linalg.solve(conditions, np.array([1, 0, 0, 0, 0, 0], complex))
    return np.array([profile(z)[2] @ constants for z in heights])


def fit(time, pressure, omega):
    """Least squares of exp(-i omega t), a mean and a drift: complex amplitude and what is left."""
    wave = np.exp(-1j * omega * time)
    basis = np.stack([wave.real, -wave.imag, np.ones_like(time), time], axis=1)
    parts = np.linalg.lstsq(basis, pressure, rcond=None)[0]
    return parts[0] + 1j * parts[1], np.sum((basis @ parts - pressure) ** 2)


def find_frequency(time, pressure):
    """Complex frequency of the wave as it is in the run: what is left is smallest."""
    best = np.sqrt(9.81 * WAVE_NUMBER * np.tanh(WAVE_NUMBER * WATER)) + 0j
    step = 0.1
    while step > 1e-6:
        trials = [best + step * (a + 1j * b) for a in (-1, 0, 1) for b in (-1, 0, 1)]
        now = min(trials, key=lambda omega: fit(time, pressure, omega)[1])
        step, best = (step / 2, best) if now == best else (step, now)
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--run", metavar="PROGRAM", help="run the case with this program first")
    parser.add_argument("--results", type=Path, default=Path("results/wave_over_bed"))
    parser.add_argument("--picture", type=Path, default=Path("wave_over_bed.png"))
    arguments = parser.parse_args()
    if arguments.run:
        subprocess.run([arguments.run, "run", str(CASE / "standing.toml"), "-o", str(arguments.results), "--quiet"], check=True)
    results = Results(arguments.results)
    water = results.gauge("pressure at 0.5125")
    chosen = water.time > START
    time = water.time[chosen]
    omega = find_frequency(time, water["pressure"][chosen])
    print(f"wave: period {2 * np.pi / omega.real:.4f} s, over rigid ground {2 * np.pi / 4.7638:.4f} s; "
          f"decay {-omega.imag:.5f} 1/s")
    surface = fit(time, water["pressure"][chosen], omega)[0] / np.cosh(WAVE_NUMBER * (0.5125 - BED))
    exact = pore_pressure(omega, HEIGHTS)
    ours = np.array([fit(time, results.gauge(f"pressure at {z:g}")["pressure"][chosen], omega)[0] for z in HEIGHTS]) / surface
    for z, mine, theory in zip(HEIGHTS, ours, exact):
        print(f"{BED - z:.4f} m deep: {abs(mine):.4f} of the surface's, lag {np.degrees(np.angle(mine)):+6.2f} deg;  exact "
              f"{abs(theory):.4f}, {np.degrees(np.angle(theory)):+6.2f} deg")
    worst = np.abs(ours - exact).max() * 100
    good = worst <= TOLERANCE
    print(f"largest difference {worst:.2f} % of the surface's pressure (tolerance {TOLERANCE:g}){'' if good else '  MISS'}")
    figure, axes = plt.subplots(1, 2, figsize=(8, 3.6), layout="constrained", sharey=True)
    fine = np.linspace(0, BED, 200)
    curve = pore_pressure(omega, fine)
    for axis, part, label in zip(axes, (np.abs, lambda c: np.degrees(np.angle(c))),
                                 ("amplitude over that at the surface [-]", "lag of the phase [degrees]")):
        axis.plot(part(curve), fine, "k", lw=1, label="exact")
        axis.plot(part(ours), HEIGHTS, "o", ms=4, mfc="none", label="Mudlark")
        axis.set_xlabel(label)
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("z [m]")
    axes[0].legend(frameon=False)
    arguments.picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(arguments.picture, dpi=130)
    print(f"picture: {arguments.picture}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
