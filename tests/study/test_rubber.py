"""The rubber of a run file: whatever it is made from, and what is wrong with it goes with it."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from rheology.planted import liquid_modulus, write_moduli
from viscofric.errors import DataFileError, InputError, LiquidError
from viscofric.friction.identification.result import with_origin
from viscofric.notes import codes
from viscofric.study.make_rubber import make_rubber
from viscofric.study.rubber_datasets import rubber_groups
from viscofric.study.rubber_results import run_material
from viscofric.study.run_file.material import MaterialTable
from viscofric.study.run_file.study import validated

REFERENCE = {"reference_temperature": "30 degC"}


@pytest.fixture(scope="module")
def sweeps(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write sweeps of a standard linear solid with a WLF shift, free of noise; return the file."""
    path = tmp_path_factory.mktemp("sweeps") / "dma.csv"
    rubber = vf.Material(
        vf.Material.standard_linear_solid("2 MPa", "200 MPa", "1 ms").spectrum, vf.WLF(8.0, 120.0, "30 degC")
    )
    return write_moduli(path, rubber.complex_modulus, range(-10, 61, 5), np.geomspace(0.1, 100.0, 13))


def rubber(**asked: Any) -> Any:
    return make_rubber(validated(MaterialTable, asked))


def test_a_material_is_synthetic_where_the_catalogue_or_a_file_says_so(sweeps: Path, tmp_path: Path) -> None:
    own = vf.Material.standard_linear_solid("2 MPa", "200 MPa", "1 ms")
    for material, synthetic in ((own, False), (vf.synthetic_fluoroelastomer(), True)):
        vf.write_card(material, tmp_path / "card.json", format="json")
        assert rubber(file=str(tmp_path / "card.json")).synthetic is synthetic
    plain = sweeps.read_text(encoding="utf-8")
    for remark, synthetic in (("", False), ("# SYNTHETIC data\n", True), ("# a synthetic rubber, measured\n", False)):
        (tmp_path / "dma.csv").write_text(remark + plain, encoding="utf-8")
        assert rubber(dma=str(tmp_path / "dma.csv"), **REFERENCE).synthetic is synthetic


def test_the_reference_is_the_middle_isotherm_unless_it_is_given(sweeps: Path) -> None:
    made, given = rubber(dma=str(sweeps)), rubber(dma=str(sweeps), reference_temperature="25 degC")  # −10 to 60 °C
    taken = next(note for note in made.notes if note.code == "reference-taken")
    assert taken.values["temperature"] == made.material.reference == pytest.approx(given.material.reference, abs=1e-9)
    assert "reference-taken" not in codes(given.notes)
    np.testing.assert_allclose(made.fit.shift_factors.log10_values, given.fit.shift_factors.log10_values, atol=1e-9)


def test_a_temperature_without_isotherms_is_refused_before_they_are_superposed(
    sweeps: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viscofric.study.make_rubber.superpose", lambda *_, **__: pytest.fail("superposed"))
    with refused("outside-measured"):
        make_rubber(validated(MaterialTable, {"dma": str(sweeps)}), temperatures=[300.0, 400.0])


def test_given_factors_are_used_as_they_are(sweeps: Path, tmp_path: Path) -> None:
    law = vf.WLF(8.0, 120.0, "30 degC")
    kelvin = np.arange(-10.0, 61.0, 5.0) + 273.15
    vf.ShiftFactors(kelvin, law.log10(kelvin), 303.15).save(tmp_path / "alpha.csv")
    made = rubber(dma=str(sweeps), shift_factors=str(tmp_path / "alpha.csv"), **REFERENCE)
    assert made.shift_origin == "given"
    np.testing.assert_allclose(made.fit.shift_factors.log10_values, law.log10(kelvin), atol=1e-12)
    # The curves of one solid, shifted by the truth, join to what linear interpolation between points misses.
    assert made.fit.quality.joint < 0.01


@pytest.mark.slow
def test_headings_and_sheet_are_keys_of_the_run_file(sweeps: Path, tmp_path: Path) -> None:
    strange = tmp_path / "strange.csv"
    strange.write_text(sweeps.read_text(encoding="utf-8").replace("frequency", "v1"), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        rubber(dma=str(strange), **REFERENCE)
    assert caught.value.field == "material.columns"
    columns = {"frequency": "v1 (Hz)"}
    found, known = rubber(dma=str(strange), columns=columns, **REFERENCE), rubber(dma=str(sweeps), **REFERENCE)
    assert np.array_equal(found.material.spectrum.C, known.material.spectrum.C)
    with pytest.raises(InputError) as caught:
        rubber(dma=str(sweeps), sheet="run 1", **REFERENCE)
    assert caught.value.code == "no-sheet"
    with pytest.raises(InputError):
        rubber(catalogue="synthetic fluoroelastomer", columns=columns)


@pytest.fixture(scope="module")
def ramps(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write synthetic ramps at two frequencies; return the file."""
    path = tmp_path_factory.mktemp("ramps") / "ramps.csv"
    return write_moduli(path, vf.synthetic_fluoroelastomer().complex_modulus, range(-5, 91, 2), (1.0, 10.0))


def test_a_material_is_made_of_ramps(ramps: Path) -> None:
    made = rubber(ramps=str(ramps), shift="wlf", **REFERENCE)
    truth = vf.synthetic_fluoroelastomer()
    for celsius in (10.0, 30.0, 70.0):
        ratio = made.material.complex_modulus(10.0, celsius + 273.15) / truth.complex_modulus(10.0, celsius + 273.15)
        assert abs(ratio) == pytest.approx(1.0, abs=0.05)
    groups = rubber_groups(made)
    assert {"/ramps", "/master_curve", "/shift_law", "/spectrum"} <= set(groups)
    assert groups["/ramps"].attrs["source"] == "ramps.csv"
    content = ramps.read_text().splitlines(keepends=True)
    folder = ramps.parent / "NR 7, new"  # a mark that also stands between names
    folder.mkdir()
    halves = [folder / "a.csv", folder / "b.csv"]
    for path, rows in zip(halves, (content[1::2], content[2::2]), strict=True):
        path.write_text("".join([content[0], *rows]))
    split = rubber(ramps=[str(path) for path in halves], shift="wlf", **REFERENCE)
    assert rubber_groups(split)["/ramps"].attrs["source"] == "a.csv, b.csv"
    assumed = rubber(ramps=str(ramps), assumed_shift="150 kJ/mol", **REFERENCE)
    assert assumed.shift_used == "assumed"
    assert "shift-assumed" in codes(assumed.notes)
    assert assumed.material.shift.activation_energy == pytest.approx(1.5e5)
    for name, value, code in (
        ("shift", "polynomial", "contradiction"),
        ("vertical_shift", "free", "contradiction"),
        ("assumed_shift", "x", "no-number"),
        ("shift_by", "loss", "contradiction"),
    ):
        with refused(code, naming=name):
            rubber(ramps=str(ramps), **{name: value}, **REFERENCE)


@pytest.mark.slow
def test_factors_are_found_from_the_moduli_that_are_named(sweeps: Path) -> None:
    made = rubber(dma=str(sweeps), shift_by="storage", **REFERENCE)
    assert "shifted-by" in codes(made.notes)
    assert rubber_groups(made)["/shift_factors"].attrs["shifted_by"] == "storage"
    weighted = rubber(dma=str(sweeps), shift_weights=[1.0, 0.25], **REFERENCE).fit
    assert weighted.weights == pytest.approx((1.6, 0.4))
    for wrong, code in (
        ({"shift_by": "loss", "shift_weights": [1.0, 1.0]}, "contradiction"),
        ({"shift_by": "loss-tangent", "vertical_shift": "free"}, "contradiction"),
        ({"shift_by": "loss", "shift_factors": "alpha.csv"}, "contradiction"),
        ({"shift_factor_columns": {"temperature": "T (degC)"}}, "contradiction"),
        ({"shift_weights": [1.0, 0.0]}, "greater-than"),
    ):
        with refused(code, naming=tuple(set(wrong) & {"shift_by", "shift_weights"})):
            rubber(dma=str(sweeps), **wrong, **REFERENCE)


@pytest.mark.slow
def test_a_held_factor_is_held(sweeps: Path) -> None:
    made = rubber(dma=str(sweeps), fixed_shift_factors={"0 degC": 2.5}, **REFERENCE)
    assert made.shift_origin == "held"
    assert made.fit.shift_factors.log10("0 degC") == pytest.approx(2.5, abs=1e-9)


def test_the_best_law_is_the_one_that_was_planted(sweeps: Path) -> None:
    made = rubber(dma=str(sweeps), shift="best", **REFERENCE)
    assert made.shift_used == "wlf"
    assert isinstance(made.material.shift, vf.WLF)


def test_a_law_far_from_the_factors_is_noted_in_the_material_file(sweeps: Path, tmp_path: Path) -> None:
    # Planted with WLF from 40 K below the reference, where an Arrhenius law is off by decades.
    for law, noted in (("wlf", set()), ("arrhenius", {"law-misfit"}), ("measured", set())):
        made = rubber(dma=str(sweeps), shift=law, **REFERENCE)
        again = vf.read_card(vf.write_card(made.material, tmp_path / "rubber.json", format="json"))
        assert codes(again.spectrum.fit.notes) & {"law-misfit"} == noted
        assert "law-misfit" not in codes(made.notes)  # the check of the fit says it there


def test_a_file_that_is_missing_is_named_once(sweeps: Path) -> None:
    with refused("no-file", DataFileError, naming="such.csv"):
        rubber(dma=str(sweeps), shift_factors="no such.csv", **REFERENCE)


def test_a_catalogue_rubber_says_where_it_comes_from() -> None:
    made = rubber(catalogue="pvb interlayer")
    assert made.material.citation
    assert made.attributes["citation"] == made.material.citation
    assert not made.synthetic
    assert rubber(catalogue="synthetic fluoroelastomer").synthetic
    # What a ready rubber has, its results show: spectrum and shift law, and no sweeps.
    assert set(rubber_groups(made)) == {"/spectrum", "/spectrum_curve", "/shift_law"}


def test_a_ready_rubber_can_have_another_reference() -> None:
    before, after = rubber(catalogue="PVB interlayer"), rubber(catalogue="PVB interlayer", **REFERENCE)
    assert after.material.reference == pytest.approx(303.15)
    for kelvin in (283.15, 323.15):
        # The same solid, described about another temperature.
        assert complex(after.material.complex_modulus(1.0, kelvin)) == pytest.approx(
            complex(before.material.complex_modulus(1.0, kelvin)), rel=1e-12
        )


def test_a_rubber_identified_from_friction_says_so_after_its_file(tmp_path: Path) -> None:
    solid = vf.Material.standard_linear_solid("2 MPa", "6 MPa", "10 ms")
    found: Any = SimpleNamespace(
        material=vf.Material(solid.modes_at(), name="mine"),
        identified=SimpleNamespace(low=3.0, high=400.0),
        METHOD="friction",
        UNMEASURED="",
        middle=30.0,
        notes=(),
        known=("|E(ω)| is known to 5 % from 3 to 400 rad/s.",),
    )
    vf.write_card(with_origin(found, "fr.csv"), tmp_path / "rubber.json", format="json")
    made = rubber(file=str(tmp_path / "rubber.json"))
    assert made.from_friction
    assert made.attributes["identified_from_friction"] == 1
    assert made.attributes["material"] == "“mine” of the file rubber.json"
    spectrum = made.material.spectrum
    assert isinstance(spectrum, vf.RetardationSpectrum)
    assert spectrum.fit is not None
    assert spectrum.fit.frequency_range == (3.0, 400.0)
    origin, known = spectrum.fit.notes
    assert "fr.csv" in origin
    assert (known,) == found.known
    assert (spectrum.fit.from_friction, spectrum.fit.E_inf_extrapolated) == (True, True)
    assert not rubber(catalogue="pvb interlayer").from_friction


def test_two_names_of_one_temperature_are_reported() -> None:
    with pytest.raises(InputError) as caught:
        validated(MaterialTable, {"dma": "a.csv", "fixed_shift_factors": {"0 degC": 1.0, "273.15 K": 2.0}, **REFERENCE})
    assert (caught.value.field, caught.value.code) == ("fixed_shift_factors", "value")


@pytest.mark.slow
def test_failed_superposition_goes_with_the_rubber(real_data: Path, tmp_path: Path) -> None:
    eva = real_data / "dma" / "eva_shear.csv"
    made = rubber(dma=str(eva), deformation="shear", reference_temperature="25 degC")
    vf.write_card(made.material, tmp_path / "rubber.json", format="json")
    again = rubber(file=str(tmp_path / "rubber.json"))
    spectrum = again.material.spectrum
    assert isinstance(spectrum, vf.RetardationSpectrum)
    assert spectrum.fit is not None
    assert made.fit is not None
    assert made.fit.check.verdict == "fails"
    assert made.material.spectrum.fit.notes == spectrum.fit.notes  # type: ignore[union-attr]


@pytest.fixture
def melt(tmp_path: Path) -> Path:
    """Write sweeps of a SYNTHETIC liquid, free of noise; return the file."""
    return write_moduli(tmp_path / "melt.csv", liquid_modulus, range(10, 51, 10), np.geomspace(0.1, 10.0, 13))


@pytest.mark.slow
def test_shift_factors_and_master_curve_of_a_liquid_are_kept(melt: Path, tmp_path: Path) -> None:
    """It has no spectrum that a contact could use, but all that sweeps say before one."""
    wanted = validated(MaterialTable, {"dma": str(melt), "deformation": "tension", **REFERENCE})
    with pytest.raises(LiquidError):
        make_rubber(wanted)
    results, made, written = run_material(wanted, tmp_path / "out", samples=20, synthetic=True)
    assert {path.name for path in written} == {"rubber.json", "shift_factors.csv", "master_curve.csv"}
    assert "liquid" in codes(made.notes)
    law = vf.WLF(8.0, 120.0, "30 degC")
    factors = vf.read_shift_factors(tmp_path / "out" / "shift_factors.csv")
    np.testing.assert_allclose(factors.log10_values, law.log10(factors.temperatures), atol=0.01)
    assert {"master_curve", "shift_factors", "laws"} <= set(results.tree.children)
    assert "spectrum" not in results.tree.children
    with pytest.raises(LiquidError):
        vf.solve_steady(made.material, vf.Ball("10 mm"), speed="10 mm/s", load="1 N", temperature="30 degC")
