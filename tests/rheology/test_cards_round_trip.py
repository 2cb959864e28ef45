"""Material cards: what is written comes back, whatever the program, the shift law and the Poisson ratio."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from refusals import refused
from viscofric.errors import DataFileError
from viscofric.notes import Note, Remedy, codes, warned
from viscofric.rheology.cards import open_card, read_card, write_card
from viscofric.rheology.catalogue import synthetic_fluoroelastomer
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import VFT, WLF, Arrhenius, InversePolynomial, WLFArrhenius
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.vertical_shift import DensityShift, VerticalShiftFactors
from viscofric.rheology.spectra.modulus_table import ModulusTable
from viscofric.rheology.spectra.quality import SpectrumFit
from viscofric.rheology.spectra.retardation import RelaxationSpectrum, RetardationSpectrum

#: What a card leaves out is the business of two tests below.
pytestmark = pytest.mark.filterwarnings("ignore:The card for")

FINITE_ELEMENTS = ("abaqus", "ansys", "ls-dyna", "comsol", "comsol-branches")
FORMATS = (*FINITE_ELEMENTS, "json")
OMEGA = np.logspace(-12, 12, 400)
KELVIN = np.linspace(285.0, 330.0, 10)
MATRIX = np.array([[0.04, 0.3], [0.3, 4.0]])
LAWS = {
    "none": None,
    "wlf": WLF(8.86, 101.6, 298.15, MATRIX, (273.15, 373.15)),
    "vft": VFT(900.0, 196.5, 298.15, MATRIX),
    "arrhenius": Arrhenius(123456.789, 303.15, [[1.0e6]]),
    "wlf+arrhenius": WLFArrhenius(17.44, 51.6, 255.15, 303.15, np.diag([0.1, 2.0, 1.0])),
    "polynomial": InversePolynomial((5123.0, 4.0e5), 303.15, (280.0, 340.0)),
    "table": ShiftFactors([280.0, 300.0, 320.0, 340.0], [2.0, 0.3, -1.0, -2.1], 303.15, 0.01 * np.eye(4)),
}


def prony(modes=14):
    random = np.random.default_rng(4)
    return RelaxationSpectrum(
        1.2345678901234567e6, 1e6 * 10 ** random.uniform(-2, 3, modes), 10.0 ** np.linspace(-9, 4, modes)
    )


def rubber(law="wlf", poisson_ratio=0.49, **options):
    return Material(
        prony().to_retardation(), LAWS[law], poisson_ratio, name="Filled SBR, 50 phr – Mischung α", **options
    )


def assert_same(one, other):
    assert one.name == other.name
    assert one.poisson_ratio == other.poisson_ratio
    modulus, expected = one.complex_modulus(OMEGA), other.complex_modulus(OMEGA)
    assert modulus.real == pytest.approx(expected.real, rel=1e-12)
    assert modulus.imag == pytest.approx(expected.imag, rel=1e-12)
    if other.shift is None:
        assert one.shift is None
        return
    assert type(one.shift) is type(other.shift)
    assert one.shift.reference == other.shift.reference
    assert one.shift.log10(KELVIN) == pytest.approx(other.shift.log10(KELVIN), rel=1e-12, abs=1e-14)
    assert np.array_equal(one.shift.covariance, other.shift.covariance)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("program", FORMATS)
@pytest.mark.parametrize("law", LAWS)
def test_what_is_written_comes_back(tmp_path, program, law):
    material = rubber(law)
    with warned() as notes:
        path = write_card(material, tmp_path / "card", program, density=1100.0)
    without = law != "none" and program in FINITE_ELEMENTS
    without = without and (law not in ("wlf", "vft", "arrhenius") or program == "comsol-branches")
    lacks = {"card-without-density"} if program in ("comsol-branches", "json") else set()
    assert codes(notes) == lacks | ({"card-without-shift"} if without else set())
    assert_same(read_card(path), material)  # no warning: nothing had to be assumed
    assert_same(read_card(path, program), material)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("program", ["abaqus", "ansys", "ls-dyna", "comsol"])
def test_a_table_of_shift_factors_becomes_a_law_where_one_is_asked_for(tmp_path, program):
    """WLF (8.0, 120 K) at five temperatures: the program gets the constants, and viscofric reads the law back."""
    kelvin = np.arange(283.15, 324.0, 10.0)
    factors = ShiftFactors(kelvin, WLF(8.0, 120.0, 303.15).log10(kelvin), 303.15)
    material = replace(rubber(), shift=factors)
    for law in ("best", "wlf", "vft"):
        path = write_card(material, tmp_path / "card", program, density=1100.0, law=law)
        found = read_card(path).shift
        found = found.to_wlf() if isinstance(found, VFT) else found
        assert (found.C1, found.C2, found.reference) == pytest.approx((8.0, 120.0, 303.15), rel=1e-6)
    with warned() as notes:
        write_card(material, tmp_path / "card", program, density=1100.0, law="arrhenius")
    assert codes(notes) == {"card-law-misfit"}  # by 0.14 decades
    with refused("unknown-law"):
        write_card(material, tmp_path / "card", program, density=1100.0, law="polynomial")


def test_what_a_card_leaves_out_is_warned_of(tmp_path):
    shifted = replace(rubber(), vertical_shift=DensityShift(298.15))
    with pytest.warns(UserWarning, match="abaqus") as caught:
        write_card(shifted, tmp_path / "card", "abaqus", domain="frequency")
    assert codes(one.message.args[0] for one in caught) == {"card-without-shift", "card-without-vertical-shift"}
    assert all(one.filename == __file__ for one in caught)


@pytest.mark.parametrize("program", ["abaqus", "comsol", "comsol-branches", "json"])
def test_an_incompressible_material_comes_back_incompressible(tmp_path, program):
    material = rubber(poisson_ratio=0.5)
    path = write_card(material, tmp_path / "card", program)
    assert_same(read_card(path), material)


@pytest.mark.parametrize("program", ["ansys", "ls-dyna"])
def test_programs_that_need_a_bulk_modulus_say_so(tmp_path, program):
    material = rubber(poisson_ratio=0.5)
    with refused("incompressible"):
        write_card(material, tmp_path / "card", program, density=1100.0)
    path = write_card(material, tmp_path / "card", program, density=1100.0, poisson_ratio=0.4999)
    assert_same(read_card(path), material)  # the material's own ratio, and its E


@pytest.mark.parametrize("program", ["abaqus", "ansys", "ls-dyna"])
@pytest.mark.parametrize("law", ["wlf", "arrhenius"])
def test_temperatures_in_degrees_celsius_come_back(tmp_path, program, law):
    material = rubber(law)
    if (program, law) == ("ls-dyna", "arrhenius"):
        with refused("temperature-unit"):
            write_card(material, tmp_path / "card", program, density=1e3, temperature_unit="degC")
        return
    path = write_card(material, tmp_path / "card", program, density=1e3, temperature_unit="degC")
    assert_same(read_card(path), material)
    if law == "wlf":
        assert "298.15" not in "".join(line for line in path.read_text().splitlines() if "viscofric>" not in line)


def test_abaqus_in_the_frequency_domain_keeps_its_shift_in_comments(tmp_path):
    material = rubber("wlf")
    path = write_card(material, tmp_path / "card", "abaqus", domain="frequency")
    text = path.read_text()
    assert "*VISCOELASTIC, FREQUENCY=PRONY" in text
    assert "*TRS" not in text  # which belongs to the time domain
    assert_same(read_card(path), material)


def test_abaqus_card_has_the_keywords_of_its_manual(tmp_path):
    series = RelaxationSpectrum(1e6, [3e6], [0.5])
    material = Material(series.to_retardation(), WLF(8.86, 101.6, 298.0), 0.25, name="70 Shore A")
    lines = write_card(material, tmp_path / "card", "abaqus", density=1100.0).read_text().splitlines()
    card = [line for line in lines if not line.startswith("**")]
    assert card[:4] == ["*MATERIAL, NAME=M_70_Shore_A", "*DENSITY", "1100.0,", "*ELASTIC, MODULI=INSTANTANEOUS"]
    assert [float(part) for part in card[4].split(",")] == pytest.approx([4e6, 0.25], rel=1e-14)
    assert card[5] == "*VISCOELASTIC, TIME=PRONY"
    share, bulk, time = (float(part) for part in lines[-3].split(","))
    assert (share, bulk, time) == pytest.approx((0.75, 0.75, 0.5), rel=1e-14)
    assert lines[-2:] == ["*TRS, DEFINITION=WLF", "298.0, 8.86, 101.6"]


@pytest.mark.parametrize("program", FINITE_ELEMENTS)
def test_cards_are_plain_ascii_in_short_lines(tmp_path, program):
    text = write_card(rubber("table"), tmp_path / "card", program, density=1e3).read_bytes().decode("ascii")
    # Abaqus reads 256 characters of a line, LS-DYNA 160 in its long format and 80 of a comment.
    assert max(len(line) for line in text.splitlines()) <= 256
    if program == "ls-dyna":
        assert all(len(line) <= (80 if line.startswith("$") else 160) for line in text.splitlines())


def test_a_glass_a_million_times_stiffer_than_the_rubber_keeps_its_plateau(tmp_path):
    # 1 − Σg would leave ten digits of E0 in Abaqus and ANSYS.
    series = RelaxationSpectrum(1.2345678901234e3, [1e9, 2e9, 3e5], [1e-6, 1e-3, 10.0])
    material = Material(series.to_retardation(), None, 0.49)
    for program in FORMATS:
        path = write_card(material, tmp_path / "card", program, density=1e3)
        assert read_card(path).complex_modulus(OMEGA) == pytest.approx(material.complex_modulus(OMEGA), rel=1e-12)


def test_sixty_modes_come_back_and_ls_dyna_shows_its_limit(tmp_path):
    material = Material(prony(60).to_retardation(), None, 0.45)
    for program in ("abaqus", "ansys", "comsol", "json"):
        path = write_card(material, tmp_path / "card", program)
        assert read_card(path).complex_modulus(OMEGA) == pytest.approx(material.complex_modulus(OMEGA), rel=1e-12)
    with refused("too-many-modes"):
        write_card(material, tmp_path / "card", "ls-dyna", density=1e3)


def test_the_synthetic_fluoroelastomer_survives_every_program(tmp_path):
    material = synthetic_fluoroelastomer()
    for program in ("abaqus", "comsol", "json"):
        back = read_card(write_card(material, tmp_path / "card", program))
        assert_same(back, material)
        assert pytest.approx(material.spectrum.C, rel=1e-9, abs=0.0) == back.spectrum.C


def test_how_a_spectrum_was_fitted_is_kept(tmp_path):
    series = prony(5).to_retardation()
    notes = ("E0 is extrapolated.", Note("spectrum-misfit", "It misses.", values={"rms": 0.2}))
    fit = SpectrumFit(0.01, 0.02, True, False, (1e-3, 1e5), notes, gaps=((1.0, 20.0), (1e2, 2e3)))
    material = Material(RetardationSpectrum(series.E0, series.E_inf, series.C, series.tau, fit), None, 0.45)
    for program in FORMATS:
        back = read_card(write_card(material, tmp_path / "card", program, density=1e3))
        assert back.spectrum.fit == fit
        assert [note.values for note in back.notes_at()] == [{"rms": 0.2}]  # results from it say so too


@pytest.mark.parametrize("program", FORMATS)
@pytest.mark.parametrize(
    "vertical",
    [DensityShift(298.15), VerticalShiftFactors([280.0, 300.0, 320.0], [-0.02, 0.0, 0.03], 298.15, 1e-4 * np.eye(3))],
)
def test_vertical_shift_citation_and_mark_of_synthetic_data_are_kept(tmp_path, program, vertical):
    material = rubber(vertical_shift=vertical, citation="A. Author, J. Rubber 1 (2000) 1.", synthetic=True)
    written = write_card(material, tmp_path / "card", program, density=1e3)
    back = read_card(written)
    assert back.synthetic
    assert program == "json" or "SYNTHETIC, not measured" in written.read_text()  # also for people
    assert back.citation == material.citation
    assert back.vertical_shift.log10(310.0) == pytest.approx(vertical.log10(310.0), rel=1e-12)
    assert pytest.approx(material.at("40 degC").E0, rel=1e-12) == back.at("40 degC").E0


def table_material():
    omega = np.logspace(-3, 6, 40)
    modulus = synthetic_fluoroelastomer().spectrum.complex_modulus(omega)
    return Material(ModulusTable(omega, modulus.real, modulus.imag, "plateau", ("Averaged.",)), LAWS["wlf"])


def test_a_table_of_moduli_is_kept_to_the_last_digit(tmp_path):
    material = table_material()
    back = read_card(write_card(material, tmp_path / "card", "json"))
    assert np.array_equal(back.spectrum.storage_modulus_values, material.spectrum.storage_modulus_values)
    assert np.array_equal(back.spectrum.loss_modulus_values, material.spectrum.loss_modulus_values)
    assert np.array_equal(back.spectrum.angular_frequency, material.spectrum.angular_frequency)
    assert (back.spectrum.extrapolate, back.spectrum.notes) == ("plateau", ("Averaged.",))


@pytest.mark.parametrize("program", FINITE_ELEMENTS)
def test_an_elastic_solid_is_no_prony_series(tmp_path, program):
    with refused("no-modes"):
        write_card(Material(RetardationSpectrum(1e6, 1e6, [], [])), tmp_path / "card", program, density=1e3)


def test_a_poisson_ratio_for_the_file_is_in_it_and_a_density_is_missed(tmp_path):
    path = write_card(rubber(), tmp_path / "card", "json", poisson_ratio=0.25)
    assert read_card(path).poisson_ratio == 0.25
    for program in ("json", "comsol-branches"):
        with warned() as notes:
            write_card(rubber(), path, program, density=1100.0)
        assert "card-without-density" in codes(notes)


def test_json_keeps_every_digit_of_the_modes(tmp_path):
    material = rubber("wlf+arrhenius")
    back = read_card(write_card(material, tmp_path / "card", "json"))
    assert np.array_equal(back.spectrum.C, material.spectrum.C)
    assert np.array_equal(back.spectrum.tau, material.spectrum.tau)
    assert (back.spectrum.E0, back.spectrum.E_inf) == (material.spectrum.E0, material.spectrum.E_inf)


def test_json_keeps_the_laws_that_factors_do_not_exclude(tmp_path):
    law = ShiftFactors([290.0, 305.0], [1.2, 0.0], 305.0, np.diag([1e-4, 0.0])).law("arrhenius")
    back = read_card(write_card(replace(rubber(), shift=law), tmp_path / "card", "json")).shift
    assert back.standard_error([285.0, 310.0]) == pytest.approx(law.standard_error([285.0, 310.0]), rel=1e-12)


# --- edits and damage ----------------------------------------------------------------------------------------


def edited(tmp_path, program, old, new, law="wlf", **options):
    path = write_card(rubber(law), tmp_path / "card", program, density=1100.0, **options)
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))
    return open_card(path)


@pytest.mark.parametrize(
    ("program", "old", "new"),
    [
        ("abaqus", "298.15, 8.86, 101.6", "298.15, 9.99, 101.6"),
        ("ansys", "298.15,8.86,101.6", "298.15,9.99,101.6"),
        ("comsol", "C1_WLF 8.86", "C1_WLF 9.99"),
    ],
)
def test_a_shift_changed_in_the_card_counts(tmp_path, program, old, new):
    card = edited(tmp_path, program, old, new)
    assert card.material.shift.C1 == 9.99
    assert {"shift": True} in [note.values for note in card.notes if note.code == "changed-in-card"]
    assert card.material.name == rubber().name


def test_a_shift_taken_out_of_the_card_is_gone(tmp_path):
    card = edited(tmp_path, "abaqus", "*TRS, DEFINITION=WLF\n298.15, 8.86, 101.6\n", "")
    assert card.material.shift is None
    assert {"shift": True} in [note.values for note in card.notes if note.code == "changed-in-card"]


def test_a_modulus_changed_in_the_card_counts(tmp_path):
    glass = rubber().spectrum.to_relaxation().E_inf
    card = edited(tmp_path, "abaqus", f"{glass!r}, 0.49", f"{2 * glass!r}, 0.49")
    assert card.material.complex_modulus(OMEGA) == pytest.approx(2 * rubber().complex_modulus(OMEGA), rel=1e-9)


def test_a_poisson_ratio_changed_in_the_card_counts(tmp_path):
    card = edited(tmp_path, "ansys", "MP,PRXY,1,0.49\n", "MP,PRXY,1,0.45\n")
    assert card.material.poisson_ratio == 0.45
    assert [(note.code, note.values) for note in card.notes] == [("changed-in-card", {"poisson_ratio": 0.45})]


@pytest.mark.parametrize("program", FINITE_ELEMENTS)
def test_damaged_comments_are_reported(tmp_path, program):
    path = write_card(rubber(), tmp_path / "card", program, density=1100.0)
    lines = path.read_text().splitlines()
    first = next(index for index, line in enumerate(lines) if "viscofric>" in line)
    path.write_text("\n".join(lines[:first] + lines[first + 1 :]))
    with refused("damaged", DataFileError):
        read_card(path)


@pytest.mark.parametrize("program", ["abaqus", "ansys", "ls-dyna", "comsol"])
def test_without_its_comments_a_card_is_still_a_card(tmp_path, program):
    path = write_card(rubber(), tmp_path / "card", program, density=1100.0)
    path.write_text("\n".join(line for line in path.read_text().splitlines() if "viscofric>" not in line))
    card = open_card(path, temperature_unit="K")
    assert pytest.approx(8.86) == card.material.shift.C1
    assert card.material.complex_modulus(OMEGA) == pytest.approx(rubber().complex_modulus(OMEGA), rel=1e-9)
    assert card.material.poisson_ratio == pytest.approx(0.49, rel=1e-9)


@pytest.mark.slow
@settings(deadline=None, max_examples=120, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.sampled_from(FORMATS), st.data())
def test_damaged_cards_give_an_answer_or_one_clear_error(tmp_path, program, data):
    path = write_card(rubber(), tmp_path / "card", program, density=1100.0)
    text = path.read_text()
    start = data.draw(st.integers(0, len(text)))
    end = data.draw(st.integers(start, min(len(text), start + 200)))
    junk = data.draw(st.sampled_from(["", "x", ",", "\n", "-", "nan", "1e999", "\x00", "0", "{", '"', "*END"]))
    path.write_text(text[:start] + junk + text[end:])
    try:
        card = open_card(path)
    except DataFileError:  # anything else is a failure
        return
    assert np.all(np.isfinite(card.material.complex_modulus(OMEGA)))


# --- what else is refused --------------------------------------------------------------------------------------


def test_unknown_formats_and_files_are_refused(tmp_path):
    with refused("wrong-choice", naming=("format", "'abaqus'", "'ansys'")):
        write_card(rubber(), tmp_path / "card", "nastran")
    with refused("wrong-choice", naming=("format", "'abaqus'", "'ansys'")):
        read_card(tmp_path / "card", "nastran")
    (tmp_path / "letter").write_text("Dear colleague,\nthe rubber is soft.\n")
    with refused("other-card", DataFileError):
        read_card(tmp_path / "letter", "abaqus")
    with refused("no-file", DataFileError):
        read_card(tmp_path / "nothing")
    with refused("not-written", DataFileError):
        write_card(rubber(), tmp_path / "no folder" / "card", "json")


def test_impossible_wishes_are_refused(tmp_path):
    for wish, code in (
        ({"poisson_ratio": 0.7}, "poisson-ratio"),
        ({"temperature_unit": "F"}, "wrong-choice"),
        ({"domain": "space"}, "wrong-choice"),
        ({"material_id": 0}, "not-a-whole-number"),
        ({"density": -1.0}, "not-positive"),
    ):
        with refused(code, naming=tuple(wish)):
            write_card(rubber(), tmp_path / "card", "abaqus", **wish)


def changed(tmp_path, change):
    path = write_card(rubber(), tmp_path / "card.json", "json")
    content = json.loads(path.read_text())
    change(content)
    path.write_text(json.dumps(content))
    return path


@pytest.mark.parametrize(
    ("change", "refusal"),
    [
        (lambda one: one.update(version=2), ("newer-version",)),
        (lambda one: one.update(format="other"), ("not-a-material",)),
        (lambda one: one.update(colour="black"), ("unknown-field",)),
        (lambda one: one.pop("spectrum"), ("wrong-choice", "spectrum")),
        (lambda one: one["spectrum"].pop("tau"), ("missing-fields",)),
        (lambda one: one["spectrum"].update(E0="soft"), ("no-number",)),
        (lambda one: one["shift"].update(kind="Path"), ("wrong-choice", "shift", "Path")),
        (lambda one: one["shift"].update(C3=1.0), ("unknown-field",)),
        (lambda one: one["shift"].pop("C1"), ("missing-fields",)),
        (lambda one: one.update(poisson_ratio=0.9), ("poisson-ratio", "0.5")),
        (lambda one: one.update(poisson_ratio="x"), ("no-number",)),
    ],
)
def test_a_wrong_material_file_is_reported_with_its_fault(tmp_path, change, refusal):
    with refused(refusal[0], DataFileError, naming=refusal[1:]):
        read_card(changed(tmp_path, change))


def test_broken_json_is_refused(tmp_path):
    path = tmp_path / "card"
    path.write_text('{"format": "viscofric material",\n "version": }')
    with refused("damaged", DataFileError):
        read_card(path)
    path.write_text('{"format": "viscofric material", "poisson_ratio": NaN}')
    with refused("damaged", DataFileError):
        read_card(path)


def test_material_files_keep_what_notes_advise_each_reader(tmp_path):
    advice = Note("few-points", "Few points; ", remedy=Remedy("give more=.", "give --more."), values={"points": 3})
    fit = SpectrumFit(None, None, False, False, (1.0, 1e3), notes=(advice, "A sentence alone."))
    solid = Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms")
    path = write_card(replace(solid, spectrum=replace(solid.spectrum, fit=fit)), tmp_path / "r.json", format="json")
    first, second = read_card(path).spectrum.fit.notes
    assert (first.record(), second) == (advice.record(), "A sentence alone.")
    content = json.loads(path.read_text(encoding="utf-8"))
    content["fit"]["notes"] = ["As files were written so far."]
    path.write_text(json.dumps(content), encoding="utf-8")
    assert read_card(path).spectrum.fit.notes == ("As files were written so far.",)
    content["fit"]["notes"] = [{"text": "without a code"}, 3]
    path.write_text(json.dumps(content), encoding="utf-8")
    with refused("wrong-notes", DataFileError):
        read_card(path)
