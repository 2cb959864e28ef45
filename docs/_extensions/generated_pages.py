"""What pages include that comes from the code: written before Sphinx reads them, anew only where the code changed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import command_pages
import curve_file_pages
import literature_pages
import overview_figure
import results_pages
import run_file_pages
import tutorial_figures
import verification_pages
from page_parts import write
from sphinx.util import logging

if TYPE_CHECKING:
    from sphinx.application import Sphinx

log = logging.getLogger(__name__)


def generate(app: Sphinx) -> None:
    """Write all of it into _generated."""
    log.info("tables and figures from the code ...")
    write("command_line.md", command_pages.page())
    write("friction_curves.md", curve_file_pages.page())
    write("literature.md", literature_pages.page())
    write("run_file.md", run_file_pages.page())
    overview_figure.generate()
    results_pages.generate()
    tutorial_figures.generate()
    verification_pages.generate()


def setup(app: Sphinx) -> dict[str, bool]:
    """Have them written first."""
    app.connect("builder-inited", generate, priority=10)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
