"""The numbers that stand in a card, as the program will take them: worked out by hand, without our own reader."""

from __future__ import annotations

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from refusals import refused
from viscofric.errors import DataFileError
from viscofric.rheology.cards import open_card, read_card, write_card
from viscofric.rheology.cards.card import number_text
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import WLF, Arrhenius
from viscofric.rheology.shifts.shift_law import GAS_CONSTANT
from viscofric.rheology.spectra.retardation import RelaxationSpectrum

OMEGA = np.logspace(-6, 9, 121)
DIGITS = 1e-14  # what numbers of 15 digits and more keep


def rubber(shift=None, poisson_ratio=0.49, glass=1e9):
    """1 MPa in the rubber, one mode up to the glass."""
    series = RelaxationSpectrum(1e6, [0.25 * (glass - 1e6), 0.75 * (glass - 1e6)], [1e-4, 0.5])
    return Material(series.to_retardation(), shift, poisson_ratio, "Tread")


def written(tmp_path, material, program, **options):
    return write_card(material, tmp_path / "card", program, **options).read_text()


def lines_after(text, keyword):
    lines = text.splitlines()
    return lines[lines.index(keyword) + 1 :]


def numbers(line):
    return [float(part) for part in line.split(",") if part.strip()]


def words(text, mark):
    """Return the comments for people as one text."""
    return " ".join(line[len(mark) :].strip() for line in text.splitlines() if line.startswith(mark))


# --- Abaqus ----------------------------------------------------------------------------------------------------


def test_abaqus_takes_the_glass_in_time_and_the_rubber_in_frequency(tmp_path):
    time = written(tmp_path, rubber(), "abaqus")
    assert numbers(lines_after(time, "*ELASTIC, MODULI=INSTANTANEOUS")[0]) == pytest.approx([1e9, 0.49], rel=DIGITS)
    frequency = written(tmp_path, rubber(), "abaqus", domain="frequency")
    assert "INSTANTANEOUS" not in frequency  # which Abaqus/Standard does not take in the frequency domain
    assert numbers(lines_after(frequency, "*ELASTIC, MODULI=LONG TERM")[0]) == pytest.approx([1e6, 0.49], rel=DIGITS)
    # The relative moduli are those of the glass in both: 0.25 · 0.999 and 0.75 · 0.999.
    for text, domain in ((time, "TIME"), (frequency, "FREQUENCY")):
        first, second = (numbers(line) for line in lines_after(text, f"*VISCOELASTIC, {domain}=PRONY")[:2])
        assert first == pytest.approx([0.24975, 0.24975, 1e-4], rel=DIGITS)
        assert second == pytest.approx([0.74925, 0.74925, 0.5], rel=DIGITS)


def test_abaqus_in_the_frequency_domain_keeps_glass_and_rubber_apart_by_a_million(tmp_path):
    # 1 - Σg alone would leave ten digits of the glass.
    material = rubber(glass=1e12)
    path = write_card(material, tmp_path / "card", "abaqus", domain="frequency")
    assert read_card(path).complex_modulus(OMEGA) == pytest.approx(material.complex_modulus(OMEGA), rel=1e-12)


def test_an_edited_long_term_modulus_counts(tmp_path):
    text = written(tmp_path, rubber(), "abaqus", domain="frequency")
    old = lines_after(text, "*ELASTIC, MODULI=LONG TERM")[0]
    (tmp_path / "card").write_text(text.replace(f"\n{old}\n", "\n2.0e6, 0.49\n"))
    # 1e-9: the glass follows from 1 - Σg = 0.001
    back = read_card(tmp_path / "card").complex_modulus(OMEGA)
    assert back == pytest.approx(2 * rubber().complex_modulus(OMEGA), rel=1e-9)


def test_abaqus_numbers_have_at_most_twenty_characters(tmp_path):
    random = np.random.default_rng(7)
    series = RelaxationSpectrum(
        1.2345678901234567e6, 10.0 ** random.uniform(-3, 9, 60), 1.2235076222139953 * 10.0 ** np.linspace(-18, 12, 60)
    )
    for law in (WLF(8.860000000000001, 101.60000000000001, 298.1500000000001), Arrhenius(123456.78901234567, 303.15)):
        material = Material(series.to_retardation(), law, 0.48999999999999994)
        text = written(tmp_path, material, "abaqus", density=1.1e3 / 3, modulus_unit="MPa")
        cells = [cell.strip() for line in text.splitlines() if not line.startswith("*") for cell in line.split(",")]
        assert max(map(len, cells)) == 20
        assert read_card(tmp_path / "card").complex_modulus(OMEGA) == pytest.approx(
            material.complex_modulus(OMEGA), rel=1e-12
        )


@settings(deadline=None, max_examples=200)
@given(st.floats(allow_nan=False, allow_infinity=False), st.sampled_from([19, 20]))
def test_numbers_fit_and_keep_their_digits(value, longest):
    text = number_text(value, longest)
    assert len(text) <= longest
    assert "." in text
    # Three digits of exponent and a sign leave twelve digits; the largest number must not become infinite.
    if abs(value) < 1e308:
        assert float(text) == pytest.approx(value, rel=1e-11, abs=1e-307)
    # All digits where they fit: nothing is rounded in up to 17 characters.
    if len(repr(value)) <= 17:
        assert float(text) == value


def test_numbers_by_hand():
    assert number_text(1.2235076222139953e-08, 20) == "1.223507622213995e-8"
    assert number_text(0.012235076222139953, 20) == "0.012235076222139953"
    assert number_text(0.0012235076222139954, 20) == ".0012235076222139954"
    assert number_text(1e-05, 20) == "1.0e-5"
    assert number_text(0.0, 20) == "0.0"


# --- COMSOL ----------------------------------------------------------------------------------------------------


def parameters(text):
    """Name -> number, whatever its unit."""
    found = re.findall(r"(?m)^([A-Za-z]\w*) ([-+.0-9e]+)", text)
    return {name: float(value) for name, value in found}


def young(bulk, shear):
    return 9 * bulk * shear / (3 * bulk + shear)


def test_comsol_with_volumetric_and_deviatoric_branches_has_the_modulus_of_the_material(tmp_path):
    values = parameters(written(tmp_path, rubber(), "comsol"))
    # By hand: G = E/2.98 and K = E/0.06.
    assert values["G_long_term"] == pytest.approx(335570.4697986577, rel=DIGITS)
    assert values["K_long_term"] == pytest.approx(16666666.666666666, rel=1e-13)  # 1 - 2ν loses a digit
    assert values["G_1"] == pytest.approx(0.25 * 999e6 / 2.98, rel=DIGITS)
    assert values["K_1"] == pytest.approx(0.25 * 999e6 / 0.06, rel=1e-13)
    assert values["K_2"] == pytest.approx(0.75 * 999e6 / 0.06, rel=1e-13)
    s = 1j * OMEGA
    shear, bulk = (
        values[f"{kind}_long_term"]
        + sum(values[f"{kind}_{m}"] * s * values[f"tau_{m}"] / (1 + s * values[f"tau_{m}"]) for m in (1, 2))
        for kind in "GK"
    )
    assert young(bulk, shear) == pytest.approx(rubber().complex_modulus(OMEGA), rel=1e-12)


def numbers_in(text):
    """Return the numbers in a text."""
    return [float(one) for one in re.findall(r"(?<![\w.])\d+(?:\.\d+)?(?![\w.]*\w)", text)]


def test_comsol_with_deviatoric_branches_takes_the_bulk_modulus_of_the_glass(tmp_path):
    text = written(tmp_path, rubber(), "comsol")
    values = parameters(text)
    assert values["K_constant"] == pytest.approx(16666666666.666666, rel=1e-13)  # E_inf/0.06
    glass = values["G_long_term"] + values["G_1"] + values["G_2"]
    assert young(values["K_constant"], glass) == pytest.approx(1e9, rel=1e-12)
    assert young(values["K_long_term"], glass) == pytest.approx(130e6, rel=0.01)  # 130 MPa, far too soft
    # In the rubber 3/2.98 - 1 = 0.67 % too stiff, as the card says.
    assert young(values["K_constant"], values["G_long_term"]) == pytest.approx(1e6 * 3 / 2.98, rel=1e-5)
    assert 0.67 in numbers_in(words(text, "% "))


def test_comsol_states_how_far_a_constant_bulk_modulus_is_off_at_a_low_poisson_ratio(tmp_path):
    text = written(tmp_path, rubber(poisson_ratio=0.25, glass=4e6), "comsol")
    values = parameters(text)
    # K = 4/1.5 MPa, G = 0.4 MPa: E = 9KG/(3K + G) = 9.6/8.4 = 1.142857 MPa
    assert young(values["K_constant"], values["G_long_term"]) == pytest.approx(1e6 * 9.6 / 8.4, rel=1e-12)
    assert any(one == pytest.approx(14.29, abs=0.5) for one in numbers_in(words(text, "% ")))


def test_comsol_branches_show_the_bulk_moduli_in_their_comments(tmp_path):
    text = written(tmp_path, rubber(poisson_ratio=0.25), "comsol-branches")
    said = words(text, "% ")
    # K = E/1.5 = (5/3) G
    for bulk in (5 / 3, 1e6 / 1.5, 1e9 / 1.5):  # in shear moduli; of the rubber and of the glass in Pa
        assert any(one == pytest.approx(bulk, rel=DIGITS) for one in numbers_in(said)), bulk
    rows = [line.split() for line in text.splitlines() if not line.startswith("%")]
    assert [len(row) for row in rows] == [3, 3]  # number, shear modulus, time: as COMSOL loads it
    assert float(rows[0][1]) == pytest.approx(0.25 * 999e6 / 2.5, rel=DIGITS)


def test_an_incompressible_material_has_no_bulk_modulus_in_comsol(tmp_path):
    text = written(tmp_path, rubber(poisson_ratio=0.5), "comsol")
    assert not any(name.startswith("K_") for name in parameters(text))
    assert "Volumetric" not in text


def test_a_bulk_modulus_changed_in_comsol_parameters_is_reported(tmp_path):
    text = written(tmp_path, rubber(), "comsol")
    assert open_card(tmp_path / "card").notes == ()
    (tmp_path / "card").write_text(re.sub(r"(?m)^K_2 \S+", "K_2 2[GPa]", text))
    card = open_card(tmp_path / "card")
    (note,) = card.notes
    assert (note.code, note.values) == ("bulk-contradicts", {"parameters": ["K_2"]})
    assert card.material.complex_modulus(OMEGA) == pytest.approx(rubber().complex_modulus(OMEGA), rel=1e-12)


# --- LS-DYNA ---------------------------------------------------------------------------------------------------


def test_ls_dyna_leaves_its_second_card_blank_and_its_numbers_are_those_of_the_material(tmp_path):
    text = written(tmp_path, rubber(WLF(8.86, 101.6, 298.0)), "ls-dyna", density=1100.0)
    title, head, second, *terms, end = lines_after(
        "\n".join(line for line in text.splitlines() if not line.startswith("$")), "*MAT_GENERAL_VISCOELASTIC_TITLE+"
    )
    assert (title, second, end) == ("Tread", "", "*END")  # GI count only if the second card is blank
    fields = [float(head[start : start + 20]) for start in range(0, len(head), 20)]
    # MID, RO, BULK = 1e9/0.06, PCF, EF, TREF, A = -8.86 ln 10 = -20.4009, B
    assert fields == pytest.approx([1, 1100, 1e9 / 0.06, 0, 0, 298, -20.400904, 101.6], rel=1e-7)
    rows = [[float(line[start : start + 20]) for start in range(0, len(line), 20)] for line in terms]
    assert rows[0] == pytest.approx([1e6 / 2.98, 0, 1e6 / 0.06, 0], rel=1e-13)
    assert rows[1] == pytest.approx([0.25 * 999e6 / 2.98, 1e4, 0.25 * 999e6 / 0.06, 1e4], rel=1e-13)
    assert rows[2] == pytest.approx([0.75 * 999e6 / 2.98, 2.0, 0.75 * 999e6 / 0.06, 2.0], rel=1e-13)


# --- tonne, mm, s ------------------------------------------------------------------------------------------------


@pytest.mark.filterwarnings("error", "ignore:The card for")
@pytest.mark.parametrize("law", [WLF(8.86, 101.6, 298.15), Arrhenius(123456.789, 303.15), None])
@pytest.mark.parametrize(
    ("program", "domain"), [("abaqus", "time"), ("abaqus", "frequency"), ("ansys", "time"), ("ls-dyna", "time")]
)
def test_cards_in_megapascal_come_back_in_pascal(tmp_path, program, law, domain):
    path = write_card(rubber(law), tmp_path / "card", program, density=1100.0, modulus_unit="MPa", domain=domain)
    assert "Units: MPa, s, mm, tonne" in path.read_text()
    back = read_card(path)  # no warning: its comments say its units
    assert back.complex_modulus(OMEGA) == pytest.approx(rubber().complex_modulus(OMEGA), rel=1e-12)
    assert (back.shift is None) == (law is None)
    if law is not None:
        assert back.shift.log10(330.0) == pytest.approx(law.log10(330.0), rel=1e-12)
    # Without its comments it is a card like any other, in MPa.
    path.write_text("\n".join(line for line in path.read_text().splitlines() if "viscofric>" not in line))
    bare = open_card(path, modulus_unit="MPa", time_unit="s", temperature_unit="K").material
    assert bare.complex_modulus(OMEGA) == pytest.approx(rubber().complex_modulus(OMEGA), rel=1e-9)


def test_megapascal_and_tonnes_by_hand(tmp_path):
    wish = {"density": 1100.0, "modulus_unit": "MPa"}
    abaqus = written(tmp_path, rubber(Arrhenius(1e5, 298.0)), "abaqus", **wish)
    assert numbers(lines_after(abaqus, "*ELASTIC, MODULI=INSTANTANEOUS")[0]) == pytest.approx([1000, 0.49], rel=DIGITS)
    assert lines_after(abaqus, "*DENSITY")[0] == "1.1e-9,"  # t/mm³
    assert numbers(lines_after(abaqus, "*VISCOELASTIC, TIME=PRONY")[1])[2] == pytest.approx(0.5)  # s still
    # Energies in mJ, as is the gas constant: 1e8 mJ/mol.
    assert numbers(lines_after(abaqus, "*TRS, DEFINITION=ARRHENIUS")[0]) == pytest.approx([298, 1e8])
    assert float(re.search(r"UNIVERSAL GAS CONSTANT=(\S+)", abaqus)[1]) == pytest.approx(1e3 * GAS_CONSTANT)
    ansys = written(tmp_path, rubber(), "ansys", **wish)
    assert float(re.search(r"MP,EX,1,(\S+)", ansys)[1]) == pytest.approx(1000.0, rel=DIGITS)
    assert float(re.search(r"MP,DENS,1,(\S+)", ansys)[1]) == pytest.approx(1.1e-9, rel=DIGITS)
    dyna = [line for line in written(tmp_path, rubber(), "ls-dyna", **wish).splitlines() if not line.startswith("$")]
    assert float(dyna[3][20:40]) == pytest.approx(1.1e-9, rel=DIGITS)
    assert float(dyna[3][40:60]) == pytest.approx(1000 / 0.06, rel=1e-13)
    assert [float(dyna[5][:20]), float(dyna[5][40:60])] == pytest.approx([1 / 2.98, 1 / 0.06], rel=1e-13)


@pytest.mark.parametrize("program", ["abaqus", "ansys", "ls-dyna", "comsol", "comsol-branches", "json"])
@pytest.mark.parametrize(
    ("choice", "programs"),
    [
        ({"modulus_unit": "MPa"}, ("abaqus", "ansys", "ls-dyna")),
        ({"temperature_unit": "degC"}, ("abaqus", "ansys", "ls-dyna")),
        ({"domain": "frequency"}, ("abaqus",)),
        ({"material_id": 7}, ("ansys", "ls-dyna")),
    ],
)
def test_a_choice_changes_the_card_or_is_refused(tmp_path, program, choice, programs):
    needed = {"poisson_ratio": 0.49, "density": 1e3}
    if program in programs:
        usual = written(tmp_path, rubber(), program, **needed)
        assert written(tmp_path, rubber(), program, **needed, **choice) != usual
        return
    with refused("not-of-format"):
        write_card(rubber(), tmp_path / "card", program, **needed, **choice)


def test_an_unknown_unit_of_a_card_is_refused(tmp_path):
    with refused("wrong-choice", naming="modulus_unit = 'psi'"):
        write_card(rubber(), tmp_path / "card", "abaqus", modulus_unit="psi")


def test_damaged_units_of_a_card_are_reported(tmp_path):
    text = written(tmp_path, rubber(), "abaqus", modulus_unit="MPa")
    pieces = re.findall(r"viscofric> \|(.*)\|", text)
    whole = "".join(pieces).replace('"unit_system":"MPa"', '"unit_system":"ksi"')
    kept = [line for line in text.splitlines() if "viscofric>" not in line]
    (tmp_path / "card").write_text("\n".join([f"** viscofric> |{whole}|", *kept]))
    with refused("damaged", DataFileError):
        read_card(tmp_path / "card")
