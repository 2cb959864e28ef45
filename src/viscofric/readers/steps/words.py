"""Words in files of creep and relaxation tests: names of columns, and of steps of an instrument's programme."""

from __future__ import annotations

import re

from viscofric.readers.dma.names import SET_TEMPERATURE, STEP, STRAIN_AMPLITUDE, TEMPERATURE
from viscofric.readers.headings import Vocabulary

TIME = frozenset(
    {"t", "time", "zeit", "temps", "tiempo", "tempo", "tijd", "tid", "čas", "czas", "время", "时间", "時間"}
    | {"test time", "elapsed time", "messzeit", "durée"}
)
#: Since the step, read rather than one that counts from the beginning of a programme.
STEP_TIME = frozenset({"step time", "time in step", "creep time", "relaxation time", "kriechzeit", "segment time"})
CREEP_COMPLIANCE = frozenset(
    {"J", "J(t)", "D", "D(t)", "j(t)", "d(t)", "compliance", "creep compliance", "shear compliance", "compliance j(t)"}
    | {"tensile compliance", "shear creep compliance", "tensile creep compliance", "creep compliance j(t)"}
    | {"nachgiebigkeit", "kriechnachgiebigkeit", "complaisance", "complaisance de fluage", "cedevolezza"}
    | {"complianza", "fluencia", "compliancia", "蠕变柔量", "クリープコンプライアンス"}
)
RELAXATION_MODULUS = frozenset(
    {"E", "G", "E(t)", "G(t)", "e(t)", "g(t)", "modulus", "modulus g(t)", "modulus e(t)", "relaxation modulus"}
    | {"relaxation modulus g(t)", "relaxation modulus e(t)", "shear relaxation modulus", "tensile relaxation modulus"}
    | {"stress relaxation modulus", "shear modulus", "relaxationsmodul", "module de relaxation", "módulo de relajación"}
    | {"modulo di rilassamento", "松弛模量", "緩和弾性率"}
)
STRESS = frozenset(
    {"σ", "τ", "sigma", "stress", "shear stress", "tensile stress", "spannung", "schubspannung", "contrainte"}
    | {"contrainte de cisaillement", "esfuerzo", "sforzo", "应力", "応力"}
)

#: The words of tables of step tests: name of a quantity in errors -> names of its columns.
STEPS = Vocabulary(
    "a table of creep or relaxation tests",
    {
        "temperature": TEMPERATURE,
        "time": TIME,
        "creep compliance": CREEP_COMPLIANCE,
        "relaxation modulus": RELAXATION_MODULUS,
        "stress": STRESS,
        "strain": STRAIN_AMPLITUDE,
        "step time": STEP_TIME,
        "set temperature": SET_TEMPERATURE,
        "step": STEP,
    },
    needed=(("time", "step time"), ("creep compliance", "relaxation modulus", "strain")),
    example="a creep test has e.g. 'temperature (degC)', 'time (s)', 'creep compliance (1/MPa)', a relaxation test "
    "'relaxation modulus (MPa)'",
    key="material.columns",
    offered=(
        ("temperature", "degC"),
        ("time", "s"),
        ("creep compliance", "1/MPa"),
        ("relaxation modulus", "MPa"),
    ),
)

_CREEP = re.compile(r"creep|fluage|kriech|retard", re.IGNORECASE)
_RELAXATION = re.compile(r"relax", re.IGNORECASE)
_RECOVERY = re.compile(r"recover|erholung|recouvrance", re.IGNORECASE)


def kind_in_name(name: str) -> str:
    """Return the kind of test that the name of a step or file states: creep, relaxation, recovery, or ""."""
    if _RECOVERY.search(name):
        return "recovery"
    if _RELAXATION.search(name):
        return "relaxation"
    return "creep" if _CREEP.search(name) else ""
