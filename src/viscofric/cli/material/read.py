"""``viscofric material read FILES``: what DMA files hold, and what is doubtful about them."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import click

from viscofric.cli.errors import print_notes, reported_errors
from viscofric.cli.files import Source, refuse_to_overwrite
from viscofric.cli.rubber_options import reading_options

if TYPE_CHECKING:
    from viscofric.data import Deformation, IsothermalSweeps


@click.command(name="read")
@click.argument("files", nargs=-1, required=True, type=Source())
@reading_options
@click.option(
    "--csv",
    "table",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Also write the points used to a table (CSV).",
)
def command(
    files: tuple[Path, ...],
    deformation: Deformation | None,
    temperature: tuple[str, ...],
    modulus_unit: str | None,
    columns: dict[str, str],
    sheet: str | None,
    table: Path | None,
) -> None:
    """Print the format, isotherms and doubtful data of DMA FILES.

    Several files make one set of sweeps, such as one file for each temperature.
    """
    from viscofric.readers import read_dma

    if table is not None:
        refuse_to_overwrite(table, files)
    with reported_errors():
        sweeps = read_dma(
            *files,
            deformation=deformation,
            temperature=temperature or None,
            modulus_unit=modulus_unit,
            columns=columns,
            sheet=sheet,
        )
        click.echo(f"{sweeps.format}; moduli in {sweeps.deformation}; {len(sweeps)} isotherms")
        for line in _isotherms(sweeps):
            click.echo(line)
        print_notes(sweeps.notes)
        if table is not None:
            from viscofric.study.rubber_results import write_sweeps

            click.echo(f"table    {write_sweeps(sweeps, table)}")


def _isotherms(sweeps: IsothermalSweeps) -> list[str]:
    from viscofric.units import celsius

    letter = "G" if sweeps.deformation == "shear" else "E"
    lines = [f"{'T (°C)':>8}  {'points':>6}  {'f (Hz)':>19}  {letter + chr(39) + ' (MPa)':>19}  {'tan δ':>15}"]
    for one in sweeps.isotherms:
        tangent = one.loss_modulus / one.storage_modulus
        spans = [
            f"{low:.3g} to {high:.3g}"
            for low, high in (
                (one.angular_frequency[0] / (2 * math.pi), one.angular_frequency[-1] / (2 * math.pi)),
                (one.storage_modulus.min() / 1e6, one.storage_modulus.max() / 1e6),
                (tangent.min(), tangent.max()),
            )
        ]
        lines.append(f"{celsius(one.temperature):8.1f}  {len(one):6d}  {spans[0]:>19}  {spans[1]:>19}  {spans[2]:>15}")
    return lines
