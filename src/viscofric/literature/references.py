"""The one table of references, printed for readers and as BibTeX entries."""

from __future__ import annotations

import csv
from collections.abc import Callable
from dataclasses import dataclass
from importlib.resources import files
from typing import Any

#: Characters that are commands of LaTeX.
_ESCAPED = str.maketrans({"&": r"\&", "%": r"\%", "#": r"\#", "_": r"\_", "$": r"\$"})


@dataclass(frozen=True)
class Reference:
    """A paper, a book or another source."""

    key: str  # of the BibTeX entry
    authors: tuple[str, ...] = ()  # initials before the family name; empty if unknown
    year: int | None = None
    title: str = ""  # empty if unknown
    journal: str = ""  # of a paper
    volume: str = ""
    pages: str = ""  # or the first page, or the number of the paper
    publisher: str = ""  # of a book
    doi: str = ""  # empty if there is none, or none that is certain
    note: str = ""  # further text, or all that is known of the source

    def __str__(self) -> str:
        title = f"“{self.title}”" if self.title and not self.publisher else self.title
        journal = " ".join(part for part in (self.journal, self.volume) if part)
        place = journal or self.publisher
        year = f"({self.year})" if self.year else ""
        pages = self.pages.replace("--", "–")
        where = " ".join(part for part in (place, year, pages) if part)
        doi = f"doi:{self.doi}" if self.doi else ""
        return ", ".join(part for part in (", ".join(self.authors), title, where, doi, self.note) if part)

    def bibtex(self) -> str:
        """Return the BibTeX entry, in UTF-8."""
        kind = "article" if self.journal else "book" if self.publisher else "misc"
        fields = {
            "author": " and ".join(author if "." in author else f"{{{author}}}" for author in self.authors),
            "title": f"{{{self.title}}}" if self.title else "",
            "journal": self.journal,
            "volume": self.volume,
            "pages": self.pages,
            "publisher": self.publisher,
            "year": str(self.year or ""),
            "note": self.note,
        }
        lines = [f"  {name} = {{{text.translate(_ESCAPED)}}}," for name, text in fields.items() if text]
        if self.doi:
            lines.append(f"  doi = {{{self.doi}}},")
        return "\n".join([f"@{kind}{{{self.key},", *lines, "}"])


def _table() -> list[Reference]:
    """Return the references of `references.csv`, which says what is left out there."""
    text = files(__package__).joinpath("references.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    kinds: dict[str, Callable[[str], Any]] = {"authors": lambda text: tuple(text.split("; ")), "year": int}
    return [Reference(**{name: kinds.get(name, str)(text) for name, text in row.items() if text}) for row in rows]


#: Key -> reference.
REFERENCES = {reference.key: reference for reference in _table()}
PAPER = next(iter(REFERENCES.values()))
