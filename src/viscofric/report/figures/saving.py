"""Figures into files, the same bytes every time."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.figure import Figure

from viscofric.files import write_atomically
from viscofric.report.figures.style import STYLE, mark_synthetic

_DOTS_PER_INCH = 180
_UNDATED: dict[str, dict[str, Any]] = {
    "png": {"Software": "viscofric"},
    "svg": {"Creator": "viscofric", "Date": None},
    "pdf": {"Creator": "viscofric", "CreationDate": None},
}


def save_picture(path: Path, draw: Callable[[], Figure], *, name: str, synthetic: bool = False) -> None:
    """Draw a figure in the style of the reports into a file; those of one `name` have the same marks in an SVG."""
    form = path.suffix.lower().removeprefix(".")
    write_atomically(path, images(draw, (form,), name=name, synthetic=synthetic)[form])


def images(
    draw: Callable[[], Figure | None], formats: Iterable[str], *, name: str, synthetic: bool = False
) -> dict[str, bytes]:
    """Draw a figure in the style of the reports and return the content of its files by format."""
    with matplotlib.rc_context({**STYLE, "svg.hashsalt": f"viscofric {name}"}):
        figure = draw()
        if figure is None:
            return {}
        if synthetic:
            mark_synthetic([axes for axes in figure.axes if axes.get_label() != "<colorbar>"])
        found: dict[str, bytes] = {}
        for form in formats:
            found[form] = _encoded(figure, form)
            figure.set_layout_engine("none")  # the other formats keep the places of all parts, which take long to find
        return found


def _encoded(figure: Figure, form: str) -> bytes:
    target = io.BytesIO()
    figure.savefig(target, format=form, dpi=_DOTS_PER_INCH, metadata=_UNDATED[form])
    return target.getvalue()
