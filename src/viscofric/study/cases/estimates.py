"""Rough estimates before solving: number of contacts, processor time and memory."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from viscofric.contact.free.scale import Scale
from viscofric.errors import InputError
from viscofric.friction.cases.case import Case, Rubbers
from viscofric.friction.cases.indenter_case import IndenterCase
from viscofric.friction.planning.curve import Curve
from viscofric.motion.springs import is_body_of_revolution
from viscofric.rheology.material import Material

# Processor time of a contact on one core of 2020, s: at low accuracy, what 1e-3 adds, and the power of 1/accuracy with
# which that grows.  Means over six speeds at two temperatures of the synthetic fluoroelastomer
# (benchmarks/study/costs.py).
_SECONDS = {
    "paraboloid": (0.08, 0.05, 1.6),
    "line": (0.08, 0.02, 1.0),
    "other": (0.09, 0.10, 1.6),
    "layer": (0.13, 0.05, 1.6),
}
# On a rough surface, s: for each contact and each of its points, half as much in full contact (512² points of the
# synthetic fluoroelastomer at 2 to 6 % of contact; the accuracy hardly matters).  Bytes for each point while solving.
_SURFACE_SECONDS, _SURFACE_SECONDS_PER_POINT, _BYTES_PER_POINT = 0.012, 1.1e-6, 250.0
#: Time of a friction curve with heating over that of its isothermal contacts: of free contacts 2.0 to 2.2
#: (benchmarks/friction/heated.py), of rough surfaces 2.6 to 5.5.
HEATED_CURVE, HEATED_SURFACE = 2.2, 4.0
#: Runs of a heated contact over time, three or four, and the times at which its rise is found besides those stored.
HEATED_RUNS, HEATED_TIMES = 3.5, 60
#: The derivatives take about as long as friction itself.
_SENSITIVE = 2.0
# Bytes: of a process that solves; of each cell of the finest window while it does.
_PROCESS, _PER_CELL = 1.1e8, 240.0
# Cells along the finest window that some of many contacts take at 1e-3; they grow as 1/√accuracy up to the most.
_CELLS, _MOST_CELLS = 512.0, 2048.0
_LINE_CELLS = 65536.0
# Of contacts over time, s, within a factor of three: of each stored time, on springs and on cells; of each stored time
# and point of a rough surface; the periods of a periodic state.  Of an impact.  Means over 30 and 90 °C.
_SPRINGS, _ON_CELLS, _ON_WAVES, _PERIODS, SECONDS_OF_IMPACT = 1.4e-3, 0.035, 2.5e-6, 12, 0.3


# Rounds in which the width of a contact and its frequency are found from each other.
_ROUNDS = 8


@dataclass(frozen=True)
class Expectation:
    """Estimated effort of a set of cases; all but the number of cases within a factor of about two."""

    cases: int
    solves: int  # contacts to be solved for them
    seconds: float  # processor time of all, on one core of 2020, s
    memory_per_process: float  # of each solving process at most, bytes


def estimate(
    cases: Sequence[Case],
    materials: Sequence[Material],
    *,
    accuracy: float = 1e-3,
    sensitive: bool = False,
    fields: bool = False,
    each: bool = False,
) -> Expectation:
    """Estimate the effort of `Plan` with the same arguments; bootstrap samples need not be drawn."""
    drawn = max((case.sample or 0 for case in cases), default=0)
    rubbers = Rubbers(materials, {number: [material] * drawn for number, material in enumerate(materials)})
    solves: dict[tuple[str, bool], float] = defaultdict(float)
    points = cases[0].points if cases else 0
    if each or fields:  # those that keep their fields are not interpolated
        for case in set(cases) if each else cases:
            solves[_kind(case)] += 1
    else:
        for kind, curve in _curves(cases, rubbers, accuracy):
            solves[kind] += curve.expected
    seconds = sum(
        number * _seconds(kind, accuracy, points) * (_SENSITIVE if sensitive and best and not points else 1.0)
        for (kind, best), number in solves.items()
    )
    cells = min(_MOST_CELLS, _CELLS * np.sqrt(1e-3 / accuracy)) ** 2
    working = _PER_CELL * (_LINE_CELLS if {kind for kind, _ in solves} == {"line"} else cells)
    return Expectation(
        cases=len(cases),
        solves=round(sum(solves.values())),
        seconds=float(seconds),
        memory_per_process=float(_PROCESS + (_BYTES_PER_POINT * points if points else working)),
    )


def contacts_beyond_indenter(cases: Sequence[Case], materials: Sequence[Material]) -> list[tuple[IndenterCase, float]]:
    """Return cases whose contact, with |E| at v/a, is estimated to be wider than the indenter, with its width, m."""
    together: defaultdict[tuple[object, ...], list[IndenterCase]] = defaultdict(list)
    for case in cases:
        if isinstance(case, IndenterCase) and case.layer is None and math.isfinite(case.indenter.reach):
            softens = materials[case.material].vertical_shift is not None  # the relaxed modulus, with temperature
            together[case.material, case.indenter, case.temperature if softens else None].append(case)
    found: list[tuple[IndenterCase, float]] = []
    for group in together.values():
        material, reach = materials[group[0].material], group[0].indenter.reach
        if _half_width(max(group, key=lambda case: case.load), material, 0.0) <= reach:
            continue  # no contact of these is wider
        for case in group:
            half = _half_width(case, material, 0.0)
            for _ in range(_ROUNDS if half > reach else 0):
                half = _half_width(case, material, case.speed / half)
            if half > reach:
                found.append((case, 2.0 * half))
    return found


def _half_width(case: IndenterCase, material: Material, frequency: float) -> float:
    """Return the half-width of the elastic contact with the modulus at a frequency, m."""
    modulus = abs(complex(material.complex_modulus(frequency, case.temperature)))
    return Scale.for_load(case.indenter, modulus / (1.0 - material.poisson_ratio**2), case.load).length


def seconds_over_time(case: Case, points: int, *, moves: bool, cycle: bool) -> float:
    """Return the estimated processor time of a case at so many times, s, within a factor of about three."""
    on_springs = not moves and case.cost in ("paraboloid", "other") and is_body_of_revolution(case.indenter)  # type: ignore[attr-defined]
    each = _ON_WAVES * case.points if case.points else _SPRINGS if on_springs else _ON_CELLS
    return each * points * (_PERIODS if cycle else 1)


def _curves(cases: Sequence[Case], rubbers: Rubbers, accuracy: float) -> list[tuple[tuple[str, bool], Curve]]:
    """Return the curves of all families with their kinds."""
    places: dict[Case, list[float]] = defaultdict(list)
    kinds: dict[Case, tuple[str, bool]] = {}
    for case in cases:
        try:
            place = case.place(rubbers)
        except InputError:
            continue  # it fails at once
        places[place.family].append(place.s)
        kinds[place.family] = _kind(case)
    return [(kinds[family], Curve(np.array(values), accuracy, family.LOGARITHMIC)) for family, values in places.items()]


def _kind(case: Case) -> tuple[str, bool]:
    """Return the kind of contact, and whether it has the best estimate of the material."""
    return case.cost, case.sample is None


def _seconds(kind: str, accuracy: float, points: int) -> float:
    if points:
        return _SURFACE_SECONDS + _SURFACE_SECONDS_PER_POINT * points
    least, more, power = _SECONDS[kind]
    return float(least + more * (1e-3 / accuracy) ** power)
