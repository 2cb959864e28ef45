"""What the predictions of a study take for granted, checked for the cases asked for and for those measured."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.friction.assumptions import AssumptionCheck, check_assumptions
from viscofric.study import labels
from viscofric.study.bands import curves_of

if TYPE_CHECKING:
    import xarray

    from viscofric.friction.curves import FrictionCurves
    from viscofric.study.cases import CaseSolver
    from viscofric.study.measurement import Measurement
    from viscofric.study.record import CaseRecord
    from viscofric.study.run_file import Study


def assumptions(
    study: Study,
    solver: CaseSolver,
    measured: Measurement | None,
    records: list[CaseRecord],
    at_points: list[CaseRecord | None],
) -> dict[str, xarray.Dataset]:
    """Check thickness, small strain and warming of all contacts; of each, what is told is the worst.

    Parameters
    ----------
    study : Study
    solver : CaseSolver
        That solved them.
    measured : Measurement, optional
        Tells the Coulomb friction, which heats.
    records : list of CaseRecord
        Cases asked for.
    at_points : list of CaseRecord or None
        At the measured points; None where the solve failed.
    """
    found = list(_checked(study, solver, curves_of(records), records))
    if measured is not None:
        solved = np.array([record is not None for record in at_points], dtype=bool)
        if solved.any():
            here = [record for record in at_points if record is not None]
            found = _worse(found, _checked(study, solver, measured.curves.select(solved), here))
    return {"/assumptions": labels.assumption_data(found)} if found else {}


def _checked(
    study: Study, solver: CaseSolver, curves: FrictionCurves, records: list[CaseRecord]
) -> tuple[AssumptionCheck, ...]:
    reach = np.array([max(record.half_width, 0.5 * (record.front + record.rear)) for record in records])
    thickness = study.conditions.thickness
    return check_assumptions(solver.material, solver.ball, curves, thickness=thickness, contact_radius=reach)


def _worse(some: list[AssumptionCheck], others: tuple[AssumptionCheck, ...]) -> list[AssumptionCheck]:
    """Return, of two checks of the same assumption, the one with more to tell."""
    if not some:
        return list(others)
    beside = {other.name: other for other in others}
    return [max((one, beside.get(one.name, one)), key=lambda check: check.value or 0.0) for one in some]
