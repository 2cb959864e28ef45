"""``viscofric measure RUNS``: viscoelastic and Coulomb friction of tribometer files."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.commands import as_command
from viscofric.cli.errors import print_notes
from viscofric.cli.files import CSV, Source, plainly, refuse_to_overwrite
from viscofric.cli.friction_sources import separated_runs, separation_options, separation_record
from viscofric.cli.output import answer, drawing, is_synthetic, json_record, outputs, print_pairs, write_files

if TYPE_CHECKING:
    from pathlib import Path

    from viscofric.friction.curves import FrictionCurves

_EXAMPLE = """\b
Example:
  viscofric measure run1.txt run2.txt --out curves.csv --picture curves.svg
"""


@as_command("measure", epilog=_EXAMPLE)
@click.argument("runs", nargs=-1, required=True, type=Source())
@separation_options
@outputs(
    "Write the friction curves (CSV); `-` prints them instead of the table.",
    endings=CSV,
    picture="Draw viscoelastic and Coulomb friction against speed",
    synthetic=True,
)
def command(runs: tuple[Path, ...], out: Path | None, picture: Path | None, synthetic: bool, **parameters: Any) -> None:
    """Separate viscoelastic from Coulomb friction in RUNS, files of a mini-traction machine (MTM, ETM).

    The signs of the surface speeds separate the force: viscoelastic friction changes sign with the motion of the
    rubber, Coulomb friction with the slip, the zero offset of the force cell with neither. Several files make one
    test; `-` is standard input.
    """
    refuse_to_overwrite(runs, out, picture)
    from viscofric.files import marked
    from viscofric.friction.curve_files import write_friction_curves

    made_up = is_synthetic(synthetic, runs)
    curves = separated_runs(runs, parameters)
    curves = replace(curves, source=marked(curves.source, synthetic=made_up))

    def record() -> dict[str, Any]:
        inputs = {"runs": [plainly(str(path)) for path in runs], **separation_record(parameters)}
        return json_record("friction curves 2", inputs, curves.points_dataset(), notes=curves.notes)

    answer(record, lambda: _print(curves))
    print_notes(curves.notes)
    draw = drawing("friction.friction_figure", curves, mark=made_up, synthetic=made_up)
    write_files(("curves", out, lambda path: write_friction_curves(curves, path)), ("picture", picture, draw))


def _print(curves: FrictionCurves) -> None:
    from viscofric.report.texts.friction import friction_lines, friction_table

    click.echo("\n".join(friction_table(curves)))
    said = friction_lines(curves)
    if said:
        click.echo()
    print_pairs(said)
