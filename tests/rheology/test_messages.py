"""Messages of the room: what is done, and the sentence that follows."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from rheology.test_cards_foreign import ABAQUS, ANSYS, COMSOL, LS_DYNA
from rheology.test_cards_round_trip import rubber
from viscofric.rheology.cards import open_card
from viscofric.rheology.spectra.quality import FROM_FRICTION, SpectrumFit

KELVIN = np.arange(0.0, 121.0, 10.0) + 273.15
WLF = vf.WLF(8.0, 120.0, "30 degC")
FITTED = vf.WLF(8.0, 120.0, "30 degC", covariance=np.diag([1e-6, 1e-4]), fitted_range=("0 degC", "120 degC"))
FACTORS = vf.ShiftFactors(KELVIN, WLF.log10(KELVIN), 303.15)
TWO = vf.ShiftFactors([273.15, 303.15], [1.0, 0.0], 303.15)
SOLID = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms")
TABLE = vf.rheology.ModulusTable([1.0, 10.0], [3e6, 4e6], [3e5, 4e5])
LIQUID = vf.RelaxationSpectrum(0.0, [1e6], [1.0])


def written(name: str, text: str) -> str:
    Path(name).write_text(text, encoding="utf-8")
    return name


def card(text: str, old: str, new: str) -> vf.Material:
    assert old in text
    return vf.read_card(written("card", text.replace(old, new)))


abaqus, ansys, comsol, ls_dyna = (partial(card, text) for text in (ABAQUS, ANSYS, COMSOL, LS_DYNA))


def shifts(text: str) -> vf.ShiftFactors:
    return vf.read_shift_factors(written("a.csv", text))


SAID = [
    (
        lambda: FITTED("180 degC"),
        "outside-fitted",
        (
            "temperature = 180.0 °C lies 60 K above the 0.0 to 120.0 °C that this WLF law was fitted on. It is "
            "valid up to 170.0 °C only, because it is used no more than 50 K beyond its data; measure isotherms "
            "there, or lift the limit with unbounded() of the law, in Python."
        ),
    ),
    (
        lambda: FITTED("-25 degC"),
        "outside-fitted",
        (
            "temperature = −25.0 °C lies 25 K below the 0.0 to 120.0 °C that this WLF law was fitted on. It is "
            "valid down to −20.0 °C only, because it is used no more than 20 K beyond its data; measure isotherms"
            " there, or lift the limit with unbounded() of the law, in Python."
        ),
    ),
    (
        lambda: WLF("-100 degC"),
        "below-pole",
        "temperature = −100.0 °C: the WLF law diverges at −90.0 °C and is valid above it only.",
    ),
    (
        lambda: WLF.standard_error("60 degC"),
        "no-covariance",
        (
            "the uncertainty of this WLF law is not known, because its constants have no covariance; fit the law "
            "to measured shift factors, or give the covariance."
        ),
    ),
    (
        lambda: vf.InversePolynomial([5000.0], "30 degC", None),
        "polynomial-without-range",
        (
            "a polynomial law is valid only between the temperatures that it was fitted on: it needs their range "
            "(fitted_range) and cannot be without bounds; take a WLF or an Arrhenius law to extrapolate."
        ),
    ),
    (
        lambda: vf.InversePolynomial([-5000.0], "30 degC", ("0 degC", "60 degC")),
        "law-rises",
        (
            "the polynomial of degree 1 rises with temperature somewhere between 0.0 and 60.0 °C, which no shift "
            "factor does; take a lower degree, or another law."
        ),
    ),
    (
        lambda: FACTORS("130 degC"),
        "outside-measured",
        (
            "temperature = 130.0 °C lies outside the shift factors, 0.0 to 120.0 °C; fit a law (such as WLF or "
            "Arrhenius) to extrapolate."
        ),
    ),
    (
        lambda: FACTORS(60.0),
        "outside-measured",
        (
            "temperature = −213.1 °C lies outside the shift factors, 0.0 to 120.0 °C; fit a law (such as WLF or "
            "Arrhenius) to extrapolate; plain numbers are kelvin: for 60 °C write '60 degC'."
        ),
    ),
    (
        lambda: FACTORS.law("cubic"),
        "unknown-law",
        "law = 'cubic': must be 'wlf', 'arrhenius', 'vft', 'wlf+arrhenius' or 'polynomial'.",
    ),
    (lambda: TWO.law("wlf"), "too-few-temperatures", "2 temperatures are too few to fit 'wlf'; give 3 or more."),
    (
        lambda: vf.ShiftFactors(KELVIN, 0.01 * (KELVIN - 300), 303.15).law("arrhenius"),
        "no-law",
        "the shift factors rise with temperature: no Arrhenius law describes them.",
    ),
    (
        lambda: vf.WLF(8.0, 400.0, "30 degC").to_vft(),
        "no-law",
        (
            "the shift factors are too straight for a VFT law, whose pole would lie below absolute zero; use a "
            "WLF or an Arrhenius law instead."
        ),
    ),
    (
        lambda: vf.rheology.VerticalShiftFactors(["0 degC", "60 degC"], [0.0, 0.04], "0 degC")("61 degC"),
        "outside-measured",
        (
            "temperature = 61.0 °C lies outside 0.0 to 60.0 °C, where the vertical shift was measured; a "
            "density shift, ρT/(ρ0 T0), is valid beyond."
        ),
    ),
    (
        lambda: TABLE.complex_modulus(100.0),
        "outside-table",
        (
            "angular frequency = 100 rad/s lies outside the table's 1 to 10 rad/s; extrapolate='plateau' treats "
            "its ends as plateaus, and a fitted spectrum goes beyond."
        ),
    ),
    (
        lambda: vf.Material(TABLE).modes_at(),
        "too-short",
        "a modulus table of 2 frequencies is too short for retardation modes; give 4 or more.",
    ),
    (
        lambda: LIQUID.to_retardation(),
        "liquid",
        (
            "E0 = 0: a liquid has no rubber plateau and creeps without end, so that it has no retardation "
            "spectrum; give E0 above zero."
        ),
    ),
    (
        lambda: LIQUID.compliance(0.0),
        "liquid",
        "compliance at frequency 0: E0 = 0, a liquid flows without bound at rest.",
    ),
    (
        lambda: vf.Material.standard_linear_solid("10 MPa", "1 MPa", "1 ms"),
        "modulus-order",
        "E0 = 1e+07 Pa must be below E_inf = 1e+06 Pa.",
    ),
    (
        lambda: SOLID.at("60 degC"),
        "no-shift",
        (
            "temperature: this material has no shift, so its temperature cannot be chosen; give "
            "Material(spectrum, shift=WLF(…)) or leave out temperature."
        ),
    ),
    (
        lambda: vf.Material(3e6),  # type: ignore[arg-type]
        "wrong-type",
        "spectrum = 3000000.0: must be a RetardationSpectrum, a RelaxationSpectrum or a ModulusTable.",
    ),
    (
        lambda: vf.Material(SOLID.spectrum, vertical_shift=vf.rheology.DensityShift(303.15)),
        "no-shift",
        "vertical_shift of a material needs a shift too, which gives its reference.",
    ),
    (
        lambda: vf.catalogue_material("VHB 4911"),
        "unknown-material",
        "name = 'VHB 4911': the catalogue has no such material; did you mean 'VHB 4910'?",
    ),
    (
        lambda: vf.write_card(SOLID, "card", "abaqus", law="best"),
        "no-table",
        "law = 'best': the material has no table of shift factors to fit a law to; leave it out.",
    ),
    (
        lambda: vf.write_card(SOLID, "card", "ansys"),
        "incompressible",
        (
            "ANSYS needs a Poisson ratio below 0.5 (MP,PRXY), and this material has 0.5; give the card a nearly "
            "incompressible one, poisson_ratio=0.4995 for instance (E stays as it is, 2(1+ν)G changes with it)."
        ),
    ),
    (
        lambda: vf.write_card(SOLID, "card", "ls-dyna", poisson_ratio=0.49),
        "no-density",
        "LS-DYNA needs a density, such as density=1100 for 1100 kg/m³.",
    ),
    (
        lambda: vf.write_card(SOLID, "card", "comsol", modulus_unit="MPa"),
        "not-of-format",
        ("modulus_unit = 'MPa': comsol has no such choice; leave it out (it is for abaqus, ansys, ls-dyna)."),
    ),
    (
        lambda: vf.write_card(vf.Material(TABLE), "card", "abaqus"),
        "no-modes",
        (
            "Abaqus cards contain a Prony series, but this material is a table of moduli; fit a spectrum "
            'first, or write format="json".'
        ),
    ),
    (
        lambda: vf.read_card(written("letter", "Dear colleague,\n")),
        "unknown-card",
        (
            "letter: is not a material card. Supported are Abaqus, ANSYS and LS-DYNA cards with a Prony series, "
            "COMSOL parameters, and material files of viscofric (JSON); `viscofric material fit` makes one"
            " from DMA sweeps."
        ),
    ),
    (
        lambda: vf.read_shift_factors(written("a.csv", "T_C,log10_aT\n0,-1\n20,0\n40,1\n")),
        "factors-rise",
        (
            "a.csv: the shift factors rise with temperature, but α must fall, E(ω, T) = E(α(T) ω, T0); flip the "
            "sign of the logarithm, or give inverse=True."
        ),
    ),
    (
        lambda: vf.read_shift_factors(written("a.csv", "T_C,log10_aT\n0,3\n20,2\n40,1\n")),
        "no-reference",
        "a.csv: log10 aT is not zero between 0.0 and 40.0 °C; give the temperature where α is 1 (reference=).",
    ),
    (
        lambda: abaqus("0.3, 0.3, 1.0", "0.5, 0.5, 1.0"),
        "relative-moduli",
        (
            "card: the long-term shear modulus is zero (the relative moduli add up to 1, or no term is constant): a "
            "liquid has no rubber plateau, which a Material needs."
        ),
    ),
    (
        lambda: abaqus("0.3, 0.3, 1.0", "0.6, 0.6, 1.0"),
        "relative-moduli",
        "card: the relative moduli add up to 1.1; they must stay below 1.",
    ),
    (
        lambda: abaqus("0.3, 0.3, 1.0", "0.3, 0.3, soft"),
        "not-a-number",
        "card: line 10: '0.3, 0.3, soft' is not a row of numbers parted by commas.",
    ),
    (
        lambda: abaqus("TIME=PRONY", "TIME=CREEP TEST DATA"),
        "not-prony",
        ("card: line 8: *VISCOELASTIC must have TIME=PRONY or FREQUENCY=PRONY; other ways of giving it are not read."),
    ),
    (
        lambda: abaqus("60.0, 0.49", "60.0, 0.6"),
        "no-modulus",
        "card: line 6: *ELASTIC needs a modulus above zero, a Poisson ratio from 0 to 0.5.",
    ),
    (
        lambda: ansys("MP,PRXY,1,0.45\n", ""),
        "no-modulus",
        (
            "card: contains no MP,EX or no MP,PRXY (nor NUXY) of material 1, so that its instantaneous moduli are not "
            "known."
        ),
    ),
    (
        lambda: ansys("TBDATA,1,0.4,5.0", "TBDATA,2,0.4"),
        "missing-constants",
        "card: line 5: TB,PRONY,…,BULK lacks constant 1 of 2.",
    ),
    (
        lambda: ansys("60.0e6", "9**9**9"),
        "not-a-number",
        "card: line 2: '9**9**9' is neither a number nor simple arithmetic.",
    ),
    (
        lambda: comsol("tau_1 10[ms]\n", ""),
        "missing-constants",
        "card: lacks the parameter tau_1.",
    ),
    (
        lambda: comsol("10[ms]", "ten"),
        "not-a-number",
        "card: line 4: 'tau_1 ten' is not a name, a number with [unit] and a description.",
    ),
    (
        lambda: ls_dyna("    2000.0", "       0.0"),
        "not-positive",
        "card: the bulk modulus BULK and all KI are zero; one of them must be above zero.",
    ),
    (
        lambda: ls_dyna("    2000.0", "       1.0"),
        "out-of-range",
        (
            "card: shear and bulk moduli give Poisson ratios of 0.125 (long-term) and -0.625 (instantaneous); both "
            "must lie between 0 and 0.5."
        ),
    ),
    (
        lambda: shifts("T_C,E\n1,2\n3,4\n"),
        "missing-columns",
        (
            "a.csv: no row names columns for log10 shift factor; a table of shift factors has 'temperature (degC)' or "
            "'T_C', and 'log10 aT' or 'aT', this file has 'T_C', 'E'; name them, e.g. "
            "columns={'log10_shift_factor': 'heading'}."
        ),
    ),
    (
        lambda: shifts("T,log_aT\n1,2\n3,0\n"),
        "no-unit",
        "a.csv: column 'T' has no unit; write it as 'T (degC)', or name it: columns={'temperature': 'T (degC)'}.",
    ),
    (
        lambda: shifts("T_C,aT\n1,2\n3,-1\n"),
        "not-positive",
        "a.csv, line 3: a shift factor aT must be above zero; name the column 'log10 aT' if it holds logarithms.",
    ),
    (
        lambda: shifts("T_C,log_aT\n1,2\n3\n"),
        "row-length",
        "a.csv, line 3: the row has 1 cells where the header names 2 columns.",
    ),
    (
        lambda: shifts("T_C,log_aT\n1,1\n1,0\n"),
        "wrong-length",
        "a.csv: shift factors need at least two temperatures, none twice, all above absolute zero.",
    ),
    (
        lambda: shifts("T_C,log_aT,cov 1\n1,1,0\n2,0,0\n"),
        "missing-columns",
        "a.csv: the covariance must have the columns cov 1 to cov 2, one for each row.",
    ),
    (
        lambda: vf.readers.StepTest(300.0, [2.0, 1.0, 3.0], [1e-6, 2e-6, 3e-6]),
        "not-ascending",
        "the times of a step test must ascend without repeats.",
    ),
    (
        lambda: vf.readers.StepTest(300.0, [1.0, 2.0, 3.0], [-1e-6, 2e-6, 3e-6]),
        "wrong-length",
        "response of a step test must be one row of positive numbers, one per time.",
    ),
]


@pytest.mark.parametrize(("does", "code", "message"), SAID, ids=[code for _, code, _ in SAID])
def test_message(
    does: Callable[[], object], code: str, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(vf.ViscofricError) as caught:
        does()
    assert (caught.value.code, str(caught.value)) == (code, message)


NOTES = [
    (
        ABAQUS.replace("*TRS\n20., 8.86, 101.6", "*TRS, DEFINITION=USER\n*MULLINS EFFECT\n1.1, 2., 0.1"),
        {"modulus_unit": "MPa", "time_unit": "s"},
        [
            "Keywords that were not read: *MULLINSEFFECT.",
            (
                "*TRS, DEFINITION=USER is a subroutine outside the card; the material holds at its reference "
                "temperature only."
            ),
        ],
    ),
    (
        ABAQUS + ABAQUS.replace("EPDM70", "NR55"),
        {"modulus_unit": "MPa", "time_unit": "s", "temperature_unit": "degC"},
        ["The file holds 2 viscoelastic materials; the first, 'EPDM70', was read."],
    ),
    (COMSOL, {}, ["Parameters that were not read: width."]),
    (
        ABAQUS.replace("60.0", "60e6"),
        {"temperature_unit": "degC"},
        [
            (
                "The card does not state its units; Pa and s were assumed (give others with modulus_unit='MPa', "
                "time_unit='ms')."
            ),
        ],
    ),
]


@pytest.mark.parametrize(("text", "units", "notes"), NOTES)
def test_notes_on_cards(text: str, units: dict[str, str], notes: list[str], tmp_path: Path) -> None:
    (tmp_path / "card").write_text(text, encoding="utf-8")
    assert list(open_card(tmp_path / "card", **units).notes) == notes


def test_notes_on_step_tests() -> None:
    step = vf.readers.StepTest(300.0, [1.0, 2.0, 3.0], [1e-6, 2e-6, 3e-6])
    assert vf.readers.StepTests((step,), "creep", "shear").in_tension(0.5).notes == (
        "Shear responses converted to tensile ones by E = 2(1+ν)G with ν = 0.5.",
    )


def test_comments_of_cards(tmp_path: Path) -> None:
    """What a user of the program must check by hand is in the comments of the card, and only where it applies."""

    def comments(program: str, law: vf.WLF | vf.Arrhenius | None, mark: str) -> str:
        material = vf.Material(SOLID.spectrum, law, 0.49)
        text = vf.write_card(material, tmp_path / "card", program, density=1100.0).read_text(encoding="utf-8")
        return " ".join(line[len(mark) :].strip() for line in text.splitlines() if line.startswith(mark))

    check = "Check it on one element: if that relaxes slower when warm, change the sign of A"
    assert check in comments("ls-dyna", vf.WLF(8.86, 101.6, 298.0), "$")
    for law in (None, vf.Arrhenius(1e5, 298.0)):
        assert "one element" not in comments("ls-dyna", law, "$")
    said = comments("comsol", None, "% ")
    assert "enter K_constant, that of the glass" in said
    assert "percent too stiff in the rubber" in said
    assert '"Volumetric and deviatoric" (in COMSOL 6.2)' in said


MEASURED: dict[str, Any] = {"E0_extrapolated": False, "E_inf_extrapolated": False, "frequency_range": (1.0, 10.0)}


def test_plain_numbers_are_named_to_users_of_python_only() -> None:
    """Commands, run files and the page take a temperature with its unit: −200 °C there is no 73 °C."""
    for of in (vf.synthetic_fluoroelastomer().shift, FACTORS, vf.WLF(10.0, 100.0, 293.15)):
        with pytest.raises(vf.InputError) as caught:
            of(73.15)
        assert "'73.15 degC'" in caught.value.note.words("python")
        for reader in ("shell", "run_file", "page"):
            assert "kelvin" not in caught.value.note.words(reader)
            said = caught.value.note.words(reader)
            assert said.endswith(("extrapolate.", "extrapolates.", "decades.", "above it only."))


@pytest.mark.parametrize(
    ("known", "remarks"),
    [
        ({}, ("reached by the measurement", "reached by the measurement")),
        (
            {"method": FROM_FRICTION, "E_inf_extrapolated": True},
            (None, "extrapolated: beyond the range of the friction"),
        ),
        (
            {"E0_missed": True, "E_inf_missed": True, "measured_storage": (2.838e6, 5e8)},
            (
                "the fit lies above the smallest measured modulus, 2.838 MPa",
                "the fit lies below the largest measured modulus, 500 MPa",
            ),
        ),
        (
            {"E_inf_at_limit": True},
            (
                None,
                "not known: the measurement does not reach it, and the fit stopped at 30 times the largest modulus",
            ),
        ),
    ],
)
def test_remarks_on_limits_of_a_fit(known: dict[str, Any], remarks: tuple[str | None, str]) -> None:
    fit = SpectrumFit(0.01, 0.01, **{**MEASURED, **known})
    assert remarks[0] in (None, fit.E0_remark)
    assert remarks[1] == fit.E_inf_remark


def test_entries_without_a_shift_are_valid_at_one_temperature_only() -> None:
    for entry in vf.catalogue():
        assert ("valid at one temperature only" in entry.holds) == (vf.catalogue_material(entry.name).shift is None)


@pytest.mark.parametrize(
    ("change", "program", "settings", "remark"),
    [
        ({"poisson_ratio": 0.5}, "abaqus", {}, "use hybrid (mixed) elements"),
        ({"poisson_ratio": 0.5}, "comsol", {}, "use hybrid (mixed) elements"),
        ({"poisson_ratio": 0.5}, "ansys", {"poisson_ratio": 0.4999}, "Poisson ratio is 0.5; this card"),
        ({"poisson_ratio": 0.5}, "ls-dyna", {"poisson_ratio": 0.4999}, "Poisson ratio is 0.5; this card"),
        ({}, "abaqus", {"temperature_unit": "degC"}, "temperatures in degrees Celsius"),
        ({}, "ansys", {"temperature_unit": "degC"}, "temperatures in degrees Celsius"),
        ({}, "ls-dyna", {"temperature_unit": "degC"}, "temperatures in degrees Celsius"),
        ({}, "abaqus", {"domain": "frequency"}, "is valid at 25 degrees Celsius only"),
        ({"vertical_shift": vf.rheology.DensityShift(298.15)}, "ansys", {}, "vertical shift of the modulus"),
    ],
)
@pytest.mark.filterwarnings("ignore::UserWarning")
def test_remarks_in_cards(
    tmp_path: Path, change: dict[str, Any], program: Any, settings: dict[str, Any], remark: str
) -> None:
    path = vf.write_card(rubber("wlf", **change), tmp_path / "card", program, density=1100.0, **settings)
    assert remark in " ".join(path.read_text().replace("\n! ", " ").replace("\n$ ", " ").split())
