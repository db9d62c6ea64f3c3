"""Linear waves that meet a row of blocks head-on: exact by matching eigenfunctions at both ends of the gaps.

    python3 cases/caisson/row_theory.py        checks energy, limits and convergence

Blocks that stand on the bed and reach through the surface leave the wave its cosh k(z+d): only its plan is to be found, which
obeys Helmholtz's equation (Fernyhough & Evans 1995, Scattering by a periodic array of rectangular blocks, J. Fluid Mech.
305). Between the planes of symmetry y = 0 (middle of a block) and y = half_period (middle of a gap):

- before: exp(ikx) + sum A_m cos(m pi y/b) exp(-i k_m x), k_m^2 = k^2 - (m pi/b)^2;
- in the gap: sum [B_n exp(i k_n x) + C_n exp(i k_n (w-x))] cos(n pi (y-a)/g);
- behind: sum D_m cos(m pi y/b) exp(i k_m (x-w)).

Level and flux are continuous at x = 0 and x = w over the gap, no flux enters the block. Time: exp(-iwt).
"""
from dataclasses import dataclass

import numpy as np


@dataclass
class Row:
    """Complex, for an incident wave of unit amplitude, phases at the block's front (behind: at its lee)."""

    reflection: complex
    transmission: complex
    front: complex  # mean level over the front of the block
    lee: complex


def row(k, half_period, half_gap, width, modes=160):
    """Waves of number k [1/m]; lengths in m. 160 modes: to 1e-5."""
    b, g = half_period, half_gap
    a, gap_modes = b - g, max(4, round(modes * g / b))
    m, n = np.arange(modes), np.arange(gap_modes)
    k_m = np.sqrt((k**2 - (m * np.pi / b) ** 2).astype(complex))
    k_n = np.sqrt((k**2 - (n * np.pi / g) ** 2).astype(complex))
    norm_m, norm_n = np.where(m == 0, b, b / 2), np.where(n == 0, g, g / 2)
    overlap = overlaps(m * np.pi / b, n * np.pi / g, a, g)  # of the modes outside (rows) and in the gap
    over = np.exp(1j * k_n * width)
    incident = np.zeros(modes, complex)
    incident[0] = 1.0
    size = modes + gap_modes
    A, B = slice(0, modes), slice(modes, size)
    C, D = slice(size, size + gap_modes), slice(size + gap_modes, 2 * size)
    level_1, flux_1 = slice(0, gap_modes), slice(gap_modes, size)
    level_2, flux_2 = slice(size, size + gap_modes), slice(size + gap_modes, 2 * size)
    matrix, right = np.zeros((2 * size, 2 * size), complex), np.zeros(2 * size, complex)
    for level, flux, outside, near, far in ((level_1, flux_1, A, B, C), (level_2, flux_2, D, C, B)):
        matrix[level, outside] = overlap.T
        matrix[level, near], matrix[level, far] = -np.diag(norm_n), -np.diag(norm_n * over)
        matrix[flux, outside] = np.diag(k_m * norm_m)
        matrix[flux, near], matrix[flux, far] = overlap * k_n, -overlap * k_n * over
    right[level_1], right[flux_1] = -overlap.T @ incident, k_m * norm_m * incident
    found = np.linalg.solve(matrix, right)
    mean = np.sinc(m * a / b)  # of cos(m pi y/b) over the block
    return Row(found[A][0], found[D][0], mean @ (incident + found[A]), mean @ found[D])


def overlaps(p, q, a, g):
    """Integrals of cos(p y) cos(q (y-a)) from y = a to a + g, for all p (rows) and q."""
    p, q = p[:, None], q[None, :]
    half = lambda wave: 0.5 * g * np.cos(p * a + wave * g / 2) * np.sinc(wave * g / 2 / np.pi)
    return half(p + q) + half(p - q)


def main():
    k, b, g, w = 2.0412, 0.6, 0.3, 0.6
    print("modes  |R|      |T|      |R|^2+|T|^2-1  |front-lee|")
    for modes in (20, 40, 80, 160, 320):
        one = row(k, b, g, w, modes)
        energy = abs(one.reflection) ** 2 + abs(one.transmission) ** 2 - 1
        print(f"{modes:5}  {abs(one.reflection):.5f}  {abs(one.transmission):.5f}  {energy:13.1e}  "
              f"{abs(one.front - one.lee):.5f}")
        assert abs(energy) < 1e-12
    free = row(k, b, b, w)
    print(f"no block: |R| = {abs(free.reflection):.1e}, T exp(-ikw) - 1 = {abs(free.transmission * np.exp(-1j * k * w) - 1):.1e}")
    wall = row(k, b, 1e-4 * b, w)
    print(f"a gap of 1e-4: |R| = {abs(wall.reflection):.5f}, |front| = {abs(wall.front):.5f} (a wall: 1 and 2)")
    ratio, long = b / g, row(k, 1e-3 * b, 1e-3 * g, w)
    exact = 1 / np.sqrt(1 + 0.25 * (ratio - 1 / ratio) ** 2 * np.sin(k * w) ** 2)
    print(f"a fine row, |T| = {abs(long.transmission):.5f}, channel theory {exact:.5f}")
    assert abs(free.reflection) < 1e-12 and abs(abs(long.transmission) / exact - 1) < 2e-3


if __name__ == "__main__":
    main()
