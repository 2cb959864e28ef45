"""Exports of real machines are separated as they are."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import viscofric as vf


@pytest.mark.slow
def test_an_export_of_500_traction_steps_is_separated_by_its_recorded_zeros(real_data: Path) -> None:
    """Steel in oil, slip swept from 20 % to none and back: Coulomb friction is the Traction Coeff of the export."""
    path = real_data / "mtm" / "ETM_slim_mapper.txt"
    if not path.exists():
        pytest.skip(f"no {path}")
    curves = vf.separate(vf.read_mtm(path))
    assert curves.coulomb is not None
    assert curves.slip is not None
    sliding = curves.slip > 0.05 * curves.speed
    assert np.any(sliding)
    coefficients = _coefficients(path)
    low, high = np.quantile(coefficients, [0.05, 0.95])
    assert np.all((low < curves.coulomb[sliding]) & (curves.coulomb[sliding] < high))
    # Steps are the replicates; sliding intervals were measured in all of them.
    assert np.max(curves.replicates[sliding]) == 500
    # Rolling friction of steel is small beside 0.05.
    assert np.all(np.abs(curves.viscoelastic[sliding]) < 0.01)
    assert [note.count("500") for note in curves.notes if note.code == "recorded-zero"] == [1]
    assert len(curves.notes) < 20


def _coefficients(path: Path) -> np.ndarray:
    """Traction Coeff (−) of all rows of the traction steps at slips above 5 %."""
    rows = [line.split("\t") for line in path.read_text("utf-8-sig", errors="replace").splitlines()]
    found, swept = [], False
    for row in rows:
        if len(row) > 10 and not row[0][:1].lstrip("-").isdigit():
            swept = row[0].startswith("SRR")
        elif swept and len(row) > 10 and float(row[0]) > 5.0:
            found.append(float(row[1]))
    return np.array(found)
