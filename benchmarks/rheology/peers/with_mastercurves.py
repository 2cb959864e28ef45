"""mastercurves: Gaussian processes, neighbour to neighbour, on log E' alone, with an uncertainty of each shift."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from exchange import main, sweeps, timed
from mastercurves import MasterCurve
from mastercurves.transforms import Multiply


def shift_factors(path: Path) -> dict[str, Any]:
    given = sweeps(path)
    temperatures = [sweep.temperature for sweep in given]

    def work() -> MasterCurve:
        curve = MasterCurve()
        curve.add_data(
            [np.log(sweep.angular_frequency) for sweep in given],
            [np.log(sweep.storage) for sweep in given],
            list(temperatures),
        )
        curve.add_htransform(Multiply())
        curve.superpose()
        return curve

    curve, seconds = timed(work)
    log10 = np.log10(np.array(curve.hparams[0], dtype=float))
    reference = int(np.argmin(np.abs(np.array(temperatures) - 20.0)))
    return {"log10": log10 - log10[reference], "seconds": seconds}


if __name__ == "__main__":
    main({"shift": shift_factors})
