"""What the results of a study rest on: all of its parts, as its run file and its groups name them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from viscofric.contact.layers import Layer
from viscofric.files import parse_toml
from viscofric.literature import basis as parts
from viscofric.rheology.catalogue import catalogue_material
from viscofric.rheology.shifts.laws import VFT, WLF, Arrhenius, InversePolynomial, ParametricLaw, WLFArrhenius

if TYPE_CHECKING:
    import xarray

    from viscofric.study import StudyResults

_LAWS: tuple[type[ParametricLaw], ...] = (WLF, Arrhenius, VFT, WLFArrhenius, InversePolynomial)


def study_basis(results: StudyResults) -> parts.Basis:
    """Yield the references that a study, or a rubber alone, rests on, each with what for.

    Parameters
    ----------
    results : StudyResults
    """
    tables = parse_toml(str(results.tree.attrs.get("study_text", "")))
    given = tables.get("material", {})
    rubbers = given if isinstance(given, list) else [given]
    for rubber, found in zip(rubbers, results.materials.values(), strict=True):
        yield from _rubber(rubber, found)
    if "indenter" in tables:
        yield from parts.solved_contact(line=tables["indenter"].get("shape") == "cylinder")
    if "surface" in tables:
        yield from parts.solved_surface()
    if "layer" in tables:
        yield from parts.basis(Layer(1.0))
    yield from _friction(results.tree)


def _rubber(table: dict[str, Any], found: xarray.DataTree) -> parts.Basis:
    if "catalogue" in table:
        yield from parts.basis(catalogue_material(table["catalogue"]))
        return
    if "superposition" in found.children:
        yield from parts.superposed_sweeps()
    yield from parts.modes(table.get("spectrum", "non-negative") if "master_curve" in found.children else "")
    if "shift_law" in found.children and table.get("shift", "measured") != "measured":
        used = found["shift_law"].attrs["law"]
        yield from parts.shifted_by(next(law for law in _LAWS if law.title == used))
    if table.get("shift") == "best":
        yield from parts.compared_laws()


def _friction(tree: xarray.DataTree) -> parts.Basis:
    groups = tree.children
    if "prediction" in groups and "friction_lower" in groups["prediction"].data_vars:
        yield from parts.banded_friction()
    if "measurement" in groups and "coulomb" in groups["measurement"].data_vars:
        yield from parts.separated_friction()
    if "measurement_master" in groups:
        yield from parts.shifted_friction(found="friction_shift_factors" in groups)
    elif "prediction_master" in groups:
        yield from parts.one_curve()
