"""Called by python_reads_results_test.cpp: the reference solutions against closed forms and published figures."""
import numpy as np

from mudlark.reference.consolidation import LAWS, LargeStrainColumn, Terzaghi, effective_stress, final_settlement, time_of_settlement

# Closed forms of the final settlement at q/M = 0.29714 (Table 1): 1 - exp(-q/M), 1 - 1/(1 + q/M), q/M; hencky by
# its defining equation.
ratio = 4e5 / (1e6 * 0.7 / (1.3 * 0.4))
assert np.isclose(final_settlement("log"), 1 - np.exp(-ratio), rtol=1e-12)
assert np.isclose(final_settlement("objective"), 1 - 1 / (1 + ratio), rtol=1e-12)
assert np.isclose(final_settlement("small"), ratio, rtol=1e-12)
assert abs(final_settlement("hencky") - 0.20937) < 5e-6
# Anura3D's verification manual, oedometer under 20 kPa (E = 100 kPa, nu = 0.2): 0.16473 m and 0.15254 m.
modulus = 1e5 * 0.8 / (1.2 * 0.6)
assert np.isclose(final_settlement("log", 2e4, modulus), 0.16473, rtol=1e-4)
assert np.isclose(final_settlement("objective", 2e4, modulus), 0.15254, rtol=1e-4)

# Terzaghi's classical table: T at U = 50 % and 90 % (Taylor 1948).
classical = Terzaghi(water_modulus=None)
assert np.isclose(classical.degree(0.1967 / classical.time_factor(1.0)), 0.5, atol=1e-4)
assert np.isclose(classical.degree(0.8481 / classical.time_factor(1.0)), 0.9, atol=1e-4)
assert np.isclose(Terzaghi().start_pressure / 1e3, 0.97557, atol=1e-5)

# At a small load every law is Terzaghi's.
times = np.array([1.0, 10.0, 40.0, 100.0])
series = Terzaghi(conductivity=1e-4, load=100.0).settlement(times)
for law in LAWS:
    assert np.allclose(LargeStrainColumn(law=law, load=100.0, cells=80).solve(times).settlement, series, rtol=6e-4), law

# Large strain, Table 1 at k = 1e-4 m/s: t50 and t90 of an independent solver (Radau in time).
times = np.linspace(0.05, 100.0, 800)
for bulk, half, ninety in ((2.15e7, 9.52, 39.61), (None, 9.854, 39.36)):
    history = LargeStrainColumn(law="log", water_modulus=bulk, cells=120).solve(times)
    assert abs(time_of_settlement(history, 0.5, final_settlement("log")) / half - 1) < 1e-3
    assert abs(time_of_settlement(history, 0.9, final_settlement("log")) / ninety - 1) < 1e-3

# Long after, the column stands as the law says, self weight and ramp or not.
for law in LAWS:
    end = LargeStrainColumn(law=law, ramp=0.05, cells=60).solve([2000.0])
    assert abs(end.settlement[-1] - final_settlement(law)) < 1e-6, law
heavy = LargeStrainColumn(law="hencky", self_weight=True, cells=60)
stretch = heavy.solve([2000.0]).stretch[-1]
assert np.allclose(effective_stress("hencky", heavy.modulus, stretch, heavy.start_stress) - heavy.start_stress, 4e5, rtol=1e-5)
