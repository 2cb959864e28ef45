"""Job ``rubber``: the rubber of a study, from its shift factors to its spectrum with bands."""

from __future__ import annotations

from typing import Any

from viscofric.datasets import plain, record
from viscofric.notes import listed, note_of
from viscofric.report.texts.tables import law_table
from viscofric.rheology.shifts.parametric_law import LEVEL_95
from viscofric.rheology.superposition.kramers_kronig import LARGEST_RMS
from viscofric.rheology.superposition.result import Superposition
from viscofric.study.rubber import Rubber
from viscofric.web.figures.shift import shift_figures, verdict_numbers
from viscofric.web.figures.spectrum import modes_table, spectrum_figures, spectrum_numbers_shown
from viscofric.web.figures.sweeps import moduli_of_material
from viscofric.web.jobs.context import Context, JobOptions
from viscofric.web.jobs.friction_data import table_record
from viscofric.web.jobs.rubbers import checked_tables, friction_bands, made_rubber
from viscofric.web.jobs.shift_numbers import shift_numbers
from viscofric.web.jobs.spectrum_numbers import band_numbers, frequencies, spectrum_numbers


class Options(JobOptions):
    """Whether the rubber is drawn anew for its bands."""

    bands: bool = True


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Make the rubber of [material]; what is known before it is drawn for its bands is sent as a part."""
    table, wanted = checked_tables(study, context)
    tested = table.dma or table.steps or table.ramps
    context.progress(0, 2, "shifting the isotherms" if tested else "reading the rubber")
    rubber = made_rubber(study, context)
    found = _without_bands(rubber, table.fixed_shift_factors)
    reply = found | _view(found)
    if not options.bands or wanted.draws == 0 or rubber.superposed is None:
        why = "only a material fitted to sweeps or step tests at several temperatures has a known uncertainty"
        return reply | {"band": None, "no_band": why if rubber.superposed is None else ""}
    context.part(reply)
    context.progress(1, 2, f"drawing the rubber {wanted.draws} times for its 95 % bands")
    drawn = friction_bands(study, context)
    if drawn.samples is None:
        return reply | {"band": None, "no_band": " ".join(note_of(one).words("page") for one in drawn.notes)}
    found |= {"band": plain(band_numbers(drawn.samples, frequencies(rubber))), "no_band": ""}
    return found | _view(found)


def _view(found: dict[str, Any]) -> dict[str, Any]:
    """Return what is shown of a result, without columns that figures have of their own."""
    shift, check, spectrum = found["shift"], found["check"], found["spectrum"]
    modes, causal = spectrum["modes"], (check or {}).get("kramers_kronig")
    alone = causal and {name: entry for name, entry in causal.items() if not isinstance(entry, (list, dict))}
    return {
        "shift": shift and _without_lines(shift),
        "check": check and {**check, "kramers_kronig": alone},
        "figures": spectrum_figures(found) | (shift_figures(found) if shift else {}) | moduli_of_material(spectrum),
        "tables": found["tables"] | ({"modes": modes_table(spectrum)} if modes else {}),
        "key_numbers": spectrum_numbers_shown(found),
        "verdict_numbers": verdict_numbers(found) if shift and check else [],
        "summary": {
            "shift": _shift_summary(found),
            "spectrum": f"{len(modes['retardation_time'])} modes" if modes else "a table of moduli",
        },
    }


def _without_lines(shift: dict[str, Any]) -> dict[str, Any]:
    def bare(law: dict[str, Any]) -> dict[str, Any]:
        return {name: entry for name, entry in law.items() if name != "line"}

    return {**shift, "laws": [bare(law) for law in shift["laws"]], "material": bare(shift["material"])}


def _shift_summary(found: dict[str, Any]) -> str:
    if not found["shift"]:
        return "no shift with temperature"
    if found["check"]:
        return str(found["check"]["short"])
    return "assumed law" if found["shift"]["used"] == "assumed" else "from the material file"


def _without_bands(rubber: Rubber, held: dict[float, float]) -> dict[str, Any]:
    # notes on reading are those of the job `sweeps`
    tests = (rubber.sweeps, rubber.step_tests, None if rubber.ramps is None else rubber.ramps.ramps)
    read = [note for one in tests if one is not None for note in one.notes]
    found = {
        "name": rubber.material.name,
        "source": rubber.source,
        "synthetic": rubber.synthetic,
        "deformation": None if rubber.sweeps is None else rubber.sweeps.deformation,
        "shift": shift_numbers(rubber, held),
        "check": _check(rubber),
        "spectrum": spectrum_numbers(rubber),
        "tables": {} if rubber.laws is None else {"laws": table_record(law_table(rubber.laws.to_dataset()))},
    }
    return dict(plain(found)) | listed("notes", [one for one in rubber.notes if one not in read], "page")


def _check(rubber: Rubber) -> dict[str, Any] | None:
    if rubber.fit is not None:
        return check_numbers(rubber.fit)
    if rubber.step_fit is not None:
        check = rubber.step_fit.check
        return _verdict(check.verdict, list(check.sentences)) | {"figure_of_merit": check.figure_of_merit}
    if rubber.ramps is not None and rubber.ramps.check is not None:
        return _verdict("holds" if rubber.ramps.check.holds else "fails", [rubber.ramps.check.sentence])
    return None


def _verdict(verdict: str, sentences: list[str]) -> dict[str, Any]:
    short = _VERDICTS[verdict]
    kind = {"holds": "good", "fails": "error"}.get(verdict, "warning")
    headline = f"Superposition {short}"
    said = [note_of(one).words("page") for one in sentences]
    return {"verdict": verdict, "kind": kind, "short": short, "headline": headline, "sentences": said}


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
    """Return the verdict on a superposition with what it rests on."""
    check, found = fit.check, fit.check.kramers_kronig
    return {
        **_verdict(check.verdict, list(check.sentences)),
        "figure_of_merit": check.figure_of_merit,
        "neighbours": [
            {name: getattr(pair, name) for name in ("colder", "warmer", "distance")}
            | {"error95": LEVEL_95 * pair.standard_error}
            for pair in check.neighbours
        ],
        "kramers_kronig": None if found is None else record(found.to_dataset(), 6) | {"allowed": LARGEST_RMS},
    }
