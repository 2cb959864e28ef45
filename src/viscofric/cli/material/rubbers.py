"""A rubber named on the command line: a material file, or a name of the catalogue."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

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
    for note in card.notes:
        click.echo(f"Note: {note}", err=True)
    return card.material


def tell_of_card(material: Material, form: str) -> None:
    """Say where a program's card holds less of the rubber than its own files do."""
    from viscofric.rheology import ShiftFactors

    if form not in ("csv", "json") and isinstance(material.shift, ShiftFactors):
        click.echo(
            f"Note: the card for {form} holds at the reference temperature only, since other programs take a shift law "
            "but no table of factors; fit with --shift best gives the rubber a law.",
            err=True,
        )
