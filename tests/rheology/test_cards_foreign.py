"""Material cards that others typed: as the programs' manuals have them, with the physics worked out by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from refusals import refused
from viscofric.errors import DataFileError
from viscofric.rheology.cards import open_card, read_card
from viscofric.rheology.shifts.shift_law import GAS_CONSTANT

OMEGA = np.logspace(-6, 6, 61)


def opened(tmp_path, text, **units):
    path = tmp_path / "card"
    path.write_text(text)
    return open_card(path, **units)


def maxwell(rubber, modes, omega=OMEGA):
    """E(ω) of the generalised Maxwell model, term by term."""
    s = 1j * omega
    return rubber + sum(modulus * s * tau / (1 + s * tau) for modulus, tau in modes)


def tensile(shear, bulk):
    """E = 9KG/(3K + G)."""
    return 9 * bulk * shear / (3 * bulk + shear)


# --- Abaqus ----------------------------------------------------------------------------------------------------

ABAQUS = """*HEADING
 a bush
*MATERIAL, NAME=EPDM70
*DENSITY
1.1e-9,
*ELASTIC, MODULI=INSTANTANEOUS
60.0, 0.49
*VISCOELASTIC, TIME=PRONY
0.5, 0.5, 0.01
0.3, 0.3, 1.0
*TRS
20., 8.86, 101.6
"""


def test_abaqus_card_in_megapascal(tmp_path):
    card = opened(tmp_path, ABAQUS, modulus_unit="MPa", time_unit="s", temperature_unit="degC")
    assert card.notes == ()
    assert card.format == "an Abaqus card"
    assert card.material.name == "EPDM70"
    assert card.material.poisson_ratio == pytest.approx(0.49)
    assert card.material.complex_modulus(OMEGA) == pytest.approx(maxwell(12e6, [(30e6, 0.01), (18e6, 1.0)]), rel=1e-12)
    assert card.material.shift.reference == pytest.approx(293.15)
    # −log10 A = C1 (θ − θ0)/(C2 + θ − θ0), by hand at 50 °C
    assert card.material.shift.log10("50 degC") == pytest.approx(-8.86 * 30 / 131.6)


def test_abaqus_moduli_are_long_term_unless_stated(tmp_path):
    card = opened(tmp_path, ABAQUS.replace(", MODULI=INSTANTANEOUS", ""), modulus_unit="MPa", time_unit="s")
    assert pytest.approx(60e6) == card.material.spectrum.E0
    assert card.material.spectrum.E_inf == pytest.approx(60e6 / 0.2)


def test_abaqus_units_that_are_not_stated_are_noted(tmp_path):
    card = opened(tmp_path, ABAQUS.replace("60.0", "60.0e6"))
    assert card.material.spectrum.E_inf == pytest.approx(60e6)
    assert [note.code for note in card.notes] == ["unit-assumed", "unit-assumed"]
    assert card.notes[0].values == {"assumed": {"modulus_unit": "Pa", "time_unit": "s"}}
    with pytest.warns(UserWarning, match="card: ") as caught:
        read_card(tmp_path / "card")
    assert [str(one.message) for one in caught] == [f"{tmp_path / 'card'}: {note}" for note in card.notes]


@pytest.mark.parametrize("form", ["abaqus", "ansys", "ls-dyna"])
def test_moduli_that_cannot_be_in_pascal_are_refused_without_a_unit(tmp_path, form):
    text = {"abaqus": ABAQUS, "ansys": ANSYS.replace("60.0e6", "60.0"), "ls-dyna": LS_DYNA}[form]
    with refused("unit-unknown", DataFileError, naming=("modulus_unit",)):
        opened(tmp_path, text)
    assert opened(tmp_path, text, modulus_unit="Pa").material.spectrum.E_inf < 100.0


def test_abaqus_keyword_lines_go_on_after_a_comma(tmp_path):
    wrapped = ABAQUS.replace("*MATERIAL, ", "*MATERIAL,\n").replace("*ELASTIC, ", "*ELASTIC,\n** instantaneous\n ")
    units = {"modulus_unit": "MPa", "time_unit": "s", "temperature_unit": "degC"}
    card, same = opened(tmp_path, wrapped, **units), opened(tmp_path, ABAQUS, **units)
    assert card.material.name == "EPDM70"
    assert card.material.complex_modulus(OMEGA) == pytest.approx(same.material.complex_modulus(OMEGA), rel=1e-14)


@pytest.mark.parametrize("keyword", ["*ELASTIC, MODULI=INSTANTANEOUS", "*VISCOELASTIC, TIME=PRONY", "*DENSITY", "*TRS"])
def test_abaqus_keyword_lines_that_end_in_a_comma_keep_their_numbers(tmp_path, keyword):
    units = {"modulus_unit": "MPa", "time_unit": "s", "temperature_unit": "degC"}
    whole, comma = (opened(tmp_path, text, **units) for text in (ABAQUS, ABAQUS.replace(keyword, keyword + ",")))
    assert comma.material == whole.material
    assert comma.notes == whole.notes


def test_a_shift_that_is_no_subroutine_is_not_called_one(tmp_path):
    table = ABAQUS.replace("*TRS\n20., 8.86, 101.6", "*TRS, DEFINITION=TABULAR\n0., 20.\n-1., 40.")
    fictive = ANSYS.replace("1,2,TN", "1,3,FICT")
    for text, option in ((table, "TABULAR"), (fictive, "FICT")):
        card = opened(tmp_path, text, modulus_unit="MPa", time_unit="s")
        assert card.material.shift is None
        assert {note.code: note.values.get("option") for note in card.notes}["shift-not-read"] == option


def test_abaqus_elastic_bulk_is_exact_and_its_poisson_ratio_noted(tmp_path):
    text = ABAQUS.replace("0.5, 0.5, 0.01", "0.5, 0., 0.01").replace("0.3, 0.3, 1.0", "0.3, , 1.0")
    card = opened(tmp_path, text, modulus_unit="MPa", time_unit="s", temperature_unit="degC")
    glass = 60e6 / 2.98
    shear = maxwell(0.2 * glass, [(0.5 * glass, 0.01), (0.3 * glass, 1.0)])
    bulk = 60e6 / (3 * 0.02)
    assert card.material.complex_modulus(OMEGA) == pytest.approx(tensile(shear, bulk), rel=1e-12)
    rubber = 0.2 * glass
    ratio = (3 * bulk - 2 * rubber) / (2 * (3 * bulk + rubber))
    assert card.material.poisson_ratio == pytest.approx(ratio)
    (note,) = card.notes
    assert note.code == "ratio-of-rubber"
    assert note.values == pytest.approx({"glass": 0.49, "rubber": ratio})


def test_abaqus_bulk_that_relaxes_at_its_own_times(tmp_path):
    text = ABAQUS.replace("0.5, 0.5, 0.01", "0.5, 0., 0.01").replace("0.3, 0.3, 1.0", "0., 0.2, 7.0")
    card = opened(tmp_path, text, modulus_unit="MPa", time_unit="s", temperature_unit="degC")
    G, K = 60e6 / 2.98, 60e6 / 0.06
    expected = tensile(maxwell(0.5 * G, [(0.5 * G, 0.01)]), maxwell(0.8 * K, [(0.2 * K, 7.0)]))
    assert card.material.complex_modulus(OMEGA) == pytest.approx(expected, rel=1e-12)


def test_abaqus_hyperelastic_card_gives_its_small_strain_limit(tmp_path):
    text = """*Material, name=Rubber-1
*Hyperelastic, mooney-rivlin
0.4, 0.1, 0.001
*Viscoelastic, time=PRONY
0.6, 0., 0.1
"""
    card = opened(tmp_path, text, modulus_unit="MPa", time_unit="s")
    # Long-term: G = 2 (C10 + C01) = 1 MPa, K = 2/D1 = 2000 MPa.
    expected = tensile(maxwell(1e6, [(1.5e6, 0.1)]), 2000e6)
    assert card.material.complex_modulus(OMEGA) == pytest.approx(expected, rel=1e-12)
    assert card.notes[0].code == "hyperelastic"
    incompressible = opened(tmp_path, text.replace("0.4, 0.1, 0.001", "0.4, 0.1"), modulus_unit="MPa", time_unit="s")
    assert incompressible.material.poisson_ratio == 0.5
    assert pytest.approx(3e6) == incompressible.material.spectrum.E0


@pytest.mark.parametrize(("model", "constants", "shear"), [("neo hooke", "0.5", 1.0), ("yeoh", "0.7, -0.1, 0.01", 1.4)])
def test_abaqus_hyperelastic_models(tmp_path, model, constants, shear):
    text = (
        f"*MATERIAL, NAME=A\n*HYPERELASTIC, {model}, MODULI=LONG TERM\n{constants}\n*VISCOELASTIC, TIME=PRONY\n.5,,1.\n"
    )
    card = opened(tmp_path, text, modulus_unit="MPa", time_unit="s")
    assert pytest.approx(3e6 * shear) == card.material.spectrum.E0


@pytest.mark.parametrize(
    ("model", "constants"), [("neo hooke", "0.5"), ("mooney-rivlin", "0.4, 0.1"), ("yeoh", "0.5, 0., 0.")]
)
def test_abaqus_moduli_at_several_temperatures_are_those_of_the_first(tmp_path, model, constants):
    text = f"*MATERIAL, NAME=A\n*HYPERELASTIC, {model}\n{constants}\n0.4, 0.1\n*VISCOELASTIC, TIME=PRONY\n.5,,1.\n"
    card = opened(tmp_path, text, modulus_unit="MPa", time_unit="s")
    assert pytest.approx(3e6) == card.material.spectrum.E0
    assert card.material.poisson_ratio == 0.5
    assert "first-line-taken" in {note.code for note in card.notes}


def test_abaqus_arrhenius_has_its_own_gas_constant_and_zero(tmp_path):
    text = "*PHYSICAL CONSTANTS, ABSOLUTE ZERO=-273.15, UNIVERSAL GAS CONSTANT=8314.0\n" + ABAQUS.replace(
        "*TRS\n20., 8.86, 101.6", "*TRS, DEFINITION=ARRHENIUS\n20., 1.2e8"
    )
    shift = opened(tmp_path, text, modulus_unit="MPa").material.shift
    # Energy in mJ/mol with the gas constant in mJ/(mol K): E0/R = 14433 K.
    expected = 1.2e8 / 8314.0 * (1 / 323.15 - 1 / 293.15) / math.log(10)
    assert shift.log10("50 degC") == pytest.approx(expected)


def test_abaqus_energy_without_gas_constant_is_noted(tmp_path):
    text = ABAQUS.replace("*TRS\n20., 8.86, 101.6", "*TRS, DEFINITION=ARRHENIUS\n20., 1.2e5")
    card = opened(tmp_path, text, modulus_unit="MPa", time_unit="s", temperature_unit="degC")
    assert card.material.shift.activation_energy == pytest.approx(1.2e5)
    assert [note.code for note in card.notes] == ["unit-assumed"]


def test_abaqus_subroutines_and_other_keywords_are_reported(tmp_path):
    text = ABAQUS.replace("*TRS\n20., 8.86, 101.6", "*TRS, DEFINITION=USER\n*MULLINS EFFECT\n1.1, 2., 0.1")
    card = opened(tmp_path, text, modulus_unit="MPa", time_unit="s")
    assert card.material.shift is None
    assert [(note.code, note.values) for note in card.notes] == [
        ("not-read", {"names": ["MULLINSEFFECT"]}),
        ("shift-in-subroutine", {"option": "USER"}),
    ]


def test_the_first_viscoelastic_material_of_a_deck_is_read(tmp_path):
    steel = "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n"
    card = opened(tmp_path, steel + ABAQUS + ABAQUS.replace("EPDM70", "NR55"), modulus_unit="MPa", time_unit="s")
    assert card.material.name == "EPDM70"
    assert (card.notes[0].code, card.notes[0].values) == ("first-of-several", {"materials": 2, "read": "EPDM70"})


@pytest.mark.parametrize("modulus", ["2.3", "60.0", "7.1"])  # whose shear and bulk moduli round
def test_a_poisson_ratio_of_zero_is_read(tmp_path, modulus):
    one = opened(tmp_path, ABAQUS.replace("60.0, 0.49", f"{modulus}, 0."), modulus_unit="MPa").material
    assert one.poisson_ratio == 0.0
    assert one.spectrum.E_inf == pytest.approx(float(modulus) * 1e6)
    text = ANSYS.replace("0.45", "0.").replace("60.0e6", modulus).partition("TB,PRONY,1,1,1,BULK")[0]
    other = text + text[text.index("TB,PRONY") :].replace("SHEAR", "BULK")
    assert opened(tmp_path, other, modulus_unit="MPa").material.poisson_ratio == 0.0


def test_exponents_of_fortran_are_read(tmp_path):
    plain, units = opened(tmp_path, ABAQUS, modulus_unit="MPa").material, {"modulus_unit": "MPa"}
    written = ABAQUS.replace("60.0, 0.49", "6.D1, 49.d-2").replace("0.3, 0.3, 1.0", "3.-1, 3.0-1, 1.0+0")
    assert opened(tmp_path, written, **units).material.spectrum.E_inf == plain.spectrum.E_inf
    text = LS_DYNA.replace("1.1E-09    2000.0", " 1.1-09   2.0D+03").replace("   1000.0", "   1.00+3")
    assert opened(tmp_path, text, **units).material == opened(tmp_path, LS_DYNA, **units).material
    other = opened(tmp_path, ANSYS.replace("60.0e6", "6.D7").replace("303.15", "300.+3.15"), modulus_unit="Pa").material
    assert other.spectrum.E_inf == pytest.approx(60e6)
    assert other.shift.reference == pytest.approx(303.15)  # a sum in APDL


WLF_IN_CELSIUS = {"abaqus": "20., 8.86, 101.6", "ansys": "20,8.86,101.6", "ls-dyna": "20.,-20.4,101.6"}
WLF_IN_FAHRENHEIT = {"abaqus": "68., 8.86, 182.88", "ansys": "68,8.86,182.88", "ls-dyna": "68.,-20.4,182.88"}


def wlf_card(program, constants):
    if program == "abaqus":
        return ABAQUS.replace("20., 8.86, 101.6", constants)
    if program == "ansys":
        return ANSYS.replace("2,TN", "3,WLF").replace("303.15,15000", constants)
    return LS_DYNA.replace(
        "         7   1.1E-09    2000.0                        303.15    15000.", f"7,1,2e3,,,{constants}"
    )


@pytest.mark.parametrize("program", WLF_IN_CELSIUS)
def test_constants_of_a_wlf_law_in_degrees_fahrenheit_are_those_in_celsius(tmp_path, program):
    laws = [
        opened(
            tmp_path, wlf_card(program, constants[program]), modulus_unit="MPa", temperature_unit=unit
        ).material.shift
        for constants, unit in ((WLF_IN_CELSIUS, "degC"), (WLF_IN_FAHRENHEIT, "degF"))
    ]
    assert pytest.approx(101.6) == laws[1].C2  # 182.88 °F, a difference
    assert laws[1].log10("50 degC") == pytest.approx(laws[0].log10("50 degC"))


@pytest.mark.parametrize(
    ("program", "card"),
    [
        ("ansys", lambda: ANSYS.replace("303.15,15000", "86,27000")),
        ("ls-dyna", lambda: LS_DYNA.replace("303.15    15000.", "   86.    27000.")),
    ],
)
def test_activation_temperatures_in_degrees_fahrenheit_are_in_rankine(tmp_path, program, card):
    shift = opened(tmp_path, card(), modulus_unit="MPa", temperature_unit="degF").material.shift
    assert shift.reference == pytest.approx(303.15)
    assert shift.activation_energy == pytest.approx(15000 * GAS_CONSTANT)  # 27000/1.8 K


@pytest.mark.parametrize("unit", ["degF", None])  # the card's absolute zero is that of Fahrenheit
def test_abaqus_card_in_degrees_fahrenheit(tmp_path, unit):
    head = "*PHYSICAL CONSTANTS, ABSOLUTE ZERO=-459.67, UNIVERSAL GAS CONSTANT=4.619\n"
    wlf = opened(tmp_path, head + wlf_card("abaqus", "68., 8.86, 182.88"), temperature_unit=unit, modulus_unit="MPa")
    assert wlf.material.shift.reference == pytest.approx(293.15)
    assert pytest.approx(101.6) == wlf.material.shift.C2
    text = head + ABAQUS.replace("*TRS\n20., 8.86, 101.6", "*TRS, DEFINITION=ARRHENIUS\n68., 124713.")
    shift = opened(tmp_path, text, temperature_unit=unit, modulus_unit="MPa").material.shift
    assert shift.reference == pytest.approx(293.15)
    assert shift.activation_energy == pytest.approx(15000 * GAS_CONSTANT)  # 124713/4.619 = 27000 °R


# --- ANSYS -----------------------------------------------------------------------------------------------------

ANSYS = """/PREP7
MP,EX,1,60.0e6
MP,PRXY,1,0.45
TB,PRONY,1,1,2,SHEAR $ TBDATA,1,0.5,0.01,0.3,1.0
TB,PRONY,1,1,1,BULK
TBDATA,1,0.4,5.0   ! bulk
TB,SHIFT,1,1,2,TN
TBDATA,1,303.15,15000
"""


def test_ansys_card_by_hand(tmp_path):
    card = opened(tmp_path, ANSYS, modulus_unit="Pa", time_unit="s", temperature_unit="K")
    G, K = 60e6 / 2.9, 60e6 / 0.3
    expected = tensile(maxwell(0.2 * G, [(0.5 * G, 0.01), (0.3 * G, 1.0)]), maxwell(0.6 * K, [(0.4 * K, 5.0)]))
    assert card.material.complex_modulus(OMEGA) == pytest.approx(expected, rel=1e-12)
    # ln A = H/R (1/Tr − 1/T) multiplies time: α = 1/A
    expected = -15000 * (1 / 303.15 - 1 / 333.15) / math.log(10)
    assert card.material.shift.log10(333.15) == pytest.approx(expected)
    assert card.material.shift.activation_energy == pytest.approx(15000 * GAS_CONSTANT)


def test_ansys_commands_of_other_materials_do_not_count(tmp_path):
    steel = "MP,EX,2,210e9\nMP,PRXY,2,0.3\n"
    other = ANSYS.replace(",1,60.0e6", ",3,5e6").replace("PRXY,1", "PRXY,3").replace("NY,1,", "NY,3,")
    units = {"modulus_unit": "Pa", "time_unit": "s", "temperature_unit": "K"}
    alone = opened(tmp_path, ANSYS, **units)
    card = opened(tmp_path, steel + ANSYS + other.replace("SHIFT,1,1,2,TN", "SHIFT,3,1,2,TN"), **units)
    expected = alone.material.complex_modulus(OMEGA)
    assert card.material.complex_modulus(OMEGA) == pytest.approx(expected, rel=1e-14)
    (values,) = (note.values for note in card.notes if note.code == "first-of-several")
    assert values == {"materials": 2, "read": "1"}


def test_ansys_constants_go_on_after_the_last_one(tmp_path):
    pairs = ANSYS.replace("TBDATA,1,0.5,0.01,0.3,1.0", "TBDATA,,0.5,0.01\nTBDATA,,0.3,1.0")
    assert pairs != ANSYS
    units = {"modulus_unit": "Pa", "time_unit": "s", "temperature_unit": "K"}
    expected = opened(tmp_path, ANSYS, **units).material.complex_modulus(OMEGA)
    assert opened(tmp_path, pairs, **units).material.complex_modulus(OMEGA) == pytest.approx(expected, rel=1e-14)


def test_ansys_units_command_states_the_units(tmp_path):
    card = opened(tmp_path, "/UNITS,MPA\n" + ANSYS.replace("60.0e6", "60.0"), temperature_unit="K")
    assert card.material.spectrum.E_inf == pytest.approx(60e6)
    assert not any(note.code == "unit-assumed" for note in card.notes)
    with refused("unit-unknown", DataFileError):
        opened(tmp_path, "/UNITS,BIN\n" + ANSYS.replace("60.0e6", "60.0"))


@pytest.mark.parametrize(("unit", "noted"), [("Pa", True), ("kPa", True), ("MPa", False), ("N/mm**2", False)])
def test_other_units_than_those_of_the_ansys_units_command_are_noted(tmp_path, unit, noted):
    card = opened(tmp_path, "/UNITS,MPA\n" + ANSYS, modulus_unit=unit, time_unit="s", temperature_unit="K")
    assert any(note.code == "unit-contradicted" for note in card.notes) == noted


def test_ansys_materials_may_be_parameters_and_others_may_depend_on_temperature(tmp_path):
    units = {"modulus_unit": "MPa", "time_unit": "s", "temperature_unit": "degC"}
    plain = opened(tmp_path, ANSYS, **units)
    named = "matid=1\n" + ANSYS.replace("TB,PRONY,1,", "TB,PRONY,matid,") + "MP,DENS,1,1100,-0.5\nMP,EX,2,2e11,-5e7\n"
    assert opened(tmp_path, named, **units).material == plain.material


def test_ansys_arithmetic_in_fields(tmp_path):
    text = ANSYS.replace("2,TN\nTBDATA,1,303.15,15000", "3,WLF\nTBDATA,1,273+2*(10-5),17.44,-(-51.6)")
    shift = opened(tmp_path, text, temperature_unit="K").material.shift
    assert (shift.reference, shift.C1, shift.C2) == (283.0, 17.44, 51.6)


def test_published_ansys_card_with_wlf(real_data):
    card = open_card(real_data / "instruments" / "ansys_cards" / "E1_WLF.USER_MPL", modulus_unit="Pa", time_unit="s")
    spectrum = card.material.spectrum
    # MP,EX is the instantaneous modulus: 9115.80 MPa; thirty shear terms, bulk elastic.
    assert spectrum.E_inf == pytest.approx(9115.80e6, rel=1e-12)
    assert len(card.material.spectrum.to_relaxation()) == 30
    assert (card.material.shift.C1, card.material.shift.C2) == (199.73, 933.5)
    assert card.material.shift.reference == 268.0  # written 273-5
    found = {note.code: note for note in card.notes}
    assert set(found) == {"not-read", "ratio-of-rubber", "unit-assumed"}
    assert {"MP,ALPX", "MP,REFT", "MPAMOD", "MPTEMP", "MPTGEN"} <= set(found["not-read"].values["names"])
    # The first and last of its shear terms by hand: G_i = g_i G, G = E/(2 · 1.35).
    share = 1.0 - spectrum.E0 / spectrum.E_inf
    assert 0.9 < share < 1.0


def test_published_ansys_card_with_a_subroutine_for_its_shift(real_data):
    folder = real_data / "instruments" / "ansys_cards"
    card = open_card(folder / "E1_Poly.USER_MPL")
    assert card.material.shift is None
    (values,) = (note.values for note in card.notes if note.code == "shift-in-subroutine")
    assert values["option"] == "USER"
    assert values["constants"][:2] == pytest.approx([-343.398, 4.68277], rel=1e-5)
    same = open_card(folder / "E1_WLF.USER_MPL").material
    assert card.material.complex_modulus(OMEGA) == pytest.approx(same.complex_modulus(OMEGA), rel=1e-14)


# --- LS-DYNA ---------------------------------------------------------------------------------------------------

LS_DYNA = """*KEYWORD
*MAT_GENERAL_VISCOELASTIC_TITLE
Tread compound
$      mid        ro      bulk       pcf        ef      tref         a         b
         7   1.1E-09    2000.0                        303.15    15000.
$     lcid        nt    bstart     tramp     lcidk       ntk   bstartk    trampk

$       gi     betai        ki    betaki
       1.0
       5.0    1000.0
       3.0       2.0
*END
"""


def test_ls_dyna_card_in_standard_format(tmp_path):
    card = opened(tmp_path, LS_DYNA, modulus_unit="MPa", time_unit="s", temperature_unit="K")
    expected = tensile(maxwell(1e6, [(5e6, 1e-3), (3e6, 0.5)]), 2000e6)
    assert card.material.complex_modulus(OMEGA) == pytest.approx(expected, rel=1e-12)
    assert card.material.name == "Tread compound"
    # Φ = exp(−A (1/T − 1/TREF)) multiplies time: at 333.15 K by hand
    phi = math.exp(-15000 * (1 / 333.15 - 1 / 303.15))
    assert card.material.shift(333.15) == pytest.approx(1 / phi)


def test_ls_dyna_wlf_multiplies_time(tmp_path):
    fixed = "         7   1.1E-09    2000.0                        303.15    15000."
    assert fixed in LS_DYNA
    commas = LS_DYNA.replace(fixed, "7,1.1e-9,2000.0,,,303.15,-20.4,101.6")
    shift = opened(tmp_path, commas, modulus_unit="MPa", time_unit="s", temperature_unit="K").material.shift
    phi = math.exp(20.4 * 30 / 131.6)
    assert shift(333.15) == pytest.approx(1 / phi)
    wrong = opened(tmp_path, commas.replace("-20.4", "20.4"), modulus_unit="MPa", time_unit="s")
    assert wrong.material.shift is None
    assert wrong.notes[0].code == "wrong-sign"


def test_the_first_ls_dyna_material_of_a_deck_is_read_and_named(tmp_path):
    deck = LS_DYNA.replace("         7   1.1E-09", "   1234567   1.1E-09") + LS_DYNA.partition("\n")[2]
    card = opened(tmp_path, deck, modulus_unit="MPa", time_unit="s")
    expected = ("first-of-several", {"materials": 2, "read": "1234567"})
    assert expected in [(note.code, note.values) for note in card.notes]


def test_ls_dyna_long_format_is_reported_by_keyword_or_deck(tmp_path):
    lines = [
        "".join(f"{one:>20}" for one in row)
        for row in (("7", "1.1e-9", "2000.0"), ("0",), ("1.0",), ("5.123456789012", "1000.0"))
    ]
    for head in ("*KEYWORD LONG=Y\n*MAT_076\n", "*KEYWORD\n*MAT_GENERAL_VISCOELASTIC +\n"):
        card = opened(tmp_path, head + "\n".join(lines) + "\n*END\n", modulus_unit="Pa", time_unit="s")
        expected = tensile(maxwell(1.0, [(5.123456789012, 1e-3)]), 2000.0)
        assert card.material.complex_modulus(OMEGA) == pytest.approx(expected, rel=1e-12)


# --- COMSOL ----------------------------------------------------------------------------------------------------

COMSOL = """G_long_term 0.5[MPa]
nu 0.49 "Poisson ratio"
G_1 2[MPa] "branch"
tau_1 10[ms]
T_reference 25[degC]
Q_arrhenius 120[kJ/mol]
width 3[mm]
"""


def test_comsol_parameters_have_units(tmp_path):
    card = opened(tmp_path, COMSOL)
    assert card.material.complex_modulus(OMEGA) == pytest.approx(2.98 * maxwell(0.5e6, [(2e6, 0.01)]), rel=1e-12)
    assert card.material.shift.activation_energy == pytest.approx(120e3)
    assert card.material.shift.reference == pytest.approx(298.15)
    (note,) = card.notes
    assert (note.code, note.values) == ("not-read", {"names": ["width"]})


def test_a_bare_table_of_branches_lacks_its_long_term_modulus(tmp_path):
    with refused("no-modulus", DataFileError):
        opened(tmp_path, "1 2.0e6 0.01\n2 1.0e6 0.1\n")


@pytest.mark.parametrize(
    ("card", "old", "new", "refusal"),
    [
        (ABAQUS, "0.3, 0.3, 1.0", "0.3, 0.3, 0.", ("no-terms",)),
        (ABAQUS, "*ELASTIC, MODULI=INSTANTANEOUS\n60.0, 0.49\n", "", ("no-modulus",)),
        (ABAQUS, "20., 8.86, 101.6", "20., 8.86", ("missing-constants",)),
        (ABAQUS, "*ELASTIC, MODULI", "*ELASTIC, TYPE=ORTHOTROPIC, MODULI", ("not-isotropic",)),
        (ANSYS, "0.45", "0.5", ("not-positive", "0.5")),
        (ANSYS, "0.3,1.0", "0.3", ("row-length",)),
        (ANSYS, "TBDATA,1,0.4,5.0", "TBDATA,1e30,0.4,5.0", ("out-of-range",)),
        (ANSYS, "303.15,15000", "303.15", ("missing-constants",)),
        (ANSYS, "60.0e6", "__import__('os')", ("not-a-number",)),
        (ANSYS, "60.0e6", "60.0e6,-1e4", ("several-temperatures", "line 2")),
        (
            ANSYS,
            "TBDATA,1,0.4,5.0",
            "TBTEMP,20\nTBDATA,1,0.4,5\nTBTEMP,60\nTBDATA,1,0.5,5",
            ("several-temperatures", "line 5"),
        ),
        (ANSYS, ",2,SHEAR", ",2,INTEGRAL", ("no-terms",)),
        (LS_DYNA, "       1.0\n", "", ("relative-moduli",)),
        (LS_DYNA, "       5.0    1000.0", "      -5.0    1000.0", ("not-positive",)),
        (LS_DYNA, "       5.0    1000.0", "       5.x    1000.0", ("not-a-number", "line 10", "'5.x    1000.0'")),
        (LS_DYNA, "trampk\n\n$       gi", "trampk\n        12\n$       gi", ("load-curves",)),
        (COMSOL, 'nu 0.49 "Poisson ratio"\n', "", ("missing-constants",)),
        (COMSOL, "10[ms]", "10[mm]", ("wrong-unit",)),
        (COMSOL, "0.5[MPa]", "0.5", ("no-unit", "0.5[Pa]")),
        (COMSOL, "25[degC]", "25", ("no-unit", "25[K]")),
        (COMSOL, "0.5[MPa]", "0[MPa]", ("liquid",)),
    ],
)
def test_cards_that_make_no_solid_are_refused(tmp_path, card, old, new, refusal):
    """And what `test_messages` has of them."""
    assert old in card
    with refused(refusal[0], DataFileError, naming=refusal[1:]):
        opened(tmp_path, card.replace(old, new))
