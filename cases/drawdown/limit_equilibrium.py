"""Safety of a bank by slip circles: Bishop's simplified method (Bishop 1955, Geotechnique 5), in the plane.

F = sum[(c b + (W - u b) tan phi)/m] / sum[W sin a],  m = cos a + sin a tan phi/F

over slices of width b and weight W (grains and water, per metre), with the pore pressure u at the base of each, which
rises at an angle a. The smallest F among circles from behind the crest to the face is looked for on a lattice of their
ends and depths. The bank's floor, at z = 0, does not slide.
"""
import numpy as np
from scipy.interpolate import RegularGridInterpolator
from scipy.sparse import lil_matrix
from scipy.sparse.linalg import spsolve

WATER = 9810.0                                      # weight of water [N/m3]
SLICES = 40


class Bank:
    """Saturated ground below a `line` [(x, z), ...] that falls towards growing x; x of the ends of the circles."""

    def __init__(self, line, weight, friction, uppers, lowers):
        self.x, self.z = np.array(line, float).T
        self.weight, self.slope = weight, np.tan(np.radians(friction))
        ends = np.meshgrid(np.linspace(*uppers, 31), np.linspace(*lowers, 13), np.linspace(0.03, 0.4, 31))
        self.circles = [side.ravel() for side in ends]

    def surface(self, x):
        return np.interp(x, self.x, self.z)

    def slices(self):
        """Places of the bases, sine and cosine of their angles, widths, heights; which circles can slide."""
        upper, lower, sagitta = self.circles
        rise = self.surface(lower) - self.surface(upper)
        chord = np.hypot(lower - upper, rise)
        depth = sagitta * chord
        radius = (0.25 * chord**2 + depth**2) / (2 * depth)
        middle_x = 0.5 * (upper + lower) - (radius - depth) * rise / chord
        middle_z = 0.5 * (self.surface(upper) + self.surface(lower)) + (radius - depth) * (lower - upper) / chord
        x = upper[:, None] + (lower - upper)[:, None] * (np.arange(SLICES) + 0.5) / SLICES
        square = radius[:, None]**2 - (x - middle_x[:, None])**2
        z = middle_z[:, None] - np.sqrt(np.maximum(square, 0.0))
        height = self.surface(x) - z
        good = (square > 0).all(axis=1) & (height > -1e-9).all(axis=1) & (z > 0).all(axis=1)
        sine = (middle_x[:, None] - x) / radius[:, None]
        width = ((lower - upper) / SLICES)[:, None]
        return x, z, sine, np.sqrt(np.maximum(1 - sine**2, 1e-9)), width, height, good

    def safety(self, cohesion, pressure):
        """F of every circle; pressure(x, z) [Pa]."""
        x, z, sine, cosine, width, height, good = self.slices()
        weight = self.weight * height * width
        driving = np.sum(weight * sine, axis=1)
        good &= driving > 0
        held = cohesion * width + np.maximum(weight - pressure(x, z) * width, 0.0) * self.slope
        safety = np.ones(len(good))
        for _ in range(60):
            share = cosine + sine * self.slope / safety[:, None]
            safety = np.where(good, np.sum(held / share, axis=1) / np.where(good, driving, 1.0), np.inf)
        # Where circles come out steeply the method is known to fail.
        return np.where(good & (share.min(axis=1) > 0.2), safety, np.inf)

    def cohesion_at_failure(self, pressure, most):
        """Cohesion [Pa] with which the least F is one, and the upper end, lower end and sagitta of that circle."""
        low, high = 0.0, most
        for _ in range(16):
            middle = 0.5 * (low + high)
            low, high = (low, middle) if self.safety(middle, pressure).min() > 1 else (middle, high)
        worst = int(np.argmin(self.safety(high, pressure)))
        return high, tuple(side[worst] for side in self.circles)

    def undrained(self, x, z):
        """Water in the pores as before the fall, its load on the surface gone, B-bar = 1 (Bishop 1954; Morgenstern
        1963): u = gamma_w times the depth below the surface."""
        return WATER * (self.surface(x) - z)

    def flow_net(self, h):
        """u of steady flow in rigid ground with p = 0 on its surface, over a closed floor and beside a closed side at
        the crest: the state at once after a fall, before the surface of the water in the ground has moved."""
        nx, nz = round(self.x[2] / h), round(self.z.max() / h)
        xs, zs = (np.arange(nx) + 0.5) * h, (np.arange(nz) + 0.5) * h
        top = self.surface(xs)
        inside = zs[None, :] < top[:, None]
        number = np.full(inside.shape, -1)
        number[inside] = np.arange(inside.sum())
        matrix, right = lil_matrix((inside.sum(),) * 2), np.zeros(inside.sum())
        face = np.interp(-zs, -self.z[1:3], self.x[1:3])           # x of the face at a height
        for i, j in zip(*np.nonzero(inside)):
            me = number[i, j]
            for k, m in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)):
                if k < 0 or m < 0:
                    continue
                if k < nx and m < nz and inside[k, m]:
                    weight, right_side, other = 1.0, 0.0, number[k, m]
                    matrix[me, other] += weight
                else:                                               # the surface, where the head is its height
                    gap = (top[i] - zs[j]) / h if m > j else (face[j] - xs[i]) / h
                    weight = 1 / max(gap, 0.1)
                    right_side = weight * (top[i] if m > j else zs[j])
                matrix[me, me] -= weight
                right[me] -= right_side
        head = np.full(inside.shape, np.nan)
        head[inside] = spsolve(matrix.tocsr(), right)
        return pressure_field(xs, zs, np.where(inside, (head - zs[None, :]) * WATER, 0.0))


def pressure_field(x, z, values):
    """u(x, z), linear between the values at (x, z), not negative."""
    field = RegularGridInterpolator((x, z), values, bounds_error=False, fill_value=None)
    return lambda at, height: np.maximum(field(np.stack([at.ravel(), height.ravel()], axis=1)).reshape(at.shape), 0.0)
