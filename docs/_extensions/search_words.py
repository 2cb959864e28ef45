"""The search of the site finds the field's words: a build whose index lacks one on the page about it fails."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sphinx.errors import ExtensionError
from sphinx.search.en import SearchEnglish

if TYPE_CHECKING:
    from sphinx.application import Sphinx

#: What users type -> a page that must be among the results.
WANTED = {
    "rolling resistance": "theory/friction",
    "hysteresis friction": "theory/friction",
    "rubber friction": "guide/friction",
    "Prony series": "how_to/fem_cards",
    "WLF": "guide/material",
    "Payne effect": "how_to/amplitude_sweep",
    "tan delta": "glossary",
    "viscoelastic friction": "guide/friction",
    "time-temperature superposition": "guide/material",
    "shift factor": "guide/material",
    "relaxation test": "how_to/creep",
    "tyre": "tutorial/tread",
    "tire": "faq",
    "seal": "auto_examples/plot_19_seal",
    "Abaqus": "how_to/fem_cards",
}


def results(index: dict[str, Any], words: str) -> set[str]:
    """Return the pages that the index lists for every one of the words, in their text or title."""
    stem = SearchEnglish({"language": "en"}).stem
    found = [_pages(index, stem(word.lower())) for word in words.replace("-", " ").split()]
    return {index["docnames"][number] for number in set.intersection(*found)}


def _pages(index: dict[str, Any], term: str) -> set[int]:
    listed = [index[table].get(term, []) for table in ("terms", "titleterms")]
    return {number for one in listed for number in (one if isinstance(one, list) else [one])}


def require(app: Sphinx, exception: Exception | None) -> None:
    """Fail if a search of the finished site misses its page."""
    if exception or app.builder.name != "html":
        return
    text = (Path(app.outdir) / "searchindex.js").read_text(encoding="utf-8")
    index = json.loads(text.removeprefix("Search.setIndex(").removesuffix(")"))
    missed = [f"{words!r} ({page})" for words, page in WANTED.items() if page not in results(index, words)]
    if missed:
        raise ExtensionError("the search of the site does not find: " + ", ".join(missed))


def setup(app: Sphinx) -> dict[str, bool]:
    """Search when the index is written."""
    app.connect("build-finished", require, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
