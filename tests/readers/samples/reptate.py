"""A sweep as RepTate stores it."""

from __future__ import annotations

import math
from pathlib import Path

from readers.samples.rubber import FREQUENCIES, moduli


def sweep(folder: Path) -> Path:
    """Write one temperature, more names than columns, Latin-1, from high to low frequency."""
    lines = [
        "T=-10;Mw=0;chem=rubber;label=synthetic;",
        "Freq\tG'\tG\"\tTemp\tStrain\tPhaseAngle",
        "rad/s\tPa\tPa\t°C\t%\t°",
    ]
    for n, frequency in enumerate(reversed(FREQUENCIES)):
        storage, loss = moduli(-10.0, frequency)
        row = (2 * math.pi * frequency, storage / 3, loss / 3, -10 + 0.01 * n, 1.99)
        lines.append("".join(f"{value:>15.5G}" for value in row))
    path = folder / "sweep.osc"
    path.write_bytes("\n".join([*lines, ""]).encode("latin-1"))
    return path


SAMPLES = {"RepTate: sweep": sweep}
