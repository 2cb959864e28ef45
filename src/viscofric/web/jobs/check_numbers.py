"""Whether superposition holds, as words and numbers that the page shows."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.datasets import plain
from viscofric.rheology.shifts.parametric_law import LEVEL_95
from viscofric.rheology.superposition.kramers_kronig import LARGEST_RMS

if TYPE_CHECKING:
    from viscofric.rheology.superposition.consistency import Diagram, SuperpositionCheck
    from viscofric.rheology.superposition.result import Superposition

# What superposition does, in the words of the page.
_VERDICTS = {
    "holds": "holds",
    "other factors": "holds, but not with these shift factors",
    "not identified": "is tested only in part",
    "doubtful": "is doubtful",
    "roughly": "holds only roughly",
    "fails": "does not hold",
    "untested": "is not tested",
}


def check_numbers(fit: Superposition) -> dict[str, Any]:
    """Return the verdict on a superposition with what it rests on.

    Parameters
    ----------
    fit : Superposition

    Returns
    -------
    dict
        ``verdict`` (`SuperpositionCheck.verdict`), ``headline`` and ``sentences``;
        distances of ``neighbours`` in decades; ``diagrams`` in SI units and rad; ``kramers_kronig`` or None.
    """
    check = fit.check
    return {
        "verdict": check.verdict,
        "short": _VERDICTS[check.verdict],
        "headline": f"Superposition {_VERDICTS[check.verdict]}",
        "sentences": list(check.sentences),
        "figure_of_merit": plain(check.figure_of_merit),
        "neighbours": [
            {
                "colder": plain(pair.colder),
                "warmer": plain(pair.warmer),
                "distance": plain(pair.distance),
                "error95": plain(LEVEL_95 * pair.standard_error),
            }
            for pair in check.neighbours
        ],
        "diagrams": {
            "van_gurp_palmen": _by_temperature(check.van_gurp_palmen),
            "booij_thoone_palmen": _by_temperature(check.booij_thoone_palmen),
            "cole_cole": _by_temperature(check.cole_cole),
            "wicket": _by_temperature(check.wicket),
        },
        "kramers_kronig": _kramers_kronig(check),
    }


def _by_temperature(diagram: Diagram) -> list[dict[str, Any]]:
    cuts = np.flatnonzero(np.diff(diagram.temperature)) + 1
    return [
        {"temperature": plain(float(kelvin[0])), "x": plain(x), "y": plain(y)}
        for kelvin, x, y in zip(
            *(np.split(column, cuts) for column in (diagram.temperature, diagram.x, diagram.y)), strict=True
        )
        if len(kelvin)
    ]


def _kramers_kronig(check: SuperpositionCheck) -> dict[str, Any] | None:
    found = check.kramers_kronig
    if found is None:
        return None
    return {
        "holds": found.holds,
        "sentence": found.sentence,
        "angular_frequency": plain(found.angular_frequency),
        "storage": plain(found.storage_deviation),
        "loss": plain(found.loss_deviation),
        "judged": found.judged.tolist(),
        "rms_storage": plain(found.rms_storage),
        "rms_loss": plain(found.rms_loss),
        "allowed": LARGEST_RMS,
    }
