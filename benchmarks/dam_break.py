#!/usr/bin/python3
"""The dam break of 200 x 200 cells that codes are compared by, in CPU time of one core: Mudlark with a free surface and
with two fluids, and OpenFOAM's interFoam on the same grid and Courant number.

    /usr/bin/python3 benchmarks/dam_break.py build/release/bin/mudlark [--cells 200] [--end 1.0] [--no-openfoam]

A column of water 0.146 m wide and 0.292 m high beside a wall of a box 0.584 m wide and high, no-slip walls, open above,
Courant number 0.5, one simulated second. OpenFOAM is Debian's (`apt install openfoam`); without it only Mudlark runs.
Printed for each: steps, CPU seconds of the solver, microseconds per cell and step, where the front is, by how much the
volume of the water changed up to the last of these times (later some splashes out of the box), and OpenFOAM's time as a
multiple of Mudlark's. Targets: 15 s and 100 s (two fluids).
"""
import argparse
import json
import os
import re
import resource
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

SIZE, COLUMN = 0.584, (0.146, 0.292)  # [m]
FRONT_TIMES = (0.05, 0.1, 0.15, 0.2, 0.25)  # [s], before the front meets the far wall at about 0.3 s

CASE = """
title = "dam break, {cells} x {cells} cells"
[domain]
upper = [{size}, {size}]
cells = [{cells}, {cells}]
gravity = "9.81 m/s2"
[domain.walls]
lower_x = "no-slip"
upper_x = "no-slip"
lower_z = "no-slip"
upper_z = "open"
[time]
end = {end}
output_every = {end}
[water]
density = 1000.0
viscosity = "1e-3 Pa s"
air = "{air}"
[flow_solver]
courant = 0.5
[[water.body]]
shape = {{ box = {{ lower = [0.0, 0.0], upper = [{width}, {height}] }} }}
pressure = "hydrostatic"
[[gauge]]
name = "front"
quantity = "front"
every = "10 ms"
[[gauge]]
name = "water"
quantity = "total_water"
every = "10 ms"
"""

HEADER = "FoamFile {{ version 2.0; format ascii; class {0}; object {1}; }}\n"
FOAM = {
    ("system/blockMeshDict", "dictionary"): """
scale 1;
vertices ((0 0 0) ({size} 0 0) ({size} {size} 0) (0 {size} 0) (0 0 0.01) ({size} 0 0.01) ({size} {size} 0.01) (0 {size} 0.01));
blocks (hex (0 1 2 3 4 5 6 7) ({cells} {cells} 1) simpleGrading (1 1 1));
boundary (
  walls {{ type wall; faces ((0 4 7 3) (1 2 6 5) (0 1 5 4)); }}
  atmosphere {{ type patch; faces ((3 7 6 2)); }}
  sides {{ type empty; faces ((0 3 2 1) (4 5 6 7)); }}
);
""",
    ("system/controlDict", "dictionary"): """
application interFoam; startFrom startTime; startTime 0; stopAt endTime; endTime {end};
deltaT 1e-4; writeControl adjustableRunTime; writeInterval 0.05; purgeWrite 0; writeFormat ascii; writePrecision 10;
timeFormat general; timePrecision 6; runTimeModifiable no; adjustTimeStep yes; maxCo 0.5; maxAlphaCo 0.5; maxDeltaT 1;
""",
    ("system/fvSchemes", "dictionary"): """
ddtSchemes {{ default Euler; }}
gradSchemes {{ default Gauss linear; }}
divSchemes {{ div(rhoPhi,U) Gauss linearUpwind grad(U); div(phi,alpha) Gauss vanLeer; div(phirb,alpha) Gauss linear;
  div(((rho*nuEff)*dev2(T(grad(U))))) Gauss linear; }}
laplacianSchemes {{ default Gauss linear corrected; }}
interpolationSchemes {{ default linear; }}
snGradSchemes {{ default corrected; }}
""",
    ("system/fvSolution", "dictionary"): """
solvers {{
  "alpha.water.*" {{ nAlphaCorr 2; nAlphaSubCycles 1; cAlpha 1; MULESCorr yes; nLimiterIter 5;
    solver smoothSolver; smoother symGaussSeidel; tolerance 1e-8; relTol 0; }}
  "pcorr.*" {{ solver PCG; preconditioner DIC; tolerance 1e-5; relTol 0; }}
  p_rgh {{ solver PCG; preconditioner DIC; tolerance 1e-7; relTol 0.05; }}
  p_rghFinal {{ solver PCG; preconditioner DIC; tolerance 1e-7; relTol 0; }}
  U {{ solver smoothSolver; smoother symGaussSeidel; tolerance 1e-6; relTol 0; }}
}}
PIMPLE {{ momentumPredictor no; nOuterCorrectors 1; nCorrectors 3; nNonOrthogonalCorrectors 0; }}
""",
    ("system/setFieldsDict", "dictionary"): """
defaultFieldValues (volScalarFieldValue alpha.water 0);
regions (boxToCell {{ box (0 0 -1) ({width} {height} 1); fieldValues (volScalarFieldValue alpha.water 1); }});
""",
    ("constant/transportProperties", "dictionary"): """
phases (water air);
water {{ transportModel Newtonian; nu 1e-6; rho 1000; }}
air {{ transportModel Newtonian; nu 1.5e-5; rho 1.2; }}
sigma 0;
""",
    ("constant/turbulenceProperties", "dictionary"): "simulationType laminar;\n",
    ("constant/g", "uniformDimensionedVectorField"): "dimensions [0 1 -2 0 0 0 0]; value (0 -9.81 0);\n",
    ("0/U", "volVectorField"): """
dimensions [0 1 -1 0 0 0 0]; internalField uniform (0 0 0);
boundaryField {{ walls {{ type noSlip; }} sides {{ type empty; }}
  atmosphere {{ type pressureInletOutletVelocity; value uniform (0 0 0); }} }}
""",
    ("0/p_rgh", "volScalarField"): """
dimensions [1 -1 -2 0 0 0 0]; internalField uniform 0;
boundaryField {{ walls {{ type fixedFluxPressure; value uniform 0; }} sides {{ type empty; }}
  atmosphere {{ type totalPressure; p0 uniform 0; }} }}
""",
    ("0/alpha.water", "volScalarField"): """
dimensions [0 0 0 0 0 0 0]; internalField uniform 0;
boundaryField {{ walls {{ type zeroGradient; }} sides {{ type empty; }}
  atmosphere {{ type inletOutlet; inletValue uniform 0; value uniform 0; }} }}
""",
}


def cpu_seconds(command, folder, environment):
    """CPU time of a command and its children [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{command[0]} failed ({done.returncode}):\n{(done.stdout + done.stderr)[-2000:]}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout


def run_mudlark(program, values, air):
    """Steps, CPU seconds, front by time, change of volume."""
    with tempfile.TemporaryDirectory() as folder:
        case = Path(folder) / "case.toml"
        case.write_text(CASE.format(air=air, **values))
        cpu, _ = cpu_seconds([program, "run", str(case), "-o", str(Path(folder) / "out"), "--quiet"], folder, os.environ)
        out = Path(folder) / "out"
        summary = json.loads((out / "summary.json").read_text())
        rows = {name: [line.split(",")[:2] for line in (out / f"gauges/{name}.csv").read_text().splitlines()
                       if re.match(r"[0-9.]", line)] for name in ("front", "water")}
    front = {round(float(t), 3): float(x) for t, x in rows["front"]}
    water = [float(v) for t, v in rows["water"] if float(t) <= FRONT_TIMES[-1] + 1e-9]
    return summary["steps"], cpu, front, max(abs(v / water[0] - 1) for v in water)


def internal_values(path, count):
    """The cells' values of an ASCII field of OpenFOAM."""
    text = path.read_text()
    uniform = re.search(r"internalField\s+uniform\s+([-0-9.e]+);", text)
    if uniform:
        return [float(uniform[1])] * count
    return [float(v) for v in re.search(r"internalField\s+nonuniform[^(]*\(([^)]*)\)", text)[1].split()]


def run_openfoam(values):
    cells = values["cells"]
    environment = dict(os.environ)
    environment.setdefault("WM_PROJECT_DIR", "/usr/share/openfoam")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for (path, kind), text in FOAM.items():
            (folder / path).parent.mkdir(exist_ok=True)
            (folder / path).write_text(HEADER.format(kind, Path(path).name) + text.format(**values))
        for command in ("blockMesh", "setFields"):
            cpu_seconds([command], folder, environment)
        cpu, log = cpu_seconds(["interFoam"], folder, environment)
        front, volume = {}, []
        for when in sorted((p for p in folder.iterdir() if re.fullmatch(r"[0-9.]+", p.name)), key=lambda p: float(p.name)):
            alpha = internal_values(when / "alpha.water", cells * cells)
            wet = [i for i in range(cells) if alpha[i] > 0.5]  # the row on the floor
            front[round(float(when.name), 3)] = (wet[-1] + 1) * SIZE / cells if wet else 0.0
            if float(when.name) <= FRONT_TIMES[-1] + 1e-9:
                volume.append(sum(alpha))
    return len(re.findall(r"^Time = ", log, re.M)), cpu, front, max(abs(v / volume[0] - 1) for v in volume)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--cells", type=int, default=200, help="along each side")
    parser.add_argument("--end", type=float, default=1.0, help="simulated seconds")
    parser.add_argument("--no-openfoam", action="store_true")
    arguments = parser.parse_args()
    program = str(Path(arguments.program).resolve())
    values = {"cells": arguments.cells, "end": arguments.end, "size": SIZE, "width": COLUMN[0], "height": COLUMN[1]}
    runs = {"mudlark, free surface": lambda: run_mudlark(program, values, "void"),
            "mudlark, two fluids": lambda: run_mudlark(program, values, "gas")}
    if shutil.which("interFoam") and not arguments.no_openfoam:
        runs["OpenFOAM interFoam"] = lambda: run_openfoam(values)
    else:
        print("OpenFOAM is not run (interFoam is not on the PATH, or --no-openfoam)")
    cost = {}
    print(f"{arguments.cells} x {arguments.cells} cells, {arguments.end:g} s, Courant 0.5, one core, {time.strftime('%Y-%m-%d')}")
    for name, run in runs.items():
        steps, cost[name], front, lost = run()
        places = "  ".join(f"{front[t]:.3f}" if t in front else "-" for t in FRONT_TIMES)
        print(f"{name:24} {steps:6} steps {cost[name]:9.1f} s {1e6 * cost[name] / steps / arguments.cells**2:7.3f} us per cell "
              f"and step   front at {', '.join(f'{t:g}' for t in FRONT_TIMES)} s: {places} m   volume {lost:.1e}", flush=True)
    foam = cost.pop("OpenFOAM interFoam", None)
    for name, seconds in cost.items():
        if foam:
            print(f"OpenFOAM / ({name}) = {foam / seconds:.1f}")


if __name__ == "__main__":
    main()
