"""``viscofric material …``: what the commands print and write, and how they fail."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path

import click
import numpy as np
import pytest

import viscofric as vf
from cli import calls
from cli.calls import refusal
from rheology.planted import write_amplitudes, write_moduli
from viscofric.cli import main
from viscofric.cli.output import typed_command
from viscofric.files import says_synthetic
from viscofric.notes import Note, Remedy, dumped, records
from viscofric.report.html import write_report

EXAMPLE = Path(vf.__file__).parent / "example" / "dma.csv"


call = partial(calls.call, "material")
succeed = partial(calls.succeed, "material")


@pytest.fixture(scope="module")
def fitted(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """Make the rubber of the example once; return its folder, and what was printed."""
    folder = tmp_path_factory.mktemp("fitted") / "out"
    done = succeed(
        "fit", EXAMPLE, "--reference", "30 degC", "--shift", "best", "--samples", 20, "--card", "abaqus", "-o", folder
    )
    return folder, done.output


def test_read_says_what_the_file_holds(tmp_path: Path) -> None:
    done = succeed("read", EXAMPLE, "--out", tmp_path / "again.csv")
    before, after = vf.read_dma(EXAMPLE), vf.read_dma(tmp_path / "again.csv")
    assert len(after.isotherms) == len(before.isotherms) == 24
    assert f"{len(before.isotherms)} isotherms" in done.stdout
    # ten printed digits
    for one, other in zip(before.isotherms, after.isotherms, strict=True):
        np.testing.assert_allclose(other.storage_modulus, one.storage_modulus, rtol=1e-9)
        np.testing.assert_allclose(other.angular_frequency, one.angular_frequency, rtol=1e-9)
    assert after.deformation == "tension"


STRANGE_TABLE = "Chamber,v1,Alpha,Beta\n20,1,5,0.5\n20,10,6,0.7\n30,1,4,0.4\n30,10,5,0.6\n"
COLUMNS = {"temperature": "Chamber (degC)", "frequency": "v1 (Hz)", "storage_modulus": "Alpha (MPa)"}


def test_columns_that_are_not_understood_are_named(tmp_path: Path) -> None:
    path = tmp_path / "strange.csv"
    path.write_text(STRANGE_TABLE, encoding="utf-8")
    refused = call("read", path)
    assert refused.exit_code == 1
    assert "--column" in refused.output
    words = [word for what, said in COLUMNS.items() for word in ("--column", f"{what}={said}")]
    done = succeed("read", path, *words, "--column", "loss_modulus=#4 (MPa)", "--deformation", "bending")
    assert "moduli in bending; 2 isotherms" in done.output
    for wrong in ("frequency", "=f (Hz)", "frequency="):
        assert call("read", path, "--column", wrong).exit_code == 2
    assert call("read", path, "--column", "colour=red").exit_code == 1
    assert "no-sheet" not in call("read", path, "--sheet", "a").output


def test_a_command_is_kept_as_it_was_typed() -> None:
    with click.Context(main) as context:
        main.parse_args(context, ["material", "fit", "a.csv", "--column", "frequency=v1 (Hz)"])
        assert typed_command() == "viscofric material fit a.csv --column 'frequency=v1 (Hz)'"


@pytest.mark.slow
def test_fit_writes_the_rubber_for_everyone(fitted: tuple[Path, str]) -> None:
    folder, printed = fitted
    for name in ("rubber.json", "shift_factors.csv", "master_curve.csv", "spectrum.csv", "report.html", "results.nc"):
        assert (folder / name).stat().st_size > 0, name
    assert (folder / "figures" / "master_curve.svg").exists()
    assert (folder / "cards" / "rubber_abaqus.inp").exists()
    assert "WLF" in printed


@pytest.mark.slow
def test_what_fit_writes_is_the_same_rubber(fitted: tuple[Path, str]) -> None:
    folder, _ = fitted
    rubber, card = vf.read_card(folder / "rubber.json"), vf.read_card(folder / "cards" / "rubber_abaqus.inp")
    omega = np.geomspace(1e-3, 1e6, 10)
    for kelvin in (303.15, 333.15):
        # The card's moduli are printed in full, and converted exactly.
        np.testing.assert_allclose(
            card.complex_modulus(omega, kelvin), rubber.complex_modulus(omega, kelvin), rtol=1e-10
        )
    factors = vf.read_shift_factors(folder / "shift_factors.csv")
    again = vf.superpose(vf.read_dma(EXAMPLE), "30 degC")
    np.testing.assert_allclose(factors.log10_values, again.shift_factors.log10_values, atol=1e-12)


@pytest.mark.slow
def test_the_report_shows_the_command_that_made_it(fitted: tuple[Path, str]) -> None:
    folder, _ = fitted
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert "viscofric material fit" in page
    assert "--shift best" in page
    assert "--samples 20" in page
    assert "--poisson-ratio" not in page  # the default needs no mention


@pytest.mark.slow
def test_show_prints_the_modulus_asked_for(fitted: tuple[Path, str]) -> None:
    folder, _ = fitted
    done = succeed("show", folder / "rubber.json", "--temperature", "60 degC", "--frequency", "1 Hz")
    rubber = vf.read_card(folder / "rubber.json")
    modulus = complex(rubber.complex_modulus(2 * np.pi, "60 degC")) / 1e6
    assert f"{modulus.real:.4g}" in done.output
    assert f"{modulus.imag:.4g}" in done.output


@pytest.mark.slow
def test_convert_there_and_back_loses_nothing(fitted: tuple[Path, str], tmp_path: Path) -> None:
    folder, _ = fitted
    succeed("convert", folder / "rubber.json", tmp_path / "a.txt", "--format", "comsol")
    succeed("convert", tmp_path / "a.txt", tmp_path / "b.json", "--format", "json")
    before, after = (vf.read_card(path) for path in (folder / "rubber.json", tmp_path / "b.json"))
    np.testing.assert_allclose(after.complex_modulus(1.0), before.complex_modulus(1.0), rtol=1e-12)


def test_show_calls_synthetic_materials_so() -> None:
    marked = {}
    for name in ("synthetic tread rubber", "PVB interlayer"):
        said = json.loads(succeed("show", name, "--frequency", "1 Hz", "--json").stdout)["material"]["synthetic"]
        marked[name] = (said, "SYNTHETIC" in succeed("show", name, "--frequency", "1 Hz").stdout)
    assert marked == {"synthetic tread rubber": (True, True), "PVB interlayer": (False, False)}


def test_catalogue_is_listed_with_its_sources() -> None:
    done = succeed("list")
    for entry in vf.catalogue():
        assert entry.name in done.output
        assert entry.citation in done.output
    assert "SYNTHETIC" in done.output


@pytest.mark.slow
def test_sparse_spectrum_has_no_more_modes_than_asked(tmp_path: Path) -> None:
    succeed(
        "fit", EXAMPLE, "--reference", "30 degC", "--spectrum", "sparse", "--modes", 8, "--samples", 0, "-o", tmp_path
    )
    rubber = json.loads((tmp_path / "rubber.json").read_text(encoding="utf-8"))
    assert rubber
    spectrum = vf.read_card(tmp_path / "rubber.json").spectrum
    assert isinstance(spectrum, vf.RetardationSpectrum)
    assert 1 <= len(spectrum) <= 8


def test_an_input_is_not_overwritten(tmp_path: Path) -> None:
    raw = tmp_path / "raw.csv"
    raw.write_bytes(EXAMPLE.read_bytes())
    assert refusal("material", "read", raw, "--out", raw)[:2] == (1, "is-input")
    assert raw.read_bytes() == EXAMPLE.read_bytes()


@pytest.mark.slow
def test_a_card_that_cannot_be_written_keeps_no_other_from_it(tmp_path: Path) -> None:
    done = call(
        "fit", EXAMPLE, "--reference", "30 degC", "--samples", 0, "-o", tmp_path / "out",
        "--card", "ansys", "--card", "abaqus",
    )  # fmt: skip
    assert done.exit_code == 1  # ANSYS takes no Poisson ratio of 0.5
    assert [path.name for path in (tmp_path / "out" / "cards").iterdir()] == ["rubber_abaqus.inp"]
    assert "Note: " in done.stderr  # without a law, the card holds at the reference temperature only
    law = call(
        "convert", tmp_path / "out" / "rubber.json", tmp_path / "law.inp", "--format", "abaqus", "--card-law", "wlf"
    )
    assert law.exit_code == 0
    assert "The card" not in law.stderr
    assert isinstance(vf.read_card(tmp_path / "law.inp").shift, vf.WLF)


@pytest.mark.slow
def test_a_finished_master_curve_makes_the_same_rubber(fitted: tuple[Path, str], tmp_path: Path) -> None:
    folder, _ = fitted
    before = vf.read_card(folder / "rubber.json")
    rows = (folder / "master_curve.csv").read_text(encoding="utf-8").splitlines()[2:]
    table = [",".join(row.split(",")[:3]) for row in rows]
    table[0] = "omega (rad/s),E' (Pa),E'' (Pa)"
    (tmp_path / "curve.csv").write_text("\n".join(table), encoding="utf-8")
    succeed(
        "fit", tmp_path / "curve.csv", "--master-curve", "--reference", "30 degC", "--name", "again",
        "--shift-factors", folder / "shift_factors.csv", "-o", tmp_path / "out",
    )  # fmt: skip
    after = vf.read_card(tmp_path / "out" / "rubber.json")
    assert after.name == "again"
    # Ten printed digits of the curve; the fit is as smooth as that.
    np.testing.assert_allclose(after.complex_modulus([1.0, 1e4]), before.complex_modulus([1.0, 1e4]), rtol=1e-6)
    assert after.shift is not None
    assert after.shift.log10("60 degC") == pytest.approx(
        vf.read_shift_factors(folder / "shift_factors.csv").log10("60 degC"), rel=1e-12
    )


@pytest.mark.slow
def test_made_data_are_called_synthetic(tmp_path: Path) -> None:
    succeed("fit", EXAMPLE, "--reference", "30 degC", "--samples", 0, "-o", tmp_path / "out")
    assert "Synthetic data" in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert all(map(says_synthetic, (tmp_path / "out").glob("*.csv")))


def test_a_test_at_one_temperature_has_no_samples_and_says_so_in_words_of_commands(tmp_path: Path) -> None:
    omega = np.geomspace(0.1, 100.0, 25)
    modulus = vf.synthetic_fluoroelastomer().complex_modulus(omega, "20 degC")
    rows = zip(omega, modulus.real, modulus.imag, strict=True)
    lines = ["omega (rad/s),E' (Pa),E'' (Pa)", *(f"{w:.8g},{storage:.8g},{loss:.8g}" for w, storage, loss in rows)]
    (tmp_path / "curve.csv").write_text("\n".join(lines), encoding="utf-8")
    fit = ("fit", tmp_path / "curve.csv", "--master-curve", "--reference", "20 degC", "-o", tmp_path / "out")
    assert "no-bands" in {one["code"] for one in json.loads(succeed(*fit, "--json").stdout)["note_records"]}
    tree = vf.open_results(tmp_path / "out").tree
    advised = Note("", "Too coarse", remedy=Remedy("; modes=12.", "; --modes 12.", "; modes = 12 under [material]."))
    tree["spectrum"].attrs["statements"] = dumped(records([advised]))
    page = write_report(tree, tmp_path).read_text(encoding="utf-8")
    assert "Too coarse; --modes 12." in page
    assert not says_synthetic(tmp_path / "out" / "spectrum.csv")


@pytest.mark.parametrize(
    ("words", "status", "code"),
    [
        (["--modes", "3"], 2, "contradiction"),
        (["--master-curve", "--vertical-shift", "free"], 2, "contradiction"),
        (["--shift-factor-column", "T=temp"], 2, "contradiction"),
        (["--card-law", "wlf"], 2, ""),
        (["--fix", "0 degC=1", "--fix", "273.15 K=2"], 1, "value"),
    ],
    ids=lambda value: str(value)[:40],
)
def test_options_that_contradict_each_other_are_wrong_usage(
    words: list[object], status: int, code: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    found = refusal("material", "fit", EXAMPLE, "--reference", "30 degC", *words)
    assert (found.status, found.code) == (status, code), found


@pytest.mark.slow
def test_ramp_prints_peaks_and_makes_a_material(tmp_path: Path) -> None:
    made = vf.synthetic_fluoroelastomer()
    write_moduli(tmp_path / "ramps.csv", made.complex_modulus, range(-15, 91, 2), (1.0, 10.0))
    done = succeed("ramp", tmp_path / "ramps.csv")
    assert "tan δ at 1 Hz" in done.output
    record = json.loads(call("ramp", tmp_path / "ramps.csv", "--json").stdout)
    assert len(record["angular_frequency"]) == 2
    done = succeed("ramp", tmp_path / "ramps.csv", "--reference", "30 degC", "--synthetic", "-o", tmp_path / "out")
    assert "Peak of tan δ at 1 Hz" in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    for name in ("rubber.json", "master_curve.csv", "report.html", "figures/ramps.svg"):
        assert (tmp_path / "out" / name).stat().st_size > 0, name
    assert call("ramp", tmp_path / "ramps.csv", "--assumed-shift", "universal").exit_code == 2


def test_amplitude_prints_the_linear_range_and_scales_a_material(tmp_path: Path) -> None:
    law = vf.rheology.KrausLaw(6e6, 2.5e6, 0.02, 0.6, 6e5, 4e5, 62.8, 333.15, "shear")
    path = write_amplitudes(tmp_path / "payne.csv", law, np.geomspace(1e-4, 0.5, 20))
    record = json.loads(call("amplitude", path, "--json").stdout)
    assert record["critical_strain"] == pytest.approx(0.02, rel=0.01)
    rubber = ("--material", "synthetic fluoroelastomer")
    scaled = tmp_path / "scaled.json"
    succeed("amplitude", path, *rubber, "--strain", 5, "-o", scaled, "--picture", tmp_path / "payne.svg")
    assert "approximation" in vf.read_card(scaled).name
    assert (tmp_path / "payne.svg").stat().st_size > 0
    assert call("amplitude", path, "-o", scaled).exit_code == 2


def test_a_material_is_identified_from_indentation(tmp_path: Path) -> None:
    planted = vf.synthetic_fluoroelastomer().at("30 degC")
    time = np.geomspace(0.05, 20.0, 12)
    depth = (0.75 * planted.creep_compliance(time) * 0.75 / 0.1) ** (2.0 / 3.0)  # 1 N, R = 10 mm
    rows = "".join(f"{t:.8g},1,{1e6 * d:.8g}\n" for t, d in zip(time, depth, strict=True))
    (tmp_path / "creep.csv").write_text("time (s),load (N),depth (um)\n" + rows, encoding="utf-8")
    said = ("indentation", tmp_path / "creep.csv", "--control", "load", "--ball", "10 mm", "--modes", 8)
    out = ("--samples", 20, "--start", "0 s", "--out", tmp_path / "rubber.json", "--csv", tmp_path / "E.csv", "--json")
    done = succeed(*said, "--temperature", "23 degC", *out)
    results = json.loads(done.stdout)
    assert results["notes"] == []
    found = vf.read_card(tmp_path / "rubber.json")
    # Without noise: what is left is what creep from 0.05 s on does not determine.
    assert abs(found.complex_modulus(0.5)) == pytest.approx(abs(planted.complex_modulus(0.5)), rel=0.02)
    assert (tmp_path / "E.csv").read_text().startswith("angular_frequency,storage_modulus")
    assert refusal(call(*said))
    twice = call(*said, "--temperature", "23 degC", "--temperature", "30 degC")
    assert twice.exit_code == 2


def test_a_material_is_identified_from_rebounds_and_stiffness(tmp_path: Path) -> None:
    rows = "speed (m/s),contact time (ms),restitution (1)\n0.5,3.1,0.6\n1.5,2.5,0.62\n"
    (tmp_path / "rebound.csv").write_text(rows, encoding="utf-8")
    rows = "frequency (Hz),storage stiffness (N/mm),loss stiffness (N/mm)\n1,9.3,1\n3,9.9,1.2\n10,10.7,1.5\n"
    (tmp_path / "stiffness.csv").write_text(rows, encoding="utf-8")
    common = ("--ball", "10 mm", "--modes", 8, "--samples", 20, "--temperature", "23 degC", "--error", "0.01")
    rebound = ("indentation", tmp_path / "rebound.csv", "--mass", "33 g")
    done = succeed(*rebound, *common, "--radius-error", 0.01)
    assert "Found error of the radius" in done.output
    stiffness = ("indentation", tmp_path / "stiffness.csv", "--depth", "100 um", "--amplitude", "2 um")
    done = succeed(*stiffness, *common, "--picture", tmp_path / "E.svg", "--beside", "synthetic fluoroelastomer")
    assert (tmp_path / "E.svg").stat().st_size > 0
    assert call(*stiffness, *common, "--mass", "33 g").exit_code == 2
    assert call(*rebound, "--ball", "10 mm").exit_code == 2


def test_a_card_without_units_is_converted_with_those_given(tmp_path: Path) -> None:
    card = tmp_path / "card.inp"
    card.write_text(
        "*MATERIAL, NAME=TREAD\n*ELASTIC, MODULI=INSTANTANEOUS\n600., 0.49\n*VISCOELASTIC, TIME=PRONY\n"
        "0.6, 0.6, 1e-2\n0.3, 0.3, 10.\n*TRS, DEFINITION=WLF\n86., 12., 108.\n",
        encoding="utf-8",
    )
    made = tmp_path / "rubber.json"
    refused = refusal("material", "convert", card, made, "--format", "json")
    assert (refused.status, refused.code) == (1, "unit-unknown")
    units = ("--read-modulus-unit", "MPa", "--read-time-unit", "ms", "--read-temperature-unit", "degF")
    succeed("convert", card, made, "--format", "json", *units)
    rubber, expected = (
        vf.read_card(made),
        vf.read_card(card, modulus_unit="MPa", time_unit="ms", temperature_unit="degF"),
    )
    assert rubber.spectrum.E_inf == pytest.approx(6e8)  # 600 MPa
    assert expected.shift is not None
    assert rubber.shift is not None
    assert rubber.shift.reference == pytest.approx(303.15)  # 86 °F
    np.testing.assert_allclose(rubber.complex_modulus(1e3), expected.complex_modulus(1e3), rtol=1e-12)
    own = tmp_path / "own.inp"
    succeed("convert", "PVB interlayer", own, "--format", "abaqus")
    for stated in (made, own, "PVB interlayer"):  # these have units of their own
        refused = refusal("material", "convert", stated, tmp_path / "no", "--format", "json", *units[:2])
        assert refused.code == "unit-not-needed"
