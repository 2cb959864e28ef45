"""Job ``master``: friction master curves, with shift factors of the material and with those found from friction."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from viscofric.datasets import plain
from viscofric.errors import SuperpositionError
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.shifting.master_curve import FrictionMasterCurve
from viscofric.friction.shifting.shift import common_reference, shift_friction
from viscofric.friction.shifting.shift_agreement import concluded
from viscofric.notes import listed
from viscofric.report.data import beside_friction, law_line, measured_line
from viscofric.report.texts.inverse import shift_words
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.shift_law import ShiftLaw
from viscofric.web.figures.friction import master_figures
from viscofric.web.jobs.context import Context, JobOptions
from viscofric.web.jobs.friction_data import by_temperature, drawn_line, pairs
from viscofric.web.jobs.friction_input import friction_curves, indenter_of, measured
from viscofric.web.jobs.rubbers import made_rubber
from viscofric.web.jobs.shift_numbers import with_bars

_DOWNLOAD = "shift_factors_from_friction.csv"


class Options(JobOptions):
    """Options of the job."""

    beside: bool = True  # whether to compare with the page's material
    #: Law to fit to the shift factors found from friction
    law: Literal["best", "wlf", "arrhenius", "vft", "wlf+arrhenius", "polynomial", "none"] = "best"


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Shift measured friction onto master curves: with the material's shift factors, and with those found from it."""
    curves = friction_curves(study, context)
    rubber = made_rubber(study, context).material if options.beside else None
    known = None if rubber is None else rubber.shift
    settings = _settings(curves, indenter_of(study), rubber)
    notes: list[str] = []
    result: dict[str, Any] = {"by_rubber": None, "found": None, "refusal": None, "known": None}
    if known is not None:
        context.progress(0, 2, "Shifting by the rubber's factors")
        by_rubber = shift_friction(curves, shift=known, **settings)
        result["by_rubber"] = _curve(by_rubber) | {"words": _words(by_rubber)}
        notes += by_rubber.notes
    context.progress(1, 2, "Finding shift factors from friction")
    try:
        found = shift_friction(curves, reference=common_reference(curves, known), **settings)
    except SuperpositionError as error:
        if known is None:
            raise
        result["refusal"] = error.words("page")
    else:
        result["found"], found_notes = _found(found, known, options, context)
        notes += found_notes
    if known is not None:
        result["known"] = _known(known, result["found"] or result["by_rubber"])
    numbers: dict[str, Any] = plain(result | listed("notes", dict.fromkeys(notes), "page"))
    made_up = measured(study, context).synthetic
    return numbers | {"figures": master_figures(numbers, synthetic=made_up or (None if options.beside else False))}


def _settings(curves: FrictionCurves, indenter: Any, rubber: Material | None) -> dict[str, Any]:
    """Return how friction at several loads is reduced to one, where the indenter allows it."""
    if indenter is None or indenter.geometry.load_unit != curves.load_unit:
        return {}
    return {"indenter": indenter, "vertical_shift": None if rubber is None else rubber.vertical_shift}


def _curve(master: FrictionMasterCurve) -> dict[str, Any]:
    mu, errors = master.friction_coefficient, {"error": master.friction_error, "scatter": master.friction_scatter}
    return {
        "reference": master.reference,
        "points": by_temperature(master.temperature, master.reduced_speed, friction=mu, **errors),
        "line": drawn_line(measured_line(master)),
        "overlap": master.overlap.sentence,
    }


def _words(master: FrictionMasterCurve, *found: Any) -> list[dict[str, str]]:
    law, agreement, why = found or (None, None, "")
    rows = [(name, words) for name, words in shift_words(master, law, agreement, why) if name != "reduced speed"]
    return pairs((name or "law, why", words) for name, words in rows)


def _found(
    master: FrictionMasterCurve, known: ShiftLaw | None, options: Options, context: Context
) -> tuple[dict[str, Any], list[str]]:
    """Return the master curve and shift factors found from friction alone, and their notes."""
    law, why, agreement, refused = concluded(master, options.law, known)
    factors = master.shift_factors
    factors.save(context.downloads / _DOWNLOAD)
    more = {
        "words": _words(master, law, agreement, why),
        "factors": with_bars(factors.to_dataset()),
        "law": None if law is None else with_bars(law_line(law, *factors.temperatures[[0, -1]].tolist())),
        "agreement": None if agreement is None else agreement.sentence,
        "download": _DOWNLOAD,
    }
    return _curve(master) | more, [*master.notes, *refused]


def _known(known: ShiftLaw, beside: dict[str, Any]) -> dict[str, Any] | None:
    """Return the rubber's shift factors about the reference of a master curve, None of one temperature only."""
    law = known.at_reference(beside["reference"])
    warm = np.array([one["temperature"] for one in beside["points"]])
    if warm.size < 2:
        return None
    points = with_bars(beside_friction(law.to_dataset(), warm)) if isinstance(law, ShiftFactors) else None
    return {"points": points, "line": with_bars(law_line(law, float(warm.min()), float(warm.max())))}
