"""``viscofric identify SOURCES``: the modulus inferred from friction."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.commands import Decorator, as_command, quantity, together
from viscofric.cli.contact_options import chosen_indenter, sliding_indenter_options
from viscofric.cli.errors import print_notes, typed_as
from viscofric.cli.files import JSON, WRITTEN, Source, plainly, refuse_to_overwrite
from viscofric.cli.friction_sources import (
    friction_curves,
    is_of_synthetic,
    separation_options,
    separation_record,
    shifts,
)
from viscofric.cli.output import answer, drawing, is_synthetic, json_record, optional_si, outputs, write_files
from viscofric.cli.rubber_options import find_rubber, shift_factor_options
from viscofric.cli.speed_options import list_of

if TYPE_CHECKING:
    from pathlib import Path

    from viscofric.friction.identification.anchors import Anchor
    from viscofric.friction.identification.result import IdentifiedMaterial
    from viscofric.rheology.material import Material


_SIZES = ("indentation", "area", "half_width")
#: What an anchor takes besides the modulus or the size.
_OF_MODULUS, _OF_SIZE = ("frequency", "temperature"), ("speed", "temperature", "load")

anchor_options = together(
    quantity("--anchor-modulus", "E", "Known |E| at one frequency, e.g. '8 MPa'; fixes the magnitude."),
    quantity("--anchor-frequency", "F", "Frequency of --anchor-modulus, e.g. '1 Hz' or '6.28 rad/s'."),
    quantity("--anchor-indentation", "DEPTH", "Alternative: measured indentation of a moving contact."),
    quantity("--anchor-area", "AREA", "Alternative: contact area of a moving contact, e.g. '12 mm^2'."),
    quantity("--anchor-half-width", "LENGTH", "Alternative: contact half-width across the motion."),
    quantity("--anchor-speed", "V", "Speed of the anchor contact, e.g. '100 mm/s'."),
    quantity("--anchor-load", "F", "Load of the anchor contact, e.g. '25 N'."),
    quantity("--anchor-temperature", "T", "Temperature of the anchor, e.g. '30 degC'."),
    click.option(
        "--anchor-error", type=float, metavar="SHARE", help="Relative standard error of the anchor [default: 0.01]."
    ),
    heading="Anchor: a known modulus or contact size",
)


def check_anchor(parameters: dict[str, Any]) -> str | None:
    """Return which modulus or size the anchor is of, or None without one."""
    given = {
        name for name in ("modulus", *_SIZES, *_OF_MODULUS, *_OF_SIZE, "error") if _of(parameters, name) is not None
    }
    what = [name for name in ("modulus", *_SIZES) if name in given]
    if not what:
        if given:
            raise click.UsageError(f"{_typed(min(given))} is of an anchor; give --anchor-modulus or a contact's size.")
        return None
    if len(what) > 1:
        raise click.UsageError(f"{_typed(what[0])} and {_typed(what[1])} are both given; one anchor is enough.")
    needed = _OF_MODULUS if what == ["modulus"] else _OF_SIZE
    for name in needed:
        if name not in given:
            raise click.UsageError(f"{_typed(what[0])} needs {_typed(name)} too.")
    useless = given - {*what, *needed, "error"}
    if useless:
        raise click.UsageError(f"{_typed(min(useless))} does not belong to {_typed(what[0])}.")
    return what[0]


def make_anchor(parameters: dict[str, Any], what: str, load_unit: str) -> Anchor:
    """Return the requested anchor, which was checked; a load is in N, or of a line contact in N/m."""
    from viscofric.friction.identification.anchors import ContactAnchor, ModulusAnchor
    from viscofric.units import positive

    options: dict[str, Any] = {} if parameters["anchor_error"] is None else {"error": parameters["anchor_error"]}
    typed = {name.removeprefix("anchor_"): name for name in parameters if name.startswith("anchor_")}
    with typed_as(typed | {"angular_frequency": "anchor_frequency"}):
        if what == "modulus":
            more = (_of(parameters, name) for name in _OF_MODULUS)
            return ModulusAnchor(_of(parameters, "modulus"), *more, **options)
        options |= {name: _of(parameters, name) for name in _OF_SIZE}
        options["load"] = positive(options["load"], load_unit, "load")
        return ContactAnchor(**{"contact_area" if what == "area" else what: _of(parameters, what)}, **options)


def _of(parameters: dict[str, Any], name: str) -> Any:
    return parameters[f"anchor_{name}"]


def _typed(name: str) -> str:
    return f"--anchor-{name.replace('_', '-')}"


#: Options that are settings of `identify_material` as they stand.
_SETTINGS = ("load", "reference", "poisson_ratio", "modes", "samples", "seed", "accuracy", "name", "workers")
#: Errors of friction that points have in common.
_SHARED = {
    "level_error": "of friction that the points of a temperature share, independent between temperatures",
    "common_error": "of friction that all points share, e.g. of the calibration of force and load",
    "drift_error": "of friction per decade of speed, shared by all points",
    "coulomb_level_error": "of the Coulomb friction that was subtracted, shared by all points",
}
_EXAMPLE = """\b
Example:
  viscofric identify curves.csv --ball "9.525 mm" --out rubber.json \\
      --anchor-modulus "8 MPa" --anchor-frequency "1 Hz" --anchor-temperature "30 degC"
"""


_shared_options = together(
    *(
        click.option(f"--{name.replace('_', '-')}", default=0.0, help=f"Relative standard error {words}.")
        for name, words in _SHARED.items()
    ),
    quantity(
        "--temperature-error", "DT", "Standard error of every temperature, each its own, e.g. '1 K'.", default="0 K"
    ),
    heading="Errors that points have in common",
)


def identified_options(name: str, picture: str) -> Decorator:
    """Return a decorator that adds the options of a material to be identified: its name, and what is drawn of it."""
    words = "Shift factors: a table (CSV), a material file or a catalogue name [default: found from the data]."
    return together(
        click.option("--shift", metavar="FILE|NAME", help=words),
        shift_factor_options,
        quantity("--reference", "T", "Reference temperature of the material, e.g. '30 degC'."),
        click.option("--poisson-ratio", default=0.5, help="Poisson's ratio, 0 to 0.5."),
        click.option("--modes", default=30, help="Least number of retardation times."),
        click.option("--samples", default=200, help="Number of uncertainty samples for the limits."),
        click.option("--seed", default=0, help="Random seed of the samples."),
        click.option("--name", default=name, help="Name of the material."),
        click.option("--beside", metavar="FILE|NAME", help="Material to draw for comparison, e.g. from DMA."),
        outputs(
            "Write the material (JSON), for `solve`, run files and `material`.",
            WRITTEN,
            endings=JSON,
            picture=picture,
            synthetic=True,
        ),
    )


def chosen_beside(parameters: dict[str, Any], picture: Path | None) -> Material | None:
    """Return the material to be drawn for comparison, None without one."""
    if parameters["beside"] is None:
        return None
    if picture is None:
        raise click.UsageError("--beside is drawn into the --picture; give --picture too.")
    return find_rubber(parameters["beside"], "beside")


def chosen_shift(parameters: dict[str, Any]) -> dict[str, Any]:
    """Return the shift factors of the options as a setting, none if they are to be found."""
    shift, _ = shifts(parameters)
    return {} if shift is None else {"shift": shift}


@as_command("identify", epilog=_EXAMPLE)
@click.argument("sources", nargs=-1, required=True, type=Source())
@sliding_indenter_options
@quantity("--load", "F", "Normal load of all points, e.g. '25 N' [default: each point's own].")
@anchor_options
@click.option("--prior", metavar="FILE|NAME", help="Material known over a part of the frequencies.")
@quantity("--prior-band", "LOW,HIGH", "Frequencies over which the prior is known, e.g. '0.1 Hz,10 Hz'.")
@click.option("--prior-error", default=0.02, help="Relative standard error of the prior.")
@_shared_options
@click.option("--accuracy", default=1e-3, help="Target relative error of each solved contact.")
@click.option("--workers", default=1, help="Number of processes.")
@separation_options
@identified_options("rubber identified from friction", "Draw the modulus with its limits")
def command(
    sources: tuple[Path, ...],
    out: Path | None,
    picture: Path | None,
    synthetic: bool,
    as_json: bool,
    **parameters: Any,
) -> None:
    """Infer the modulus and the shift factors from friction data.

    SOURCES are tables of friction curves (CSV, as written by `viscofric measure --out`), files of a tribometer, or
    `-` for standard input. Friction hardly determines the magnitude of the modulus: give an anchor or a prior.
    """
    refuse_to_overwrite(sources, out, picture)
    known, anchor = chosen_beside(parameters, picture), check_anchor(parameters)
    from viscofric.cli.progress import contact_bar
    from viscofric.friction.identification.identify import identify_material
    from viscofric.report.texts.inverse import shown_frequencies
    from viscofric.rheology.cards import native, write_card

    shape = chosen_indenter(parameters)
    options = {name: parameters[name] for name in (*_SETTINGS, *_SHARED, "temperature_error")}
    options |= _prior(parameters) | chosen_shift(parameters)
    if anchor is not None:
        options["anchor"] = make_anchor(parameters, anchor, shape.indenter.geometry.load_unit)
    curves = friction_curves(sources, parameters)
    with contact_bar("Shift factors", quiet=as_json) as bar:

        def show(step: int, done: int, total: int) -> None:
            bar(done, total, f"Step {step}: contacts")

        found = identify_material(curves, indenter=shape.indenter, progress=show, **options)

    def record() -> dict[str, Any]:
        inputs = {"sources": [plainly(str(path)) for path in sources], "indenter": shape.record}
        inputs |= _inputs(parameters, options, shape.indenter.geometry.load_unit) | separation_record(parameters)
        spectra = [one.modes_at() for one in (found.material, *found.samples.materials)]
        bands = ("identified", "identified_storage", "identified_loss")
        levels = ("factor", "modulus", "chi2", "rms", "penalty")
        return json_record(
            "identification 2",
            inputs,
            found.to_dataset(shown_frequencies(found)),
            material=spectra[0].to_dataset(),
            shift=native.plain(found.material.shift),
            shift_found=found.shift_found,
            **{name: vars(getattr(found, name)) for name in bands},
            family=[{name: getattr(fit, name) for name in levels} for fit in found.family],
            points=found.friction_dataset(),
            samples=[{name: getattr(one, name) for name in ("E0", "E_inf", "C")} for one in spectra[1:]],
            sentences=found.sentences,
            notes=(*curves.notes, *found.notes),
        )

    answer(record, lambda: _print(found))
    print_notes(curves.notes)
    made_up = found.material.synthetic or is_synthetic(synthetic, sources) or is_of_synthetic(parameters["shift"])
    material = replace(found.material, synthetic=made_up)
    write_files(
        ("material", out, lambda path: write_card(material, path, format="json")),
        ("picture", picture, drawing("identified.identified_figure", found, known, mark=made_up)),
    )


def _inputs(parameters: dict[str, Any], options: dict[str, Any], load_unit: str) -> dict[str, Any]:
    """Return what was requested besides the indenter and the separation in plain types, SI; None if not given."""
    anchor, band = options.get("anchor"), options.get("prior_band")
    return {
        **{name: parameters[name] for name in (*_SETTINGS, *_SHARED, "shift", "prior", "prior_error")},
        "temperature_error": optional_si(parameters["temperature_error"], "delta_degC"),
        "load": optional_si(parameters["load"], load_unit),
        "reference": optional_si(parameters["reference"], "K"),
        "prior_band": None if band is None else list(band),
        "anchor": None if anchor is None else {name: one for name, one in asdict(anchor).items() if one is not None},
    }


def _prior(parameters: dict[str, Any]) -> dict[str, Any]:
    """Return what is known of the rubber beforehand, as settings."""
    if parameters["prior"] is None:
        if parameters["prior_band"] is not None:
            raise click.UsageError("--prior-band is the band of a --prior, which is not given.")
        return {}
    from viscofric.units import angular_frequency

    known = find_rubber(parameters["prior"], "prior")
    prior: dict[str, Any] = {"prior": known, "prior_error": parameters["prior_error"]}
    if parameters["prior_band"] is not None:
        ends = list_of(parameters["prior_band"])
        if len(ends) != 2:
            raise click.BadParameter("give two frequencies: '0.1 Hz,10 Hz'.", param_hint="--prior-band")
        prior["prior_band"] = tuple(angular_frequency(end, "--prior-band") for end in ends)
    return prior


def _print(found: IdentifiedMaterial) -> None:
    from viscofric.notes import note_of
    from viscofric.report.texts.inverse import family_lines, modulus_lines

    for table in (modulus_lines(found), family_lines(found)):
        for line in table:
            click.echo(line)
        if table:
            click.echo()
    for sentence in found.sentences:
        click.echo(note_of(sentence).words("shell"))
