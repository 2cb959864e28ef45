"""Elastic contact (E* = 1) with ContactMechanics; runs in its environment.

Periodic: dual conjugate gradients without restart, its quickest, for a given displacement.  Free: constrained
conjugate gradients for a given load.
"""

import json
import sys
import time
from pathlib import Path

import numpy as np
from ContactMechanics import FreeFFTElasticHalfSpace, PeriodicFFTElasticHalfSpace
from ContactMechanics.Factory import make_system
from SurfaceTopography import Topography

folder = Path(sys.argv[1])
given = json.loads((folder / "given.json").read_text(encoding="utf-8"))
heights = np.load(folder / "heights.npy")
periodic = given["boundary"] == "periodic"
size = tuple(given["size"])
cell = size[0] * size[1] / heights.size
half_space = (PeriodicFFTElasticHalfSpace if periodic else FreeFFTElasticHalfSpace)(
    nb_grid_pts=heights.shape, young=1.0, physical_sizes=size
)
system = make_system(substrate=half_space, surface=Topography(heights, size, periodic=periodic))
start = time.process_time()
if periodic:
    # Its mean displacement answers to the mean pressure like the longest wave: 2 p/(E* q).
    offset = given["level"] + 2.0 * given["pressure"] / (2.0 * np.pi / size[0])
    answer = system.dual_minimize_proxy(
        offset=offset,
        init_force=np.full(heights.shape, given["pressure"] * cell),
        gtol=given["tolerance"] * heights.std(),
        maxiter=5000,
        solver="ccg-without-restart",
    )
    seconds = time.process_time() - start
    pressure = np.reshape(answer.x, heights.shape) / cell
    gap = half_space.evaluate_disp(-cell * pressure) - heights - offset
    name = "dual CG without restart"
else:
    answer = system.minimize_proxy(
        external_force=given["load"], pentol=given["tolerance"] * np.ptp(heights), maxiter=5000
    )
    seconds = time.process_time() - start
    pressure = np.reshape(answer.jac, heights.shape) / cell
    gap = answer.x[: heights.shape[0], : heights.shape[1]] - heights - answer.offset
    name = "constrained CG"
if not answer.success:
    sys.exit(f"did not converge: {answer.message}")
np.savez(folder / "fields.npz", pressure=pressure, gap=gap)
row = {"tool": f"ContactMechanics 1.8, {name}", "seconds": seconds, "iterations": int(answer.nit)}
(folder / "answer.json").write_text(json.dumps([row | {"arrays": "fields.npz"}]), encoding="utf-8")
