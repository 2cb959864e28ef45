"""The rubber as a card for finite-element programs, or as viscofric's own file."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

from viscofric.notes import warned
from viscofric.rheology.cards import CardFormat, CardLaw, write_card
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.study.rubber_results import CARDS
from viscofric.web.jobs.context import Context, JobOptions
from viscofric.web.jobs.export_files import offered
from viscofric.web.jobs.rubbers import made_rubber


class Options(JobOptions):
    """Which card, and what the rubber does not say; see `viscofric.rheology.cards.write_card`."""

    format: CardFormat = "abaqus"
    poisson_ratio: float | None = Field(None, ge=0.0, le=0.5)
    density: str | None = Field(None, max_length=100)
    temperature_unit: Literal["K", "degC"] = "K"
    modulus_unit: Literal["Pa", "MPa"] = "Pa"
    domain: Literal["time", "frequency"] = "time"
    #: Fitted where the rubber has a table of shift factors; a rubber with a law keeps it.
    law: CardLaw | None = None


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Write a card of the rubber; return its ``text``, the ``download`` and ``notes``."""
    rubber = made_rubber(study, context)
    form = options.format
    name = "rubber" if form == "json" else f"rubber_{form.replace('-', '_')}"
    path = context.downloads / f"{name}{CARDS[form]}"
    chosen = options.model_dump(exclude={"format"}) | {"density": options.density or None}
    if form == "json" or not isinstance(rubber.material.shift, ShiftFactors):
        chosen["law"] = None
    with warned() as notes:
        write_card(rubber.material, path, form, **chosen)
    said = [note.words("page") for note in notes]
    return {"text": path.read_text(encoding="utf-8"), "download": offered(path, f"card for {form}"), "notes": said}
