"""Job ``motion``: the contact of the study through a history of load and motion, or an impact."""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, ConfigDict, Field

from viscofric.datasets import plain, record
from viscofric.friction.cases.case import Case, moved
from viscofric.friction.cases.indenter_case import IndenterCase
from viscofric.friction.cases.surface_case import SurfaceCase
from viscofric.friction.cases.surfaces import surface_of
from viscofric.motion.history import History, dense_times
from viscofric.motion.impact import LOOSEST, solve_impact
from viscofric.motion.impact_solution import ImpactSolution
from viscofric.motion.solution import TransientSolution
from viscofric.motion.solve import solve_transient
from viscofric.notes import listed
from viscofric.report.texts.numbers import prefixed
from viscofric.rheology.material import Material, unknown_frequencies
from viscofric.study.run_file.tables import kelvin
from viscofric.web.figures.motion import motion_view, pressures
from viscofric.web.jobs.combinations import of_combination, of_material, page_sweep
from viscofric.web.jobs.context import Context, JobError, JobOptions
from viscofric.web.jobs.rubbers import study_rubber
from viscofric.web.study_text import study_of

_DIGITS = 7
#: Rows of a history on the page.
MOST_ROWS = 200
#: Times drawn of a history: of each part between two of its rows, and of all parts.
_EACH, _ALL = 60, 240


class Row(JobOptions):
    """What is prescribed at a time; a time given twice is a jump."""

    model_config = ConfigDict(allow_inf_nan=False)

    time: float  # s
    value: float  # of the options' `control`: N (N/m of a line contact), m or Pa
    along: float = 0.0  # m or m/s


class Impact(JobOptions):
    """A mass that hits the material, kg and m/s, and the gravity, m/s², that brings it back."""

    model_config = ConfigDict(allow_inf_nan=False)

    mass: float
    speed: float
    gravity: float = 0.0
    rebounds: int = Field(1, ge=1, le=20)


class Rows(JobOptions):
    """A history as the page has it."""

    rows: list[Row] = Field([], max_length=MOST_ROWS)
    control: Literal["load", "indentation", "pressure", "gap"] = "load"  # what their values are
    path: Literal["speed", "position"] = "speed"  # what their `along` is, along the motion
    before: Literal["untouched", "at rest", "sliding"] = "untouched"  # see `History`

    def history(self, **more: Any) -> History:
        """Return the history; `more` is passed on to it."""
        along = [row.along for row in self.rows]
        values: dict[str, Any] = {self.control: [row.value for row in self.rows]}
        path = {self.path: along} if any(along) else {}
        return History(time=[row.time for row in self.rows], **values, **path, before=self.before, **more)


class Options(Rows):
    """What the study's first indenter or surface does."""

    impact: Impact | None = None  # instead of a history
    coulomb: float = 0.0  # Coulomb friction coefficient of a history
    #: K, or text with its unit; instead of the study's first one
    temperature: Annotated[
        float | None, BeforeValidator(lambda value: kelvin(value) if isinstance(value, str) else value)
    ] = Field(None, gt=0.0, lt=1e5)


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Solve the contact over time, or an impact; an interruption keeps what was found."""
    _, checked = study_of(study, context.files)
    first = of_combination(page_sweep(checked), 0)
    case = first if options.temperature is None else moved(first, temperature=options.temperature)
    rubber = study_rubber(of_material(study, first.material), context, [case.temperature])
    accuracy = checked.solver.accuracy
    solved: TransientSolution | ImpactSolution
    if options.impact is not None:
        hit = solved = _impact(rubber.material, case, options.impact, min(accuracy, LOOSEST))
        whole, contacts = hit.run, hit.contacts
    else:
        whole = solved = _transient(rubber.material, case, options, accuracy, context)
        contacts = ()
        if not len(whole.time):  # nothing was reached
            raise KeyboardInterrupt
    notes = [*rubber.rubber.notes, *unknown_frequencies(rubber.material)]
    warnings = [*solved.warnings, *rubber.doubts([case.temperature])]
    data = solved.to_dataset()
    shown = motion_view(data, contacts, f"{whole.steps} steps, {whole.rejected_steps} rejected")
    over_time = pressures(whole)
    shown["figures"] = over_time.pop("figures", {}) | shown["figures"]
    return {
        **record(data, _DIGITS),
        **over_time,
        **({"contacts": plain([one._asdict() for one in contacts], _DIGITS)} if contacts else {}),
        **plain(shown, _DIGITS),
        **listed("warnings", dict.fromkeys(warnings), "page"),
        **listed("notes", dict.fromkeys(notes), "page"),
    }


def _transient(
    material: Material, case: Case, options: Options, accuracy: float, context: Context
) -> TransientSolution:
    """Solve the contact of a case through the history of the options."""
    assert isinstance(case, (IndenterCase, SurfaceCase))
    angle = case.direction if isinstance(case, SurfaceCase) else 0.0
    history = options.history(temperature=case.temperature, direction=(math.cos(angle), math.sin(angle)))
    start, end = float(history.time[0]), float(history.time[-1])

    def progress(reached: float, _: float) -> None:
        words = f"{prefixed(reached - start, None, 's')} of {prefixed(end - start, None, 's')}"
        context.progress((reached - start) / (end - start), 1.0, words)

    return solve_transient(
        material,
        case.indenter if isinstance(case, IndenterCase) else surface_of(case.surface),
        history,
        times=dense_times(history, len(history.time) + min(_EACH * (len(history.time) - 1), _ALL)),
        accuracy=accuracy,
        layer=case.layer,
        indenter_modulus=case.modulus,
        indenter_poisson_ratio=case.poisson_ratio,
        coulomb=options.coulomb,
        progress=progress,
    )


def _impact(material: Material, case: Case, impact: Impact, accuracy: float) -> ImpactSolution:
    """Solve the impact of the indenter of a case."""
    if not isinstance(case, IndenterCase):
        raise JobError("An impact needs an indenter; choose a ball or a cone.", "surface", code="rough-surface")
    if case.layer is not None:
        words = "An impact is solved on a half-space; remove the layer."
        raise JobError(words, "layer", code="not-available")
    return solve_impact(
        material,
        case.indenter,
        **impact.model_dump(),
        temperature=case.temperature,
        accuracy=accuracy,
        indenter_modulus=case.modulus,
        indenter_poisson_ratio=case.poisson_ratio,
    )
