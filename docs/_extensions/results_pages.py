"""The layout of results.nc as Markdown: groups, variables, dimensions and units of studies that are run for it."""

from __future__ import annotations

import re
import shutil
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from page_parts import SOURCE, cell, digest, is_made_of, made_of, table, write

import viscofric

if TYPE_CHECKING:
    import xarray

    from viscofric.study.results.results import StudyResults

#: Groups that are alike for every number in their name.
_NUMBERED = re.compile(r"^/(fields|materials)/\d+")
_WORDS = {
    "/": "The study; attributes only.",
    "/isotherms": "The measured moduli (tensile) that were used.",
    "/ramps": "Temperature ramps (tensile) with α(T) at every point, and the peaks of tan δ and E''.",
    "/shift_factors": "log10 α of each isotherm.",
    "/superposition": "Validity of superposition: the checks, in numbers and sentences.",
    "/master_curve": "The isotherms shifted to the reference temperature, and the fit at the same points.",
    "/laws": "Comparison of all shift laws.",
    "/shift_law": "The law that is used, or the best one, over the same temperatures.",
    "/spectrum": "The retardation spectrum at the reference temperature.",
    "/spectrum_curve": "Its storage and loss modulus over a wider range, with the 95 % band.",
    "/prediction": "All cases over the axes that have more than one point; the others are scalar coordinates.",
    "/prediction_master": "Friction at the reference temperature over the reduced speeds α(T)·v.",
    "/measurement": "The separated measurement, and the prediction at the same points.",
    "/measurement_master": "Measured friction over the reduced speed, at the load of the master curve.",
    "/friction_shift_factors": "log10 α found from the measured friction alone, beside that of the material.",
    "/interface": "With a fitted `[interface]`: shear stress at the measured points.",
    "/interface_law": "Its law at the reference temperature.",
    "/heating": "With `[heating]`: the cases at the temperatures to which their own friction heats them.",
    "/temperature_map": "Its warmest contact: rise of temperature of the rubber's face.",
    "/agreement": "Prediction against measurement, at each temperature.",
    "/assumptions": "Assumptions of the predictions, and their checks.",
    "/history": "With `[history]`: the cases over time; with `[heating]`, also their rise of temperature.",
    "/fields/<n>": "Pressure and displacement of the case with the number n, if they were kept.",
    "/materials/<n>/…": "For several materials, the groups of each from `/isotherms` to `/spectrum_curve`.",
}


def example(folder: Path) -> StudyResults:
    """Run the built-in example at two speeds, so coarse that it takes seconds."""
    for file in (SOURCE / "example").iterdir():
        shutil.copy(file, folder)
    study = folder / "study.toml"
    text = re.sub(r"\bpoints = \d+", "points = 2", study.read_text(encoding="utf-8"), count=1)
    text = re.sub(r"(?m)^accuracy = .*$", "accuracy = 0.1\nmaster_curve_points = 3", text)
    study.write_text(text, encoding="utf-8")
    runs = folder / "mtm.csv"
    lines = runs.read_text(encoding="utf-8").splitlines(keepends=True)
    others = ("9.", "10.", "19.", "20.", "29.", "30.", "89.", "90.")  # °C: two temperatures of six are enough
    runs.write_text("".join(line for line in lines if not line.startswith(others)), encoding="utf-8")
    return viscofric.run_study(study)


def section(name: str, group: xarray.Dataset) -> str:
    """Return the section of one group."""
    rows = [
        [
            f"`{variable}`" + (" (coordinate)" if variable in group.coords else ""),
            ", ".join(f"`{dimension}`" for dimension in values.dims) or "one value",
            cell(values.attrs.get("units", "")),
            cell(values.attrs.get("long_name", "")),
        ]
        for variable, values in group.variables.items()
    ]
    shown = [f"## `{name}`", _WORDS[name]]
    if rows:
        shown.append(table(["variable", "dimensions", "unit", "meaning"], rows, numbers=False))
    if group.attrs:
        shown.append("Attributes: " + ", ".join(f"`{attribute}`" for attribute in group.attrs) + ".")
    return "\n\n".join(shown)


def page(results: StudyResults) -> str:
    """Return all groups, numbered ones once."""
    shown = {}
    for group in results.tree.subtree:
        name = _NUMBERED.sub(r"/\1/<n>", group.path)
        if group.ds.variables or group.ds.attrs:
            shown.setdefault(name, section(name, group.to_dataset(inherit=False)))
    shown["several"] = "## `/materials/<n>/…`\n\n" + _WORDS["/materials/<n>/…"]
    return "\n\n".join(shown.values())


def generate() -> None:
    """Write the page's tables if the code has changed."""
    state = digest("study", "example")
    if is_made_of("results", state):
        return
    with tempfile.TemporaryDirectory() as folder:
        write("results.md", page(example(Path(folder))))
    made_of("results", state)
