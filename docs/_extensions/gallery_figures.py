"""Figures of the gallery in words for those who cannot see them: titles, axes and curves, as scripts name them."""

from __future__ import annotations

import re
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

MOST_NAMES = 8  # of curves that are listed one by one


def plain(text: str) -> str:
    """Return a label without the marks of formulas, in one line."""
    text = re.sub(r"\\(?:mathrm|mathsf|mathit|text)\{([^}]*)\}", r"\1", text)
    text = re.sub(r"\\frac\{([^}]*)\}\{([^}]*)\}", r" of \1 over \2", text)
    text = re.sub(r"\\([A-Za-z]+)", r" \1 ", text)
    text = re.sub(r"[${}^]|\\,", "", text).replace("_", " ")
    return " ".join(text.split())


def words_of_axes(axes: Axes) -> str:
    """Describe one Axes: its title, axis labels, and the names of its curves."""
    x, y = plain(axes.get_xlabel()), plain(axes.get_ylabel())
    against = f"{y} against {x}" if x and y else y or x
    names = [plain(str(label)) for label in axes.get_legend_handles_labels()[1]]
    listed = ", ".join(names) if len(names) <= MOST_NAMES else f"{len(names)} curves, {names[0]} to {names[-1]}"
    parts = [plain(axes.get_title()), against, listed]
    return ": ".join(part for part in parts if part)


def words(figure: Figure) -> str:
    """Describe a figure, one Axes after the other."""
    described = dict.fromkeys(words_of_axes(axes) for axes in figure.axes)
    return "; ".join(part for part in described if part)


def scrape(block: tuple[Any, ...], block_vars: dict[str, Any], gallery_conf: dict[str, Any]) -> str:
    """Save the open figures as sphinx-gallery does, each with an alternative text of its own."""
    import matplotlib.pyplot as plt
    from sphinx_gallery.scrapers import matplotlib_scraper

    alternatives = iter([words(plt.figure(number)) for number in plt.get_fignums()])
    rst: str = matplotlib_scraper(block, block_vars, gallery_conf)
    return re.sub(r"(?m)^(\s*:alt:).*$", lambda found: f"{found[1]} {next(alternatives)}", rst)


def _get_sg_image_scraper() -> Any:
    """Name the scraper to sphinx-gallery."""
    return scrape
