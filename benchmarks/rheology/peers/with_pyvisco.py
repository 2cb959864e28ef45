"""Pyvisco: shifts neighbour to neighbour by E' alone, and fits a Prony series to the master curve."""

from __future__ import annotations

import contextlib
import io
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from exchange import main, master_curve, sweeps, timed
from pyvisco import load, master, opt, prony, shift

PASCAL = 1e-6  # its files are in MPa


def shift_factors(path: Path) -> dict[str, Any]:
    text = ["f,E_stor,E_loss,T,Set", "Hz,MPa,MPa,°C,-"]
    for number, sweep in enumerate(sweeps(path)):
        columns = zip(sweep.angular_frequency / (2 * np.pi), sweep.storage * PASCAL, sweep.loss * PASCAL, strict=True)
        text += [f"{f:.12g},{stiff:.12g},{lost:.12g},{sweep.temperature:.8g},{number}" for f, stiff, lost in columns]
    raw, _, _ = load.user_raw("\n".join(text).encode(), "freq", "E")

    def work() -> tuple[Any, Any]:
        factors, _ = master.get_aT(raw, 20.0)
        return factors, shift.fit_WLF(20.0, factors)

    (factors, law), seconds = timed(work)
    C1, C2 = float(law["C1"].iloc[0]), float(law["C2"].iloc[0])
    return {"log10": factors["log_aT"].to_numpy(), "wlf": [C1, C2], "seconds": seconds}


def _prepared(path: Path) -> Any:
    omega, storage, loss = master_curve(path)
    frequency = omega / (2 * np.pi)
    frame = pd.DataFrame({"f": frequency, "E_stor": storage * PASCAL, "E_loss": loss * PASCAL, "omega": omega})
    frame["t"] = 1.0 / frequency
    frame.RefT, frame.domain, frame.modul = 20.0, "freq", "E"
    return master.smooth(frame, win=1)


def _series(found: Any) -> dict[str, Any]:
    terms = found["df_terms"]
    E_inf = float(found["E_0"]) / PASCAL
    alpha = terms["alpha_i"].to_numpy()
    return {"E0": E_inf * (1.0 - alpha.sum()), "E": E_inf * alpha, "tau": terms["tau_i"].to_numpy()}


def spectrum(path: Path) -> dict[str, Any]:
    curve = _prepared(path)
    (found, _), seconds = timed(lambda: prony.fit(prony.discretize(curve)))
    return {**_series(found), "seconds": seconds}


def reduced_spectrum(path: Path) -> dict[str, Any]:
    curve = _prepared(path)

    def work() -> Any:
        first, _ = prony.fit(prony.discretize(curve))
        with contextlib.redirect_stdout(io.StringIO()):
            found, best, _ = opt.nprony(curve, first)
        return found[best]

    found, seconds = timed(work)
    return {**_series(found), "seconds": seconds}


if __name__ == "__main__":
    main({"shift": shift_factors, "spectrum": spectrum, "reduced spectrum": reduced_spectrum})
