"""Draw the figure of README.md, docs/figures/friction.svg: friction predicted from sweeps beside friction of runs.

Both are the built-in example's, which is SYNTHETIC.  Some 60 contacts: ten seconds.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import viscofric as vf
from viscofric import report
from viscofric.report.figures.saving import save_picture
from viscofric.report.figures.style import new_figure

ROOT = Path(__file__).resolve().parent.parent
EXAMPLE = ROOT / "src" / "viscofric" / "example"


def draw() -> Figure:
    """Go from the example's files to friction at the tested temperatures, and to one curve for all of them."""
    fit = vf.superpose(vf.read_dma(EXAMPLE / "dma.csv"), reference="30 degC")
    rubber = vf.Material(vf.fit_retardation_spectrum(fit.master_curve), shift=fit.shift_factors, poisson_ratio=0.5)
    ball, load = vf.Ball(radius="9.525 mm"), "10 N"
    measured = vf.separate(vf.read_mtm(EXAMPLE / "mtm.csv"))
    predicted = vf.predict_friction(
        rubber, ball, speeds=np.geomspace(1e-3, 3.0, 27), temperatures=measured.temperatures, load=load
    )
    line = vf.predict_friction(
        rubber, ball, speeds=np.geomspace(1e-7, 1e3, 61), temperatures=fit.shift_factors.reference, load=load
    )
    master = vf.shift_friction(measured, shift=fit.shift_factors, reference="30 degC")

    figure = new_figure(9.6, 3.6)
    left, right = figure.subplots(1, 2, sharey=True)
    report.plot_friction_curves(left, predicted, measured)
    left.get_legend().remove()
    report.plot_friction_master_curve(right, line, master)
    left.set_title("lines: predicted from DMA sweeps alone", fontsize=10, loc="left")
    right.set_title("one curve for all temperatures", fontsize=10, loc="left")
    right.set_ylabel("")
    return figure


if __name__ == "__main__":
    save_picture(ROOT / "docs" / "figures" / "friction.svg", draw, name="friction", synthetic=True)
