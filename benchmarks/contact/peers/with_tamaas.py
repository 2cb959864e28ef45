"""Elastic contact (E* = 1), periodic or free, with Tamaas' Polonsky-Keer-Rey solver; runs in its environment."""

import json
import sys
import time
from pathlib import Path

import numpy as np
import tamaas

folder = Path(sys.argv[1])
given = json.loads((folder / "given.json").read_text(encoding="utf-8"))
heights = np.load(folder / "heights.npy")
tamaas.initialize(1)
model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, given["size"], list(heights.shape))
model.E, model.nu = 1.0, 0.0
# Its own measure is the mean of pressure times gap: 1e-9 leaves about what is asked for of the largest gap.
solver = tamaas.PolonskyKeerRey(model, heights, 0.1 * given["tolerance"])
solver.max_iter = 5000
pressure = given.get("pressure")
if given["boundary"] == "free":
    # To be registered and then chosen; without the second, the periodic problem is solved.
    tamaas.ModelFactory.registerNonPeriodic(model, "dcfft")
    solver.setIntegralOperator("dcfft")
    pressure = given["load"] / (given["size"][0] * given["size"][1])
start = time.process_time()
solver.solve(pressure)
seconds = time.process_time() - start
np.savez(folder / "fields.npz", pressure=model.traction, gap=model["gap"])
row = {"tool": "Tamaas 2.9, Polonsky-Keer-Rey", "seconds": seconds, "arrays": "fields.npz"}
(folder / "answer.json").write_text(json.dumps([row]), encoding="utf-8")
