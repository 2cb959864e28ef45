"""Stresses below a pressure on the surface of a half-space: on layers and planes by FFT, and at points.

For a frictionless pressure on a half-space of constant Poisson's ratio the stresses follow from the pressure alone:
they do not depend on the modulus, hence (by the correspondence principle) not on a viscoelastic solid's history either.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy.fft
from numpy.typing import ArrayLike

from viscofric.arrays import Array
from viscofric.contact.fields.stress import Stress, on_cells, pressure_on, rectangle_corners, spacing, strip_ends
from viscofric.errors import InputError
from viscofric.units import checked_poisson_ratio, in_si, positive, to_si, to_si_array

# Sign of xx, yy, zz, yz, xz, xy on the other side of the loaded cell, along x and along y.
_PARITY_X = np.array([1.0, 1.0, 1.0, 1.0, -1.0, -1.0])
_PARITY_Y = np.array([1.0, 1.0, 1.0, -1.0, 1.0, -1.0])
_CELLS_AT_ONCE = 200_000


def stress_layer(x: ArrayLike, y: ArrayLike, pressure: ArrayLike, depth: float, poisson_ratio: float) -> Stress:
    """Stress at one depth below every cell.

    Parameters
    ----------
    x, y : (nx,) and (ny,) array
        Centres of rectangular cells, each in equal steps, m.
    pressure : (nx, ny) array
        Pa.
    depth : float
        z above zero, m.
    poisson_ratio : float

    Returns
    -------
    Stress
        Of (nx, ny) arrays.

    Raises
    ------
    InputError
        If the arrays do not fit each other, or the depth is not above zero.

    Notes
    -----
    Exact for pressures that are uniform on each cell; cost: 13 FFTs of the window padded to twice its size.  At depths
    less than a cell the steps from cell to cell are felt.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    >>> contact = vf.solve_steady(rubber, vf.Ball("10 mm"), speed="1 m/s", load="1 N", accuracy=1e-2)
    >>> stress = vf.contact.stress_layer(contact.x, contact.y, contact.pressure, 1e-4, poisson_ratio=0.5)
    >>> stress.von_mises.shape == contact.pressure.shape
    True
    """
    ratio = checked_poisson_ratio(poisson_ratio, above=-1.0)
    load = pressure_on(x, y, pressure)
    nx, ny = load.shape
    edges_x, edges_y = _ends(nx, x, "x"), _ends(ny, y, "y")
    corners = rectangle_corners(edges_x[:, None], edges_y, _depth(depth), ratio)
    quarter = np.diff(np.diff(corners, axis=1), axis=2)
    padded = scipy.fft.next_fast_len(2 * nx - 1, real=False), scipy.fft.next_fast_len(2 * ny - 1, real=True)
    pressure_spectrum = scipy.fft.rfft2(load, padded)
    components = []
    for part, sign_x, sign_y in zip(quarter, _PARITY_X, _PARITY_Y, strict=True):
        circulant = np.zeros(padded)
        circulant[:nx, :ny] = part
        circulant[padded[0] - nx + 1 :, :ny] = sign_x * part[:0:-1]
        circulant[:, padded[1] - ny + 1 :] = sign_y * circulant[:, ny - 1 : 0 : -1]
        summed = scipy.fft.irfft2(pressure_spectrum * scipy.fft.rfft2(circulant), padded)
        components.append(np.asarray(summed[:nx, :ny]))
    return Stress(*components)


def stress_plane(
    x: ArrayLike, y: ArrayLike, pressure: ArrayLike, depths: ArrayLike, poisson_ratio: float, across: float = 0.0
) -> Stress:
    """Stress on a plane along the motion, below every cell centre of x.

    Parameters
    ----------
    x, y : (nx,) and (ny,) array
        Centres of rectangular cells, each in equal steps, m.
    pressure : (nx, ny) array
        Pa.
    depths : (nz,) array
        z above zero, m.
    poisson_ratio : float
    across : float
        Where the plane cuts the y axis, m; need not be a cell centre.

    Returns
    -------
    Stress
        Of (nx, nz) arrays.

    Raises
    ------
    InputError
        If the arrays do not fit each other, or a depth is not above zero.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    >>> contact = vf.solve_steady(rubber, vf.Ball("10 mm"), speed="1 m/s", load="1 N", accuracy=1e-2)
    >>> stress = vf.contact.stress_plane(contact.x, contact.y, contact.pressure, [1e-4, 5e-4], poisson_ratio=0.5)
    >>> stress.von_mises.shape == (len(contact.x), 2)
    True
    """
    ratio = checked_poisson_ratio(poisson_ratio, above=-1.0)
    load = pressure_on(x, y, pressure)
    nx = len(load)
    offsets_x = _ends(nx, x, "x")
    step_y = spacing(y, "y")
    starts = to_si(across, "m", "across") - (in_si(y, "m", "y") + 0.5 * step_y)
    offsets_y = np.stack([starts, starts + step_y], axis=-1)

    def influence(depth: float) -> Array:
        corners = rectangle_corners(offsets_x[:, None, None], offsets_y, depth, ratio)
        return np.diff(np.diff(corners, axis=1), axis=3)[..., 0]

    return _planes(load, depths, influence)


def line_stress(x: ArrayLike, pressure: ArrayLike, depths: ArrayLike, poisson_ratio: float) -> Stress:
    """Stress below a line contact, in plane strain.

    Parameters
    ----------
    x : (nx,) array
        Cell centres in equal steps, m.
    pressure : (nx,) or (nx, 1) array
        Pa.
    depths : (nz,) array
        z above zero, m.
    poisson_ratio : float

    Returns
    -------
    Stress
        Of (nx, nz) arrays.

    Raises
    ------
    InputError
        If the arrays do not fit each other, or a depth is not above zero.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> x = np.linspace(-0.995e-3, 0.995e-3, 200)  # m
    >>> stress = vf.contact.line_stress(x, 1e6 * np.sqrt(1.0 - (x / 1e-3) ** 2), [0.78e-3], 0.5)  # Hertz's pressure
    >>> f"{stress.max_shear.max() / 1e6:.2f}"  # of the peak pressure, 0.78 half-widths deep (K. L. Johnson, 1985)
    '0.30'
    """
    ratio = checked_poisson_ratio(poisson_ratio, above=-1.0)
    load = on_cells(in_si(pressure, "Pa", "pressure").reshape(-1), in_si(x, "m", "x").shape, "pressure")
    ends = _ends(len(load), x, "x")
    return _planes(load[:, None], depths, lambda z: np.diff(strip_ends(ends, z, ratio), axis=1)[..., None])


def stress_at(x: ArrayLike, y: ArrayLike, pressure: ArrayLike, points: ArrayLike, poisson_ratio: float) -> Stress:
    """Stress at any points below the surface, by summing over all loaded cells.

    Parameters
    ----------
    x, y : (nx,) and (ny,) array
        Centres of rectangular cells, each in equal steps, m.
    pressure : (nx, ny) array
        Pa.
    points : (n, 3) array
        x, y and depth (above zero) of each point, m.
    poisson_ratio : float

    Returns
    -------
    Stress
        Of (n,) arrays.

    Raises
    ------
    InputError
        If the arrays do not fit each other, or a depth is not above zero.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> x = y = np.array([0.0])  # one cell
    >>> stress = vf.contact.stress_at([0.0, 1e-3], [0.0, 1e-3], np.full((2, 2), 1e6), [[0.5e-3, 0.5e-3, 10e-3]], 0.5)
    >>> f"{-stress.zz[0]:.0f} Pa"  # 4 N, 10 mm below: nearly 3P/2πz² (Boussinesq), 19100 Pa
    '18785 Pa'
    """
    ratio = checked_poisson_ratio(poisson_ratio, above=-1.0)
    load = pressure_on(x, y, pressure)
    where = in_si(points, "m", "points")
    if where.ndim != 2 or where.shape[1] != 3:
        raise InputError(
            f"points must have three columns, x, y and depth; their shape is {where.shape}.", code="not-on-points"
        )
    half_x, half_y = 0.5 * spacing(x, "x"), 0.5 * spacing(y, "y")
    i, j = np.nonzero(load)
    cell_x, cell_y, loads = in_si(x, "m", "x")[i], in_si(y, "m", "y")[j], load[i, j]
    result = np.zeros((6, len(where)))
    for number, (px, py, pz) in enumerate(where):
        depth = _depth(pz)
        for start in range(0, len(loads), _CELLS_AT_ONCE):
            piece = slice(start, start + _CELLS_AT_ONCE)
            X = px - cell_x[piece, None] + np.array([-half_x, half_x])
            Y = py - cell_y[piece, None] + np.array([-half_y, half_y])
            corners = rectangle_corners(X[:, :, None], Y[:, None, :], depth, ratio)
            result[:, number] += np.diff(np.diff(corners, axis=2), axis=3)[:, :, 0, 0] @ loads[piece]
    return Stress(*result)


def _planes(load: Array, depths: ArrayLike, influence: Callable[[float], Array]) -> Stress:
    """Sum over the rows of a pressure (nx, ny) what each adds to a plane along x, depth by depth.

    `influence` gives, for a depth, the components (6, nx, ny) at offsets 0 … nx−1 along x from each row.
    """
    nx = len(load)
    padded = scipy.fft.next_fast_len(2 * nx - 1, real=True)
    spectrum = scipy.fft.rfft(load, padded, axis=0)
    columns = []
    below = to_si_array(depths, "m", "depths")
    if not below.size:
        raise InputError("depths must hold at least one depth.", code="empty-list")
    for depth in below.tolist():
        ahead = influence(_depth(depth))
        circulant = np.zeros((6, padded, load.shape[1]))
        circulant[:, :nx] = ahead
        circulant[:, padded - nx + 1 :] = _PARITY_X[:, None, None] * ahead[:, :0:-1]
        summed = np.einsum("cij,ij->ci", scipy.fft.rfft(circulant, axis=1), spectrum)
        columns.append(scipy.fft.irfft(summed, padded, axis=1)[:, :nx])
    return Stress(*np.stack(columns, axis=-1))


def _ends(cells: int, position: ArrayLike, name: str) -> Array:
    """Return the ends of cells relative to the first one's centre."""
    return np.asarray(spacing(position, name) * (np.arange(cells + 1) - 0.5), dtype=np.float64)


def _depth(depth: float) -> float:
    return positive(depth, "m", "depth")
