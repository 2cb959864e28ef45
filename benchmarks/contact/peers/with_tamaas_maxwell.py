"""Sliding over a generalised Maxwell solid with Tamaas, step by step in time; runs in its environment.

Its solver takes the solid's relaxed shear modulus for one wherever it adds Maxwell branches to it.  So moduli and
pressures come in units of that modulus: E0 = 2 and E* = 2 for a Poisson's ratio of zero.
"""

import json
import sys
import time
from pathlib import Path

import numpy as np
import tamaas

folder = Path(sys.argv[1])
given = json.loads((folder / "given.json").read_text(encoding="utf-8"))
heights = np.load(folder / "heights.npy")
nx, ny = heights.shape
tamaas.initialize(1)
tamaas.set_log_level(tamaas.LogLevel.error)
model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [1.0, 1.0], [nx, ny])
model.E, model.nu = 2.0, 0.0
moved = heights.copy()
solver = tamaas.MaxwellViscoelastic(
    model, moved, given["tolerance"], given["time_step"], given["shear_moduli"], given["relaxation_times"]
)
solver.max_iter = 5000
solver.reset()
waves = np.fft.rfft(heights, axis=0)
numbers = 2j * np.pi * np.arange(nx // 2 + 1)[:, None]
friction, seconds = [], []
for step in range(1, given["steps"] + 1):
    shifted = waves * np.exp(-numbers * given["speed"] * given["time_step"] * step)
    solver.surface[:] = np.fft.irfft(shifted, nx, axis=0).reshape(solver.surface.shape)
    start = time.process_time()
    solver.solve(2.0 * given["pressure"])
    seconds.append(time.process_time() - start)
    if nx % 2 == 0:
        shifted[-1] = 0.0
    slope = np.fft.irfft(numbers * shifted, nx, axis=0)
    friction.append(-float(np.mean(model.traction * slope) / model.traction.mean()))
np.savez(folder / "fields.npz", friction=friction, seconds=seconds, pressure=0.5 * model.traction)
(folder / "answer.json").write_text(json.dumps([{"tool": "Tamaas 2.9, Maxwell", "arrays": "fields.npz"}]))
