"""The report: one HTML page that needs nothing else, made from a study's results."""

from __future__ import annotations

import base64
import itertools
import re
import shlex
from collections.abc import Mapping
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

from viscofric.datasets import DataTree
from viscofric.files import write_atomically
from viscofric.notes import Reader, notes_in, table_in
from viscofric.report.captions import captions
from viscofric.report.figures.study import RUBBER_FIGURES, figure_images, save_images
from viscofric.report.results import group, is_synthetic, rubbers, sentences
from viscofric.report.texts.checks import all_checks, counted
from viscofric.report.texts.friction_tables import agreement_table, detail_tables, friction_at_a_glance
from viscofric.report.texts.study import grouped_failures, inputs, key_numbers, scope

_HERE = Path(__file__).parent
_MOST_KINDS_OF_FAILURE = 20
_PIXELS_PER_POINT = 1.45


def write_figures_and_report(tree: DataTree, folder: str | Path) -> tuple[list[Path], Path]:
    """Draw a study's figures once, for files of their own and for the report.

    Parameters
    ----------
    tree : xarray.DataTree
        Results of a study.
    folder : str or Path
        Where ``report.html`` goes, and ``figures`` with the figures; see `draw_figures` and `write_report`.

    Returns
    -------
    figures : list of Path
    report : Path

    Raises
    ------
    DataFileError
        If a file cannot be written.
    """
    images = figure_images(tree)
    return save_images(images, Path(folder) / "figures"), write_report(tree, folder, images=images)


def write_report(tree: DataTree, folder: str | Path, *, images: dict[str, dict[str, bytes]] | None = None) -> Path:
    """Write the report of a study as one HTML file that loads nothing from elsewhere.

    Parameters
    ----------
    tree : xarray.DataTree
        Results of a study; the same results give the same bytes.
    folder : str or Path
        Where ``report.html`` goes; made if need be.  A report that is there is replaced.
    images : dict, optional
        The figures, as `viscofric.report.figures.study.figure_images` returns them; drawn here if not given.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    DataFileError
        If it cannot be written.
    """
    import jinja2

    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(_HERE),
        autoescape=True,
        finalize=_printable,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    page = environment.get_template("report.html").render(_content(tree, images or figure_images(tree, ("svg",))))
    path = Path(folder) / "report.html"
    write_atomically(path, page.encode("utf-8", errors="replace"))
    return path


def _words(attributes: Mapping[Any, Any], name: str, reader: Reader) -> list[str]:
    return [one.words(reader) for one in notes_in(attributes, name)]


def _content(tree: DataTree, images: dict[str, dict[str, bytes]]) -> dict[str, Any]:
    """Gather what the page shows, as texts."""
    attrs = {name: str(value) for name, value in tree.attrs.items()}
    spectrum, agreement = group(tree, "spectrum"), group(tree, "agreement")
    checks = all_checks(tree)
    reader: Reader = "run_file" if attrs.get("study_text") else "shell"  # of a command that takes no run file
    (_, answer), *others = _figures(tree, images)
    return {
        "title": attrs.get("title") or "Viscoelastic friction",
        "synthetic": is_synthetic(tree),
        "created": _moment(attrs.get("created", "")),
        "version": attrs.get("viscofric_version", ""),
        "scope": scope(tree),
        "inputs": inputs(tree),
        "key_numbers": key_numbers(tree),
        "glance": friction_at_a_glance(tree),
        "agreement": agreement_table(tree),
        "agreement_words": [] if agreement is None else sentences(agreement.attrs, "sentences"),
        "statements": _words({} if spectrum is None else spectrum.attrs, "statements", reader),
        "checks": [check.record(reader) for check in checks],
        "verdicts": counted(checks),
        "answer_figures": answer,
        "figure_groups": [(heading, found) for heading, found in others if found],
        "tables": detail_tables(tree),
        "failures": grouped_failures(notes_in(tree.attrs, "failures"), _MOST_KINDS_OF_FAILURE),
        "warnings": _words(tree.attrs, "warnings", reader),
        "notes": _words(tree.attrs, "notes", reader),
        "command": attrs.get("command") or f"viscofric run {shlex.quote(attrs.get('study_file') or 'study.toml')}",
        "study_text": attrs.get("study_text", ""),
        "software": table_in(tree.attrs, "software"),
        "hashes": table_in(tree.attrs, "input_hashes"),
        "style": (_HERE / "report.css").read_text(encoding="utf-8"),
    }


#: Figures beside the key numbers.
_ANSWER = ("friction_against_speed", "friction_sweep", "friction_map")


def _groups(tree: DataTree) -> list[tuple[str, tuple[str, ...]]]:
    """Return all other figures in groups, as they follow each other."""
    found = [
        ("Friction", ("friction_master_curve", "coulomb_friction", "friction_shift_factors")),
        ("Interface", ("friction_parts", "shear_stress")),
        ("Heating", ("heated_friction", "heated_parts", "temperature_map")),
        ("Contact", ("contacts",)),
        ("Contacts over time", ("contacts_over_time", "impacts")),
        ("Material", tuple(RUBBER_FIGURES)),
    ]
    for place, (rubber, _) in enumerate(rubbers(tree), 1):
        found.append((f"Material: {rubber}", tuple(f"{name}_{place}" for name in RUBBER_FIGURES)))
    return [*found, ("Calculation", ("convergence",))]


def _figures(tree: DataTree, images: dict[str, dict[str, bytes]]) -> list[tuple[str, list[dict[str, Any]]]]:
    """Return the figures that were drawn, those beside the key numbers first, numbered in the order of the page."""
    said, number = captions(tree), itertools.count(1)

    def shown(name: str) -> dict[str, Any]:
        svg = images[name]["svg"]
        # shown as an image, its names and styles stay its own
        source = "data:image/svg+xml;base64," + base64.b64encode(svg).decode("ascii")
        return {"name": name, "number": next(number), "caption": said[name], "source": source, "width": _width(svg)}

    groups = [("", _ANSWER), *_groups(tree)]
    return [(heading, [shown(name) for name in names if name in images]) for heading, names in groups]


def _width(svg: bytes) -> int:
    """Return the width at which the letters of a figure are as large as those of its caption, CSS pixels."""
    points = re.search(rb'<svg[^>]*\swidth="([\d.]+)pt"', svg)
    return round(_PIXELS_PER_POINT * float(points[1])) if points else 0


def _moment(text: str) -> str:
    """Return a time in ISO format as readers write it."""
    try:
        moment = datetime.fromisoformat(text)
    except ValueError:
        return text
    return moment.strftime("%Y-%m-%d %H:%M") + (" UTC" if moment.utcoffset() == timedelta(0) else "")


def _printable(value: Any) -> Any:
    """Leave out control characters, which HTML forbids, of text that is not yet markup."""
    return re.sub(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f]", "", value) if type(value) is str else value
