"""A material alone: made from its sweeps, with bands, stored like the results of a study, and as files for others."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from viscofric.data import IsothermalSweeps, MasterCurve
from viscofric.files import write_atomically
from viscofric.notes import dumped, records
from viscofric.rheology.cards import CardFormat, CardLaw, write_card
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.step_tests import StepMasterCurve
from viscofric.study.make_rubber import called_synthetic, make_rubber
from viscofric.study.results.file import save_results
from viscofric.study.results.results import StudyResults, input_hashes, provenance
from viscofric.study.rubber import Rubber
from viscofric.study.rubber_datasets import rubber_groups
from viscofric.study.run_file.material import MaterialTable
from viscofric.study.study_rubber import draw_rubber, no_samples
from viscofric.units import CELSIUS_ZERO, celsius, shown_celsius

#: Format of a card -> the end of its file's name.
CARDS: dict[CardFormat, str] = {
    "abaqus": ".inp",
    "ansys": ".mac",
    "ls-dyna": ".k",
    "comsol": ".txt",
    "comsol-branches": ".txt",
    "json": ".json",
}
#: The rubber as viscofric itself reads it, lossless.
MATERIAL_FILE = "rubber.json"


def run_material(
    table: MaterialTable,
    output: str | Path,
    *,
    title: str = "Rubber",
    command: str = "",
    samples: int = 200,
    synthetic: bool = False,
) -> tuple[StudyResults, Rubber, list[Path]]:
    """Make a material and store it: results with its groups, the material, and its files (material file and tables)."""
    import xarray

    folder = Path(output)
    hashes = input_hashes(table.inputs)
    rubber = make_rubber(table, liquids=True)
    rubber = called_synthetic(rubber) if synthetic else rubber
    draws = draw_rubber(rubber, samples)
    missing = no_samples(rubber, "The modulus has") if samples and draws is None else ()
    tree = xarray.DataTree.from_dict(rubber_groups(rubber, draws))
    tree.attrs = {
        "title": title,
        "data_origin": "synthetic" if rubber.synthetic else "measured",
        "command": command,
        "notes": dumped(records([*rubber.notes, *(missing if draws is None else draws.notes)])),
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
    fit = rubber.superposed
    if fit is not None:
        fit.shift_factors.save(folder / "shift_factors.csv")
        written.append(folder / "shift_factors.csv")
    curve = rubber.master_curve if rubber.fit is None else rubber.fit.master_curve
    if curve is not None:
        written.append(write_master_curve(curve, folder / "master_curve.csv"))
    if rubber.step_curve is not None:
        name = "master_curve.csv" if curve is None else "step_master_curve.csv"
        written.append(write_step_master_curve(rubber.step_curve, folder / name))
    if isinstance(material.spectrum, RetardationSpectrum):
        written.append(write_spectrum(material.spectrum, folder / "spectrum.csv"))
    if material.synthetic:
        for path in written[1:]:  # the first says so itself
            write_atomically(path, b"# SYNTHETIC, not measured\n" + path.read_bytes())
    return written


def write_program_card(material: Material, folder: Path, form: CardFormat, law: CardLaw | None = None) -> Path:
    """Write a material for a program into a folder, in a file named after the program; see `write_card`."""
    folder.mkdir(parents=True, exist_ok=True)
    return write_card(material, folder / f"rubber_{form.replace('-', '_')}{CARDS[form]}", format=form, law=law)


def write_sweeps(sweeps: IsothermalSweeps, path: str | Path) -> Path:
    """Write sweeps (moduli as measured, MPa, headed E or G) as a table for `read_dma`, without strain amplitudes."""
    letter = "G" if sweeps.deformation == "shear" else "E"
    headings = ["temperature (degC)", "frequency (Hz)", f"{letter}' (MPa)", f"{letter}'' (MPa)"]
    rows = (
        (celsius(one.temperature), frequency / (2 * math.pi), storage / 1e6, loss / 1e6)
        for one in sweeps.isotherms
        for frequency, storage, loss in zip(one.angular_frequency, one.storage_modulus, one.loss_modulus, strict=True)
    )
    return _write(path, headings, rows)


def write_master_curve(curve: MasterCurve, path: str | Path) -> Path:
    """Write a master curve: reduced angular frequency, tensile moduli, and the isotherm of each point."""
    headings = ["reduced angular frequency (rad/s)", "E' (Pa)", "E'' (Pa)", "isotherm (degC)"]
    columns = (curve.angular_frequency, curve.storage_modulus, curve.loss_modulus, curve.temperature - CELSIUS_ZERO)
    remark = f"reference temperature {shown_celsius(curve.reference, 'z.6g')} degC"
    return _write(path, headings, np.column_stack(columns), remark)


def write_step_master_curve(curve: StepMasterCurve, path: str | Path) -> Path:
    """Write a creep or relaxation master curve: reduced time, tensile response, and the isotherm of each point."""
    response = "creep compliance (1/Pa)" if curve.kind == "creep" else "relaxation modulus (Pa)"
    columns = (curve.time, curve.response, curve.temperature - CELSIUS_ZERO)
    remark = f"reference temperature {shown_celsius(curve.reference, 'z.6g')} degC"
    return _write(path, ["reduced time (s)", response, "isotherm (degC)"], np.column_stack(columns), remark)


def write_spectrum(spectrum: RetardationSpectrum, path: str | Path) -> Path:
    """Write the retardation modes: 1/E(ω) = 1/E_inf + Σ C/(1 + iωτ)."""
    remark = f"E0 = {spectrum.E0!r} Pa, E_inf = {spectrum.E_inf!r} Pa; 1/E = 1/E_inf + sum of C/(1 + i omega tau)"
    return _write(path, ["retardation time tau (s)", "C (1/Pa)"], np.column_stack((spectrum.tau, spectrum.C)), remark)


def _write(
    path: str | Path, headings: Sequence[str], rows: Iterable[Sequence[float]], remark: str | None = None
) -> Path:
    """Write rows with all significant digits."""
    text = io.StringIO()
    if remark is not None:
        text.write(f"# {remark}\n")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(headings)
    writer.writerows([f"{float(number):.10g}" for number in row] for row in rows)
    target = Path(path)
    write_atomically(target, text.getvalue().encode())
    return target
