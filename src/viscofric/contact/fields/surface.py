"""The surface around a contact with the trail behind it, and the power through it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arguments import insist_on
from viscofric.arrays import Array, Mask, convolved
from viscofric.contact.bodies import Layer
from viscofric.contact.fields.stress import on_cells, spacing
from viscofric.contact.influence.layer_potentials import THINNEST, LayerCell, LayerStrip
from viscofric.contact.influence.line import line_memory_influence, strip_potential
from viscofric.contact.influence.mixtures import memory_influence
from viscofric.contact.influence.potentials import CellPotential, HalfSpaceCell
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.units import checked_modes, checked_poisson_ratio, in_si, positive, to_si, velocity

#: Most cells of the window.
LARGEST = 2**24
#: Most cells to either side of the contact, whose influence takes thousands of numbers each.
WIDEST = 2**14
# Cells are square but for their last digits: rounded coordinates must not make them anything else.
_NOT_SQUARE = 1e-6
# Largest ratio of their sides: the influence of longer ones is lost in rounding.
_LONGEST = 1e12


@dataclass(frozen=True, eq=False)
class SurfaceDisplacement:
    """Displacement of the surface in and around a contact.

    Attributes
    ----------
    x, y : (nx,) and (ny,) array
        Cell centres, m, the pressure's own among them.
    displacement : (nx, ny) array
        u, positive into the solid, m.
    """

    x: Array
    y: Array
    displacement: Array

    def to_dataset(self) -> Dataset:
        """Return the displacement over x and y."""
        return dataset(
            ("x", "y"),
            {"displacement": (self.displacement, "m", "displacement into the solid")},
            coordinates={
                "x": (self.x, "m", "position along the motion"),
                "y": (self.y, "m", "position across the motion"),
            },
        )


def surface_displacement(
    x: ArrayLike,
    y: ArrayLike,
    pressure: ArrayLike,
    *,
    speed: float,
    E_inf: float,
    C: ArrayLike,
    tau: ArrayLike,
    poisson_ratio: float,
    layer: Layer | None = None,
    behind: float = 0.0,
    ahead: float = 0.0,
    beside: float = 0.0,
) -> SurfaceDisplacement:
    """Displacement of a half-space or layer under a steady pressure, in a window larger than the contact's.

    Parameters
    ----------
    x, y : (nx,) and (ny,) array
        Centres of rectangular cells, each in equal steps, m; one y means a line contact in plane strain.
    pressure : (nx, ny) array
        p, Pa.
    speed : float
        v, m/s, positive towards +x; 0 and ±inf are the elastic limits.
    E_inf : float
        Glass modulus, Pa.
    C, tau : (m,) array
        Compliance (1/Pa) and retardation time (s) of each mode.
    poisson_ratio : float
    layer : Layer, optional
        Thickness and base of the material; a half-space without.
    behind, ahead : float
        Distance beyond the ends of `x`, against and along the motion, m; rounded up to whole cells.
    beside : float
        Distance beyond both ends of `y`, m.

    Returns
    -------
    SurfaceDisplacement
        For a line contact on a half-space, relative to the end of the window ahead of it, since in plane strain only
        differences are determined.

    Raises
    ------
    InputError
        If the arrays do not fit each other, or the window has too many cells.

    Notes
    -----
    The convolution of Eq. 8 of [1]_, with the influence coefficients that the solver uses.

    References
    ----------
    .. [1] C. Putignano, T. Reddyhoff, D. Dini, Tribol. Int. 100 (2016) 338–343.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    >>> contact = vf.solve_steady(rubber, vf.Ball("10 mm"), speed="1 m/s", load="1 N", accuracy=1e-2)
    >>> modes = rubber.spectrum
    >>> trail = vf.contact.surface_displacement(
    ...     contact.x,
    ...     contact.y,
    ...     contact.pressure,
    ...     speed=1.0,
    ...     E_inf=modes.E_inf,
    ...     C=modes.C,
    ...     tau=modes.tau,
    ...     poisson_ratio=0.5,
    ...     behind=2e-3,
    ... )
    >>> bool(trail.x[0] < contact.x[0] - 1.9e-3)
    True
    """
    along, across = in_si(x, "m", "x"), in_si(y, "m", "y")
    ratio = checked_poisson_ratio(poisson_ratio, above=-1.0)
    insist_on(layer, "layer", Layer, type(None), right="a Layer or None")
    step = spacing(along, "x")
    load = on_cells(pressure, (len(along), len(across)), "pressure")
    is_line = len(across) == 1
    width = step if is_line else spacing(across, "y")
    aspect = 1.0 if abs(width / step - 1.0) < _NOT_SQUARE else width / step
    if not 1.0 / _LONGEST <= aspect <= _LONGEST:
        raise InputError(
            f"y: the cells are {aspect:.1e} times as wide as long; the ratio must lie within {_LONGEST:g}.",
            code="out-of-range",
        )
    beyond = [to_si(value, "m", name) for name, value in (("behind", behind), ("ahead", ahead), ("beside", beside))]
    if min(beyond) < 0.0:
        raise InputError("behind, ahead and beside must not be negative.", code="not-positive")
    sliding = velocity(speed)
    modes = _Modes.at(sliding, E_inf, C, tau, step)
    below, above = (math.ceil(distance / step - 1e-9) for distance in beyond[:2])
    if sliding < 0.0:
        below, above = above, below
    sides = 0 if is_line else math.ceil(beyond[2] / width - 1e-9)
    cells = (len(along) + below + above) * (len(across) + 2 * sides)
    if cells > LARGEST or sides > WIDEST:
        raise InputError(
            f"the window has {cells} cells, more than {LARGEST}, or is too wide; give smaller distances.",
            code="too-large",
        )
    larger = np.pad(load, ((below, above), (sides, sides)))
    # The influence functions hold for motion towards +x.
    mirrored = larger[::-1] if sliding < 0.0 else larger
    if is_line and layer is None:
        influence = _line_influence(modes, len(larger))
    else:
        influence = _influence(modes, larger.shape, _cell(layer, is_line, step, aspect, ratio))
    factor = 2.0 if is_line else 1.0
    found = factor * (1.0 - ratio**2) * step / np.pi * convolved(influence, mirrored)
    if is_line and layer is None:
        found -= found[-1]
    return SurfaceDisplacement(
        x=along[0] + step * (np.arange(len(larger)) - below),
        y=across if is_line else across[0] + width * (np.arange(larger.shape[1]) - sides),
        displacement=found[::-1] if sliding < 0.0 else found,
    )


@dataclass(frozen=True, eq=False)
class _Modes:
    """Compliance without memory, and those that fade with memory lengths in cells."""

    glassy: float
    compliances: Array
    lengths: Array

    @classmethod
    def at(cls, speed: float, E_inf: float, C: ArrayLike, tau: ArrayLike, step: float) -> _Modes:
        compliances, times = checked_modes(C, "C", "1/Pa", tau)
        glassy = 1.0 / positive(E_inf, "Pa", "E_inf")
        if speed == 0.0:
            glassy += float(compliances.sum())
        if speed == 0.0 or math.isinf(speed):
            compliances = times = np.zeros(0)
        return cls(glassy, compliances, abs(speed) * times / step if len(times) else times)


def _cell(layer: Layer | None, is_line: bool, step: float, aspect: float, poisson_ratio: float) -> CellPotential:
    if layer is None:
        return HalfSpaceCell(aspect)
    thickness = float(layer.thickness) / step
    if thickness < THINNEST * max(1.0, aspect):
        raise InputError(
            f"the cells are too large for the layer: it must be at least {THINNEST} of them thick.",
            code="layer-too-thin",
        )
    if is_line:
        return LayerStrip(thickness, layer.bonded, poisson_ratio)
    return LayerCell(thickness, layer.bonded, poisson_ratio, aspect)


def _influence(modes: _Modes, shape: tuple[int, ...], cell: CellPotential) -> Array:
    """Influence of the unit cell at offsets −(nx−1) … nx−1 and 0 … ny−1."""
    nx, ny = shape
    instant = np.array([modes.glassy])
    found = memory_influence((nx, ny), modes.compliances[None], modes.lengths, instant=instant, potential=cell)
    return np.asarray(found[0])


def _line_influence(modes: _Modes, cells: int) -> Array:
    """Influence of the unit cell of a strip on a half-space, up to a constant."""
    x = np.arange(-(cells - 1.0), cells)
    total = modes.glassy * strip_potential(x)
    for compliance, length in zip(modes.compliances, modes.lengths, strict=True):
        total += compliance * line_memory_influence(x, length)[0]
    return total[:, None]


def surface_power(x: ArrayLike, pressure: ArrayLike, displacement: ArrayLike, speed: float) -> Array:
    """Power per area that the indenter puts into the solid, p ∂u/∂t = −v p ∂u/∂x.

    At a fixed point of the surface u changes because the contact moves past it: ∂u/∂t = −v ∂u/∂x.  The map is positive
    where the surface is pushed in (the front of the contact) and negative where it springs back and returns
    part of the work; in a steady contact the integral is what the material turns into heat, F_t v.

    Parameters
    ----------
    x : (nx,) array
        Cell centres along the motion, in equal steps, m.
    pressure : (nx, ny) array
        p ≥ 0, Pa.
    displacement : (nx, ny) array
        u, positive into the solid, m; only differences matter.
    speed : float
        v, m/s, positive towards +x.

    Returns
    -------
    (nx, ny) array
        W/m².

    Raises
    ------
    InputError
        If the arrays do not fit each other.

    Notes
    -----
    Slopes are differences over neighbouring cells of the contact; a cell at its edge has a one-sided one, since the
    slope outside is infinite there.  For a paraboloid they are exact elsewhere.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    >>> contact = vf.solve_steady(rubber, vf.Ball("10 mm"), speed="1 m/s", load="1 N", accuracy=1e-2)
    >>> power = vf.contact.surface_power(contact.x, contact.pressure, contact.displacement, speed=1.0)  # W/m²
    >>> cell = (contact.x[1] - contact.x[0]) * (contact.y[1] - contact.y[0])
    >>> bool(abs(power.sum() * cell / (contact.friction_coefficient * 1.0) - 1.0) < 0.02)  # μ F v, 1 N at 1 m/s
    True
    """
    step = spacing(x, "x")
    shape = (in_si(x, "m", "x").size, *in_si(pressure, "Pa", "pressure").shape[1:])
    load, depth = on_cells(pressure, shape, "pressure"), on_cells(displacement, shape, "displacement", "m")
    return np.asarray(-to_si(speed, "m/s", "speed") * load * _slope_in_contact(depth, load > 0.0) / step)


def _slope_in_contact(depth: Array, loaded: Mask) -> Array:
    """Change from cell to cell along x, over loaded neighbours where there are any."""
    change = np.zeros((depth.shape[0] + 1, *depth.shape[1:]))
    change[1:-1] = np.diff(depth, axis=0)
    joined = np.zeros(change.shape, dtype=bool)
    joined[1:-1] = loaded[1:] & loaded[:-1]
    before, after = joined[:-1], joined[1:]
    neighbours = before.astype(float) + after
    inside = (change[:-1] * before + change[1:] * after) / np.maximum(neighbours, 1.0)
    return np.where(neighbours > 0.0, inside, 0.5 * (change[:-1] + change[1:]))
