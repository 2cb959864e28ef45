"""``viscofric verify``: closed forms, reference values, energy balance and refinement, on the user's own machine."""

from __future__ import annotations

import sys
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.commands import NOT_ACCURATE, SOME_CASES_FAILED, as_command
from viscofric.cli.errors import placed_at
from viscofric.cli.files import CSV, DASH
from viscofric.cli.output import outputs, print_json, print_written, write_rows
from viscofric.notes import listed

if TYPE_CHECKING:
    from viscofric.study.run_file.study import Study
    from viscofric.verification import Check, Outcome


#: Columns of the report's table that are printed.
_PRINTED = (
    "temperature",
    "speed (mm/s)",
    "load (N)",
    "viscoelastic, measured",
    "standard error",
    "predicted",
    "95 % from",
    "to",
    "predicted minus measured",
)


def open_friction_test(folder: Path) -> tuple[Path, Study]:
    """Return the run file of a friction test, and what it holds; raise `StudyError` where something is missing."""
    from viscofric.errors import StudyError
    from viscofric.study.run_file.study import load_study

    if not folder.is_dir():
        raise StudyError(f"{folder}: is not a folder; expected the folder of a friction test.", code="no-folder")
    found = sorted(folder.glob("*.toml"))
    if len(found) != 1:
        names = ", ".join(path.name for path in found) or "none"
        raise StudyError(
            f"{folder}: expected one run file (*.toml) beside the sweeps and the friction; found {names}.",
            code="no-run-file",
        )
    study = load_study(found[0])
    missing = [
        (not study.material.dma, '[material] dma = "sweeps.csv"'),
        (study.measurement is None, '[measurement] mtm = "friction.csv" (or curves = "friction.csv")'),
        (not study.citation, 'citation = "…"'),
        (not study.licence, 'licence = "…"'),
    ]
    wanted = [text for lacks, text in missing if lacks]
    if wanted:
        raise StudyError(
            f"{found[0]}: a friction test needs its sweeps, its measured friction, a citation and a licence; add "
            f"{', and '.join(wanted)}.",
            code="incomplete-test",
        )
    return found[0], study


def compare_test(folder: Path, as_json: bool) -> None:
    """Run the study of a friction test, and print every point with the errors of both."""
    from viscofric.cli.run import run_and_report
    from viscofric.datasets import plain, record
    from viscofric.report.results import group, is_synthetic, sentences
    from viscofric.report.texts.friction_tables import measurement_table
    from viscofric.showing import aligned
    from viscofric.study.results.results import open_results

    run_file, study = open_friction_test(folder)
    output = run_file.with_suffix(".results")
    status = 0
    try:
        run_and_report(run_file, output, resume=True, quiet=True)
    except SystemExit as stop:
        if stop.code not in (SOME_CASES_FAILED, NOT_ACCURATE):
            raise
        status = int(stop.code)
    results = open_results(output)
    tree = results.tree
    measurement, agreement, table = group(tree, "measurement"), group(tree, "agreement"), measurement_table(tree)
    said = [] if agreement is None else sentences(agreement.attrs, "sentences")
    assert measurement is not None
    assert table is not None
    if as_json:
        found = {
            "title": study.title,
            "citation": study.citation,
            "licence": study.licence,
            "synthetic": is_synthetic(tree),
            "points": record(measurement),
            "agreement": None if agreement is None else plain(agreement.attrs) | {"sentences": said},
            "by_temperature": None if agreement is None else record(agreement.drop_attrs(deep=False)),
            **listed("warnings", results.warnings),
            **listed("notes", results.notes),
            "report": str(output / "report.html"),
        }
        print_json(found)
        sys.exit(status)
    click.echo(study.title + (" (SYNTHETIC data: nothing was measured)" if is_synthetic(tree) else ""))
    click.echo(f"{study.citation}; licence: {study.licence}\n")
    chosen = [table.headings.index(heading) for heading in _PRINTED if heading in table.headings]
    rows = [table.headings, *table.rows]
    click.echo("\n".join(aligned([row[place] for place in chosen] for row in rows)))
    click.echo("")
    for sentence in said:
        click.echo(sentence)
    print_written(("page", output / "report.html"))
    sys.exit(status)


@as_command("verify")
@click.option("--published", is_flag=True, help="Compare with published results and other programs instead.")
@click.option(
    "--test",
    "folder",
    metavar="FOLDER",
    type=click.Path(path_type=Path),
    help="Predict the friction test in FOLDER instead, and compare point by point.",
)
@click.option("--only", "names", metavar="NAME", multiple=True, help="Run this check or group only; may be repeated.")
@click.option("--list", "listed", is_flag=True, help="List the checks and exit.")
@click.option("--details", is_flag=True, help="Print every comparison, and the reasons of the bounds.")
@click.option("--backend", default="scipy", help="Array and FFT library, e.g. ducc0 or torch:cuda.")
@outputs("Write every comparison as a table (CSV); `-` prints it.", endings=CSV)
def command(
    published: bool,
    folder: Path | None,
    names: tuple[str, ...],
    listed: bool,
    details: bool,
    backend: str,
    out: Path | None,
    as_json: bool,
) -> None:
    """Verify the contact engine on this machine, in less than a minute.

    Each check compares computed values with a closed form, a reference value, or an equivalent computation. Its
    line shows the worst comparison. Exit status 1 if any check fails.

    With --test, FOLDER contains sweeps, measured friction, and a run file with citation and licence. The comparison is
    printed and written as a page.
    """
    if folder is not None:
        if published or names or listed or details or backend != "scipy" or out is not None:
            raise click.UsageError("--test takes a folder and --json only.")
        compare_test(folder, as_json)
        return
    if listed and (as_json or out is not None):
        raise click.UsageError("--list only prints; give it without --json and --out.")
    from viscofric.cli.progress import contact_bar
    from viscofric.verification import CHECKS, run_checks, select
    from viscofric.verification.published import PUBLISHED

    with placed_at("--only"):
        checks = select(PUBLISHED if published else CHECKS, names)
    if listed:
        _list(checks)
        return
    quiet = as_json or out == DASH
    outcomes: list[Outcome] = []
    with contact_bar("", quiet=quiet) as bar:
        for outcome in run_checks(checks, lambda one: bar(len(outcomes), len(checks), one.title), backend):
            outcomes.append(outcome)
            if not quiet:
                click.echo(_line(outcome))
                if details:
                    _print_details(outcome)
    if out is not None:
        found = [outcome.record for outcome in outcomes]
        write_rows(out, [{"check": each["name"], **one} for each in found for one in each["comparisons"]])
    if as_json:
        about: dict[str, Any] = {"backend": backend, "viscofric": version("viscofric")}
        about |= {"passed": all(one.passed for one in outcomes), "seconds": sum(one.seconds for one in outcomes)}
        print_json({**about, "checks": [one.record for one in outcomes]})
    elif out != DASH:
        _print_verdict(outcomes)
    if not all(outcome.passed for outcome in outcomes):
        sys.exit(1)


def _list(checks: tuple[Check, ...]) -> None:
    group = ""
    for check in checks:
        if check.group != group:
            group = check.group
            click.echo(group)
        click.echo(f"  {check.name:<18} {check.title}")
        click.echo(f"  {'':<18} against {check.source}")
        for about, text in check.origin.items():
            click.echo(f"  {'':<18} {about}: {text}")


def _line(outcome: Outcome) -> str:
    """Return one line: name, verdict, time, and numbers of the worst comparison."""
    start = f"{outcome.check.name:<18} {'passed' if outcome.passed else 'FAILED'} {outcome.seconds:6.1f} s"
    worst = outcome.worst
    if outcome.trouble or worst is None:
        return f"{start}  {outcome.trouble or 'nothing to compare'}"
    computed, expected, error, bound = worst.texts
    count = len(outcome.comparisons)
    return (
        f"{start}  {count:3d} compared; worst: {worst.quantity} ({worst.case}): {computed}, expected {expected}, "
        f"error {error}, bound {bound}"
    )


def _print_details(outcome: Outcome) -> None:
    click.echo(f"    {outcome.check.title}; against {outcome.check.source}")
    click.echo(f"    bounds: {outcome.check.reason}")
    for about, text in outcome.check.origin.items():
        click.echo(f"    {about}: {text}")
    for one in outcome.comparisons:
        computed, expected, error, bound = one.texts
        mark = " " if one.passed else "!"
        click.echo(
            f"  {mark} {one.case}, {one.quantity}: {computed}, expected {expected}, error {error}, bound {bound}"
        )


def _print_verdict(outcomes: list[Outcome]) -> None:
    seconds = sum(outcome.seconds for outcome in outcomes)
    count = sum(len(outcome.comparisons) for outcome in outcomes)
    failed = [outcome.check.name for outcome in outcomes if not outcome.passed]
    if failed:
        click.echo(f"{len(failed)} of {len(outcomes)} checks FAILED: {', '.join(failed)}.")
        return
    passed = f"All {len(outcomes)} checks passed" if len(outcomes) > 1 else "The check passed"
    click.echo(f"{passed}, {count} comparisons, in {seconds:.{0 if seconds >= 10.0 else 1}f} s.")
