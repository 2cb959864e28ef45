"""The table of references as Markdown, each with a target that other pages refer to by its BibTeX key."""

from __future__ import annotations

from viscofric.literature.references import PAPER, REFERENCES, Reference


def page() -> str:
    """Return a paragraph for each reference: the implemented paper, and the others by their authors."""
    others = sorted((one for one in REFERENCES.values() if one is not PAPER), key=_order)
    return "\n\n".join(f"({one.key})=\n{_entry(one)}" for one in (PAPER, *others)) + "\n"


def _order(reference: Reference) -> tuple[str, int]:
    return reference.key.rstrip("0123456789"), reference.year or 0


def _entry(reference: Reference) -> str:
    text = str(reference).removesuffix(".").replace("*", r"\*")
    if reference.doi:
        text = text.replace(f"doi:{reference.doi}", f"[doi:{reference.doi}](<https://doi.org/{reference.doi}>)")
    return f"{text}."
