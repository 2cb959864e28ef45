"""Results of a fit to indentation: bands, residuals, notes on them, and the origin of the material."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from viscofric.arrays import Array
from viscofric.friction.identification.conclusions import FOLLOWING
from viscofric.friction.identification.drawn_materials import Findings, limits
from viscofric.friction.identification.indentation.impacts import Impacts
from viscofric.friction.identification.indentation.problem import IndentationProblem
from viscofric.friction.identification.indentation.result import FittedRecord, MaterialFromIndentation
from viscofric.friction.identification.indentation.setting_up import LEAST_POINTS, Usable
from viscofric.friction.identification.indentation.tables import ReboundRecord
from viscofric.friction.identification.iteration import Weighed, freedom_of, most_evident
from viscofric.friction.identification.posterior import correlation, too_small
from viscofric.friction.identification.problem import ROUGHNESS
from viscofric.friction.identification.result import IdentifiedBand, synthetic_notes, with_origin
from viscofric.motion.impact import LOOSEST, solve_impact
from viscofric.notes import Note, counted, note_of
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.shift_law import ShiftLaw

#: Bands of moduli begin at this factor below the inverse of the longest time; they end at that of the shortest one.
BEYOND = 3.0
#: Correlated residuals smaller than this get no note: records do not repeat better.
WORTH_A_NOTE = 2e-3


def conclude(
    usable: Usable,
    fits: list[Weighed[IndentationProblem]],
    error_scale: float,
    *,
    shift: ShiftLaw | None,
    poisson_ratio: float,
    name: str,
    limit: float,
    samples: int,
    seed: int,
) -> MaterialFromIndentation:
    """Return the result; see `identify_from_indentation` for the arguments."""
    best = most_evident(fits)
    problem = best.problem
    low, high, fastest = _ends(problem, best.minimum.place)
    findings = Findings(
        fits, (low, high), shift=shift, poisson_ratio=poisson_ratio, name=name, samples=samples, seed=seed
    )
    middle = findings.middle
    highest = {"magnitude": fastest, "storage": fastest, "loss": max(high, middle)}
    bands = [findings.band(part, (low / BEYOND, end), limit, relative=False) for part, end in highest.items()]
    residuals = -problem.measured(best.minimum.place)[0]
    fitted = _fitted(usable, findings)
    narrow = _narrow(problem)
    if narrow:
        bands[2] = IdentifiedBand(middle, middle, limit, relative=False)
    source = ", ".join(dict.fromkeys(name for one in fitted if (name := getattr(one.record, "source", ""))))
    made_up = synthetic_notes(source, shift)
    found = MaterialFromIndentation(
        **findings.common(bands, residuals, error_scale),
        anchored=True,
        records=fitted,
        common_errors=_common_errors(usable, findings),
        notes=(*made_up, *usable.notes, *_doubts(fitted, error_scale), *_shared(best, residuals, error_scale), *narrow),
    )
    notes = (*found.notes, *_fastest(found.material, problem))
    return replace(found, material=with_origin(found, source), notes=notes)


def _ends(problem: IndentationProblem, place: Array) -> tuple[float, float, float]:
    """Return the lowest angular frequency at the reference, rad/s, and the highest ones of E'' and of |E|."""
    found = []
    for number, contact in enumerate(problem.contacts):
        trial = problem.trial(number, place)
        found.append(np.exp(trial.log_alpha) * np.array(contact.ends(trial)))
    low, high, fastest = np.array(found).T
    return float(low.min()), float(max(high.max(), low.min())), float(fastest.max())


def _common_errors(usable: Usable, findings: Findings[IndentationProblem]) -> dict[str, tuple[float, float]]:
    """Return the errors in common that were given a standard deviation: what was found, and its standard error."""
    problem, place, covariance = findings.best.problem, findings.best.minimum.place, findings.covariance
    if not problem.others:
        return {}
    first = len(place) - problem.others
    named = {"radius": (0, problem.shared.radius), "load": (1, problem.shared.gain)}
    for number, record in enumerate(usable.records):
        if hasattr(record, "indentation") and not isinstance(record, ReboundRecord):
            named[f"zero {number + 1}"] = 2 + number, problem.shared.zero
    return {
        name: (size * float(place[first + at]), size * float(np.sqrt(covariance[first + at, first + at])))
        for name, (at, size) in named.items()
        if size > 0.0
    }


def _fitted(usable: Usable, findings: Findings[IndentationProblem]) -> tuple[FittedRecord, ...]:
    """Return the measured and fitted responses of every record, with 95 % limits of the fit."""
    problem, place = findings.best.problem, findings.best.minimum.place
    value, _ = problem.modelled(place)
    lower, upper = limits(np.array([problem.modelled(row)[0] for row in findings.rows]))
    found = []
    for record, contact, rows in zip(usable.records, problem.contacts, problem.rows, strict=True):
        for quantity, part in contact.parts:
            own = slice(rows.start + part.start, rows.start + part.stop)
            fit = (np.exp(one[own]) for one in (value, lower, upper))
            points = contact.along[part], contact.response[part], *fit, problem.errors[own], contact.count[part]
            found.append(FittedRecord(record, quantity, *points))
    return tuple(found)


def _doubts(records: tuple[FittedRecord, ...], error_scale: float) -> Iterator[Note]:
    """Yield notes on doubtful residuals."""
    if error_scale > 1.0:
        yield Note(
            "errors-enlarged",
            f"The residuals are {error_scale:.2g} times larger than the given standard errors, which were "
            "multiplied by this factor. The errors are too small, or no one linear material describes all records.",
            values={"factor": error_scale},
        )
    each = list(dict.fromkeys(id(one.record) for one in records))
    for one in records:
        number = 1 + each.index(id(one.record))
        size = float(np.sqrt(np.mean((one.residuals * one.error) ** 2)))
        if size > WORTH_A_NOTE and len(one.along) > LEAST_POINTS and correlation(one.residuals) > FOLLOWING:
            yield Note(
                "structured-residuals",
                f"Record {number}: the residuals of {one.words}, {100.0 * size:.2g} % of it, are correlated: "
                "they are not scatter, and the bands are too narrow; check the zero of the depth, the beginning of "
                "the test, and whether the material is linear.",
                values={"record": number, "rms": size},
            )


def _fastest(material: Material, problem: IndentationProblem) -> tuple[Note, ...]:
    """Return notes on the fastest impact of each record with the material found: on large strain and waves."""
    found = []
    for one in (one for one in problem.contacts if isinstance(one, Impacts)):
        measured = one.record
        hit = solve_impact(
            material, one.indenter, mass=measured.mass, speed=float(measured.speed.max()), gravity=measured.gravity,
            temperature=measured.temperature, accuracy=LOOSEST,
        )  # fmt: skip
        found.append([note for note in map(note_of, hit.warnings) if note.code in ("large-strain", "quasi-static")])
    return tuple(note.at("Fastest impacts, with the material found") for note in counted(found, of="records"))


def _shared(best: Weighed[IndentationProblem], residuals: Array, error_scale: float) -> tuple[Note, ...]:
    """Return a note if the residuals are much smaller than the errors that were given."""
    contacts = best.problem.contacts
    given = np.repeat([one.error is not None for one in contacts], [len(one) for one in contacts])
    if error_scale > 1.0 or not np.any(given):
        return ()
    freedom = freedom_of(best, len(given), given)
    example = "which radius_error, load_error and zero_error account for"
    return too_small(residuals[: len(given)][given], freedom, example)


def _narrow(problem: IndentationProblem) -> list[Note]:
    """Return a note on a spectrum that is less smooth than the prior has it."""
    if problem.smoothness.roughness < ROUGHNESS[-1]:
        return []
    said = (
        "The spectrum is not smooth: the material has almost a single retardation time, or a few. The fit misses the "
        "response by up to 1 or 2 %, the 95 % bands are too narrow, and E'' does not count as identified; fit a few "
        "modes to the response instead."
    )
    return [Note("narrow-spectrum", said, values={"roughness": problem.smoothness.roughness})]
