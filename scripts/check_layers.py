#!/usr/bin/python3
"""Fails when the house loses its shape: an include that points upwards, a library used outside its place,
a file that has grown too long, a folder of src/ without its CMake target or with a link that points upwards.

The table is that of docs/developer/architecture.md.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LONGEST_FILE = 500  # lines

FOUNDATION = {"base", "parallel", "grid"}
MAY_INCLUDE = {  # besides itself
    "base": set(),
    "parallel": {"base"},
    "materials": {"base"},
    "grid": {"base", "parallel"},
    "numerics": FOUNDATION,
    "output": FOUNDATION,
    "flow": FOUNDATION | {"materials", "numerics"},
    "soil": FOUNDATION | {"materials", "numerics"},
    "coupling": FOUNDATION | {"materials", "numerics", "flow", "soil"},
    "run": FOUNDATION | {"materials", "numerics", "flow", "soil", "coupling", "output"},
    "input": FOUNDATION | {"materials", "numerics", "flow", "soil", "coupling", "output", "run"},
}
# Libraries that only some folders may see, by the beginning of the header's name.
ONLY_IN = {
    "toml++": {"input"},
    "udunits2": {"input"},
    "muParser": {"input"},
    "hdf5": {"output"},
    "HYPRE": {"numerics"},
    "_hypre": {"numerics"},
    "mpi": set(MAY_INCLUDE) - {"base", "materials"},
    "petsc": set(MAY_INCLUDE) - {"base", "materials"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')


def files(folder, *endings):
    return sorted(p for p in (ROOT / folder).rglob("*") if p.suffix in endings)


def check_includes(module, path):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        quote, header = match.groups()
        place = f"{path.relative_to(ROOT)}:{number}: includes {header}"
        if quote == '"':
            target = header.split("/")[0]
            if not (ROOT / "src" / header).is_file():
                yield f"{place}, which is not in src/ (write the path from src/)"
            elif target != module and target not in MAY_INCLUDE[module]:
                allowed = ", ".join(sorted(MAY_INCLUDE[module])) or "nothing else"
                yield f"{place}, but {module} may include only itself and: {allowed}"
        for library, places in ONLY_IN.items():
            if quote == "<" and header.startswith(library) and module not in places:
                yield f"{place}, but only {', '.join(sorted(places))} may use {library}"


def check_targets(modules):
    cmake = (ROOT / "src/CMakeLists.txt").read_text()
    links = dict(re.findall(r"mudlark_module\((\w+)\s+LINKS\s+([^)]*)\)", cmake))
    for module in modules:
        if module not in MAY_INCLUDE:
            yield f"src/{module}: no such layer; add it to scripts/check_layers.py and the architecture page"
        if module not in links:
            yield f"src/CMakeLists.txt: no mudlark_module({module} ...) for the folder src/{module}"
    for module, linked in links.items():
        for target in re.findall(r"mudlark_(\w+)", linked):
            if target in MAY_INCLUDE and target not in MAY_INCLUDE.get(module, set()):
                yield f"src/CMakeLists.txt: mudlark_{module} links mudlark_{target}, which is not below it"


def check_lengths():
    for folder in ("src", "apps", "tests", "benchmarks", "python", "cases", "scripts"):
        for path in files(folder, ".cpp", ".hpp", ".py", ".sh"):
            length = len(path.read_text().splitlines())
            if length > LONGEST_FILE:
                yield f"{path.relative_to(ROOT)}: {length} lines; split it (at most {LONGEST_FILE})"


def main():
    modules = sorted(p.name for p in (ROOT / "src").iterdir() if p.is_dir() and any(p.iterdir()))
    problems = list(check_targets(modules))
    for module in modules:
        if module in MAY_INCLUDE:
            for path in files(f"src/{module}", ".cpp", ".hpp"):
                problems += check_includes(module, path)
    problems += check_lengths()
    for problem in problems:
        print(problem)
    print(f"check_layers: {len(modules)} modules, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
