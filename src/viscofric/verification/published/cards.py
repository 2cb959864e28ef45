"""Material cards against finite-element programs: one element held at constant strain, with the numbers of a card."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from viscofric.arrays import Array
from viscofric.rheology.cards import abaqus
from viscofric.rheology.cards.card import Writing
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import WLF
from viscofric.rheology.spectra.retardation import RelaxationSpectrum
from viscofric.verification.check import Comparison, checks

check = checks("material cards in other programs")

_NU = 0.49


def card_material() -> Material:
    """Rubber of the comparison: E0 3 MPa, E∞ 528 MPa, five relaxation times, WLF."""
    relaxation = RelaxationSpectrum(3e6, [400e6, 100e6, 20e6, 4e6, 1e6], [1e-6, 1e-4, 1e-2, 1.0, 100.0])
    return Material(relaxation.to_retardation(), shift=WLF(12.0, 60.0, 303.0), poisson_ratio=_NU)


def card_numbers() -> tuple[float, float, Array, tuple[float, float, float]]:
    """E∞ (Pa), ν, lines of g, k, τ (s), and reference (K), C1, C2 as the text of the Abaqus card holds them."""
    blocks: dict[str, list[list[float]]] = {}
    keyword = ""
    for line in abaqus.write(card_material(), Writing()).splitlines():
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            keyword = line.split(",")[0]
        else:
            blocks.setdefault(keyword, []).append([float(part) for part in line.split(",")])
    modulus, ratio = blocks["*ELASTIC"][0]
    reference, C1, C2 = blocks["*TRS"][0]
    return modulus, ratio, np.array(blocks["*VISCOELASTIC"]), (reference, C1, C2)


def held_element(seconds: float, kelvin: float) -> float:
    """Axial stress, Pa, of a bar element with free sides: only the deviator relaxes, the bulk modulus stays.

    The strain rises over the first of 100 equal increments, each integrated exactly for a linear rise.
    """
    strain = 1e-6
    modulus, ratio, prony, (reference, C1, C2) = card_numbers()
    shear, bulk = modulus / (2.0 * (1.0 + ratio)), modulus / (3.0 * (1.0 - 2.0 * ratio))
    g, tau = prony[:, 0], prony[:, 2]
    shift = 10.0 ** (-C1 * (kelvin - reference) / (C2 + kelvin - reference))
    step = seconds / shift / 100
    decay = np.exp(-step / tau)
    gain = shear * g * (1.0 - decay) * tau / step
    relaxed = shear * (1.0 - g.sum())
    branches = np.zeros(len(tau))  # G e/ε of each; the deviator of ε_axial − ε_lateral is (2/3, −1/3, −1/3)
    difference = lateral = 0.0
    for _ in range(100):
        # No stress on the sides: K (ε + 2 l) = (2/3) [G0 (ε − l) + Σ branches].
        held = 2.0 / 3.0 * (float((decay * branches).sum()) - gain.sum() * difference)
        stiffness = 2.0 / 3.0 * (relaxed + gain.sum())
        lateral = (stiffness * strain + held - bulk * strain) / (2.0 * bulk + stiffness)
        branches = decay * branches + gain * (strain - lateral - difference)
        difference = strain - lateral
    deviator = relaxed * difference + float(branches.sum())
    return float(bulk * (strain + 2.0 * lateral) + 4.0 / 3.0 * deviator)


#: Temperature (K), time (s), stress (Pa) with the five digits that FrontISTR prints.
_FRONTISTR = (
    (303.0, 0.01, 15.456),
    (303.0, 1.0, 5.5054),
    (303.0, 100.0, 3.3922),
    (323.0, 0.01, 3.9315),
    (283.0, 0.01, 524.06),
    (283.0, 100.0, 65.176),
)


@check(
    "frontistr-card",
    "Abaqus card with WLF: stress of one element at constant strain, three temperatures",
    "FrontISTR 5.9 (finite elements, input close to Abaqus)",
    "The five digits that FrontISTR prints.",
    obtained="Run by hand with the card's E, g, τ and TRS: E0 3 MPa, E∞ 528 MPa, Maxwell terms of 400, 100, 20, 4 "
    "and 1 MPa at 1e-6, 1e-4, 0.01, 1 and 100 s, ν 0.49, WLF 12, 60 K at 303 K; the strain of 1e-6 rises in the "
    "first of 100 increments. FrontISTR relaxes the deviator only (the card's k is not used).",
    unstated="The single terms, ν and the increments were not recorded with the numbers; these reproduce all six.",
)
def _frontistr() -> Iterator[Comparison]:
    for kelvin, seconds, stress in _FRONTISTR:
        found = held_element(seconds, kelvin)
        yield Comparison(f"{kelvin:g} K, {seconds:g} s", "stress at strain 1e-6 (Pa)", found, stress, 5e-5)


#: Time (s), shear modulus and bulk modulus (MPa): stress over strain of simcoon.
_SIMCOON = (
    (1e-8, 175.842, 8733.50),
    (1e-6, 92.0267, 4570.66),
    (1e-4, 21.6811, 1076.83),
    (1e-2, 5.14158, 255.365),
    (1.0, 1.83302, 91.0402),
    (100.0, 1.13023, 56.1349),
)


@check(
    "simcoon-relaxation",
    "Abaqus card: relaxation of shear and bulk at constant strain over ten decades",
    "simcoon 2.2.0 (generalised Maxwell law, point-level integration)",
    "Backward differences of first order, 1000 increments a decade: 1.15e-3 of a decade each, below 4e-4.",
    obtained="Computed for the same rubber, `Viscoelasticity` with the viscosities E τ/(2(1+ν)) and E τ/(3(1−2ν)); "
    "with 100 increments a decade the differences are ten times larger (`tests/verification/test_finite_elements.py`).",
)
def _simcoon() -> Iterator[Comparison]:
    modulus, ratio, prony, _ = card_numbers()
    for seconds, shear, bulk in _SIMCOON:
        left = 1.0 - prony[:, :2].sum(axis=0) + (prony[:, :2].T * np.exp(-seconds / prony[:, 2])).sum(axis=1)
        found = 1e-6 * modulus * left / np.array([2.0 * (1.0 + ratio), 3.0 * (1.0 - 2.0 * ratio)])
        case = f"{seconds:g} s"
        yield Comparison(case, "shear modulus (MPa)", float(found[0]), shear, 5e-4)
        yield Comparison(case, "bulk modulus (MPa)", float(found[1]), bulk, 5e-4)
