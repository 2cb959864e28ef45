"""What a steady contact gives back: fields, numbers, and how far they can be trusted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

if TYPE_CHECKING:
    import xarray
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]


class Level(NamedTuple):
    """What one of the nested grids gave.

    Attributes
    ----------
    cells : int
        Along the window's longer edge.
    pressure_friction, energy_friction : float
        Friction coefficient from the lean of the pressure and from the dissipated energy.
    indentation : float
        m.
    """

    cells: int
    pressure_friction: float
    energy_friction: float
    indentation: float


@dataclass(frozen=True)
class Diagnostics:
    """How a contact was solved, and what is known of its errors.

    Attributes
    ----------
    shape : (int, int)
        Cells of the finest window.
    spacing : float
        Side of a cell, m.
    collocation_shift : float
        How far behind the cell centres the gap was held at zero, in cells; above zero only where the cells do not
        resolve the shortest memory (see `viscofric.contact.operator.collocation_shift`).
    complementarity : float
        Largest gap under pressure or overlap without it, where the gap was looked at, relative to the indentation.
    load : float
        Relative error of the load.
    energy : float
        Energy balance: friction from the pressure's lean less that from the dissipated energy, over the larger of
        them (or over 1e-6 a0/R).
    friction_error : float
        Error estimate of the friction coefficient (absolute), from its changes on the nested grids.
    indentation_error : float
        Change of the indentation from the last but one grid to the last, m.
    levels : tuple of Level
        What each nested grid gave, coarsest first.
    set_changes, linear_iterations, products, ffts : int
        Work on all grids: looks at the contact set, steps of the linear solver, products with the influence
        matrix and two-dimensional real FFTs (of the padded window in products, of the bare one for the
        preconditioner).
    """

    shape: tuple[int, int]
    spacing: float
    collocation_shift: float
    complementarity: float
    load: float
    energy: float
    friction_error: float
    indentation_error: float
    levels: tuple[Level, ...]
    set_changes: int
    linear_iterations: int
    products: int
    ffts: int


@dataclass(frozen=True, eq=False)
class ContactSolution:
    """Steady contact of an indenter moving at a constant velocity over a viscoelastic half-space.

    All in SI units.  The indenter moves towards +x for a positive speed.

    Attributes
    ----------
    speed, load : float
        m/s and N, as asked.
    temperature : float or None
        K, as asked.
    friction_coefficient : float
        μ = F_t/F_N, with the sign of the speed: of the two below the one that has settled better on the nested
        grids (the second maybe extrapolated).
    pressure_friction_coefficient : float
        From the lean of the pressure, on the finest grid.
    energy_friction_coefficient : float
        From the energy that the material dissipates, on the finest grid.
    indentation : float
        δ, m.
    contact_area : float
        m², counted in cells.
    front, rear : float
        Distances from the indenter's axis to the leading and to the trailing edge of the contact on the centre
        line, m, positive ahead of and behind it respectively.
    half_width : float
        Half the largest width of the contact across the motion, m.
    max_pressure : float
        Pa.
    x, y : (nx,) and (ny,) array
        Cell centres relative to the indenter's axis, m.
    pressure, displacement : (nx, ny) array
        Pa, and m into the solid.
    diagnostics : Diagnostics
    warnings : tuple of str
        One sentence for each assumption that does not hold well.
    """

    speed: float
    load: float
    temperature: float | None
    friction_coefficient: float
    pressure_friction_coefficient: float
    energy_friction_coefficient: float
    indentation: float
    contact_area: float
    front: float
    rear: float
    half_width: float
    max_pressure: float
    x: Array
    y: Array
    pressure: Array
    displacement: Array
    diagnostics: Diagnostics
    warnings: tuple[str, ...] = ()

    def to_dataset(self) -> xarray.Dataset:
        """Return pressure and displacement as a labelled data set with units in its attributes."""
        import xarray

        def field(values: Array, name: str, unit: str) -> tuple[tuple[str, str], Array, dict[str, str]]:
            return ("x", "y"), values, {"units": unit, "long_name": name}

        return xarray.Dataset(
            {
                "pressure": field(self.pressure, "contact pressure", "Pa"),
                "displacement": field(self.displacement, "displacement into the solid", "m"),
            },
            coords={
                "x": ("x", self.x, {"units": "m", "long_name": "position along the motion"}),
                "y": ("y", self.y, {"units": "m", "long_name": "position across the motion"}),
            },
            attrs={
                "speed": self.speed,
                "load": self.load,
                "friction_coefficient": self.friction_coefficient,
                "indentation": self.indentation,
            },
        )


def edges(position: Array, pressure: Array) -> tuple[float, float]:
    """Lower and upper end of the loaded stretch of a pressure profile, to a fraction of a cell.

    Near the edge of a smooth contact the pressure rises like the square root of the distance, so its square is
    extrapolated linearly to zero from the two outermost loaded cells, and never beyond the next cell's centre.

    Parameters
    ----------
    position : (n,) array
        Equally spaced, ascending.
    pressure : (n,) array
        Positive somewhere.
    """
    loaded = np.flatnonzero(pressure > 0.0)
    first, last = int(loaded[0]), int(loaded[-1])
    return (
        _zero_of_square(position, pressure, first, first + 1),
        _zero_of_square(position, pressure, last, last - 1),
    )


def _zero_of_square(position: Array, pressure: Array, outer: int, inner: int) -> float:
    cell = position[1] - position[0]
    outward = np.sign(outer - inner) * cell
    if not 0 <= inner < len(pressure) or pressure[inner] <= pressure[outer]:
        return float(position[outer] + 0.5 * outward)
    ratio = (pressure[outer] / pressure[inner]) ** 2
    return float(position[outer] + outward * min(1.0, ratio / (1.0 - ratio)))
