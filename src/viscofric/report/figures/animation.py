"""A contact over time as an animation in one file (GIF): its pressure, beside friction or depth against time."""

from __future__ import annotations

import io
from os import PathLike
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg

from viscofric.errors import InputError
from viscofric.files import write_atomically
from viscofric.motion.solution import TransientSolution
from viscofric.report.data import moves
from viscofric.report.figures.motion import plot_transient
from viscofric.report.figures.pressures import Frames, frames_of, plot_pressure_frame
from viscofric.report.figures.style import INK, STYLE, mark_synthetic, new_figure, slender_bar, unit_for
from viscofric.report.texts.numbers import prefixed

#: Most frames, and how long they last together, s.
FRAMES, _SECONDS = 60, 6.0
_DOTS_PER_INCH, _SMALL = 90, 9.5


def save_animation(
    path: str | PathLike[str], run: TransientSolution, title: str = "", *, frames: int = FRAMES, synthetic: bool = False
) -> None:
    """Draw the pressure over time, beside friction (or the indentation of normal motion), into a GIF.

    Parameters
    ----------
    path : str or path
        Ends in ``.gif``.  Replaced if it exists.
    run : TransientSolution
    title : str
    frames : int
        Most frames; each is one of the solution's times, spread evenly.
    synthetic : bool
        Whether the data are synthetic, which the animation then says.

    Raises
    ------
    InputError
        If the name does not end in ``.gif``, or no pressures were kept.
    DataFileError
        If the file cannot be written.
    """
    target = Path(path)
    if target.suffix.lower() != ".gif":
        raise InputError(f"{target}: an animation is a GIF; its name must end in .gif.", code="wrong-ending")
    with matplotlib.rc_context(dict(STYLE)):
        content = _drawn(run, frames_of(run, count=frames), title, synthetic=synthetic)
    write_atomically(target, content)


def _drawn(run: TransientSolution, shown: Frames, title: str, *, synthetic: bool) -> bytes:
    """Draw the axes once, and the pressure and the time of each frame anew."""
    from PIL import Image

    data = run.to_dataset()
    figure = new_figure(9.0, 3.8, title=title)
    left, right = figure.subplots(1, 2)
    plot_transient(right, data, "friction_coefficient" if moves(data) else "indentation")
    now = right.axvline(0.0, color=INK, linewidth=1.2)
    mesh = plot_pressure_frame(left, shown, 0)
    if mesh is not None:
        slender_bar(figure, mesh, [left], shown.label)
    if synthetic:
        mark_synthetic([right])
    left.set_title(" ", fontsize=_SMALL)
    figure.set_dpi(_DOTS_PER_INCH)
    canvas: Any = FigureCanvasAgg(figure)
    figure.draw_without_rendering()
    figure.set_layout_engine("none")  # all frames keep the places of the parts
    second = 1.0 / unit_for(float(np.abs(run.time).max()), "s").size
    pictures = []
    for place, time in enumerate(shown.times):
        for artist in [*left.lines, *left.collections]:
            artist.remove()
        plot_pressure_frame(left, shown, place)
        left.set_title(prefixed(time, None, "s"), fontsize=_SMALL)
        now.set_xdata([second * time] * 2)
        canvas.draw()
        pictures.append(Image.fromarray(np.array(canvas.buffer_rgba())).convert("RGB"))
    target = io.BytesIO()
    rate = max(1, round(len(shown.times) / _SECONDS))
    pictures[0].save(target, "GIF", save_all=True, append_images=pictures[1:], duration=1000 // rate, loop=0)
    return target.getvalue()
