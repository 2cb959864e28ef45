"""``viscofric material fit FILES``: shift factors, master curve and spectrum of DMA files, with figures."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.commands import as_command
from viscofric.cli.errors import print_doubtful_checks, print_notes
from viscofric.cli.files import FILE, FOLDER
from viscofric.cli.keys import key, table_of
from viscofric.cli.material.convert import CARD_LAWS, FORMATS
from viscofric.cli.output import outputs, print_json, print_written, typed_command
from viscofric.cli.rubber_options import reading_options, shift_factor_options

if TYPE_CHECKING:
    from viscofric.rheology.cards import CardFormat, CardLaw
    from viscofric.rheology.material import Material
    from viscofric.study.results.results import StudyResults
    from viscofric.study.run_file.material import MaterialTable

_KINDS = ("creep", "relaxation", "master_curve")
_BESIDE = ("with_creep", "with_relaxation")


@as_command("fit")
@click.argument("files", nargs=-1, required=True, type=click.Path(path_type=Path))
@key(
    "material.reference_temperature",
    "--reference",
    metavar="T",
    help="Reference temperature, e.g. '20 degC' [default: the middle one of the tests; needed for --master-curve].",
)
@reading_options
@key(
    "material.leave_out_temperatures",
    metavar="T",
    multiple=True,
    help="Isotherms of the sweeps to leave out, e.g. '60 degC'; repeatable.",
)
@key("material.name", help="Name of the material, for reports and cards.")
@click.option("--creep", is_flag=True, help="FILES are creep tests, J(t) at several temperatures, instead of sweeps.")
@click.option("--relaxation", is_flag=True, help="FILES are relaxation tests, E(t) or G(t), instead of sweeps.")
@click.option(
    "--with-creep",
    multiple=True,
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Creep tests of the same material, besides the sweeps in FILES; repeatable.",
)
@click.option(
    "--with-relaxation",
    multiple=True,
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Relaxation tests of the same material, besides the sweeps in FILES; repeatable.",
)
@click.option("--master-curve", is_flag=True, help="FILES is one finished master curve at the reference temperature.")
@key("material.poisson_ratio")
@key("material.vertical_shift")
@key("material.shift_by")
@key(
    "material.shift_weights",
    metavar="E' E''",
    type=(float, float),
    help="Weights of log E' and log E'' in the superposition, e.g. 1 0.2.",
)
@key("material.shift")
@key("material.shift_factors", type=FILE)
@shift_factor_options
@click.option("--fix", metavar="T=LOG10", multiple=True, help="Fix one factor, e.g. '-20 degC=4.2'.")
@key("material.spectrum")
@key("material.modes")
@key("material.tau_ratio")
@click.option(
    "--card", "cards", type=click.Choice(FORMATS), multiple=True, help="Also write a material card for this program."
)
@click.option(
    "--card-law", type=click.Choice(CARD_LAWS), help="Shift law of the cards, fitted to the measured shift factors."
)
@click.option("--samples", default=200, help="Bootstrap samples for the bands of E; 0 for none.")
@outputs("Folder for the results [default: FILE.material beside the first file].", FOLDER, synthetic=True)
def command(
    files: tuple[Path, ...],
    out: Path | None,
    as_json: bool,
    cards: tuple[CardFormat, ...],
    card_law: CardLaw | None,
    samples: int,
    synthetic: bool,
    **parameters: Any,
) -> None:
    """Fit a material to FILES of DMA sweeps, creep or relaxation tests: shift factors, master curve, spectrum, report.

    The output folder has rubber.json (for run files and the other commands), tables (CSV), figures and report.html.
    """
    if samples < 0:
        raise click.BadParameter("must not be below zero.", param_hint="--samples")
    kinds = [name for name in _KINDS if parameters[name]]
    if len(kinds) > 1:
        raise click.UsageError(" and ".join(f"--{one.replace('_', '-')}" for one in kinds) + " exclude each other.")
    if parameters["master_curve"] and len(files) > 1:
        raise click.BadParameter("is one file, not several.", param_hint="--master-curve")
    if card_law and not cards:
        raise click.UsageError("--card-law is for --card only.")
    from viscofric.cli.run import outcome_record, status_of
    from viscofric.report import write_figures_and_report
    from viscofric.study.rubber_results import run_material

    folder = files[0].with_suffix(".material") if out is None else out
    results, rubber, written = run_material(
        _table(files, parameters),
        folder,
        title=parameters["name"] or f"Rubber of {files[0].name}" + (f" and {len(files) - 1} more" if files[1:] else ""),
        command=typed_command(),
        samples=samples,
        synthetic=synthetic,
    )
    figures, report = write_figures_and_report(results.tree, results.folder)
    print_notes(results.notes)
    print_doubtful_checks(results.tree)
    made = [_write_card(rubber.material, folder, form, card_law) for form in cards]
    cards_made = [path for path in made if path is not None]
    status = 1 if None in made else status_of(results)
    if as_json:
        from viscofric.datasets import record
        from viscofric.notes import listed

        fit = getattr(rubber.material.spectrum, "fit", None)
        found = {"spectrum": record(rubber.material.to_dataset())} | outcome_record(results, figures, report)
        found |= listed("spectrum_notes", () if fit is None else fit.notes)
        print_json(found | {"files": written, "cards": cards_made, "exit_status": status})
    else:
        _print(results)
        said = [*(("file", path) for path in written), *(("card", path) for path in cards_made)]
        print_written(*said, ("report", report), figures=figures)
    raise click.exceptions.Exit(status)


def _write_card(material: Material, folder: Path, form: CardFormat, law: CardLaw | None) -> Path | None:
    """Write one card; one that fails does not stop the others."""
    from viscofric.errors import ViscofricError
    from viscofric.notes import warned
    from viscofric.study.rubber_results import write_program_card

    try:
        with warned() as notes:
            path = write_program_card(material, folder / "cards", form, law)
    except ViscofricError as error:
        click.echo(
            f"Error: no card for {form}: {error.words('shell')} (viscofric material convert has the options.)", err=True
        )
        return None
    print_notes(notes)
    return path


def _table(files: tuple[Path, ...], parameters: dict[str, Any]) -> MaterialTable:
    """Check the parameters as a run file's [material] is checked."""
    values: dict[str, Any] = {}
    if parameters["master_curve"]:
        values["master_curve"] = str(files[0])
    else:
        kind = next((name for name in ("creep", "relaxation") if parameters[name]), "dma")
        values[kind] = [str(path) for path in files]
        for other in _BESIDE:
            if parameters[other]:
                values.setdefault(other.removeprefix("with_"), []).extend(map(str, parameters[other]))
    if parameters["fix"]:
        pairs = [_fixed(text) for text in parameters["fix"]]
        values["fixed_shift_factors"] = dict(pairs)
        if len(values["fixed_shift_factors"]) < len(pairs):
            raise click.BadParameter("holds one temperature twice.", param_hint="--fix")
    table: MaterialTable = table_of("material", parameters, **values)
    return table


def _fixed(text: str) -> tuple[str, float]:
    temperature, _, value = text.rpartition("=")
    try:
        if temperature and math.isfinite(float(value)):
            return temperature, float(value)
        raise ValueError(text)
    except ValueError:
        raise click.BadParameter(
            f"{text!r}: write temperature and decadic logarithm, such as '-20 degC=4.2'.", param_hint="--fix"
        ) from None


def _print(results: StudyResults) -> None:
    """Print the superposition and the key numbers."""
    from viscofric.report.results import group, number, sentences
    from viscofric.report.texts.study import key_numbers

    whole = group(results.tree, "superposition")
    if whole is not None and number(whole.attrs, "holds") == 1.0:
        click.echo(sentences(whole.attrs, "sentences")[0])
    for item in key_numbers(results.tree):
        click.echo(f"{item.name}: {item.value}" + (f" ({item.remark})" if item.remark else ""))
