"""Elastic rough contact with ContactMechanics' dual conjugate gradients without restart; runs in its environment."""

import json
import sys
import time
from pathlib import Path

import numpy as np
from ContactMechanics import PeriodicFFTElasticHalfSpace
from ContactMechanics.Factory import make_system
from SurfaceTopography import Topography

folder = Path(sys.argv[1])
given = json.loads((folder / "given.json").read_text(encoding="utf-8"))
heights = np.load(folder / "heights.npy")
half_space = PeriodicFFTElasticHalfSpace(nb_grid_pts=heights.shape, young=1.0, physical_sizes=(1.0, 1.0))
system = make_system(substrate=half_space, surface=Topography(heights, (1.0, 1.0), periodic=True))
# Its mean displacement answers to the mean pressure like the longest wave: 2 p/(E* q).
offset = given["level"] + 2.0 * given["pressure"] / (2.0 * np.pi)
first = np.full(heights.shape, given["pressure"] / heights.size)
start = time.process_time()
answer = system.dual_minimize_proxy(
    offset=offset, init_force=first, gtol=given["tolerance"] * heights.std(), maxiter=5000, solver="ccg-without-restart"
)
seconds = time.process_time() - start
np.save(folder / "dual.npy", np.reshape(answer.x, heights.shape) * heights.size)
row = {"tool": "ContactMechanics 1.8, dual CG without restart", "seconds": seconds, "iterations": int(answer.nit)}
(folder / "answer.json").write_text(json.dumps([row | {"pressures": "dual.npy"}]), encoding="utf-8")
