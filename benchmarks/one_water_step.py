#!/usr/bin/python3
"""What a step of one water costs against a flow step and a soil step on the same grid and points (CPU time, one rank).

    /usr/bin/python3 benchmarks/one_water_step.py build/release/bin/mudlark [--cells 96] [--steps 200]

A mound of soil under water that sloshes over it: in one water; as water over a porous mound of the same drag; as soil
alone, single-phase. Each is run twice, the difference of the two is that of the steps alone. Target: 1.3.
"""
import argparse
import json
import subprocess
import tempfile
from pathlib import Path

STEP = 2e-4  # [s], below what any of the three asks for

COMMON = """
title = "step of one water"
[domain]
upper = [2.0, 1.0]
cells = [{cells}, {half}]
walls = {{ upper_z = "open" }}
[time]
end = {end}
max_step = {step}
"""
WATER = """
[water]
[[water.body]]
shape = {{ box = {{ lower = [0.0, 0.0], upper = [1.0, 0.85] }} }}
[[water.body]]
shape = {{ box = {{ lower = [1.0, 0.0], upper = [2.0, 0.75] }} }}
"""
MOUND = "shape = {{ below = {{ line = [[0.0, 0.4], [0.8, 0.4], [1.0, 0.5], [1.2, 0.4], [2.0, 0.4]] }} }}\nporosity = 0.4\n"
SOIL = ("[[soil]]\nname = \"mound\"\n" + MOUND + "points_per_cell = 4\ninitial_stress = \"geostatic\"\n"
        "law = {{ type = \"mohr-coulomb\", young_modulus = \"1 MPa\", poisson_ratio = 0.3, friction_angle = 31, cohesion = 500 }}\n")
CASES = {
    "one water": COMMON + WATER + SOIL + 'pore_water = "unified"\nhydraulic_conductivity = "1e-3 m/s"\n'
                 '[coupling]\nmode = "unified"\n',
    "flow": COMMON + WATER + "[[porous]]\nname = \"mound\"\n" + MOUND
            + 'drag = {{ type = "darcy", hydraulic_conductivity = "1e-3 m/s" }}\n',
    "soil": COMMON + SOIL + 'pore_water = "none"\n',
}


def seconds(program, text, cells, steps):
    with tempfile.TemporaryDirectory() as folder:
        case = Path(folder) / "case.toml"
        case.write_text(text.format(cells=cells, half=cells // 2, end=steps * STEP, step=STEP))
        subprocess.run([program, "run", case, "-o", Path(folder) / "out", "--quiet"], check=True)
        summary = json.loads((Path(folder) / "out" / "summary.json").read_text())
        done = max(summary["steps"], summary.get("soil steps") or 0)
        return summary["CPU time [s]"], done


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--cells", type=int, default=96, help="along the longer side")
    parser.add_argument("--steps", type=int, default=200)
    arguments = parser.parse_args()
    cost = {}
    for name, text in CASES.items():
        short, few = seconds(arguments.program, text, arguments.cells, arguments.steps // 4)
        long, many = seconds(arguments.program, text, arguments.cells, arguments.steps)
        cost[name] = (long - short) / (many - few) * 1000
        print(f"{name:10} {cost[name]:8.3f} ms per step ({many} steps)")
    print(f"one water / (flow + soil) = {cost['one water'] / (cost['flow'] + cost['soil']):.2f}  (target 1.3)")


if __name__ == "__main__":
    main()
