"""``viscofric material amplitude FILES``: the Payne effect of an amplitude sweep, and what it makes of friction."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.commands import as_command, quantity
from viscofric.cli.contact_options import accuracy_option, chosen_indenter, sliding_indenter_options
from viscofric.cli.errors import print_notes, typed_as
from viscofric.cli.files import WRITTEN, Source, refuse_to_overwrite
from viscofric.cli.output import drawing, is_synthetic, outputs, print_json, write_files
from viscofric.cli.rubber_options import reading_options
from viscofric.notes import listed
from viscofric.showing import with_error

if TYPE_CHECKING:
    from pathlib import Path

    from viscofric.friction.contact_strain import ContactAtStrain
    from viscofric.rheology.payne.kraus_fit import PayneFit


_PERCENT = click.FloatRange(0.0, 1000.0)


@as_command("amplitude")
@click.argument("files", nargs=-1, required=True, type=Source())
@reading_options
@click.option("--material", metavar="NAME|FILE", help="Material of frequency sweeps, to be scaled to a larger strain.")
@click.option(
    "--strain", type=_PERCENT, metavar="%", help="Tensile strain amplitude to scale --material to, in percent."
)
@click.option(
    "--measured-at",
    type=_PERCENT,
    metavar="%",
    help="Tensile strain amplitude of the frequency sweeps [default: small].",
)
@sliding_indenter_options
@quantity("--load", "F", "Load of a contact, e.g. '25 N': scale --material to the strain of the contact.")
@quantity("--speed", "V", "Its speed, e.g. '20 mm/s'.")
@quantity("--contact-temperature", "T", "Its temperature, e.g. '60 degC'.")
@accuracy_option
@outputs(
    "Write the scaled material (JSON), for run files and the other commands.",
    WRITTEN,
    picture="Draw the sweep",
    synthetic=True,
)
def command(files: tuple[Path, ...], as_json: bool, picture: Path | None, out: Path | None, **chosen: Any) -> None:
    """Print the linear range and Kraus's law of an amplitude sweep in FILES.

    With --material and --strain, or a contact (--ball, --load, --speed), the material is scaled to that strain: an
    approximation.
    """
    from viscofric.cli.material.readings import read_kind
    from viscofric.rheology.payne.kraus_fit import fit_kraus

    refuse_to_overwrite(files, picture, out)
    if out is not None and chosen["material"] is None:
        raise click.UsageError("--out needs --material, and --strain or a contact.")
    reading = {name: chosen[name] for name in ("deformation", "modulus_unit", "columns", "sheet")}
    sweep = read_kind("amplitude", files, reading | {"temperature": chosen["temperature"]})
    fit = fit_kraus(sweep)
    record, lines = _fitted(fit)
    notes = list(fit.notes)
    if chosen["material"] is not None:
        more, said, material = _scaled(fit, chosen, notes)
        record |= more
        lines += said
        if out is not None:
            from viscofric.rheology.cards import write_card

            lines.append(f"file     {write_card(material, out, format='json')}")
    record |= listed("notes", notes)
    if as_json:
        print_json(record)
    else:
        click.echo("\n".join(lines))
        print_notes(notes)
    made_up = is_synthetic(chosen["synthetic"], files)
    write_files(("picture", picture, drawing("ramps.amplitude_figure", fit, mark=made_up)))


def _fitted(fit: PayneFit) -> tuple[dict[str, Any], list[str]]:
    from viscofric.datasets import plain

    found = fit.to_dataset()
    record = {"sweep": str(fit.sweep), **plain(dict(found.attrs))}
    lines = [f"{fit.sweep.format}: {fit.sweep}", str(fit.law), *map(str, fit.linear_ranges)]
    return record, lines


def _scaled(fit: PayneFit, chosen: dict[str, Any], notes: list[str]) -> tuple[dict[str, Any], list[str], Any]:
    """Scale a material to a strain, given or that of a contact."""
    from viscofric.cli.rubber_options import find_rubber
    from viscofric.rheology.payne.kraus import material_at_strain, on_strain

    material = find_rubber(chosen["material"])
    measured = None if chosen["measured_at"] is None else 0.01 * chosen["measured_at"]
    if chosen["load"] is None:
        if chosen["strain"] is None:
            raise click.UsageError("--material needs --strain, or a contact: --ball, --load and --speed.")
        strain = 0.01 * chosen["strain"]
        notes += on_strain(fit.law, strain)
        return {"strain": strain}, [], material_at_strain(material, fit.law, strain, measured_at=measured)
    if chosen["speed"] is None:
        raise click.UsageError("--load needs --speed too.")
    from viscofric.friction.contact_strain import solve_at_contact_strain

    shape = chosen_indenter(chosen)
    with typed_as({"temperature": "contact_temperature"}):
        found = solve_at_contact_strain(
            material,
            fit.law,
            shape.indenter,
            speed=chosen["speed"],
            load=chosen["load"],
            temperature=chosen["contact_temperature"],
            measured_at=measured,
            accuracy=chosen["accuracy"],
        )
    notes += found.notes
    return *_compared(found, shape.words), found.material


def _compared(found: ContactAtStrain, words: str) -> tuple[dict[str, Any], list[str]]:
    both = {"linear": found.linear, "at the strain of the contact": found.scaled}
    record = {
        "strain": found.strain,
        "friction_coefficient_linear": found.linear.friction_coefficient,
        "friction_coefficient": found.scaled.friction_coefficient,
        "contact_area_linear": found.linear.contact_area,
        "contact_area": found.scaled.contact_area,
    }
    lines = [f"{words}: strain {100 * found.strain:.3g} %"]
    lines += [
        f"friction {name}: {with_error(one.friction_coefficient, one.diagnostics.friction_error)}"
        for name, one in both.items()
    ]
    return record, lines
