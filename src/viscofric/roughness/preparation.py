"""Steps that prepare a measured surface: trends taken off, edges tapered, waves or pieces cut out, grids changed."""

from __future__ import annotations

import math

import numpy as np
import scipy.fft

from viscofric.arrays import Array, Mask
from viscofric.contact.free.geometry import LINE
from viscofric.contact.indenters.height_map import HeightMap, Profile
from viscofric.contact.indenters.indenter import Indenter, insist_on_indenter
from viscofric.contact.periodic.surface import wave_number, without_nyquist
from viscofric.errors import InputError, brief, check_choice, wrong_argument
from viscofric.notes import Note
from viscofric.showing import prefixed
from viscofric.units import Quantity, positive, to_si

#: A wave just at a cut-off stays whatever the rounding.
_ROUNDING = 1e-9


def gradient(heights: Array, spacing: tuple[float, float], periodic: bool) -> tuple[Array, ...]:
    """Return the slopes along the axes that have points: from the Fourier series if periodic, else of neighbours."""
    axes = [axis for axis, points in enumerate(heights.shape) if points > 1]
    if not periodic:
        return tuple(np.diff(heights, axis=axis) / spacing[axis] for axis in axes)
    found = []
    for axis in axes:
        points = heights.shape[axis]
        q: Array = 2.0 * np.pi * np.fft.rfftfreq(points, spacing[axis]).astype(np.float64)
        factor = 1j * without_nyquist(q, points)
        series = scipy.fft.rfft(heights, axis=axis) * (factor[:, None] if axis == 0 else factor)
        found.append(scipy.fft.irfft(series, points, axis=axis))
    return tuple(found)


def passed(
    heights: Array, spacing: tuple[float, float], shortest: Quantity | None, longest: Quantity | None
) -> tuple[Array, Note]:
    """Return the waves between two lengths, with the mean height, and what was done."""
    if shortest is None and longest is None:
        raise InputError(
            "shortest, longest: neither given; give the shortest wavelength to keep, the longest, or both.",
            code="give-one",
        )
    q = np.hypot(*wave_number((heights.shape[0], heights.shape[1]), spacing))
    keep = q > 0.0
    bounds, values = [], {}
    if longest is not None:
        length = positive(longest, "m", "longest")
        keep &= q >= 2.0 * np.pi / length * (1.0 - _ROUNDING)
        bounds.append(f"longer than {prefixed(length, None, 'm')}")
        values["longest"] = length
    if shortest is not None:
        length = positive(shortest, "m", "shortest")
        keep &= q <= 2.0 * np.pi / length * (1.0 + _ROUNDING)
        bounds.append(f"shorter than {prefixed(length, None, 'm')}")
        values["shortest"] = length
    if not keep.any():
        raise InputError(
            f"shortest = {shortest!r}, longest = {longest!r}: the surface has no wave in between.", code="no-wave"
        )
    keep[0, 0] = True
    series = np.where(keep, scipy.fft.rfft2(heights), 0.0)
    note = Note("waves-left-out", f"waves left out: {' and '.join(bounds)}", values=values)
    return scipy.fft.irfft2(series, heights.shape), note


def resampled_series(
    heights: Array, spacing: tuple[float, float], wanted: tuple[float, float]
) -> tuple[Array, tuple[float, float]]:
    """Return a periodic surface on the grid nearest to another spacing, by its Fourier series."""
    found = [*spacing]
    for axis, step in enumerate(wanted):
        points = heights.shape[axis]
        if points == 1:
            found[axis] = step
            continue
        period = points * spacing[axis]
        count = round(period / step)
        if count < 2:
            raise InputError(
                f"spacing = {step:g} m: fewer than two points would be left of {period:.4g} m.", code="too-few-points"
            )
        heights = _resampled_along(heights, axis, count)
        found[axis] = period / count
    return heights, (found[0], found[1])


def _resampled_along(heights: Array, axis: int, count: int) -> Array:
    points = heights.shape[axis]
    if count == points:
        return heights
    series = np.moveaxis(scipy.fft.rfft(heights, axis=axis), axis, 0)
    found = np.zeros((count // 2 + 1, *series.shape[1:]), complex)
    # A Nyquist wave has no direction: that of the coarser grid is left out, and halved where a finer grid parts it.
    kept = (min(points, count) + 1) // 2
    found[:kept] = series[:kept]
    if points % 2 == 0 and count > points:
        found[points // 2] = 0.5 * series[points // 2]
    return np.asarray(scipy.fft.irfft(np.moveaxis(found, 0, axis) * (count / points), count, axis=axis))


_TOLD = {
    "mean": "mean height removed",
    "tilt": "tilt removed: least-squares plane",
    "curvature": "curvature removed: least-squares paraboloid",
}
_DEGREES = {"mean": 0, "tilt": 1, "curvature": 2}


def without_trend(heights: Array, what: str) -> tuple[Array, Note]:
    """Return heights less a least-squares polynomial of degree 0, 1 or 2 in x and y, and what was done."""
    check_choice(what, "what", *_DEGREES)
    known = ~np.isnan(heights)
    # Legendre polynomials on [−1, 1] keep the equations well conditioned.
    s = [np.linspace(-1.0, 1.0, n) if n > 1 else np.zeros(1) for n in heights.shape]
    along = np.polynomial.legendre.legvander(s[0], 2)
    across = np.polynomial.legendre.legvander(s[1], 2)
    pairs = [
        (i, j) for i in range(_DEGREES[what] + 1) for j in range(_DEGREES[what] + 1 - i if heights.shape[1] > 1 else 1)
    ]
    if np.count_nonzero(known) < len(pairs):
        raise InputError(f"the {what} has {len(pairs)} terms, more than there are heights.", code="too-few-points")
    # Normal equations, term by term, so that a large scan is not copied once per term.
    z = np.where(known, heights, 0.0)
    weight = known.astype(float)
    right = np.array([along[:, i] @ z @ across[:, j] for i, j in pairs])
    matrix = np.array(
        [[(along[:, i] * along[:, k]) @ weight @ (across[:, j] * across[:, m]) for k, m in pairs] for i, j in pairs]
    )
    terms = np.linalg.lstsq(matrix, right, rcond=None)[0]
    trend = sum(term * np.multiply.outer(along[:, i], across[:, j]) for term, (i, j) in zip(terms, pairs, strict=True))
    return np.asarray(heights - trend), Note(f"{what}-removed", _TOLD[what])


def tapered(heights: Array, edge: float) -> Array:
    """Return heights that fall to their mean towards all edges, over a share of each length."""
    share = to_si(edge, "dimensionless", "edge")
    if not 0.0 < share <= 0.5:
        raise InputError(f"edge = {share:g}: must lie above 0 and be 0.5 at most.", code="out-of-range")
    window = np.ones(heights.shape)
    for axis, points in enumerate(heights.shape):
        if points > 1:
            # Distance from the nearer end; the point after the last is the first, where the window is zero.
            place = np.arange(points)
            distance = np.minimum(place, points - place) / points
            fall = 0.5 - 0.5 * np.cos(np.pi * np.minimum(distance / share, 1.0))
            window *= fall[:, None] if axis == 0 else fall
    mean = float((window * heights).sum() / window.sum())
    return np.asarray(mean + window * (heights - mean))


def cropped(
    heights: Array,
    spacing: tuple[float, float],
    x: tuple[Quantity, Quantity] | None,
    y: tuple[Quantity, Quantity] | None,
) -> tuple[Array, Note]:
    """Return the heights between two positions along each axis, and what was done."""
    cut, steps, values = [], [], {}
    for axis, given in (("x", x), ("y", y)):
        points, step = heights.shape["xy".index(axis)], spacing["xy".index(axis)]
        if given is None:
            cut.append(slice(0, points))
            continue
        try:
            first, last = (to_si(one, "m", f"{axis} of the piece") for one in given)
        except (TypeError, ValueError) as error:
            if isinstance(error, InputError):
                raise
            raise InputError(
                f"{axis} = {brief(given)}: must be two positions, from and to.", code="wrong-count"
            ) from None
        # A position counts as on a point within a millionth of the spacing.
        start, stop = max(math.ceil(first / step - 1e-6), 0), min(math.floor(last / step + 1e-6) + 1, points)
        if stop - start < (2 if axis == "x" else 1):
            raise InputError(
                f"{axis} = {brief(given)}: too few points lie there; it ends at {(points - 1) * step:.4g} m.",
                code="too-few-points",
            )
        cut.append(slice(start, stop))
        steps.append(f"{axis} from {' to '.join(prefixed(end * step, None, 'm') for end in (start, stop - 1))}")
        values[axis] = [start * step, (stop - 1) * step]
    return heights[cut[0], cut[1]].copy(), Note("cropped", f"cropped: {', '.join(steps) or 'nothing'}", values=values)


def resampled(
    heights: Array, spacing: tuple[float, float], wanted: tuple[float, float]
) -> tuple[Array, tuple[float, float]]:
    """Return heights at another spacing by cubic splines, averaged over new cells first where these are larger."""
    from scipy.interpolate import make_interp_spline
    from scipy.ndimage import uniform_filter1d

    found = [*spacing]
    for axis, (given, step) in enumerate(zip(spacing, wanted, strict=True)):
        points = heights.shape[axis]
        if points == 1:
            found[axis] = wanted[axis]
            continue
        length = (points - 1) * given
        count = math.floor(length / step * (1.0 + 1e-9)) + 1
        if count < 2:
            raise InputError(
                f"spacing = {step:g} m: fewer than two points would be left of {length:.4g} m.", code="too-few-points"
            )
        cell = round(step / given)
        if cell > 1:
            heights = uniform_filter1d(heights, cell, axis, mode="nearest")
        spline = make_interp_spline(given * np.arange(points), heights, min(3, points - 1), axis=axis)
        heights = np.asarray(spline(np.minimum(step * np.arange(count), length)))
        found[axis] = step
    return heights, (found[0], found[1])


def filled(heights: Array, spacing: tuple[float, float], periodic: bool, method: str) -> Array:
    """Return heights without NaN; see `viscofric.Topography.fill`."""
    holes = np.isnan(heights)
    if holes.all():
        raise InputError(
            "all heights of the topography are missing; there is nothing to fill them from.", code="missing-heights"
        )
    return (_harmonic if method == "harmonic" else _nearest)(heights, spacing, periodic, holes)


def _nearest(heights: Array, spacing: tuple[float, float], periodic: bool, holes: Mask) -> Array:
    from scipy.ndimage import distance_transform_edt

    count, pad = heights.shape, [(0, 0), (0, 0)]
    if periodic:
        # Half a period on either side holds the nearest point round the edge, too.
        pad = [(n // 2, n // 2) for n in count]
        holes = np.pad(holes, pad, mode="wrap")
    i, j = distance_transform_edt(holes, sampling=spacing, return_distances=False, return_indices=True)
    inner = tuple(slice(before, before + n) for (before, _), n in zip(pad, count, strict=True))
    found: Array = heights[(i[inner] - pad[0][0]) % count[0], (j[inner] - pad[1][0]) % count[1]]
    return found


def _harmonic(heights: Array, spacing: tuple[float, float], periodic: bool, holes: Mask) -> Array:
    """Solve Laplace's equation in the holes; with zero flux through the edges of the scan."""
    from scipy.sparse import coo_array, csr_array
    from scipy.sparse.linalg import spsolve

    places = np.flatnonzero(holes)
    number = np.full(heights.size, -1)
    number[places] = np.arange(len(places))
    ij = np.stack(np.unravel_index(places, heights.shape))
    diagonal, right = np.zeros(len(places)), np.zeros(len(places))
    rows, columns, values = [], [], []
    flat = heights.ravel()
    for axis in (0, 1):
        weight = (spacing[0] / spacing[axis]) ** 2
        points = heights.shape[axis]
        if points == 1:
            continue
        for step in (-1, 1):
            beside = ij.copy()
            beside[axis] += step
            inside = np.full(len(places), True) if periodic else (beside[axis] >= 0) & (beside[axis] < points)
            beside[axis] %= points
            neighbour = np.ravel_multi_index(tuple(beside), heights.shape)
            diagonal += weight * inside
            known = inside & (number[neighbour] < 0)
            right[known] += weight * flat[neighbour[known]]
            unknown = np.flatnonzero(inside & (number[neighbour] >= 0))
            rows.append(unknown)
            columns.append(number[neighbour[unknown]])
            values.append(np.full(len(unknown), -weight))
    own = np.arange(len(places))
    entries = np.concatenate([diagonal, *values])
    matrix = coo_array((entries, (np.concatenate([own, *rows]), np.concatenate([own, *columns]))))
    found = flat.copy()
    found[places] = spsolve(csr_array(matrix).tocsc(), right)
    return found.reshape(heights.shape)


def rough_indenter(heights: Array, spacing: tuple[float, float], shape: Indenter | None) -> HeightMap | Profile:
    """Return roughness, or roughness on a smooth shape, as heights that grow away from the solid."""
    # Heights are (nx, ny), m, none of them missing; a line scan has ny = 1.
    # A summit is near to the solid, so that its height above the lowest point is small.
    z = -heights
    (nx, ny), (dx, dy) = heights.shape, spacing
    is_line = ny == 1
    if shape is not None:
        insist_on_indenter(shape)
        if (shape.geometry is LINE) != is_line:
            wanted = "a Cylinder" if is_line else "a Ball"
            noun = "a line scan" if is_line else "a map of heights"
            raise wrong_argument("shape", shape, f"{noun} is roughness on a shape such as {wanted}.", "line-or-map")
        # The middle of one row is the row itself.
        x = np.asarray(dx * (np.arange(nx) - nx // 2), dtype=np.float64)
        y = np.asarray(dy * (np.arange(ny) - ny // 2), dtype=np.float64)
        smooth = np.asarray(shape.height(x[:, None], y[None, :]))
        smooth = np.broadcast_to(smooth, z.shape)
        if not np.all(np.isfinite(smooth)):
            raise InputError(
                "the topography reaches beyond the shape that it is roughness on; crop it.", code="beyond-indenter"
            )
        z = z + smooth
    return Profile(z[:, 0], dx) if is_line else HeightMap(z, (dx, dy))
