"""Figures of a contact: the indenter is drawn where it presses, whichever way it moves."""

from __future__ import annotations

import math

import numpy as np
import pytest

import viscofric as vf
from viscofric.report.figures.contact import contact_figure


@pytest.mark.parametrize("degrees", [0.0, 30.0, 90.0, 200.0])
@pytest.mark.slow
def test_the_surface_lies_on_the_indenter_where_there_is_pressure(degrees: float) -> None:
    rubber = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms")
    indenter = vf.Ellipsoid("5 mm", "20 mm")
    toward = (math.cos(math.radians(degrees)), math.sin(math.radians(degrees)))
    solution = vf.solve_steady(rubber, indenter, speed="1 m/s", load="1 N", direction=toward, accuracy=0.1)
    surface = next(axes for axes in contact_figure(solution, indenter).axes if axes.get_ylabel().startswith("height"))
    places, heights = surface.lines[0].get_data()
    outline = surface.collections[0].get_paths()[0].vertices
    middle = solution.pressure.shape[1] // 2
    pressed = np.all(solution.pressure[:, middle - 1 : middle + 1] > 0.0, axis=1)
    assert pressed.sum() > 10
    beneath = [outline[np.isclose(outline[:, 0], place), 1].min() for place in np.asarray(places)[pressed]]
    # The solver closes the gap to 1e-8 of the indentation, the largest of the heights; where memories are short it is
    # closed up to half a cell behind the cell centres, which is nothing here.
    assert solution.diagnostics.collocation_shift == 0.0
    np.testing.assert_allclose(np.asarray(heights)[pressed], beneath, atol=1e-7 * np.abs(heights).max())
