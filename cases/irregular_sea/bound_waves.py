#!/usr/bin/python3
"""What the analysis of Mansard & Funke finds reflected in a sea of which nothing is: seas of second order, all of whose waves
run one way, at the gauges of sea.toml.

    python3 cases/irregular_sea/bound_waves.py

Free waves as the program makes them (one frequency at random in each of equal bands, JONSWAP), and the waves bound to each
pair of them at the sum of their frequencies (Sharma & Dean 1981, Second-order directional seas and associated wave forces,
Soc. Petrol. Eng. J. 21). Means of five seas.
"""
import tomllib

import numpy as np
from compare import CASE, DEPTH, HEIGHTS, PERIOD, jonswap
from mudlark import reflection

GRAVITY = 9.81


def free_waves(height, seed, components=100):
    """Amplitudes [m], angular frequencies, wave numbers and phases."""
    random = np.random.default_rng(seed)
    edges = np.linspace(0.5, 4, components + 1) / PERIOD
    frequency = edges[:-1] + random.random(components) * np.diff(edges)
    amplitude = np.sqrt(jonswap(frequency, height))
    amplitude *= height / 4 / np.sqrt(np.sum(amplitude**2) / 2)
    return (amplitude, 2 * np.pi * frequency, reflection.wave_number(1 / frequency, DEPTH),
            2 * np.pi * random.random(components))


def bound_waves(amplitude, w, k, phase):
    """The same of the sums of all pairs."""
    r = w**2 / GRAVITY
    i, j = np.triu_indices(len(w))
    root_i, root_j = np.sqrt(r[i]), np.sqrt(r[j])
    total, product = root_i + root_j, k[i] * k[j] - r[i] * r[j]
    both = k[i] + k[j]
    d = (total * (root_j * (k[i] ** 2 - r[i] ** 2) + root_i * (k[j] ** 2 - r[j] ** 2)) + 2 * total**2 * product) / (
        total**2 - both * np.tanh(both * DEPTH))
    kernel = 0.25 * ((d - product) / (root_i * root_j) + r[i] + r[j])  # k/2 of one deep wave with itself: Stokes
    bound = np.where(i == j, 1, 2) * amplitude[i] * amplitude[j] * kernel
    keep = np.abs(bound) > 1e-7
    return bound[keep], (w[i] + w[j])[keep], both[keep], (phase[i] + phase[j])[keep]


def levels(waves, places, time):
    amplitude, w, k, phase = waves
    turning = np.exp(-1j * np.outer(w, time))
    return np.array([((amplitude * np.exp(1j * (k * x + phase))) @ turning).real for x in places])


def main():
    gauges = tomllib.loads((CASE / "sea.toml").read_text())["gauge"]
    places = [gauge["at"][0] for gauge in gauges]
    for name, height in HEIGHTS.items():
        for duration in (90, 35):
            time = np.arange(0, duration + 1e-9, 0.05)
            found = []
            for seed in range(5):
                waves = free_waves(height, seed)
                free = levels(waves, places, time)
                second = free + levels(bound_waves(*waves), places, time)
                found.append([reflection.irregular(time, of, places, DEPTH, PERIOD, bands=40).coefficient
                              for of in (free, second)])
            first, second = 100 * np.sqrt(np.mean(np.square(found), axis=0))
            print(f"{name}, H_m0 = {height} m, {duration} s: free waves alone {first:.1f} % 'reflected', with bound ones "
                  f"{second:.1f} %")


if __name__ == "__main__":
    main()
