"""Rise of surface temperature by any map of heat on a grid."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
import scipy.fft
from numpy.typing import ArrayLike

from viscofric.arguments import flag, insist_on
from viscofric.arrays import Array, ComplexArray, convolved
from viscofric.errors import InputError, check_choice
from viscofric.heat.influence import Diffusion
from viscofric.thermal import ThermalProperties
from viscofric.units import Quantity, in_si, positive, to_si, two_lengths

#: Thickness over √(κt) from which on no heat has reached a base, to 1e-16; waves across thinner layers until then.
_DEEP, _ACROSS = 6.0, 14


def surface_temperature(
    heat: ArrayLike,
    spacing: Quantity | tuple[Quantity, Quantity],
    body: ThermalProperties,
    *,
    speed: Quantity,
    time: Quantity | None = None,
    thickness: Quantity | None = None,
    base: Literal["isothermal", "insulated"] = "isothermal",
    periodic: bool = False,
) -> Array:
    """Return the rise of temperature of a surface by heat on the cells of a grid that moves over it.

    Parameters
    ----------
    heat : (nx, ny) array
        Heat per area that each cell gives to the body, W/m².
    spacing : float, str or pint.Quantity, or two of them
        Of the cells along x and y, m.
    body : ThermalProperties
    speed : float, str or pint.Quantity
        Of the heat over the body along x, m/s; below zero towards −x.
    time : float, str or pint.Quantity, optional
        Since the heat began, s; the steady state without.
    thickness : float, str or pint.Quantity, optional
        Of the body, m; a half-space without.
    base : {"isothermal", "insulated"}
        Whether the lower side of a body with a thickness stays at its temperature, or passes no heat.
    periodic : bool
        Whether the map repeats itself without end, instead of being alone on the surface.

    Returns
    -------
    (nx, ny) array
        Rise above the temperature far away, or before the heat began, at cell centres, K.  In the steady state of a
        periodic map on a half-space or insulated layer, which warms without end: above the mean of the surface.

    Raises
    ------
    InputError
        If a value cannot be used, or there is no steady state.

    Notes
    -----
    Maps alone on the surface are exact for heat that is uniform on each cell (`viscofric.heat.influence`).  Periodic
    maps are sums of waves of heat, each of which raises the temperature by ::

        T(q) = Q(q)/(k s) erf(s √(κ t)),    s² = q² − i q·v/κ

    and in the steady state of a layer by tanh(s H)/(k s) or coth(s H)/(k s), H the thickness; at a time less those
    waves across the layer that have not faded.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> steel = vf.ThermalProperties("46 W/m/K", "7810 kg/m**3", "475 J/kg/K", "steel")
    >>> rise = vf.heat.surface_temperature(np.full((16, 16), 1e6), "20 um", steel, speed="1 m/s")
    >>> f"{rise.mean():.2f} K, at most {rise.max():.2f} K"
    '0.96 K, at most 1.46 K'
    """
    flux = in_si(heat, "W/m**2", "heat")
    if flux.ndim != 2 or not flux.size:
        raise InputError(f"heat must have one value for each cell of a grid; its shape is {flux.shape}.", code="shape")
    cell = two_lengths(spacing)
    insist_on(body, "body", ThermalProperties)
    velocity = to_si(speed, "m/s", "speed")
    since = math.inf if time is None else positive(time, "s", "time")
    thick = math.inf if thickness is None else positive(thickness, "m", "thickness")
    check_choice(base, "base", "isothermal", "insulated")
    insulated = base == "insulated"
    if flag(periodic, "periodic"):
        return _periodic(flux, cell, body, (velocity, 0.0), since, thick, insulated)
    mirrored = flux[::-1] if velocity < 0.0 else flux
    found = free_temperature(mirrored, cell, Diffusion(body, abs(velocity), since, thick, insulated))
    return np.ascontiguousarray(found[::-1]) if velocity < 0.0 else found


def free_temperature(flux: Array, cell: tuple[float, float], diffusion: Diffusion) -> Array:
    """Return the rise (nx, ny), K, by a map of heat (nx, ny), W/m², that moves towards +x alone on a surface."""
    nx, ny = flux.shape
    x, y = np.arange(1.0 - nx, nx), np.arange(0.0, ny)
    return convolved(diffusion.influence(np.asarray(cell[0] * x), np.asarray(cell[1] * y), cell), flux)


def _periodic(
    flux: Array,
    cell: tuple[float, float],
    body: ThermalProperties,
    velocity: tuple[float, float],
    time: float,
    thickness: float,
    insulated: bool,
) -> Array:
    nx, ny = flux.shape
    wave_x = 2.0 * np.pi * scipy.fft.fftfreq(nx, cell[0])[:, None]
    wave_y = 2.0 * np.pi * scipy.fft.rfftfreq(ny, cell[1])
    root = np.sqrt(
        np.square(wave_x) + np.square(wave_y) - 1j * (wave_x * velocity[0] + wave_y * velocity[1]) / body.diffusivity
    )
    transfer = _transfer(root, body, time, thickness, insulated)
    # The wave at the Nyquist frequency is as much one way as the other.
    if nx % 2 == 0:
        transfer[nx // 2] = 0.5 * (transfer[nx // 2] + np.conj(transfer[nx // 2]))
    if ny % 2 == 0:
        opposite = np.roll(transfer[::-1, -1], 1)  # at −q_x
        transfer[:, -1] = 0.5 * (transfer[:, -1] + np.conj(opposite))
    return np.asarray(scipy.fft.irfft2(transfer * scipy.fft.rfft2(flux), s=flux.shape))


def _transfer(
    root: ComplexArray, body: ThermalProperties, time: float, thickness: float, insulated: bool
) -> ComplexArray:
    """Return T/Q of each wave, K m²/W; that of the mean is zero where it has no steady state."""
    from scipy.special import erf

    conductivity, reach = float(body.conductivity), math.sqrt(body.diffusivity * time)
    inverse = np.zeros_like(root)
    np.divide(1.0, root, out=inverse, where=root != 0.0)
    if math.isfinite(thickness) and thickness < _DEEP * reach:
        through = np.tanh(np.minimum(root.real, 30.0 / thickness) * thickness + 1j * root.imag * thickness)
        if insulated:
            found = inverse / np.where(root != 0.0, through, 1.0)
            if math.isfinite(time):
                found[0, 0] = reach**2 / thickness + thickness / 3.0
        else:
            found = inverse * through
            found[0, 0] = thickness
        for mode in range(_ACROSS if math.isfinite(time) else 0):
            wave = np.pi / thickness * (mode if insulated else mode + 0.5)
            square, share = np.square(root) + wave**2, (2.0 if wave > 0.0 else 1.0) / thickness
            faded = share * np.exp(-square * reach**2)
            found -= np.divide(faded, square, out=np.zeros_like(root), where=square != 0.0)
    elif math.isfinite(time):
        found = inverse * erf(root * reach)
        found[0, 0] = 2.0 * reach / math.sqrt(math.pi)
    else:
        found = inverse
    return np.asarray(found / conductivity)
