"""What a study varies besides speed and temperature: one friction curve for each combination of it."""

from __future__ import annotations

from collections.abc import Mapping

from viscofric.friction.cases.case import Case
from viscofric.study.cases.sweep import Sweep, others_in
from viscofric.study.run_file.study import Study
from viscofric.web.jobs.context import JobError

#: Cases that the page solves at most; a browser shows no more.
MOST_CASES = 2_000


def page_sweep(study: Study) -> Sweep:
    """Return the cases of a study that the page solves: with the best estimate of the rubber, none measured."""
    bare = study.uncertainty.model_copy(update={"members": 0})
    sweep = study.model_copy(update={"uncertainty": bare}).sweep()
    if len(sweep.cases) > MOST_CASES:
        raise JobError(
            f"{len(sweep.cases):,} cases are more than the {MOST_CASES:,} that the page solves; take fewer "
            "speeds, temperatures or loads here, or export the run file and solve it with viscofric run.",
            "conditions",
            code="too-many-cases",
        )
    return sweep


def combinations(sweep: Sweep) -> tuple[dict[object, int], list[str]]:
    """Return the number of each combination by `Case.alike`, and its differences from the others in words, if any."""
    numbers: dict[object, int] = {}
    words: list[str] = []
    for number, case in enumerate(sweep.cases):
        if case.alike not in numbers:
            numbers[case.alike] = len(numbers)
            words.append(", ".join(others_in(sweep, number)))
    return numbers, words


def of_combination(sweep: Sweep, number: int) -> Case:
    """Return the first case of a combination, or raise `JobError`."""
    cases: dict[object, Case] = {}
    for case in sweep.cases:
        cases.setdefault(case.alike, case)
    if number >= len(cases):
        raise JobError(
            f"combination = {number}: the study has {len(cases)} of them, counted from 0.", code="no-such-combination"
        )
    return list(cases.values())[number]


def of_material(study: Mapping[str, object], number: int) -> dict[str, object]:
    """Return the tables of a study with one of its rubbers only."""
    material = study.get("material")
    return {**study, "material": material[number]} if isinstance(material, list) else dict(study)
