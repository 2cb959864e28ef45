"""One figure into one file, the same bytes every time."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

import matplotlib

from viscofric.files import write_atomically
from viscofric.report.house_style import STYLE, mark_synthetic

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from matplotlib.figure import Figure

_DOTS_PER_INCH = 180
_UNDATED: dict[str, dict[str, Any]] = {
    "png": {"Software": "viscofric"},
    "svg": {"Creator": "viscofric", "Date": None},
    "pdf": {"Creator": "viscofric", "CreationDate": None},
}


def save_picture(path: Path, draw: Callable[[], Figure], *, name: str, synthetic: bool = False) -> None:
    """Draw a figure in the house's style into a file.

    Parameters
    ----------
    path : Path
        Ends in ``.png``, ``.svg`` or ``.pdf``.  Replaced if it exists.
    draw : callable
        Returns the figure.
    name : str
        What the figure shows: figures of one name have the same marks inside an SVG.
    synthetic : bool
        Whether what it shows was made up, which the figure then says.

    Raises
    ------
    DataFileError
        If the file cannot be written.
    """
    form = path.suffix.lower().removeprefix(".")
    target = io.BytesIO()
    with matplotlib.rc_context({**STYLE, "svg.hashsalt": f"viscofric {name}"}):
        figure = draw()
        if synthetic:
            mark_synthetic([axes for axes in figure.axes if axes.get_label() != "<colorbar>"])
        figure.savefig(target, format=form, dpi=_DOTS_PER_INCH, metadata=_UNDATED[form])
    write_atomically(path, target.getvalue())
