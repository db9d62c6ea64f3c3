#!/usr/bin/python3
"""What a dam break costs per wet cell and step: in the plane from 1e4 to 1e7 cells, in space, and on more ranks.

    /usr/bin/python3 benchmarks/flow_scaling.py build/release/bin/mudlark [--plane 100 200 400] [--space 96] [--steps 200]
                                                                    [--ranks 4]

The column of benchmarks/dam_break.py, over all the depth in space. Every grid is run twice, for about SETTLING and so many
more steps; the difference is that of the steps alone, in CPU time of all ranks. Steps are fixed (a third of a cell at
the speed of the highest wave): the grids see the first moments of the same flow, the finer the shorter. Printed: cells,
wet cells, steps, CPU microseconds per wet cell and step and what the parts of the flow have of it, multigrid cycles per
step. With --ranks all is run again on that many ranks, and printed how often the time of one rank it took. Targets: in
space as much per wet cell as in the plane within 50 %; flat within 15 % from 1e4 to 1e7 cells.
"""
import argparse
import json
import subprocess
import tempfile
from pathlib import Path

SIZE, SETTLING = 0.584, 20
STEP = 0.35 * SIZE / (9.81 * SIZE / 2) ** 0.5  # [s] times cells along a side

CASE = """
title = "dam break, {cells}"
[domain]
upper = {upper}
cells = {cells}
[domain.walls]
upper_z = "open"
[time]
end = {end}
max_step = {step}
output_every = 10.0
[water]
[flow_solver]
courant = 0.5
[[water.body]]
shape = {{ box = {{ lower = {zero}, upper = {column} }} }}
pressure = "hydrostatic"
"""
PARTS = {"interface": "interface [s]", "momentum": "momentum [s]", "forces": "forces [s]", "pressure": "pressure [s]",
         "extension": "extension [s]"}


def run(program, dimension, side, steps, ranks):
    """Summary of a run of so many steps."""
    column = [SIZE / 4, SIZE, SIZE / 2] if dimension == 3 else [SIZE / 4, SIZE / 2]
    with tempfile.TemporaryDirectory() as folder:
        case, step = Path(folder) / "case.toml", STEP / side
        case.write_text(CASE.format(upper=[SIZE] * dimension, cells=[side] * dimension, zero=[0.0] * dimension,
                                    column=column, end=steps * step, step=step))
        done = subprocess.run([program, "run", str(case), "-o", f"{folder}/out", "--quiet", "-n", str(ranks)],
                              capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(done.stdout + done.stderr)
        return json.loads(Path(f"{folder}/out/summary.json").read_text())


def measure(program, dimension, side, steps, ranks):
    """Microseconds per wet cell and step: whole and of the parts; multigrid cycles per step; steps."""
    first, last = run(program, dimension, side, SETTLING, ranks), run(program, dimension, side, SETTLING + steps, ranks)
    wet, done = side**dimension / 8, last["steps"] - first["steps"]
    cost = {"all": 1e6 * (last["CPU time [s]"] - first["CPU time [s]"]) / wet / done}
    for name, key in PARTS.items():  # wall-clock time of the first rank: the share of it goes to the part
        cost[name] = last["flow"][key] - first["flow"][key]
    known = last["time per phase [s]"]["flow"] - first["time per phase [s]"]["flow"]
    for name in PARTS:
        cost[name] *= cost["all"] / known
    return cost, (last["flow"]["multigrid cycles"] - first["flow"]["multigrid cycles"]) / done, done


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--plane", type=int, nargs="*", default=[100, 200, 400, 800], help="cells along a side, 2D")
    parser.add_argument("--space", type=int, nargs="*", default=[48, 96], help="cells along a side, 3D")
    parser.add_argument("--steps", type=int, default=100)
    parser.add_argument("--ranks", type=int, default=1, help="runs all again on so many")
    arguments = parser.parse_args()
    program = str(Path(arguments.program).resolve())
    print(f"{'cells':>12} {'wet':>9} ranks steps cycles   us per wet cell and step: " + " ".join(f"{n:>9}" for n in PARTS))
    for dimension, side in [(2, n) for n in arguments.plane] + [(3, n) for n in arguments.space]:
        alone = None
        for ranks in sorted({1, arguments.ranks}):
            cost, cycles, steps = measure(program, dimension, side, arguments.steps, ranks)
            print(f"{side:>9}^{dimension} {side**dimension // 8:>10} {ranks:>5} {steps:>5} {cycles:>6.1f} {cost['all']:>10.2f}"
                  + " " * 16 + " ".join(f"{cost[n]:>9.3f}" for n in PARTS), flush=True)
            if alone:
                print(" " * 12 + f"{ranks} ranks took the CPU time of one {cost['all'] / alone['all']:.2f} times; by part: "
                      + ", ".join(f"{n} {cost[n] / alone[n]:.2f}" for n in PARTS))
            alone = alone or cost


if __name__ == "__main__":
    main()
