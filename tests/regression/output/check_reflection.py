#!/usr/bin/python3
"""Reflection analysis finds the incident and reflected parts of made-up waves."""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "python"))
from mudlark.reflection import irregular, regular, wave_number  # noqa: E402

DEPTH, PLACES = 0.5, np.array([3.0, 3.4, 4.1])


def check(what, found, expected, tolerance):
    assert abs(found - expected) <= tolerance, f"{what}: {found} instead of {expected}"


def test_regular():
    period, time = 2.0, np.arange(0, 8, 0.02)
    k, w = wave_number(period, DEPTH), 2 * np.pi / period
    assert abs(9.81 * k * np.tanh(k * DEPTH) - w * w) < 1e-10
    levels = [0.05 * np.cos(k * x - w * time + 0.3) + 0.01 * np.cos(k * x + w * time - 1)
              + 0.004 * np.cos(2 * (k * x - w * time)) + 0.02 for x in PLACES]
    found = regular(time, levels, PLACES, period, DEPTH)
    check("incident", found.incident, 0.05, 1e-9)
    check("reflected", found.coefficient, 0.2, 1e-9)
    check("phase", found.phase, 0.3, 1e-9)
    check("misfit", found.misfit, 0.0, 1e-9)
    # the other way round all of it comes back
    check("turned", regular(time, levels, -PLACES, period, DEPTH).coefficient, 5.0, 1e-6)


def test_irregular():
    random = np.random.default_rng(3)
    time, peak = np.arange(0, 400, 0.05), 1.5
    frequency = np.linspace(0.5, 2.5, 300) / peak + 1e-3 * random.random(300)
    density = (peak * frequency) ** -5 * np.exp(-1.25 * (peak * frequency) ** -4.0)
    amplitude = np.sqrt(density)
    amplitude *= 0.1 / (4 * np.sqrt(0.5 * np.sum(amplitude**2)))
    phases, k = 2 * np.pi * random.random((2, 300)), wave_number(1 / frequency, DEPTH)
    levels = [sum(a * np.cos(n * x - 2 * np.pi * f * time + one) + 0.3 * a * np.cos(n * x + 2 * np.pi * f * time + two)
                  for a, n, f, one, two in zip(amplitude, k, frequency, *phases)) for x in PLACES]
    found = irregular(time, levels, PLACES, DEPTH, peak)
    check("coefficient", found.coefficient, 0.3, 0.02)
    check("height", found.incident_height, 0.1, 0.006)
    none = [sum(a * np.cos(n * x - 2 * np.pi * f * time + one)
                for a, n, f, one in zip(amplitude, k, frequency, phases[0])) for x in PLACES]
    assert irregular(time, none, PLACES, DEPTH, peak).coefficient < 0.02


for test in (test_regular, test_irregular):
    test()
print("reflection: all good")
