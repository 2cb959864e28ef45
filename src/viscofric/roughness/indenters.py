"""Indenters of a free contact made of roughness, alone or on a smooth shape."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.contact.free.geometry import LINE
from viscofric.contact.indenters.height_map import HeightMap, Profile
from viscofric.contact.indenters.indenter import Indenter, insist_on_indenter
from viscofric.errors import InputError

if TYPE_CHECKING:
    from viscofric.arrays import Array


def rough_indenter(heights: Array, spacing: tuple[float, float], shape: Indenter | None) -> HeightMap | Profile:
    """Return roughness, or roughness on a smooth shape, as heights that grow away from the solid.

    Heights are (nx, ny), m, none of them missing; a line scan has ny = 1.
    """
    # A summit is near to the solid, so that its height above the lowest point is small.
    z = -heights
    (nx, ny), (dx, dy) = heights.shape, spacing
    is_line = ny == 1
    if shape is not None:
        insist_on_indenter(shape)
        if (shape.geometry is LINE) != is_line:
            wanted = "a Cylinder" if is_line else "a Ball"
            noun = "a line scan" if is_line else "a map of heights"
            raise InputError(f"shape = {shape!r}: {noun} is roughness on a shape such as {wanted}.")
        # The middle of one row is the row itself.
        x = np.asarray(dx * (np.arange(nx) - nx // 2), dtype=np.float64)
        y = np.asarray(dy * (np.arange(ny) - ny // 2), dtype=np.float64)
        smooth = np.asarray(shape.height(x[:, None], y[None, :]))
        smooth = np.broadcast_to(smooth, z.shape)
        if not np.all(np.isfinite(smooth)):
            raise InputError("the topography reaches beyond the shape that it is roughness on; crop it.")
        z = z + smooth
    return Profile(z[:, 0], dx) if is_line else HeightMap(z, (dx, dy))
