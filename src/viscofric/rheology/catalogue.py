"""Built-in rubbers: for now one synthetic fluoroelastomer, an assumption and not a measurement."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from viscofric.rheology.material import Material
from viscofric.rheology.shift_laws import WLFArrhenius
from viscofric.rheology.spectrum import RetardationSpectrum

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

#: The half-Gaussians end so many standard deviations from their centres, where they hold no more compliance.
WIDTH = 4.5


def synthetic_fluoroelastomer() -> Material:
    """Return a SYNTHETIC rubber that behaves like a fluoroelastomer; it was assumed, not measured.

    At 30 °C its compliance is spread over log10 τ in two half-Gaussian pairs: the glass transition (12 MPa to
    1.5 GPa) and a slow relaxation below the rubber plateau (12 MPa to 3 MPa), which makes the loss modulus
    fall with frequency where friction tests are made.  WLF above Tg = −18 °C (17.44, 51.6 K), Arrhenius
    below it; ν = 0.5.  tan δ peaks at 1.33 near 5e6 rad/s.

    Returns
    -------
    Material
        With E0 = 3 MPa, E_inf = 1.5 GPa, τ in geometric progression of ratio e, reference 30 °C.
    """
    rubber, between, glass = 3e6, 12e6, 1.5e9  # Pa
    fast = {"centre": -3.85, "long": 0.3, "short": 1.2}  # decades of seconds
    slow = {"centre": 4.5, "long": 0.5, "short": 2.5}
    ends = [(peak["centre"] - WIDTH * peak["short"], peak["centre"] + WIDTH * peak["long"]) for peak in (fast, slow)]
    first = math.ceil(min(low for low, _ in ends) * math.log(10.0))
    last = math.floor(max(high for _, high in ends) * math.log(10.0))
    tau = np.exp(np.arange(first, last + 1, dtype=float))
    glass_transition = _half_gaussians(np.log10(tau), **fast)
    relaxation = _half_gaussians(np.log10(tau), **slow)
    C = glass_transition * (1 / between - 1 / glass) + relaxation * (1 / rubber - 1 / between)
    shift = WLFArrhenius(C1=17.44, C2=51.6, glass_transition="-18 degC", reference="30 degC")
    return Material(
        RetardationSpectrum(rubber, glass, C, tau), shift, poisson_ratio=0.5, name="synthetic fluoroelastomer"
    )


def _half_gaussians(log10_tau: Array, centre: float, long: float, short: float) -> Array:
    """Two half-Gaussians joined at their centre, of total 1 over the given retardation times."""
    away = log10_tau - centre
    weight = np.exp(-0.5 * (away / np.where(away > 0.0, long, short)) ** 2)
    return np.asarray(weight / weight.sum())
