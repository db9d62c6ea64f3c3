"""What the comparisons in cases/ share: what was found beside its tolerance, and running a case with settings."""
import subprocess
import sys


class Findings:
    """Prints each finding beside its tolerance and remembers misses."""

    def __init__(self):
        self.misses = []

    def check(self, what, value, tolerance, unit="%"):
        """`value` may lie up to `tolerance` from zero; a value that is no number misses."""
        good = abs(value) <= tolerance
        print(f"{what}: {value:+.3g} {unit} (tolerance {tolerance:g}){'' if good else '  MISS'}")
        if not good:
            self.misses.append(what)
        return good

    @property
    def exit_code(self):
        return 1 if self.misses else 0


def run(program, case, folder, *settings):
    """Runs a case file into a folder; settings are texts like "time.end=2"."""
    command = [str(program), "run", str(case), "-o", str(folder), "--quiet"]
    for setting in settings:
        command += ["--set", setting]
    finished = subprocess.run(command)
    if finished.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with exit code {finished.returncode}")
