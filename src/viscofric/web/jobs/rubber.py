"""Job ``rubber``: the rubber of a study, from its shift factors to its spectrum with bands."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pydantic import BaseModel, ConfigDict

from viscofric.web.jobs.check_numbers import check_numbers
from viscofric.web.jobs.rubbers import checked_tables, friction_bands, made_rubber, without_folder
from viscofric.web.jobs.shift_numbers import shift_numbers
from viscofric.web.jobs.spectrum_numbers import band_numbers, frequencies, spectrum_numbers

if TYPE_CHECKING:
    from viscofric.study.rubber import Rubber
    from viscofric.web.jobs.context import Context


class Options(BaseModel):
    """Whether the rubber is drawn anew for its bands."""

    model_config = ConfigDict(extra="forbid")

    bands: bool = True


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Make the rubber of [material].

    Parameters
    ----------
    study : dict
        The tables of a run file; [material] and [uncertainty] count.
    options : Options
    context : Context
        Is handed the answer without bands as a part, before the rubber is drawn.

    Returns
    -------
    dict
        ``name``, ``synthetic``, ``source``; ``notes`` (but those on files, which the job ``sweeps`` tells); ``shift``
        (`shift_numbers`), ``check`` (`check_numbers`; None without sweeps), ``spectrum`` (`spectrum_numbers`) and
        ``band`` (`band_numbers`; None where nothing tells how well the rubber is known, and ``no_band`` then says why).

    Raises
    ------
    StudyError, InputError
        If the rubber cannot be made.
    """
    table, wanted = checked_tables(study, context)
    context.progress(0, 2, "shifting the isotherms" if table.dma else "reading the rubber")
    rubber = made_rubber(study, context)
    answer = _without_bands(rubber, table.fixed_shift_factors, context)
    if not options.bands or wanted.draws == 0 or rubber.fit is None:
        why = "" if rubber.fit is not None else "only the sweeps that a rubber is made of tell how well it is known"
        return answer | {"band": None, "no_band": why}
    context.part(answer)
    context.progress(1, 2, f"drawing the rubber {wanted.draws} times for its 95 % bands")
    drawn = friction_bands(study, context)
    if drawn.samples is None:
        return answer | {"band": None, "no_band": " ".join(drawn.notes)}
    return answer | {"band": band_numbers(drawn.samples, frequencies(rubber)), "no_band": ""}


def _without_bands(rubber: Rubber, held: dict[float, float], context: Context) -> dict[str, Any]:
    # what was noted on reading is told by the job `sweeps`
    read = () if rubber.sweeps is None else rubber.sweeps.notes
    return {
        "name": rubber.material.name,
        "source": without_folder(rubber.source, context),
        "citation": rubber.material.citation,
        "synthetic": rubber.synthetic,
        "deformation": None if rubber.sweeps is None else rubber.sweeps.deformation,
        "notes": [without_folder(note, context) for note in rubber.notes if note not in read],
        "shift": shift_numbers(rubber, held),
        "check": None if rubber.fit is None else check_numbers(rubber.fit),
        "spectrum": spectrum_numbers(rubber),
    }
