"""``viscofric master SOURCES``: the friction master curve, and shift factors from friction."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.commands import as_command, quantity
from viscofric.cli.errors import print_notes
from viscofric.cli.files import CSV, Source, plainly, refusal, refuse_to_overwrite
from viscofric.cli.friction_sources import friction_curves, separation_options, separation_record, shifts
from viscofric.cli.output import (
    answer,
    drawing,
    is_synthetic,
    json_record,
    optional_si,
    outputs,
    print_pairs,
    write_files,
)
from viscofric.cli.rubber_options import shift_factor_options
from viscofric.notes import Note

if TYPE_CHECKING:
    from pathlib import Path

    from viscofric.friction.curves import FrictionCurves
    from viscofric.friction.shifting.master_curve import FrictionMasterCurve
    from viscofric.friction.shifting.shift_agreement import ShiftAgreement
    from viscofric.rheology.shifts.laws import ParametricLaw
    from viscofric.rheology.shifts.shift_law import ShiftLaw
    from viscofric.rheology.shifts.vertical_shift import VerticalShift

_LAWS = ("best", "wlf", "arrhenius", "vft", "wlf+arrhenius", "polynomial", "none")
_EXAMPLE = """\b
Example:
  viscofric master curves.csv --shift rubber.json --reference "30 degC" --out alpha.csv
"""


@as_command("master", epilog=_EXAMPLE)
@click.argument("sources", nargs=-1, required=True, type=Source())
@click.option(
    "--shift",
    "known",
    metavar="FILE|NAME",
    help="Shift factors of the modulus for comparison: a table (CSV), a material file or a catalogue name.",
)
@shift_factor_options
@quantity("--reference", "T", "Reference temperature (α = 1), e.g. '30 degC' [default: that of --shift, or found].")
@click.option("--law", type=click.Choice(_LAWS), default="best", help="Law to fit to the shift factors.")
@quantity("--ball", "RADIUS", "Ball radius, e.g. '9.525 mm'; reduces friction at all loads to one load.")
@click.option(
    "--level-error",
    default=0.0,
    help="Relative standard error shared by all points of a temperature, to include in the errors of α.",
)
@separation_options
@outputs(
    "Write the shift factors with their errors (CSV); `-` prints them instead of the table.",
    endings=CSV,
    picture="Draw master curve and shift factors",
    synthetic=True,
)
def command(
    sources: tuple[Path, ...], out: Path | None, picture: Path | None, synthetic: bool, **parameters: Any
) -> None:
    """Shift the friction curves of several temperatures onto a master curve, and find α(T) from friction alone.

    SOURCES are tables of friction curves (CSV, as written by `viscofric measure --out`), files of a tribometer, or
    `-` for standard input. If the curves do not overlap, friction determines no shift factors: those of --shift are
    used; without --shift, that is an error.
    """
    refuse_to_overwrite(sources, out, picture)
    from viscofric.friction.shifting.shift_agreement import concluded
    from viscofric.report.texts.inverse import shift_factors
    from viscofric.rheology.cards import native

    curves = friction_curves(sources, parameters)
    known, vertical = shifts(parameters, "known")
    notes = list(curves.notes)
    master = _shifted(curves, known, vertical, parameters, notes)
    law, why, agreement, refused = concluded(master, parameters["law"], known)
    notes += [*refused, *master.notes]
    if out is not None and not master.found:
        raise refusal("no-factors", f"{out} is not written: friction determines no shift factors.")

    def record() -> dict[str, Any]:
        inputs = {"sources": [plainly(str(path)) for path in sources], "shift": parameters["known"]}
        inputs |= {name: parameters[name] for name in ("law", "level_error")}
        inputs |= {name: optional_si(parameters[name], unit) for name, unit in (("reference", "K"), ("ball", "m"))}
        overlap = {name: getattr(master.overlap, name) for name in ("rms", "error", "points", "sentence")}
        return json_record(
            "friction shift 2",
            inputs | separation_record(parameters),
            shift_factors(master),
            found=master.found,
            covariance=master.shift_factors.covariance if master.found else None,
            law=native.plain(law),
            law_explanation=why or None,
            overlap=overlap,
            agreement=agreement and agreement.to_dataset(),
            master_curve=master.to_dataset(),
            notes=notes,
        )

    answer(record, lambda: _print(master, known, law, why, agreement))
    print_notes(notes)
    made_up = is_synthetic(synthetic, sources)
    draw = drawing("friction.shifted_figure", master, known, mark=made_up, synthetic=made_up)
    write_files(
        ("factors", out, lambda path: master.shift_factors.save(path)),  # noqa: PLW0108 - not of all of them
        ("picture", picture, draw),
    )


def _shifted(
    curves: FrictionCurves,
    known: ShiftLaw | None,
    vertical: VerticalShift | None,
    parameters: dict[str, Any],
    notes: list[str],
) -> FrictionMasterCurve:
    """Shift friction curves by their own factors, or by those of the modulus where they have none, and note it."""
    from viscofric.contact.indenters.shapes import Ball
    from viscofric.errors import SuperpositionError
    from viscofric.friction.shifting.shift import common_reference, shift_friction

    reference = parameters["reference"]
    options: dict[str, Any] = {"indenter": None if parameters["ball"] is None else Ball(parameters["ball"])}
    if options["indenter"] is not None:
        options["vertical_shift"] = vertical
    elif vertical is not None:
        said = (
            "The rubber has a vertical shift b(T), which changes the load at which curves coincide; it is left out "
            "without the ball's radius (--ball)."
        )
        notes.append(Note("vertical-shift-left-out", said))
    try:
        about = common_reference(curves, known) if reference is None else reference
        return shift_friction(curves, reference=about, level_error=parameters["level_error"], **options)
    except SuperpositionError as error:
        if known is None:
            raise
        said = f"No shift factors from friction: {error.words('shell')} Those of the modulus are used."
        notes.append(Note("no-shift-factors", said))
        return shift_friction(curves, shift=known, reference=reference, **options)


def _print(
    master: FrictionMasterCurve,
    known: ShiftLaw | None,
    law: ParametricLaw | None,
    why: str,
    agreement: ShiftAgreement | None,
) -> None:
    from viscofric.report.texts.inverse import shift_lines, shift_words

    click.echo("\n".join([*shift_lines(master, known), ""]))
    print_pairs(shift_words(master, law, agreement, why))
