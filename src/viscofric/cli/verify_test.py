"""``viscofric verify --test FOLDER``: a friction test, predicted from its sweeps and compared point by point."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from viscofric.cli.errors import reported_errors
from viscofric.cli.output import print_json
from viscofric.notes import listed

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


def compare_test(folder: Path, as_json: bool) -> None:
    """Run the study of a friction test, and print every point with the errors of both."""
    from viscofric.cli.run import NOT_ACCURATE, SOME_CASES_FAILED, run_and_report
    from viscofric.datasets import plain, record
    from viscofric.report.results import group, is_synthetic, sentences
    from viscofric.report.texts.friction_tables import measurement_table
    from viscofric.report.texts.tables import aligned
    from viscofric.study.friction_test import open_friction_test
    from viscofric.study.results.results import open_results

    with reported_errors():
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
    click.echo(f"page     {output / 'report.html'}")
    sys.exit(status)
