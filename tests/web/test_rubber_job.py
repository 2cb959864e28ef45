"""The rubber as the page gets it: the numbers are those of the Python interface, and hold what was planted."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from rheology.planted import liquid_modulus, write_moduli
from viscofric.notes import Note, Remedy
from viscofric.rheology.catalogue import catalogue_material
from viscofric.study.rubber import Rubber
from viscofric.web.jobs.context import Context, JobError
from viscofric.web.jobs.spectrum_numbers import spectrum_numbers
from web.figure_columns import value_at
from web.rubber_workspace import EXAMPLE, SWEEPS, done, workspace_with

DRAWS = {"draws": 40}


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Context:
    return workspace_with(tmp_path_factory.mktemp("tab"), EXAMPLE)


@pytest.fixture(scope="module")
def rubber(workspace: Context) -> Any:
    return done("rubber", workspace, {**SWEEPS, "shift": "wlf"}, uncertainty=DRAWS)


@pytest.fixture(scope="module")
def fit() -> vf.rheology.Superposition:
    return vf.superpose(vf.read_dma(EXAMPLE), "30 degC")


def test_shift_factors_and_their_bars_are_those_of_superposition(rubber: Any, fit: vf.rheology.Superposition) -> None:
    factors = rubber["shift"]["factors"]
    np.testing.assert_allclose(factors["log10_shift_factor"], fit.shift_factors.log10_values, rtol=5e-6)
    np.testing.assert_allclose(factors["error95"], 1.959964 * fit.shift_factors.standard_errors, rtol=5e-6, atol=1e-12)
    assert not any(factors["held"])
    assert rubber["shift"]["misfit"]["joint"] == pytest.approx(fit.quality.joint, rel=5e-6)


def test_isotherms_are_moved_by_their_factors(rubber: Any, fit: vf.rheology.Superposition) -> None:
    for reported, one, shift in zip(
        rubber["shift"]["isotherms"], fit.isotherms, fit.shift_factors.log10_values, strict=True
    ):
        np.testing.assert_allclose(reported["angular_frequency"], one.angular_frequency * 10.0**shift, rtol=1e-5)
        np.testing.assert_allclose(reported["storage_modulus"], one.storage_modulus, rtol=5e-6)
    assert [one["temperature"] for one in rubber["shift"]["isotherms"] if one["is_reference"]] == [303.15]


def test_laws_are_compared_and_the_one_used_is_marked(rubber: Any, fit: vf.rheology.Superposition) -> None:
    laws = {one["kind"]: one for one in rubber["shift"]["laws"]}
    assert [kind for kind, one in laws.items() if one["used"]] == ["wlf"]
    compared = fit.shift_factors.compare_laws()
    assert [kind for kind, one in laws.items() if one["chosen"]] == [compared.chosen.kind]
    assert laws["wlf"]["aic"] == pytest.approx(compared.rows[0].aic if compared.rows[0].kind == "wlf" else 0, rel=5e-6)
    low, high = laws["wlf"]["limits"]["valid"]
    fitted = laws["wlf"]["limits"]["fitted"]
    assert low < fitted[0] < fitted[1] < high
    assert laws["wlf"]["ends"][0] == pytest.approx(low, abs=0.1)
    # 1 % noise leaves log10 α uncertain by hundredths of a decade
    assert np.max(np.abs(laws["wlf"]["residual"]["log10_residual"])) < 0.05


def test_verdict_is_that_of_the_check(rubber: Any, fit: vf.rheology.Superposition) -> None:
    check = rubber["check"]
    assert check["verdict"] == "holds"
    assert check["sentences"] == list(fit.check.sentences)
    assert check["kramers_kronig"]["holds"] == 1


@pytest.mark.parametrize("vertical", [None, "density"])
def test_diagrams_are_columns_of_the_shifted_isotherms(workspace: Context, vertical: Literal["density"] | None) -> None:
    material = SWEEPS if vertical is None else SWEEPS | {"vertical_shift": vertical}
    reply = done("rubber", workspace, material, options={"bands": False})
    expected = vf.superpose(vf.read_dma(EXAMPLE), "30 degC", vertical=vertical).check
    storage, loss = expected.storage_modulus, expected.loss_modulus
    size, angle, tangent = np.hypot(storage, loss), np.arctan2(loss, storage), loss / storage
    diagrams = {
        "van_gurp_palmen": (size, angle), "booij_thoone_palmen": (size, tangent),
        "cole_cole": (storage, loss), "wicket": (storage, tangent),
    }  # fmt: skip
    for name, diagram in diagrams.items():
        traces = reply["figures"][f"diagram-{name}"]["traces"]
        for axis, wanted in zip("xy", diagram, strict=True):
            shown = np.concatenate([value_at(reply, one[axis]) for one in traces])
            np.testing.assert_allclose(shown, wanted, rtol=5e-6)  # six digits
        kelvin = np.repeat([one["temperature"] for one in traces], [len(value_at(reply, one["x"])) for one in traces])
        np.testing.assert_allclose(kelvin, expected.temperature, rtol=5e-6)


def test_readings_are_sent_once(rubber: Any, fit: vf.rheology.Superposition) -> None:
    """Figures share columns: six of isotherms, four of the master curve, two of residuals; ten characters a number."""
    readings = sum(len(one) for one in fit.isotherms)
    # moduli, bands and laws are lines whose length does not depend on the readings
    assert len(json.dumps(rubber, separators=(",", ":"))) < 12 * 11 * readings + 100_000


def test_spectrum_and_its_moduli_belong_together(rubber: Any) -> None:
    spectrum = rubber["spectrum"]
    modes = vf.RetardationSpectrum(
        1.0 / (1.0 / spectrum["modes"]["E_inf"] + sum(spectrum["modes"]["creep_coefficient"])),
        spectrum["modes"]["E_inf"],
        spectrum["modes"]["creep_coefficient"],
        spectrum["modes"]["retardation_time"],
    )
    line = spectrum["modulus"]
    expected = modes.complex_modulus(line["angular_frequency"])
    np.testing.assert_allclose(line["storage_modulus"], expected.real, rtol=1e-4)  # sums of numbers of six digits
    np.testing.assert_allclose(line["loss_tangent"], expected.imag / expected.real, rtol=1e-4)
    series = spectrum["relaxation"]
    assert series["E0"] + sum(series["modulus"]) == pytest.approx(series["E_inf"], rel=1e-4)
    residual = np.array(spectrum["residual"]["storage_modulus"])
    assert np.sqrt(np.mean(residual**2)) == pytest.approx(spectrum["fit"]["rms_storage"], rel=1e-3)


def test_band_holds_the_planted_rubber(rubber: Any) -> None:
    planted = catalogue_material("synthetic fluoroelastomer")
    band, low_high = rubber["band"], rubber["spectrum"]["fit"]["frequency_range"]
    omega = np.array(band["angular_frequency"])
    measured = (omega > low_high[0]) & (omega < low_high[1])
    expected = planted.complex_modulus(omega, "30 degC")
    for name, values in (("storage_modulus", expected.real), ("loss_modulus", expected.imag)):
        lower, upper = np.array(band[f"{name}_lower"]), np.array(band[f"{name}_upper"])
        held = np.mean(((values >= lower) & (values <= upper))[measured])
        # 95 % pointwise, neighbours alike: of one draw of the noise some 80 to 100 %
        assert held > 0.75
    assert band["draws"] == 40


def test_answer_without_bands_comes_first(workspace: Context) -> None:
    reported: list[tuple[str, dict[str, Any]]] = []
    context = Context(
        workspace.files, workspace.downloads, workspace.cache, lambda event, what: reported.append((event, what))
    )
    answer = done("rubber", context, {**SWEEPS, "shift": "wlf"}, uncertainty=DRAWS)
    (part,) = [what["part"] for event, what in reported if event == "part"]
    assert "band" not in part
    assert part["shift"] == answer["shift"]
    assert done("rubber", workspace, SWEEPS, options={"bands": False})["band"] is None


def test_dragged_isotherm_stays_where_it_is_put(workspace: Context, rubber: Any) -> None:
    at = rubber["shift"]["factors"]["temperature"].index(313.15)
    wanted = rubber["shift"]["factors"]["log10_shift_factor"][at] + 0.5
    moved = done("rubber", workspace, {**SWEEPS, "fixed_shift_factors": {"40 degC": wanted}}, options={"bands": False})
    assert moved["shift"]["origin"] == "held"
    assert moved["shift"]["factors"]["log10_shift_factor"][at] == pytest.approx(wanted, rel=5e-6)
    assert [
        T for T, held in zip(*(moved["shift"]["factors"][k] for k in ("temperature", "held")), strict=True) if held
    ] == [313.15]
    # the others follow it, but for the one at the reference beside it
    assert moved["shift"]["misfit"]["joint"] > 1.2 * rubber["shift"]["misfit"]["joint"]


def test_misfit_of_a_dragged_isotherm_is_least_where_it_was_found(workspace: Context) -> None:
    found = done("isotherm_misfit", workspace, SWEEPS, options={"temperature": "60 degC", "reach": 0.5})
    misfit, moved = np.array(found["misfit"], dtype=float), np.array(found["moved"])
    # the shifts are fitted to all isotherms at once, so that one pair's best lies within its noise of theirs
    assert abs(moved[np.nanargmin(misfit)]) <= 0.06
    assert misfit[0] > 3.0 * misfit[len(misfit) // 2]
    assert moved[0] == -0.5
    with refused("no-such-temperature", JobError, naming="64.0 °C"):
        done("isotherm_misfit", workspace, SWEEPS, options={"temperature": "64 degC"})
    with refused("no-isotherms", JobError):
        done("isotherm_misfit", workspace, {"catalogue": "VHB 4910"}, options={"temperature": "64 degC"})


def test_modulus_at_another_temperature(workspace: Context, rubber: Any) -> None:
    found = done("moduli", workspace, {**SWEEPS, "shift": "wlf"}, uncertainty=DRAWS, options={"temperature": "60 degC"})
    line, reference = found["modulus"], rubber["spectrum"]["modulus"]
    # E(ω, T) = E(α ω, T0): the same moduli at other frequencies
    np.testing.assert_allclose(line["storage_modulus"], reference["storage_modulus"], rtol=2e-5)
    alpha = 10.0 ** found["log10_shift"]
    np.testing.assert_allclose(line["angular_frequency"], np.array(reference["angular_frequency"]) / alpha, rtol=2e-5)
    assert found["isotherm"]["temperature"] == 333.15
    assert found["extrapolated"] is False
    inside = np.array(found["band"]["storage_modulus_lower"]) <= np.array(line["storage_modulus"])
    assert np.mean(inside) > 0.9
    assert done("moduli", workspace, {**SWEEPS, "shift": "wlf"}, options={"temperature": "235 degC", "bands": False})[
        "extrapolated"
    ]


def test_a_rubber_without_shift_factors_has_no_moduli_at_another_temperature(workspace: Context) -> None:
    with refused("no-shift", JobError):
        done("moduli", workspace, {"catalogue": "VHB 4910"}, options={"temperature": "60 degC"})


@pytest.mark.parametrize("name", ["VHB 4910", "PVB interlayer", "synthetic fluoroelastomer"])
def test_rubbers_of_the_catalogue_have_moduli_and_modes(workspace: Context, name: str) -> None:
    found = done("rubber", workspace, {"catalogue": name})
    assert found["synthetic"] is (name == "synthetic fluoroelastomer")
    assert (found["shift"] is None) is (name == "VHB 4910")
    assert found["check"] is None
    assert found["band"] is None
    assert "sweeps" in found["no_band"]
    assert len(found["spectrum"]["modes"]["retardation_time"]) == {"VHB 4910": 3, "PVB interlayer": 11}.get(name, 37)


@pytest.mark.apart
@pytest.mark.parametrize(
    ("more", "sparse"),
    [({"spectrum": "sparse", "modes": 8}, True), ({"spectrum": "regularised", "tau_ratio": 4}, False)],
)
def test_other_kinds_of_spectrum(workspace: Context, more: dict[str, Any], sparse: bool) -> None:
    found = done("rubber", workspace, {**SWEEPS, **more}, uncertainty={"draws": 20})
    assert found["spectrum"]["fit"]["method"] == more["spectrum"]
    assert (found["spectrum"]["fit"]["regularisation"] is None) is sparse
    assert (found["band"]["modes"] is None) is sparse
    assert not sparse or len(found["spectrum"]["modes"]["retardation_time"]) <= 8


def test_vertical_shift_is_reported(workspace: Context) -> None:
    free = done("rubber", workspace, {**SWEEPS, "vertical_shift": "free"}, options={"bands": False})
    vertical = free["shift"]["vertical"]
    assert np.all(np.array(vertical["upper"]) >= vertical["b"])
    density = done("rubber", workspace, {**SWEEPS, "vertical_shift": "density"}, options={"bands": False})
    assert density["shift"]["vertical"]["upper"] is None


def test_rubber_of_a_real_instrument(real_data: Path, tmp_path: Path) -> None:
    workspace = workspace_with(tmp_path, real_data / "instruments" / "eplexor" / "freq_Eplexor_raw.xls")
    material = {"dma": "freq_Eplexor_raw.xls", "reference_temperature": "20 degC", "shift": "best"}
    found = done("rubber", workspace, material, uncertainty=DRAWS)
    # Its neighbours all lie to one side, by 0.01 to 0.04 decades: within reproducibility each, but not together.
    assert found["check"]["verdict"] == "doubtful"
    assert len(found["shift"]["factors"]["temperature"]) >= 15
    assert found["band"]["draws"] == 40


def test_a_liquid_has_shift_factors_and_moduli_and_no_modes(tmp_path: Path) -> None:
    write_moduli(tmp_path / "melt.csv", liquid_modulus, (10.0, 20.0, 30.0, 40.0), np.geomspace(0.1, 10.0, 9))
    (tmp_path / "tab").mkdir()
    context = workspace_with(tmp_path / "tab", tmp_path / "melt.csv")
    asked = {"dma": "melt.csv", "deformation": "tension", "reference_temperature": "30 degC"}
    answer = done("rubber", context, asked, uncertainty=DRAWS)
    assert len(answer["shift"]["factors"]["log10_shift_factor"]) == 4
    assert answer["shift"]["laws"]
    assert answer["spectrum"]["modes"] is None
    assert answer["spectrum"]["measured"] is not None
    assert "liquid" in [one["code"] for one in answer["note_records"]]


def test_notes_are_in_the_words_of_the_page() -> None:
    remedy = Remedy("give vertical='free'", page="set “Vertical shift b(T)”")
    spectrum = vf.synthetic_fluoroelastomer().spectrum
    notes = (Note("doubt", "Doubtful: ", remedy=remedy),)
    fit = vf.rheology.SpectrumFit(0.0, 0.0, False, False, (1.0, 2.0), notes)
    found = spectrum_numbers(Rubber(vf.Material(replace(spectrum, fit=fit))))
    assert found["fit"]["notes"] == [f"Doubtful: {remedy.page}"]
