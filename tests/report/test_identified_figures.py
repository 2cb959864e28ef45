"""Figures of a modulus identified from indentation: the fits and residuals drawn are those of the result."""

from dataclasses import replace

import matplotlib
import numpy as np
from matplotlib.figure import Figure

import viscofric as vf
from viscofric.report.figures.identified import indentation_figure, plot_fitted_records, plot_identified_modulus
from viscofric.report.figures.style import STYLE, new_figure


def found() -> vf.friction.MaterialFromIndentation:
    omega = np.geomspace(1.0, 100.0, 5)
    record = vf.friction.OscillationRecord(
        omega, 1e4 * omega**0.1, 1.6e3 * omega**0.1, 300.0, indentation=1e-4, amplitude=1e-6, error=0.01
    )
    return vf.identify_from_indentation(record, vf.Ball("10 mm"), modes=8, samples=20)


def test_the_figure_has_modulus_records_and_residuals() -> None:
    result = found()
    fit, below = Figure().subplots(1, 2)
    plot_fitted_records(fit, below, result.records[:1])
    (residuals,) = below.get_lines()
    assert residuals.get_ydata().tolist() == result.records[0].residuals.tolist()
    assert fit.get_ylabel() == "storage stiffness (N/m)"
    assert fit.get_xlabel() == "angular frequency (rad/s)"
    # The modulus, and fit and residuals of storage and loss stiffness.
    assert len(indentation_figure(result).axes) == 5


def test_the_legend_of_an_identified_modulus_is_within_its_figure() -> None:
    known = replace(vf.synthetic_fluoroelastomer(), name="fluoroelastomer of the sweeps, 75 Shore A")
    with matplotlib.rc_context(dict(STYLE)):
        figure = new_figure()
        axes = figure.subplots()
        plot_identified_modulus(axes, found(), known)
        figure.draw_without_rendering()
    legend = axes.get_legend()
    assert legend is not None
    assert legend.get_window_extent().x1 <= figure.bbox.x1
