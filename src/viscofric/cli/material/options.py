"""Options that several commands share: how DMA files are to be read."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from collections.abc import Callable


def reading_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options for what a DMA file may not say itself."""
    for option in (
        click.option("--modulus-unit", metavar="UNIT", help="Unit of the moduli if the file gives none, e.g. MPa."),
        click.option(
            "--temperature",
            metavar="T",
            multiple=True,
            help="Temperature of a file that contains none, e.g. '30 degC'; once, or once for each file.",
        ),
        click.option(
            "--deformation",
            type=click.Choice(["tension", "shear"]),
            help="Deformation of the test, if the file does not state it.",
        ),
    ):
        function = option(function)
    return function
