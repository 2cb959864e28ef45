"""The figure of the first page: master curve, contact, friction curve."""

from __future__ import annotations

import matplotlib
import numpy as np
from page_parts import SOURCE, digest, is_made_of, made_of, write
from verification_pages import drawn

import viscofric
from viscofric.report.figures.contact import plot_pressure_map
from viscofric.report.figures.friction import plot_friction_curves
from viscofric.report.figures.rubber import plot_master_curve
from viscofric.report.figures.style import STYLE, mark_synthetic, new_figure

_DEPENDS_ON = ("contact", "example", "friction", "readers", "report", "rheology")
_ACCURACY = 1e-2
_ABOVE_THE_LEGEND = 36.0  # points


def draw() -> bytes:
    """Go from the built-in example's sweeps to friction, and draw each step."""
    fit = viscofric.superpose(viscofric.read_dma(SOURCE / "example" / "dma.csv"), reference="30 degC")
    spectrum = viscofric.fit_retardation_spectrum(fit)
    rubber = viscofric.Material(spectrum, shift=fit.shift_factors)
    ball, load = viscofric.Ball(radius="9.525 mm"), "10 N"
    contact = viscofric.solve_steady(
        rubber, ball, speed="100 mm/s", load=load, temperature="60 degC", accuracy=_ACCURACY
    )
    curves = viscofric.predict_friction(
        rubber,
        ball,
        speeds=np.geomspace(1e-3, 10.0, 17),
        temperatures=["30 degC", "60 degC", "90 degC"],
        load=load,
        accuracy=_ACCURACY,
    )
    with matplotlib.rc_context(STYLE):
        figure = new_figure(13.0, 4.6)
        panels = figure.subplots(1, 3)
        plot_master_curve(panels[0], fit, spectrum, synthetic=True)
        plot_pressure_map(panels[1], contact)
        plot_friction_curves(panels[2], curves)
        titles = ("material fitted to DMA sweeps", "contact at 60 °C and 100 mm/s", "predicted friction")
        for place, (axes, title) in enumerate(zip(panels, titles, strict=True), start=1):
            axes.set_title(f"{place}   {title}", loc="left", fontsize=11, pad=_ABOVE_THE_LEGEND)
        mark_synthetic(panels)
        return drawn(figure, "overview", letters="path")


def generate() -> None:
    """Draw it if the code has changed."""
    state = digest(*_DEPENDS_ON)
    if is_made_of("overview", state):
        return
    write("overview.svg", draw())
    made_of("overview", state)
