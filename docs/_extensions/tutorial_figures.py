"""The figures of the tutorials: drawn by the Python that a page shows, in the order in which a reader types it."""

from __future__ import annotations

import contextlib
import hashlib
import io
import os
import re
import tempfile
from collections.abc import Iterator
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
from click.testing import CliRunner
from page_parts import DOCS, digest, is_made_of, made_of, write

from viscofric.cli import main

PAGES = tuple(sorted((DOCS / "tutorial").glob("*.md")))
_DEPENDS_ON = ("contact", "example", "friction", "heat", "readers", "report", "rheology", "roughness")
_BLOCK = re.compile(r"^```(python|console)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_FILES = "$ viscofric new "  # what puts files there that the Python reads
_NEEDS_A_STUDY = "open_results("  # runs after commands that draw nothing for the page


def draw(page: str) -> dict[str, bytes]:
    """Run the Python of a page in an empty folder.

    Parameters
    ----------
    page : str
        Markdown.

    Returns
    -------
    dict of str to bytes
        Name of each picture that it saved -> its SVG, the same from run to run.
    """
    names: dict[str, object] = {"__name__": "__main__"}
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder), _repeatable():
        for block in _BLOCK.finditer(page):
            language, text = block.groups()
            if language == "console":
                for line in text.splitlines():
                    if line.startswith(_FILES):
                        CliRunner().invoke(main, line.split()[2:], catch_exceptions=False)
            elif _NEEDS_A_STUDY not in text:
                above = page.count("\n", 0, block.start()) + 1  # lines, so that a traceback names the page's
                with contextlib.redirect_stdout(io.StringIO()):
                    exec(compile("\n" * above + text, "tutorial", "exec"), names)
        return {path.name: path.read_bytes() for path in sorted(Path().glob("*.svg"))}


@contextlib.contextmanager
def _repeatable() -> Iterator[None]:
    """Draw without a screen, without the time of day, and leave matplotlib as it was."""
    dated = os.environ.get("SOURCE_DATE_EPOCH")
    os.environ["SOURCE_DATE_EPOCH"] = "0"
    try:
        with matplotlib.rc_context({"svg.hashsalt": "viscofric tutorial"}):
            plt.switch_backend("agg")
            yield
    finally:
        plt.close("all")
        if dated is None:
            del os.environ["SOURCE_DATE_EPOCH"]
        else:
            os.environ["SOURCE_DATE_EPOCH"] = dated


def generate() -> None:
    """Draw them unless they were drawn by the present pages and code."""
    pages = [page.read_text(encoding="utf-8") for page in PAGES]
    state = digest(*_DEPENDS_ON) + hashlib.sha256("".join(pages).encode()).hexdigest()
    if is_made_of("tutorial", state):
        return
    for page in pages:
        for name, image in draw(page).items():
            write(f"tutorial/{name}", image)
    made_of("tutorial", state)
