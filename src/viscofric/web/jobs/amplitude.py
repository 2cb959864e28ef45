"""Job ``amplitude``: the amplitude sweep of [material] with Kraus's law, and the strain of the study's contact."""

from __future__ import annotations

from typing import Any

import numpy as np

from viscofric.datasets import plain, record
from viscofric.friction.cases.indenter_case import IndenterCase
from viscofric.friction.contact_strain import solve_at_contact_strain
from viscofric.notes import listed
from viscofric.rheology.payne.kraus_fit import PayneFit
from viscofric.study.at_strain import payne_of
from viscofric.web.figures.spec import MODULUS, Spec, axis, figure, line, points, quantity
from viscofric.web.jobs.combinations import of_combination, page_sweep
from viscofric.web.jobs.context import Context, JobError, JobOptions
from viscofric.web.jobs.rubbers import checked_tables, made_rubber
from viscofric.web.study_text import study_of

_DIGITS = 6


class Options(JobOptions):
    """Whether the strain of the study's first contact is wanted."""

    contact: bool = False


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Fit Kraus's law to the amplitude sweep of [material]; return both, and the strain of the study's contact."""
    table, _ = checked_tables(study, context)
    fit = payne_of(table)
    if fit is None:
        raise JobError("The study has no amplitude sweep; drop one under “Data”.", "material.amplitude_sweep")
    found = record(fit.to_dataset(), _DIGITS)
    return found | {
        "figures": {"amplitude-sweep": _figure(found, "G" if fit.sweep.deformation == "shear" else "E")},
        "deformation": fit.sweep.deformation,
        "words": str(fit.law),
        "linear": [str(one) for one in fit.linear_ranges],
        "contact": _contact(study, fit, table.measured_at, context) if options.contact else None,
        **listed("notes", fit.notes, "page"),
    }


def _figure(found: dict[str, Any], letter: str) -> Spec:
    percent = 100.0 * np.array(found["strain_amplitude"])
    traces = []
    for key, name, symbol, colour in (("storage", "′", "square", "blue"), ("loss", "″", "circle", "vermilion")):
        traces.append(points(percent, f"{key}_modulus", f"{letter}{name}", symbol=symbol, colour=colour, size=5))
        traces.append(line(percent, f"{key}_fitted", f"{letter}{name}, Kraus", colour=colour, legend=False))
    strain = axis("strain amplitude (%)", log=True)
    return figure("Amplitude sweep", strain, MODULUS, traces, "Points: as measured; lines: Kraus’s law.")


def _contact(study: dict[str, Any], fit: PayneFit, measured_at: float | None, context: Context) -> dict[str, Any]:
    """Solve the first contact of the study, with a rigid indenter, with the moduli of its own strain."""
    _, checked = study_of(study, context.files)
    case = of_combination(page_sweep(checked), 0)
    if not isinstance(case, IndenterCase):
        raise JobError("The strain of a contact is known for indenters, not for rough surfaces.", code="rough-surface")
    rubber = made_rubber(study, context)
    found = solve_at_contact_strain(
        rubber.linear or rubber.material,
        fit.law,
        case.indenter,
        speed=case.speed,
        load=case.load,
        temperature=case.temperature,
        measured_at=measured_at,
        layer=case.layer,
        accuracy=checked.solver.accuracy,
    )
    words = (
        f"At {quantity(case.speed, 'speed')}, {quantity(case.temperature, 'temperature')} the strain of the contact is "
        f"{100.0 * found.strain:.2g} %: friction {found.scaled.friction_coefficient:.3g} instead of "
        f"{found.linear.friction_coefficient:.3g} (small strain)."
    )
    return {
        "words": words,
        "strain": plain(found.strain),
        "friction": plain(found.scaled.friction_coefficient),
        "linear": plain(found.linear.friction_coefficient),
        "speed": plain(case.speed),
        "temperature": plain(case.temperature),
    }
