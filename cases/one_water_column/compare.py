#!/usr/bin/python3
"""Columns in one water against theory: large strain, own weight, a source below, a U-tube, two permeameters; prints the findings, draws them.

    /usr/bin/python3 cases/one_water_column/compare.py --run build/release/bin/mudlark [--results results/one_water_column]
                                                       [--picture FILE.png]

- table1.toml, printed.toml: settlement at any time against finite volumes in the material coordinate, and at the end
  against the exact one; tolerance 1 % of the final settlement. printed.toml within 60 s of CPU time.
- self_weight.toml: isochrones of the excess pore pressure (RMS over the points), tolerance 1 % of the largest at the
  start; settlement at any time, 1 % of the final one.
- boiling.toml: the gradient at which the grains weigh nothing, by the slope of the effective stresses below it, and that
  at which 1 % of them is left; tolerance 2 % of i_c = (1 - n) (G - 1).
- permeameter.toml: discharge against k A h/L, tolerance 0.5 %.
- falling_head.toml: head over the vessel's level against h_0 exp(-k t/L), tolerance 1 % of h_0; k as a laboratory
  takes it from the time in which the head falls to 1/e is printed beside it.
- u_tube.toml: difference of the levels against h_0 exp(-2 k t/L), tolerance 1 % of h_0.

Exits with 1 when a tolerance is missed.
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
from mudlark.reference.consolidation import LargeStrainColumn, constrained_modulus, final_settlement  # noqa: E402
from mudlark.results import Results  # noqa: E402

CASES = ("table1", "printed", "self_weight", "boiling", "u_tube", "permeameter", "falling_head")
POROSITY, WEIGHT, BUOYANT = 0.4, 9810.0, 0.6 * 1650 * 9.81  # n, gamma_w, gamma' [N/m3]


def check(findings, text, value, limit, unit="%"):
    good = bool(abs(value) <= limit)
    print(f"{text:<74}{value:9.3g} {unit}  (tolerance {limit:g}){'' if good else '  MISS'}")
    findings.append(good)


def check_table(results, name, conductivity, ramp, findings, axis, colour):
    modulus = constrained_modulus(1e6, 0.3)
    gauge = Results(results / name).gauge("settlement")
    time, settlement = gauge.time[gauge.time > 0], gauge["settlement"][gauge.time > 0]
    column = LargeStrainColumn(law="hencky", height=1.0, modulus=modulus, porosity=POROSITY, conductivity=conductivity,
                               load=4e5, ramp=ramp, water_modulus=1e13, self_weight=True)
    exact = final_settlement("hencky", 4e5, modulus, 1.0)
    theory = column.solve(time).settlement
    difference = 100 * (settlement - theory) / exact
    worst = np.argmax(np.abs(difference))
    check(findings, f"{name}: settlement at the end, of the exact one", 100 * (settlement[-1] / exact - 1), 1.0)
    check(findings, f"{name}: settlement at any time (t = {time[worst]:g} s), of the final one", difference[worst], 1.0)
    T = time * conductivity * modulus / WEIGHT
    axis.semilogx(T, theory, color="black", lw=1)
    axis.semilogx(T[::7], settlement[::7], "o", ms=3, mfc="none", color=colour, label=f"{name}, k = {conductivity:g} m/s")


def check_self_weight(results, findings, axis):
    run = Results(results / "self_weight")
    modulus = constrained_modulus(1e6, 0.2)
    rate = 1e-4 * modulus / WEIGHT  # c_v/H^2 [1/s]
    m = (np.arange(400) + 0.5) * np.pi
    for time, colour in zip((4, 8, 16, 40, 80), plt.cm.viridis(np.linspace(0, 0.85, 5))):
        points = run.points(time)
        z = points["initial position"][:, 2]
        excess = points["pore pressure"] - WEIGHT * (1.2 - points["position"][:, 2])
        exact = BUOYANT * (2 / m**2 * np.cos(np.outer(z, m)) * np.exp(-m * m * rate * time)).sum(axis=1)
        error = 100 * np.sqrt(np.mean((excess - exact) ** 2)) / BUOYANT
        check(findings, f"self_weight: excess pore pressure at T = {rate * time:.3f}, RMS", error, 1.0)
        order = np.argsort(z)
        axis.plot(exact[order] / 1000, z[order], color=colour, lw=1)
        axis.plot(excess[::2] / 1000, z[::2], "o", ms=3, mfc="none", color=colour, label=f"T = {rate * time:.2f}")
    gauge = run.gauge("settlement")
    final = BUOYANT / (2 * modulus)
    decay = (2 * np.sin(m) / m**3 * np.exp(-np.outer(gauge.time, m * m * rate))).sum(axis=1)
    settlement = final * (1 - 2 * decay)
    worst = 100 * np.abs(gauge["settlement"] - settlement).max() / final
    check(findings, "self_weight: settlement at any time, of the final one", worst, 1.0)


def check_boiling(results, findings, axis):
    run = Results(results / "boiling")
    critical = BUOYANT / WEIGHT
    stress, settlement = run.gauge("stress"), run.gauge("settlement")
    name = next(column for column in stress.columns if "zz" in column)
    time = stress.time
    gradient = np.where(time < 2, 0.4 * time, 0.8 + 0.02 * (time - 2))
    below = (time > 3) & (gradient < 0.95 * critical)
    slope, start = np.polyfit(gradient[below], -stress[name][below], 1)
    check(findings, f"boiling: gradient without effective stress, {-start / slope:.4f}, of i_c = {critical:.3f}",
          100 * (-start / slope / critical - 1), 2.0)
    gone = gradient[np.argmax(-stress[name] < -0.01 * stress[name][0])]
    check(findings, f"boiling: gradient at which 1 % of the effective stress is left, {gone:.4f}", 100 * (gone / critical - 1), 2.0)
    heave = -settlement["settlement"]
    axis.plot(gradient, -stress[name], color="tab:blue", label="effective stress at 0.1 m [Pa]")
    axis.axvline(critical, color="black", lw=0.8, label="$i_c$")
    axis.plot(gradient, 1e4 * heave, color="tab:orange", label="heave [0.1 mm]")
    axis.set_ylim(-100, 2500)


def check_u_tube(results, findings, axis):
    run = Results(results / "u_tube")
    left, right = run.gauge("left"), run.gauge("right")
    difference = left["water level"] - right["water level"]
    exact = 0.2 * np.exp(-2 * 0.01 * left.time / 0.2)
    error = 100 * np.sqrt(np.mean((difference - exact) ** 2)) / 0.2
    check(findings, "u_tube: difference of the levels, RMS, of h_0", error, 1.0)
    axis.semilogy(left.time, exact, color="black", lw=1, label="$h_0 e^{-2kt/L}$")
    axis.semilogy(left.time[::8], difference[::8], "o", ms=3, mfc="none", label="u_tube")


def check_permeameter(results, findings):
    exact = 0.01 * 0.2 * 0.2 / 0.2
    for name in ("upstream", "downstream"):
        discharge = Results(results / "permeameter").gauge(name)["discharge"][-1]
        check(findings, f"permeameter: discharge {name}", 100 * (discharge / exact - 1), 0.5)


def check_falling_head(results, findings, axis):
    conductivity, length, start = 0.01, 0.2, 0.2
    run = Results(results / "falling_head")
    standpipe, vessel = run.gauge("standpipe"), run.gauge("vessel")
    head = standpipe["water level"] - vessel["water level"]
    exact = start * np.exp(-conductivity * standpipe.time / length)
    error = 100 * np.sqrt(np.mean((head - exact) ** 2)) / start
    check(findings, "falling_head: head, RMS, of h_0", error, 1.0)
    i = np.argmax(head < start / np.e)
    k = length / standpipe.time[i] * np.log(start / head[i])
    print(f"falling_head: k as a laboratory reads it from the fall to h_0/e {100 * (k / conductivity - 1):+.2f} % (+1.5 % with cells twice as wide)")
    axis.semilogy(standpipe.time, exact, color="grey", lw=1, label="$h_0 e^{-kt/L}$")
    axis.semilogy(standpipe.time[::12], head[::12], "s", ms=3, mfc="none", label="falling_head")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--run", metavar="PROGRAM", help="run the cases with this program first")
    parser.add_argument("--results", type=Path, default=Path("results/one_water_column"))
    parser.add_argument("--picture", type=Path, default=Path("one_water_column.png"))
    arguments = parser.parse_args()
    for case in CASES if arguments.run else ():
        subprocess.run([arguments.run, "run", str(CASE / f"{case}.toml"), "-o", str(arguments.results / case), "--quiet"],
                       check=True)
    findings = []
    figure, axes = plt.subplots(1, 4, figsize=(15, 3.8), layout="constrained")
    check_table(arguments.results, "table1", 1e-4, 0.036, findings, axes[0], "tab:blue")
    check_table(arguments.results, "printed", 1e-6, 30.0, findings, axes[0], "tab:orange")
    seconds = Results(arguments.results / "printed").summary["CPU time [s]"]
    check(findings, "printed: CPU time", seconds, 60.0, "s")
    axes[0].invert_yaxis()
    axes[0].set(xlabel="T", ylabel="settlement [m]", title="Table 1")
    check_self_weight(arguments.results, findings, axes[1])
    axes[1].set(xlabel="excess pore pressure [kPa]", ylabel="z [m]", title="own weight")
    check_boiling(arguments.results, findings, axes[2])
    axes[2].set(xlabel="gradient of the rising flow", title="boiling")
    check_u_tube(arguments.results, findings, axes[3])
    check_permeameter(arguments.results, findings)
    check_falling_head(arguments.results, findings, axes[3])
    axes[3].set(xlabel="time [s]", ylabel="difference of the levels [m]", title="U-tube, falling head")
    for axis in axes:
        axis.legend(fontsize=7, frameon=False)
    arguments.picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(arguments.picture, dpi=110)
    print(f"picture: {arguments.picture}")
    return 0 if all(findings) else 1


if __name__ == "__main__":
    sys.exit(main())
