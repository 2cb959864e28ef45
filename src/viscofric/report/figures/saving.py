"""Figures into files, the same bytes every time, and figures for pages that may be dark."""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.colors import to_hex, to_rgb
from matplotlib.figure import Figure

from viscofric.files import write_atomically
from viscofric.report.figures.style import INK, STYLE, mark_synthetic

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


_PAPER, _LIGHT_INK = "#15191d", "#dfe4e9"
# colour on white -> on dark paper
_ON_DARK = {"#ffffff": _PAPER, INK: _LIGHT_INK, "#000000": _LIGHT_INK, "#dddddd": "#363e46"}
_STROKE = re.compile(rb"stroke: (#[0-9a-f]{6})")
#: Least contrast of a line with dark paper (WCAG 2.1, success criterion 1.4.11, for graphics).
_CONTRAST = 3.0
_STEPS = 20


def adaptive(svg: bytes) -> bytes:
    """Return a figure that turns dark under ``prefers-color-scheme: dark``, by one style sheet more.

    Paper and ink change places, lines too dark for dark paper are lightened; areas keep their colours, as scales need.
    """
    rules = [f"svg{{fill:{_LIGHT_INK}}}"]
    for light, dark in _ON_DARK.items():
        rules += [f'[style*="{name}: {light}"]{{{name}:{dark} !important}}' for name in ("fill", "stroke")]
    for colour in sorted({found.decode() for found in _STROKE.findall(svg)} - set(_ON_DARK)):
        lighter = _lightened(colour)
        if lighter != colour:
            rules.append(f'[style*="stroke: {colour}"]{{stroke:{lighter} !important}}')
            rules.append(f'[style*="fill: {colour}; stroke: {colour}"]{{fill:{lighter} !important}}')
    sheet = f"<style>@media (prefers-color-scheme: dark) {{{''.join(rules)}}}</style>"
    head, mark, rest = svg.partition(b"<defs>")
    return head + sheet.encode() + mark + rest if mark else svg


def _lightened(colour: str) -> str:
    """Return a colour mixed with as much white as its contrast with dark paper needs."""
    for step in range(_STEPS + 1):
        red, green, blue = (part + (1.0 - part) * step / _STEPS for part in to_rgb(colour))
        mixed = (red, green, blue)
        if (_luminance(mixed) + 0.05) / (_luminance(to_rgb(_PAPER)) + 0.05) >= _CONTRAST:
            return to_hex(mixed) if step else colour
    return _LIGHT_INK


def _luminance(colour: tuple[float, ...]) -> float:
    """Relative luminance of sRGB (WCAG 2.1)."""
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in colour]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
