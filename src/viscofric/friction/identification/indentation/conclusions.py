"""Results of a fit to indentation: bands, residuals, notes on them, and the origin of the material."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from viscofric.friction.identification.drawn_materials import MaterialOf, Posterior, band, limits, prior_materials
from viscofric.friction.identification.indentation.result import FittedRecord, MaterialFromIndentation
from viscofric.friction.identification.iteration import freedom_of
from viscofric.friction.identification.posterior import correlation
from viscofric.notes import Note
from viscofric.rheology.spectra.quality import FROM_INDENTATION, SpectrumFit
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.spectra.step_misfit import REACH

if TYPE_CHECKING:
    from viscofric.friction.identification.indentation.problem import IndentationProblem
    from viscofric.friction.identification.indentation.setting_up import Usable
    from viscofric.friction.identification.iteration import Weighed
    from viscofric.rheology.material import Material
    from viscofric.rheology.shifts.shift_law import ShiftLaw


#: Bands of moduli begin at this factor below the inverse of the longest time; they end at that of the shortest one.
BEYOND = 3.0
#: Successive residuals count as correlated above this many standard deviations of von Neumann's ratio.
FOLLOWING = 3.0
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
    random = np.random.default_rng(seed)
    posterior = Posterior.of(fits, samples, random)
    best = posterior.best
    problem, shifts = best.problem, best.problem.shifts
    law = shift.at_reference(shifts.reference) if shift is not None and shifts.exact else None
    material_of = MaterialOf(problem, law, poisson_ratio, name)
    log_alpha = problem.split(best.minimum.place)[1][list(problem.number)]
    reduced = [np.array(one.lags) / np.exp(by) for one, by in zip(problem.contacts, log_alpha, strict=True)]
    low, fastest = 1.0 / max(one[1] for one in reduced), 1.0 / min(one[0] for one in reduced)
    kinds = ["creep" if one.creep else "relaxation" for one in problem.contacts]
    high = max(*(REACH[kind] / one[0] for kind, one in zip(kinds, reduced, strict=True)), low)
    middle = float(np.sqrt(low * high))
    drawn = material_of.samples(posterior.drawn, (low, high))
    expected = prior_materials(material_of, best, samples, random)
    highest = {"magnitude": fastest, "storage": fastest, "loss": max(high, middle)}
    bands = [
        band(drawn, expected, part, middle, (low / BEYOND, end), limit, relative=False) for part, end in highest.items()
    ]
    material = material_of(best.minimum.place, posterior.covariance)
    residuals = -problem.measured(best.minimum.place)[0]
    fitted = _fitted(usable, posterior)
    found = MaterialFromIndentation(
        material=material,
        samples=drawn,
        shift_factors=material.shift,
        shift_found=shifts.found and material.shift is not None,
        identified=bands[0],
        identified_storage=bands[1],
        identified_loss=bands[2],
        anchored=True,
        middle=middle,
        frequency_range=(low, high),
        records=fitted,
        chi2=float(residuals @ residuals),
        freedom=freedom_of(best, problem.count),
        rms=float(np.sqrt(np.mean((residuals * np.concatenate(problem.errors)) ** 2))),
        error_scale=error_scale,
        roughness=problem.smoothness.roughness,
        notes=(*usable.notes, *_doubts(fitted, error_scale)),
    )
    return replace(found, material=_with_origin(found))


def _fitted(usable: Usable, posterior: Posterior[IndentationProblem]) -> tuple[FittedRecord, ...]:
    """Return the measured and fitted responses of every record, with 95 % limits of the fit."""
    problem, place = posterior.best.problem, posterior.best.minimum.place
    value, _ = problem.fitted(place)
    lower, upper = limits(np.array([problem.fitted(row)[0] for row in posterior.drawn]))
    found, first = [], 0
    for record, contact, error in zip(usable.records, problem.contacts, problem.errors, strict=True):
        rows = slice(first, first + len(contact))
        first += len(contact)
        found.append(
            FittedRecord(
                record,
                contact.time,
                contact.response,
                np.exp(value[rows]),
                np.exp(lower[rows]),
                np.exp(upper[rows]),
                error,
                contact.count,
            )
        )
    return tuple(found)


def _doubts(records: tuple[FittedRecord, ...], error_scale: float) -> list[Note]:
    """Return notes on doubtful residuals."""
    notes = []
    if error_scale > 1.0:
        notes.append(
            Note(
                "errors-enlarged",
                f"The residuals are {error_scale:.2g} times larger than the given standard errors, which were "
                "multiplied by this factor. The errors are too small, or no one linear material describes all records.",
                values={"factor": error_scale},
            )
        )
    for number, one in enumerate(records, 1):
        size = float(np.sqrt(np.mean((one.residuals * one.error) ** 2)))
        if size > WORTH_A_NOTE and correlation(one.residuals) > FOLLOWING:
            notes.append(
                Note(
                    "structured-residuals",
                    f"Record {number}: the residuals, {100.0 * size:.2g} % of the response, are correlated over time: "
                    "they are not scatter, and the bands are too narrow; check the zero of the depth, the beginning of "
                    "the test, and whether the material is linear.",
                    values={"record": number, "rms": size},
                )
            )
    return notes


def _with_origin(found: MaterialFromIndentation) -> Material:
    """Return the material with its origin, for its file."""
    spectrum, ends = found.material.spectrum, found.identified
    if not isinstance(spectrum, RetardationSpectrum):
        raise TypeError("an identified material is one of retardation modes.")
    reach = (ends.low, ends.high) if ends.high > ends.low else (found.middle, found.middle)
    behind = ", ".join(dict.fromkeys(one.record.source for one in found.records if one.record.source))
    origin = Note(
        "identified-from-indentation",
        f"The material was identified from indentation{f' ({behind})' if behind else ''}; none of its moduli was "
        "measured in a homogeneous test.",
        values={"source": behind},
    )
    fit = SpectrumFit(
        None, None, E0_extrapolated=True, E_inf_extrapolated=True, frequency_range=(float(reach[0]), float(reach[1])),
        notes=(origin, *found.known), method=FROM_INDENTATION, modes=len(spectrum),
        rms_step=found.rms / float(np.log(10.0)),
    )  # fmt: skip
    return replace(found.material, spectrum=replace(spectrum, fit=fit))
