"""Job ``contact``: one contact at a speed and a temperature, at first coarsely, then to the study's accuracy."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

from viscofric.contact.steady import LOOSE
from viscofric.friction.cases.case import Rubbers, moved
from viscofric.web.jobs.combinations import of_combination, of_material, page_sweep
from viscofric.web.jobs.contact_pictures import pictures
from viscofric.web.jobs.context import Context, JobOptions
from viscofric.web.jobs.rubbers import study_rubber
from viscofric.web.study_text import study_of

#: Accuracy of coarse replies, the loosest that a run file may ask for.
COARSE = 0.1
#: Points along the longer edge of the surfaces of coarse replies: coarser likenesses of those with more.
COARSE_POINTS = 128


class Options(JobOptions):
    """Which contact of the study is wanted, and how well."""

    speed: float = Field(gt=0.0, lt=1e9)  # speed, temperature: m/s and K, instead of the study's
    temperature: float = Field(gt=0.0, lt=1e5)
    #: Of all else that the study varies (loads, radii, seeds …); see `viscofric.web.jobs.combinations`
    combination: int = Field(0, ge=0, lt=1_000_000)
    #: A coarse reply, one to the study's accuracy, or the first as a part and the second as the result
    stages: Literal["coarse", "sharp", "both"] = "both"


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Solve one contact, coarsely or to the study's accuracy; then its numbers are those of a study of it alone."""
    _, checked = study_of(study, context.files)
    first = of_combination(page_sweep(checked), options.combination)
    rubber = study_rubber(of_material(study, first.material), context, [options.temperature])
    case = moved(first, material=0, speed=options.speed, temperature=options.temperature)
    accuracy = checked.solver.accuracy
    rubbers = Rubbers([rubber.material], {})
    if options.stages != "sharp":
        solution: Any = case.solution(rubbers, COARSE, COARSE_POINTS)
        # Grids are refined until they promise the accuracy: where the first of them do, no others are looked at, if a
        # study begins with the same grids.
        same = case.geometry == "line" or (case.geometry == "point" and accuracy >= LOOSE)
        allowed = accuracy * abs(solution.friction_coefficient)
        settled = same and solution.diagnostics.friction_error <= allowed
        found = pictures(case, rubber, solution, sharp=settled)
        if settled or options.stages == "coarse":
            return found
        context.part(found)
    return pictures(case, rubber, case.solution(rubbers, accuracy), sharp=True)
