"""A rubber named on the command line: a material file, or a name of the catalogue."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from viscofric.cli.errors import tell_notes

if TYPE_CHECKING:
    from viscofric.rheology.material import Material


def find_rubber(name: str) -> Material:
    """Return the rubber of a file where there is one of that name, else that of the catalogue.

    What was assumed of a card that does not say it, such as its units, is printed.
    """
    from viscofric.rheology import catalogue_material, open_card

    path = Path(name)
    if not (path.is_file() or path.suffix):
        return catalogue_material(name)
    card = open_card(path)
    tell_notes(card.notes)
    return card.material
