#!/usr/bin/python3
"""Runs the first part of every shipped case of flowing water at Courant numbers 0.25, 0.5 (the largest allowed) and as
shipped, and says whether it ended well: no divergence, no number that is not finite, no water lost. By hand:

    /usr/bin/python3 scripts/courant_sweep.py [--program build/release/bin/mudlark] [--share 0.1] [--until SECONDS]
                                              [--results results/courant] [CASE.toml ...]

Exits with 1 when a run did not end well or its water changed by more than 1e-11.
"""
import argparse
import json
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
COURANT = (0.25, None, 0.5)  # None: as shipped
MOST_LOST = 1e-11


def flow_cases():
    for path in sorted(ROOT.glob("cases/*/*.toml")):
        case = tomllib.loads(path.read_text())
        if "body" in case.get("water", {}):
            yield path


def end_of(path):
    case = tomllib.loads(path.read_text())
    end = case["time"].get("end", case.get("stage", [{}])[-1].get("end"))
    if isinstance(end, (int, float)):
        return float(end)
    number, unit = end.split()
    return float(number) * {"s": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0}[unit]


def run(program, path, folder, courant, until):
    command = [program, "run", str(path), "-o", str(folder), "--quiet", "--until", f"{until:g}"]
    if courant is not None:
        command += ["--set", f"flow_solver.courant={courant}"]
    finished = subprocess.run(command, capture_output=True, text=True)
    summary = json.loads((folder / "summary.json").read_text()) if finished.returncode in (0, 2) else {}
    lost = summary.get("conservation errors", {}).get("water")
    good = finished.returncode == 0 and lost is not None and abs(lost) <= MOST_LOST
    return good, summary, lost, (finished.stderr.strip().splitlines() or [""])[-1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", type=Path)
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/mudlark"))
    parser.add_argument("--share", type=float, default=0.1, help="part of the simulated time that is run")
    parser.add_argument("--until", type=float, help="simulated time at most [s]")
    parser.add_argument("--results", type=Path, default=Path("results/courant"))
    arguments = parser.parse_args()
    bad = 0
    print(f"{'case':<42}{'Courant':>8}{'t [s]':>9}{'steps':>7}{'dt [s]':>20}{'water lost':>12}")
    for path in arguments.cases or flow_cases():
        until = min(arguments.share * end_of(path), arguments.until or float("inf"))
        name = f"{path.parent.name}/{path.stem}"
        for courant in COURANT:
            word = "shipped" if courant is None else f"{courant:g}"
            good, summary, lost, message = run(arguments.program, path, arguments.results / name / word, courant, until)
            bad += not good
            steps = summary.get("steps", 0)
            range_ = f"{summary.get('smallest step [s]', 0):.2g} to {summary.get('largest step [s]', 0):.2g}"
            print(f"{name:<42}{word:>8}{until:>9.3g}{steps:>7}{range_:>20}{'-' if lost is None else f'{lost:.1e}':>12}"
                  f"{'' if good else '  FAILED ' + message}", flush=True)
    print(f"{bad} runs did not end well")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
