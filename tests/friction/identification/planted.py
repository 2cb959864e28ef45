"""A rubber of a broad spectrum and its friction, few points that are quickly identified."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

import viscofric as vf
from friction.synthetic_curves import curves_of
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.identification.forward import FirstOrder
from viscofric.friction.identification.solving import Contacts

BALL = vf.Ball(radius=10e-3)
LOAD = 5.0
REFERENCE = 303.15
#: Retardation times that the fit's own grid does not hold, e to the 1.2 apart; friction rises over the speeds below.
_TAU = np.exp(np.arange(-14.0, 4.0, 1.2))
_SHARE = np.exp(-0.5 * ((np.log(_TAU) + 6.0) / 3.0) ** 2)
RUBBER = vf.Material(
    vf.RetardationSpectrum(2.5e6, 7e6, _SHARE / _SHARE.sum() * (1.0 / 2.5e6 - 1.0 / 7e6), _TAU),
    vf.WLF(C1=9.0, C2=100.0, reference=REFERENCE),
)
SPEEDS = np.geomspace(0.02, 0.2, 6)


@lru_cache(maxsize=4)
def planted_curves(*kelvin: float, accuracy: float = 1e-3) -> FrictionCurves:
    """Friction without noise at six speeds and each of the temperatures."""
    temperature = np.repeat(kelvin, len(SPEEDS))
    reduced = np.tile(SPEEDS, len(kelvin)) * RUBBER.shift(temperature)
    spectrum = RUBBER.modes_at()
    compliances = np.log([1.0 / spectrum.E_inf, *spectrum.C])
    solved = Contacts(BALL, 0.5, LOAD, 1).at(compliances, vf.Material(spectrum), np.log(reduced), 1, accuracy)
    return curves_of(np.tile(SPEEDS, len(kelvin)), temperature, np.exp(solved.log_friction), 1e-6, load=LOAD)


def closed_form_curves(*kelvin: float, rubber: vf.Material = RUBBER) -> FrictionCurves:
    """Friction at six speeds and each of the temperatures, to first order in the loss: no contact is solved."""
    assert rubber.shift is not None
    temperature = np.repeat(kelvin, len(SPEEDS))
    spectrum, speed = rubber.modes_at(), np.tile(SPEEDS, len(kelvin))
    first = FirstOrder(BALL, LOAD, 0.75, spectrum.tau)
    found = first(np.log([1.0 / spectrum.E_inf, *spectrum.C]), np.log(speed * rubber.shift(temperature)))
    return curves_of(speed, temperature, np.exp(found.log_friction), 1e-6, load=LOAD)


def planted_anchor(frequency: float = 10.0, error: float = 1e-3) -> vf.friction.ModulusAnchor:
    """|E| of the rubber at the reference."""
    modulus = float(abs(RUBBER.complex_modulus(frequency)))
    return vf.friction.ModulusAnchor(modulus, frequency, REFERENCE, error=error)
