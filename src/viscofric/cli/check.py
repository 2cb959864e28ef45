"""``viscofric check``: whether anything is wrong with a run file, and how many cases it has; or with stored results."""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.commands import as_command
from viscofric.cli.errors import print_doubtful_checks, print_notes
from viscofric.cli.output import outputs, print_json
from viscofric.cli.rubber_options import tree_of
from viscofric.notes import listed

if TYPE_CHECKING:
    from viscofric.friction.cases.surfaces import SurfaceSource
    from viscofric.study.cases.sweep import Axis
    from viscofric.study.checking import CheckedStudy
    from viscofric.study.rubber import Rubber

_STDIN = Path("standard input")
# Axes that are not listed when they stand alone: the materials are listed, and one sample is the best estimate.
_NOT_SHOWN = {"material", "sample"}
#: Points in the shortest wave of a surface from which its contacts are resolved (docs/guide/surfaces.md).
_ENOUGH_POINTS = 8
_PLURAL = {"radius": "radii", "radius x": "radii x", "radius y": "radii y", "thickness": "thicknesses"}


@as_command("check", reader="run_file")
@click.argument("study", metavar="[STUDY|-]", required=False, type=click.Path(path_type=Path, allow_dash=True))
@click.option(
    "--results",
    metavar="FOLDER",
    type=click.Path(path_type=Path, file_okay=False),
    help="Results folder to check instead of STUDY: compare every stored contact, and results.nc, with its checksum.",
)
@outputs()
def command(study: Path | None, results: Path | None, as_json: bool) -> None:
    """Validate a run file and its data files, and estimate the work; nothing is solved.

    All errors are reported at once, each with its location. With - the run file is read from standard input, and
    data files are looked for in the current folder. With --results, check stored results for damage instead; exit
    status 1 if a file is damaged.
    """
    if (study is None) == (results is None):
        raise click.UsageError("give a run file, or --results with a folder of results.")
    if results is not None:
        _check_results(results, as_json)
        return
    assert study is not None
    if study.is_dir():
        named = sorted(study.glob("*.toml"))
        such = f" such as {named[0]}" if named else ""
        raise click.UsageError(f"{study} is a folder; give a run file{such}, or --results {study} for stored results.")
    from viscofric.study.checking import check_study
    from viscofric.study.run_file.study import decoded, parse_study, read_study_text

    if str(study) == "-":
        study = _STDIN
        text = decoded(sys.stdin.buffer.read(), study)
    else:
        text = read_study_text(study)
    found = check_study(parse_study(text, study), study)
    record = _record(found, study)
    if as_json:
        print_json(record)
        return
    for word, line in _lines(found, record, study):
        click.echo(f"{word:10} {line}")
    print_notes(found.notes, "run_file")
    for rubber in found.rubbers:
        print_doubtful_checks(tree_of(rubber))


def _check_results(folder: Path, as_json: bool) -> None:
    """Say which files of a folder of results are damaged; exit status 1 if any is."""
    from viscofric.study.running.folder import check_results

    found = check_results(folder)
    if as_json:
        record = {
            "results": str(folder),
            "cases": found.cases,
            "finished": found.finished,
            "damaged": {str(path): reason for path, reason in found.damaged.items()},
        }
        print_json(record)
    else:
        files = found.cases + found.finished
        click.echo(f"contacts   {found.cases} stored")
        click.echo(f"results    {'results.nc' if found.finished else 'not written yet'}")
        click.echo(f"checksums  {files - len(found.damaged)} of {files} files match")
        for path, reason in found.damaged.items():
            click.echo(f"Damaged: {path}: {reason}", err=True)
    if found.damaged:
        sys.exit(1)


def _record(found: CheckedStudy, path: Path) -> dict[str, Any]:
    """Return what was found, in plain types."""
    study, sweep = found.study, found.sweep
    made = zip(found.rubbers, study.materials, strict=True)
    extra = [form for form in ("csv", "excel") if form in study.outputs.formats]
    return {
        "study": str(path),
        "title": study.title,
        "materials": [_of_rubber(rubber, material.name) for rubber, material in made],
        "indenter": study.body.shape,
        "surface": _of_surface(getattr(sweep.cases[0], "surface", None)),
        "axes": {axis.name: {name: list(values) for name, values in axis.columns.items()} for axis in sweep.axes},
        "cases": len(sweep.cases),
        "master_curve_points": found.master_curve_points,
        "measured_points": None if found.measured is None else len(found.measured.speed),
        "expected": {
            "solves": found.expected.solves,
            "seconds": found.expected.seconds,
            "memory_per_process": found.expected.memory_per_process,
            **{name: {"contacts": count, "seconds": seconds} for name, (count, seconds) in found.singles.items()},
        },
        "outputs": ["netcdf", "figures", "report", *extra],
        **listed("notes", found.notes),
    }


def _of_surface(source: SurfaceSource | None) -> dict[str, Any] | None:
    if source is None:
        return None
    from viscofric.friction.cases.surfaces import surface_of

    surface, shortest = surface_of(source), source.wavelengths[0]
    step = max(one for one, count in zip(surface.spacing, surface.shape, strict=True) if count > 1)
    return {
        "points": list(surface.shape),
        "spacing": step,
        "rms_height": float(surface.z.std()),
        "points_in_shortest_wave": shortest / step,
    }


def _of_rubber(rubber: Rubber, name: str) -> dict[str, Any]:
    from viscofric.report.texts.checks import all_checks
    from viscofric.rheology.spectra.retardation import RetardationSpectrum

    spectrum = rubber.material.spectrum
    measured = [one for one in (rubber.sweeps, rubber.step_tests) if one is not None]
    return {
        "name": name or rubber.material.name,
        "isotherms": sum(map(len, measured)) if measured else None,
        "modes": len(spectrum.C) if isinstance(spectrum, RetardationSpectrum) else None,
        "reference_temperature": rubber.material.reference,
        "shift": rubber.shift_used or None,
        "synthetic": rubber.synthetic,
        "checks": [check.record("run_file") for check in all_checks(tree_of(rubber))],
    }


def _lines(found: CheckedStudy, record: dict[str, Any], path: Path) -> list[tuple[str, str]]:
    """Return what was found, for people: a word and a line each."""
    from viscofric.study.results.export import NAMES

    lines = [("run file", f"{path}: no errors in run file and data")]
    lines += [("material", _material_line(made)) for made in record["materials"]]
    if record["surface"] is not None:
        lines.append(("surface", _surface_line(record["surface"])))
    if record["measured_points"] is not None:
        lines.append(("measured", f"{record['measured_points']} points of friction"))
    line = found.study.body.LINE
    shown = [
        columns
        for name, columns in record["axes"].items()
        if name not in _NOT_SHOWN or (name == "sample" and len(columns[name]) > 1)
    ]
    lines += [("axis", _axis_line(columns, line)) for columns in shown]
    points = [_points(axis) for axis in found.sweep.axes if len(axis) > 1]
    product = f" = {' × '.join(points)}" if len(points) > 1 else ""
    lines.append(("cases", f"{record['cases']:,}{product}"))
    more = [f"{record['master_curve_points']} along the friction master curve"] if record["master_curve_points"] else []
    if record["measured_points"] is not None:
        more.append(f"{record['measured_points']} at the measured points")
    if more:
        lines.append(("also", ", ".join(more)))
    expected = record["expected"]
    effort = f"{duration(expected['seconds'])} on one core, {_bytes(expected['memory_per_process'])} for each process"
    lines.append(("to solve", f"about {_rounded(expected['solves'])} contacts: {effort}"))
    for name, noun in (("heating", "heated contacts"), ("histories", "contacts over time"), ("impacts", "impacts")):
        if name in expected:
            one = expected[name]
            lines.append(("also", f"{one['contacts']:,} {noun}: {duration(one['seconds'])} on one core"))
    if (cluster := found.study.cluster) is not None:
        lines.append(("cluster", f"{cluster.jobs} jobs of {cluster.cores} cores and {_bytes(cluster.memory)}"))
    files = ["results.nc", "figures", "report.html"]
    files += [NAMES[form] for form in record["outputs"][3:]]
    lines.append(("writes", f"{path.with_suffix('.results')}: {', '.join(files)}"))
    return lines


def _rounded(number: float, digits: int = 2) -> str:
    """Return a rough number, with no more digits than it deserves."""
    if number < 10**digits:
        return f"{number:.0f}"
    return f"{round(number, digits - 1 - math.floor(math.log10(number))):,.0f}"


def duration(seconds: float) -> str:
    """Return a rough time."""
    for unit, size, least in (("days", 86400.0, 2.0), ("hours", 3600.0, 2.0), ("minutes", 60.0, 2.0)):
        if seconds >= least * size:
            return f"about {_rounded(seconds / size)} {unit}"
    return "about a second" if seconds < 1.5 else f"about {_rounded(seconds)} seconds"


def _bytes(number: float) -> str:
    return f"{number / 1e9:.1f} GB" if number >= 1e9 else f"{_rounded(number / 1e6)} MB"


def _surface_line(surface: dict[str, Any]) -> str:
    from viscofric.report.texts.numbers import length

    points = " × ".join(str(count) for count in surface["points"])
    waves = surface["points_in_shortest_wave"]
    few = f"; {_ENOUGH_POINTS} or more are needed" if round(waves, 6) < _ENOUGH_POINTS else ""
    step, height = (length(surface[name]) for name in ("spacing", "rms_height"))
    return f"{points} points of {step}, rms height {height}, {waves:.2g} points in the shortest wave{few}"


def _material_line(made: dict[str, Any]) -> str:
    parts = [made["name"] or "the rubber"]
    if made["isotherms"] is not None:
        parts.append(f"{made['isotherms']} isotherms")
    parts.append(f"{made['modes']} retardation modes")
    return ", ".join(parts) + (", SYNTHETIC" if made["synthetic"] else "")


def _points(axis: Axis) -> str:
    """Say how many points an axis has: 3 loads; of one that is stepped together, by the first of them."""
    names = [name.replace("_", " ") for name in axis.columns]
    together = f" with {' and '.join(names[1:])}" if len(names) > 1 else ""
    return f"{len(axis):,} {_PLURAL.get(names[0], names[0] + 's')}{together}"


def _axis_line(columns: dict[str, list[Any]], line: bool) -> str:
    listed = ", ".join(f"{name} {_span(name, values, line)}" for name, values in columns.items())
    points = len(next(iter(columns.values())))
    return listed if points == 1 else f"{listed} ({points:,})"


def _span(name: str, values: list[Any], line: bool) -> str:
    if name == "material":
        return ", ".join(values)
    if name == "sample":
        return f"0 (the best estimate) to {values[-1]}"
    from viscofric.study.cases.sweep import shown

    return " to ".join(shown(name, value, line) for value in dict.fromkeys((values[0], values[-1])))
