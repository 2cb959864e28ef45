"""One reference: printed for readers, and as a BibTeX entry."""

from __future__ import annotations

from dataclasses import dataclass

#: Characters that are commands of LaTeX.
_ESCAPED = str.maketrans({"&": r"\&", "%": r"\%", "#": r"\#", "_": r"\_", "$": r"\$"})


@dataclass(frozen=True)
class Reference:
    """A paper, a book or another source.

    Attributes
    ----------
    key : str
        Of the BibTeX entry.
    authors : tuple of str
        Initials before the family name; empty if unknown.
    year : int or None
    title : str
        Empty if unknown.
    journal, volume, pages : str
        Of a paper; `pages` may be its first page, or its number.
    publisher : str
        Of a book.
    doi : str
        Empty if there is none, or none that is certain.
    note : str
        Further text, or all that is known of the source.
    """

    key: str
    authors: tuple[str, ...] = ()
    year: int | None = None
    title: str = ""
    journal: str = ""
    volume: str = ""
    pages: str = ""
    publisher: str = ""
    doi: str = ""
    note: str = ""

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
