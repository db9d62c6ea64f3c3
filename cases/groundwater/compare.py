#!/usr/bin/python3
"""Compares seepage with exact solutions, prints the findings and draws them.

    mudlark run cases/groundwater/upward.toml        (and sheet_pile.toml, dam.toml)
    /usr/bin/python3 cases/groundwater/compare.py [--results results] [--picture FILE.png]

- upward: the gradient at which effective stress vanishes, i_c = (1 - n)(G_s - 1); tolerance 2 %.
- sheet pile driven to s in a layer of thickness T, head difference h: q/(k h) = K(m)/(2 K'(m)), m = cos(pi s/2T), exit
  gradient at the pile i h/T, i = pi/(4 K(m') m') with m' = sin(pi s/2T) (derived by zeta = cosh(pi z/T); Harr 1962).
- dam with a flat base of width 2 b: q/(k h) = K'(m)/(2 K(m)), m = tanh(pi b/2T), head along the base by F(phi, m)/K(m).
  K, K' complete elliptic integrals of modulus m and sqrt(1 - m^2); tolerance of discharges 1 %.

Exits with 1 when a tolerance is missed.
"""
import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from scipy.special import ellipk, ellipkinc, ellipkm1  # noqa: E402

PACKAGE = Path(__file__).resolve().parents[2] / "python"
if not (PACKAGE / "mudlark").is_dir():
    sys.exit("compare.py needs Mudlark's Python package: run it where it lies, in cases/ of Mudlark's source tree.")
sys.path.insert(0, str(PACKAGE))
from mudlark.reference.consolidation import constrained_modulus  # noqa: E402
from mudlark.results import Results  # noqa: E402

T, S, B, H = 10.0, 5.0, 10.0, 2.0      # layer, pile, half dam, head difference [m]
K_S, GAMMA = 1e-5, 9810.0              # conductivity [m/s], weight of water [N/m3]
CRITICAL = (1 - 0.4) * (2.65 - 1)


def pile_exact():
    m2 = np.cos(np.pi * S / (2 * T)) ** 2
    rest = 1 - m2
    return ellipk(m2) / (2 * ellipkm1(m2)), np.pi / (4 * ellipk(rest) * np.sqrt(rest)) * H / T


def dam_exact():
    m2 = np.tanh(np.pi * B / (2 * T)) ** 2
    return ellipkm1(m2) / (2 * ellipk(m2))


def dam_head(x):
    """Excess head along the base, x from -b (upstream) to b."""
    m = np.tanh(np.pi * B / (2 * T))
    sine = np.clip(np.tanh(np.pi * x / (2 * T)) / m, -1, 1)
    return H / 2 * (1 - ellipkinc(np.arcsin(sine), m * m) / ellipk(m * m))


def heads_of(results):
    """Positions and excess heads of the points at the end."""
    points = results.points()
    position = points["position"]
    return position[:, 0], position[:, -1], points["pore pressure"] / GAMMA


class Findings:
    def __init__(self):
        self.missed = 0

    def add(self, what, found, exact, tolerance):
        error = found / exact - 1
        hit = abs(error) <= tolerance
        self.missed += not hit
        print(f"{what:44s} {found:10.4f}  exact {exact:8.4f}  {100 * error:+6.2f} %  (tolerance {100 * tolerance:g} %)"
              + ("" if hit else "  MISSED"))


def compare_upward(results, findings, axes):
    """Gradient of the water under the middle against the effective stress there."""
    pressure, stress = results.gauge("pressure"), results.gauge("stress")
    heave, discharge = results.gauge("heave"), results.gauge("discharge")
    vertical = -stress["effective stress zz"]
    depth = 0.5
    gradient = pressure["pore pressure"] / (GAMMA * depth) - 1.0
    weight = (1 - 0.4) * 1650.0 * 9.81 * depth
    # Where the line through the last half of the unloading meets zero.
    part = (vertical < 0.5 * weight) & (vertical > 0.02 * weight)
    slope, at_zero = np.polyfit(vertical[part], gradient[part], 1)
    findings.add("upward: gradient without effective stress", at_zero, CRITICAL, 0.02)
    quick = np.argmax(vertical < 0.005 * weight)
    findings.add("upward: first gradient at which it is gone", gradient[quick], CRITICAL, 0.02)
    flowing = (pressure.time > 4) & (gradient < 0.9 * CRITICAL)
    # The head rises by 0.1 m/s, and the column takes up water: at its base half of S gamma dh/dt H flows more.
    stored = 0.5 * (0.4 / 2e7 + 1 / constrained_modulus(1e7, 0.3)) * GAMMA * 0.1
    flux = -np.interp(pressure.time[flowing], discharge.time, discharge["discharge"]) / 0.08
    conductivity = (flux - stored) / gradient[flowing]
    findings.add("upward: conductivity from the discharge, mm/s", 1e3 * np.mean(conductivity), 2.0, 0.02)
    axes.plot(gradient, vertical / weight, label="computed")
    axes.plot([0, CRITICAL], [1, 0], "k--", label="exact")
    axes.plot(gradient, -heave["settlement"] / 0.04, color="tab:red", label="heave / cell")
    axes.set(xlabel="hydraulic gradient", ylabel="effective stress / that at rest", xlim=(0, 1.2), ylim=(-0.1, 1.1),
             title="upward seepage")
    axes.legend(fontsize=8)


def draw_heads(results, axes, levels, title):
    x, z, head = heads_of(results)
    axes.tricontour(x, z, head, levels=levels, linewidths=0.8)
    axes.set(aspect="equal", title=title, xlabel="x [m]", ylabel="z [m]")


def compare_pile(results, findings, axes):
    discharge, gradient = pile_exact()
    findings.add("sheet pile: q/(k h)", results.gauge("discharge")["discharge"][-1] / (K_S * H), discharge, 0.01)
    x, z, head = heads_of(results)
    cell = 10.0 / 96
    near = (x < 0.5 * cell) & (z > T - 2 * cell)
    depth = T - z[near]
    # The head goes to zero straight at the surface: i = d head / d depth, extrapolated to no depth.
    ratio = head[near] / depth
    fit = np.polyfit(depth, ratio, 1)
    findings.add("sheet pile: exit gradient", np.polyval(fit, 0.0), gradient, 0.03)
    draw_heads(results, axes, np.linspace(0.05, 0.95, 19), "sheet pile: heads")
    axes.plot([0, 0], [S, T], "k", linewidth=3)
    axes.set_xlim(0, 20)


def compare_dam(results, findings, axes, base):
    findings.add("dam: q/(k h)", results.gauge("discharge")["discharge"][-1] / (K_S * H), dam_exact(), 0.01)
    x, z, head = heads_of(results)
    cell = 10.0 / 64
    top = z > T - 0.5 * cell
    under = top & (x > -B)
    order = np.argsort(x[under])
    found, exact = head[under][order], dam_head(x[under][order])
    error = np.sqrt(np.mean((found - exact) ** 2)) / H
    print(f"dam: rms of the head under the base, a quarter cell below it: {100 * error:.2f} % of h (tolerance 1 %)"
          + ("" if error < 0.01 else "  MISSED"))
    findings.missed += error >= 0.01
    draw_heads(results, axes, np.linspace(1.05, 1.95, 19), "dam: heads")
    axes.plot([-B, 0], [T, T], "k", linewidth=3)
    axes.set_xlim(-25, 0)
    base.plot(x[under][order], found / H, label="computed")
    base.plot(x[under][order], exact / H, "k--", label="exact, on the base")
    base.set(xlabel="x [m]", ylabel="head / h", title="dam: head under the base")
    base.legend(fontsize=8)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--picture", type=Path, default=Path("groundwater.png"))
    arguments = parser.parse_args()
    findings = Findings()
    figure, axes = plt.subplots(2, 2, figsize=(11, 6.5))
    for name, compare in (("upward", lambda r: compare_upward(r, findings, axes[0, 0])),
                          ("sheet_pile", lambda r: compare_pile(r, findings, axes[0, 1])),
                          ("dam", lambda r: compare_dam(r, findings, axes[1, 1], axes[1, 0]))):
        folder = arguments.results / name
        if folder.is_dir():
            compare(Results(folder))
        else:
            print(f"{name}: {folder} is not there; first run cases/groundwater/{name}.toml")
    figure.tight_layout()
    figure.savefig(arguments.picture, dpi=100)
    print(f"picture: {arguments.picture}")
    return 1 if findings.missed else 0


if __name__ == "__main__":
    sys.exit(main())
