"""``viscofric curve``: predicted friction against speed, at one or several temperatures."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.commands import CONDITIONS, SOME_CASES_FAILED, as_command, exit_if_beyond, together
from viscofric.cli.contact import Contact, heating_options
from viscofric.cli.contact_options import chosen_direction, contact_options, load_option, sliding_indenter_options
from viscofric.cli.errors import print_notes
from viscofric.cli.files import CSV
from viscofric.cli.output import answer, drawing, json_record, outputs, print_pairs, write_files
from viscofric.cli.rubber_options import NamedRubber, layer_options, rubber_options
from viscofric.cli.speed_options import chosen_speeds, chosen_temperatures, speed_options

if TYPE_CHECKING:
    from pathlib import Path

    from viscofric.friction.curves import FrictionCurves
    from viscofric.rheology.uncertainty.material_samples import MaterialSamples

#: Codes of notes on the material, rather than on contacts.
_ON_MATERIAL = {"frequencies-unknown", "temperature-assumed"}
_EXAMPLE = """\b
Example:
  viscofric curve --material "synthetic fluoroelastomer" --ball "9.525 mm" --load "25 N" \\
      --speed "20 mm/s to 200 mm/s" --points 5 --temperature "30 degC, 60 degC"
"""


@as_command("curve", epilog=_EXAMPLE)
@rubber_options
@layer_options
@sliding_indenter_options
@together(speed_options("Speed"), load_option(required=True), heading=CONDITIONS)
@contact_options
@heating_options(steady=True)
@click.option(
    "--samples",
    type=click.IntRange(0, 10_000),
    default=0,
    help="Bootstrap samples for the 95 % band of friction, with --dma or a run file; 20 or more, 0 for none.",
)
@click.option("--workers", default=1, help="Number of processes.")
@outputs(
    "Write the friction curves (CSV); `-` prints them instead of the table.",
    endings=CSV,
    picture="Draw friction against speed",
)
def command(out: Path | None, picture: Path | None, as_json: bool, **parameters: Any) -> None:
    """Predict viscoelastic friction against speed, at one or several temperatures.

    Quantities carry their unit. Each contact is solved to the requested accuracy.
    """
    from viscofric.cli.progress import contact_bar
    from viscofric.errors import ViscofricError
    from viscofric.files import marked
    from viscofric.friction.curve_files import write_friction_curves
    from viscofric.friction.prediction import predict_friction
    from viscofric.notes import codes

    velocities = chosen_speeds(parameters)
    contact = Contact(parameters, out, picture)
    direction = chosen_direction(parameters["direction"])
    samples = _samples(contact.rubber, parameters["samples"])
    failed = False
    try:
        with contact_bar("Contacts", quiet=as_json) as bar:
            curves = predict_friction(
                contact.rubber.material,
                contact.body.indenter,
                speeds=velocities,
                temperatures=chosen_temperatures(parameters) or None,
                load=parameters["load"],
                samples=samples,
                workers=parameters["workers"],
                progress=bar,
                heating=contact.heating,
                direction=direction,
                **contact.settings,
            )
    except ViscofricError as error:
        if error.solved is None:
            raise
        curves, failed = error.solved, True
    curves = replace(curves, source=marked(curves.source, synthetic=contact.synthetic))

    def record() -> dict[str, Any]:
        inputs = contact.record(None) | {name: parameters[name] for name in ("samples", "workers")}
        inputs |= {"direction": list(direction), "load": float(curves.load[0])}
        return json_record("friction curves 2", inputs, curves.points_dataset(), notes=curves.notes)

    answer(record, lambda: _print(contact.title, curves))
    for note in curves.notes:  # those of contacts are warnings, as of `solve`
        print_notes([note], word="Note" if codes([note]) & _ON_MATERIAL else "Warning")
    write_files(
        ("curves", out, partial(write_friction_curves, curves)),
        ("picture", picture, drawing(_figure_of(curves), curves, mark=contact.synthetic)),
    )
    if failed:
        click.get_current_context().exit(SOME_CASES_FAILED)
    exit_if_beyond(parameters["accuracy"], curves.viscoelastic, curves.viscoelastic_error)


def _samples(rubber: NamedRubber, count: int) -> MaterialSamples | None:
    """Return bootstrap samples of a material that was fitted to sweeps; None if none are requested."""
    if count == 0:
        return None
    from viscofric.study.study_rubber import draw_rubber

    drawn = None if rubber.made is None else draw_rubber(rubber.made, count)
    if drawn is None:
        raise click.UsageError(
            "--samples needs the sweeps that the material is fitted to; material files do not hold them: give --dma, "
            "or a run file."
        )
    print_notes(drawn.notes)
    return drawn


def _figure_of(curves: FrictionCurves) -> str:
    from viscofric.friction.heating import HeatedFrictionCurves

    heated = isinstance(curves, HeatedFrictionCurves)
    return "heating.heated_curves_figure" if heated else "friction.predicted_figure"


def _print(title: str, curves: FrictionCurves) -> None:
    """Print a table of friction: a line for each temperature and speed."""
    from viscofric.report.texts.friction import friction_table
    from viscofric.report.texts.numbers import AFTER_PLUS_MINUS, TWO_DIGITS, in_doubt, percent

    click.echo("\n".join([f"{title}\n", *friction_table(curves)]))
    worst = float((curves.viscoelastic_error / abs(curves.viscoelastic)).max())
    said = [("numerical error", f"{percent(worst)} at most")]
    if curves.viscoelastic_lower is None:
        said.append(TWO_DIGITS if in_doubt(curves.notes) else AFTER_PLUS_MINUS)
    if curves.within_measured_frequencies is not None and not curves.within_measured_frequencies.all():
        said.append(("marked *", "frequencies at which the material is not known"))
    click.echo()
    print_pairs(said)
