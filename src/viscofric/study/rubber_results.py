"""A rubber alone: made of its sweeps, with bands, stored like the results of a study, and as files for others."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

from viscofric.notes import records
from viscofric.rheology.cards import CardFormat, CardLaw, write_card
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.study.bands import draw_rubber
from viscofric.study.results import StudyResults, input_hashes, provenance
from viscofric.study.results_file import save_results
from viscofric.study.rubber import make_rubber
from viscofric.study.rubber_labels import rubber_data
from viscofric.study.tables import write_master_curve, write_spectrum

if TYPE_CHECKING:
    from viscofric.rheology.material import Material
    from viscofric.study.material_table import MaterialTable
    from viscofric.study.rubber import Rubber

#: Format of a card -> the end of its file's name.
CARDS: dict[CardFormat, str] = {
    "abaqus": ".inp",
    "ansys": ".mac",
    "ls-dyna": ".k",
    "comsol": ".txt",
    "comsol-branches": ".txt",
    "csv": ".csv",
    "json": ".json",
}
#: The rubber as viscofric itself reads it, lossless.
MATERIAL_FILE = "rubber.json"


def run_material(
    wanted: MaterialTable,
    output: str | Path,
    *,
    title: str = "Rubber",
    command: str = "",
    samples: int = 200,
    synthetic: bool = False,
) -> tuple[StudyResults, Rubber, list[Path]]:
    """Make a rubber and store it: results, material file and tables.

    Parameters
    ----------
    wanted : MaterialTable
        Where the rubber comes from and how it is made.
    output : str or Path
        Folder for the results, made if need be.
    title : str
        Of the report.
    command : str
        What the user called, for the report.
    samples : int
        Draws of the rubber for the bands of E(ω); 0 for none.
    synthetic : bool
        Whether the data were made, not measured.

    Returns
    -------
    results : StudyResults
        With the groups of `viscofric.study.rubber_labels`.
    rubber : Rubber
        The material with what it was made from.
    files : list of Path
        Material file and tables.

    Raises
    ------
    DataFileError, SuperpositionError, InputError
        If a file cannot be read or written, or the sweeps do not give what is asked for.
    """
    import xarray

    folder = Path(output)
    hashes = input_hashes(wanted.inputs)
    rubber = make_rubber(wanted, liquids=True)
    draws = draw_rubber(rubber, samples)
    tree = xarray.DataTree.from_dict(rubber_data(rubber, draws))
    tree.attrs = {
        "title": title,
        "data_origin": "synthetic" if synthetic else "measured",
        "command": command,
        "notes": json.dumps(records([*rubber.notes, *(draws.notes if draws is not None else ())]), ensure_ascii=False),
        "warnings": "[]",
        "failures": "[]",
        **rubber.attributes,
        "input_hashes": hashes,
        **provenance(),
    }
    save_results(tree, folder)
    return StudyResults(tree, folder), rubber, _files(rubber, folder)


def _files(rubber: Rubber, folder: Path) -> list[Path]:
    material = rubber.material
    written = [folder / MATERIAL_FILE]
    write_card(material, written[0], format="json")
    if rubber.fit is not None:
        rubber.fit.shift_factors.save(folder / "shift_factors.csv")
        written.append(folder / "shift_factors.csv")
    curve = rubber.master_curve if rubber.fit is None else rubber.fit.master_curve
    if curve is not None:
        written.append(write_master_curve(curve, folder / "master_curve.csv"))
    if isinstance(material.spectrum, RetardationSpectrum):
        written.append(write_spectrum(material.spectrum, folder / "spectrum.csv"))
    return written


def write_program_card(material: Material, folder: Path, form: CardFormat, law: CardLaw | None = None) -> Path:
    """Write a rubber for a program into a folder, in a file named after the program; see `write_card`.

    Raises
    ------
    InputError
        If the format cannot hold the rubber.
    DataFileError
        If the file cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    return write_card(material, folder / f"rubber_{form.replace('-', '_')}{CARDS[form]}", format=form, law=law)
