"""The benchmarks run without their peers, on the smallest of their problems, and measure what they say."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from viscofric.rheology.spectra.retardation import RelaxationSpectrum

BENCHMARKS = Path(__file__).resolve().parents[1] / "benchmarks"


class Benchmarks:
    """The benchmarks' files, such as "contact/ball", and what they write as JSON."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, folder: Path) -> None:
        self._monkeypatch, self.target = monkeypatch, folder / "measured.json"

    def __call__(self, name: str) -> ModuleType:
        folder, module = name.split("/")
        self._monkeypatch.syspath_prepend(str(BENCHMARKS / folder))
        return import_module(module)

    def measured(self, name: str, *arguments: str) -> dict[str, Any]:
        self(name).main([*arguments, "--json", str(self.target)])
        return json.loads(self.target.read_text(encoding="utf-8"))


@pytest.fixture
def benchmarks(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Benchmarks]:
    """Import benchmarks, which import each other, and forget them afterwards: their names are common ones."""
    before = set(sys.modules)
    yield Benchmarks(monkeypatch, tmp_path)
    for name in set(sys.modules) - before:
        origin = getattr(sys.modules[name], "__file__", None) or ""
        if "benchmarks" in origin or Path(origin).name == "planted.py":
            del sys.modules[name]


def numbers_of(results: dict[str, Any], start: str) -> list[dict[str, Any]]:
    (rows,) = [rows for title, rows in results["tables"].items() if title.startswith(start)]
    return rows


@pytest.mark.apart
def test_benchmark_without_peers_and_without_real_data(
    benchmarks: Benchmarks, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("VISCOFRIC_REAL_DATA", str(tmp_path / "nowhere"))
    results = benchmarks.measured("rheology/run", "--seeds", "0")
    printed = capsys.readouterr().out
    assert "viscofric, sparse, 16 modes" in printed
    assert "left out: acrylic 468MP" in printed
    (shifting,) = numbers_of(results, "shifting")
    # 1 % noise is 0.0043 decades; the difference of a point and one interpolated between two has 1.2 to 1.4 times it
    assert 0.004 < shifting["joint"] < 0.008
    # … and a shift that rests on 17 points of 1 % each is known to a few thousandths of a decade at its neighbour
    assert shifting["error"] < 0.02
    assert shifting["C1"] == pytest.approx(10.04, rel=0.03)  # planted; the coldest isotherm lies below Tg
    spectra = numbers_of(results, "spectrum")
    assert [row["tool"] for row in spectra] == [f"viscofric, {name}" for name in benchmarks("rheology/own").SPECTRA]
    assert all(row["storage"] < 0.02 for row in spectra)
    (conversion,) = numbers_of(results, "retardation")
    assert conversion["error"] < 1e-10


def test_peer_that_is_not_there_leaves_its_reason_in_the_table(
    benchmarks: Benchmarks, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    cases = benchmarks("rheology/cases")
    others = benchmarks("rheology/others")
    run = benchmarks("rheology/run")

    row = others.shifting("RepTate 1.3.3", cases.planted_case(), tmp_path, 10.0)
    assert "make_peers.sh" in row["error"]
    run.print_table("shifting: planted", [row])
    assert "not installed" in capsys.readouterr().out


def test_true_shift_factors_have_no_error_and_wrong_ones_have_theirs(benchmarks: Benchmarks) -> None:
    cases = benchmarks("rheology/cases")
    measures = benchmarks("rheology/measures")

    case = cases.planted_case()
    true = case.truth.log10_alpha(case.sweeps.temperatures, case.reference)
    assert measures.of_shifts(case, true)["error"] == 0.0
    assert measures.of_shifts(case, true + 0.25)["error"] == pytest.approx(0.25)
    constants = measures.wlf_constants(case, true)
    # planted 10.04 and 89.6 K at 20 °C (rounded); only the coldest isotherm lies below Tg, where WLF does not hold
    assert constants == pytest.approx((10.04, 89.6), rel=0.01)


def test_spectra_of_peers_are_measured_as_prony_series(benchmarks: Benchmarks) -> None:
    measures = benchmarks("rheology/measures")

    omega = np.geomspace(1e-2, 1e4, 50)
    series = RelaxationSpectrum(1e6, [3e6, 5e7], [1.0, 1e-3])
    modulus = series.complex_modulus(omega)
    curve = vf.readers.MasterCurve(omega, 1.1 * modulus.real, modulus.imag, np.full(50, 293.15), 293.15)
    found = measures.of_modes(curve, 1e6, [3e6, 5e7, 0.0], [1.0, 1e-3, 1e-4])
    assert found["modes"] == 2
    assert found["storage"] == pytest.approx(np.log10(1.1))
    assert found["loss"] == pytest.approx(0.0, abs=1e-12)


def test_ball_benchmark_counts_products_and_transforms(
    benchmarks: Benchmarks, capsys: pytest.CaptureFixture[str]
) -> None:
    benchmarks.target = benchmarks.target.parent / "new" / "ball.json"
    results = benchmarks.measured("contact/ball", "--cells", "128", "--memory", "1")
    assert "vτ/a0 = 1 " in capsys.readouterr().out
    assert results["measured_with"]["viscofric"] == vf.__version__
    (row,) = results["rows"]
    assert row["cells"] == 128
    assert 1 < row["finest_products"] < row["products"]
    assert row["residual"] <= 1e-8
    assert row["fft_pairs"] == pytest.approx(row["seconds"] / row["seconds_per_pair"])
    # 0.1305 a0/R on finer grids, and a0/R = 0.05
    assert row["friction"] == pytest.approx(0.05 * 0.1305, rel=2.0 * row["relative_error"])
    assert row["relative_error"] < 2e-3


def test_ball_benchmark_measures_the_price_of_digits(
    benchmarks: Benchmarks, capsys: pytest.CaptureFixture[str]
) -> None:
    ball = benchmarks("contact/ball")

    rows = benchmarks.measured("contact/ball", "--accuracy", "2e-2", "--speeds", "2")["rows"]
    assert "accuracy 0.02" in capsys.readouterr().out
    assert len(rows) == len(ball.RUBBERS)
    for row in rows:
        assert row["solved"] == 2
        assert 0.0 < row["median"] <= row["most"]
        assert row["stated"] <= 2e-2


@pytest.mark.slow
def test_benchmark_of_stated_errors_compares_each_of_them(
    benchmarks: Benchmarks, capsys: pytest.CaptureFixture[str]
) -> None:
    results = benchmarks.measured("contact/stated_errors", "--first", "1", "--count", "1")
    assert "stated errors of 1 random contacts" in capsys.readouterr().out
    assert results["unsolved"] == []
    numbers = {row["number"]: row for row in results["rows"]}
    # A cylinder: its load is given, and it has no width.
    assert numbers.keys() == {
        "friction", "indentation", "area", "front", "rear", "max pressure", "centre of pressure", "derivatives",
    }  # fmt: skip
    assert all(row["apart"] > 0.0 for row in numbers.values())  # two different grids
    assert all(row["within"] == (row["worst"] <= 1.0) for row in results["summary"])
    rows = benchmarks.measured("contact/stated_errors", "--periodic", "--first", "1012", "--count", "1")["rows"]
    row, lateral = rows
    assert (row["number"], lateral["number"]) == ("friction", "lateral friction")
    assert 0.0 < row["apart"] < 0.01 * row["size"]  # nearly in full contact


def test_benchmark_of_errors_over_time_goes_on_with_a_file(
    benchmarks: Benchmarks, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    stated_errors = benchmarks("motion/stated_errors")

    wanted = ["--kinds", "ball", "--accuracy", "2e-2", "3e-2", "--lines", str(tmp_path / "errors.jsonl")]
    stated_errors.main(["--count", "1", *wanted])
    first = (tmp_path / "errors.jsonl").read_text(encoding="utf-8")
    stated_errors.main(["--count", "2", *wanted])
    second = (tmp_path / "errors.jsonl").read_text(encoding="utf-8")
    assert second.startswith(first)
    assert [json.loads(line)["case"].split(":")[0] for line in second.splitlines()] == ["0", "1"]
    assert "solved: 2, not solved: 0" in capsys.readouterr().out
    stated_errors.main(["--count", "2", "--seconds", "0", "--kinds", "ball"])
    assert "given up after 0 CPU s" in capsys.readouterr().out


@pytest.mark.slow
def test_backend_benchmark_measures_what_is_there_and_names_what_is_not(
    benchmarks: Benchmarks, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "cupy", None)
    given = ["--sizes", "32", "--backends", "scipy", "scipyx2", "cupy", "--repeats", "1"]
    rows = benchmarks.measured("contact/backends", *given)["rows"]
    assert "left out: backend = 'cupy'" in capsys.readouterr().out
    assert [row["backend"] for row in rows] == ["scipy", "scipyx2"] * 2
    assert rows[0]["FFTs"] == rows[1]["FFTs"]
    assert rows[2]["products"] == rows[3]["products"]
    assert all(row[what] > 0.0 for row in rows for what in ("elastic", "ball") if what in row)


def test_benchmark_of_octaves_compares_two_methods(
    benchmarks: Benchmarks, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(benchmarks("roughness/octaves"), "SPEEDS", (1e-6,))
    (row,) = benchmarks.measured("roughness/octaves", "--shortest", "32", "--seeds", "1")["rows"]
    assert "theory over solution" in capsys.readouterr().out
    assert row["area"] > 0.7
    assert 0.95 < row["half_ratio"] < row["full_ratio"] < 1.2  # 0.98 and 1.12 with three surfaces


def test_rough_benchmark_leaves_a_reason_where_a_peer_is_missing(
    benchmarks: Benchmarks, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found = benchmarks.measured("contact/rough", "--sizes", "32", "--peers", str(tmp_path))
    assert "not installed; run benchmarks/contact/make_peers.sh" in capsys.readouterr().out
    elastic, viscoelastic, *peers = found["rows"]
    assert len(peers) == 2
    assert elastic["ratio"] == 1.0
    assert elastic["friction"] == 0.0 < viscoelastic["friction"]
    assert max(elastic["residual"], viscoelastic["residual"]) <= 1e-8


def test_residual_of_the_rough_benchmark_is_that_of_the_pressures(benchmarks: Benchmarks) -> None:
    problems = benchmarks("contact/problems")
    rough = benchmarks("contact/rough")

    surface = problems.rough_surface(32)
    pressure = problems.elastic_rough(surface).pressure
    assert rough.residual(pressure, surface) <= 2e-8  # the solver's own measure, at another mean gap
    spoilt = pressure.copy()
    spoilt[np.unravel_index(pressure.argmax(), pressure.shape)] *= 1.01
    assert rough.residual(spoilt, surface) > 1e-4


@pytest.mark.apart
def test_scaling_benchmark_gives_exponents_and_memory(benchmarks: Benchmarks) -> None:
    small, large = benchmarks.measured("contact/scaling", "--sizes", "64", "128", "--problems", "elastic")["rows"]
    assert (small["points"], large["points"]) == (64, 128)
    assert large["exponent"] == pytest.approx(np.log(large["seconds"] / small["seconds"]) / np.log(4.0))
    # At least pressure, displacement and heights; less than what a matrix would take.
    assert all(3.0 < row["arrays"] < 64**2 for row in (small, large))
    assert large["megabytes"] > small["megabytes"]


@pytest.mark.slow
def test_random_rough_contacts_are_all_counted(benchmarks: Benchmarks) -> None:
    (row,) = benchmarks.measured("contact/random_rough", "--contacts", "6")["rows"]
    assert row["contacts"] == 6
    assert row["failed"] == 0
    assert 10 < row["median"] <= row["most"] <= row["largest"] <= row["total"]


@pytest.mark.slow
def test_the_sliding_ball_is_within_the_tolerances_of_its_table(benchmarks: Benchmarks) -> None:
    sliding_ball = benchmarks("contact/sliding_ball")

    for _, published, tolerance, friction, error, seconds in sliding_ball.rows(accuracy=1e-2):
        assert friction == pytest.approx(published, rel=tolerance)
        assert 0.0 <= error <= 1e-2 * friction
        assert seconds > 0.0


def test_growth_is_the_exponent_of_a_power_law(benchmarks: Benchmarks) -> None:
    measuring = benchmarks("contact/measuring")

    assert measuring.growth([1e4, 4e4, 16e4], [2.0, 2.0 * 4**1.1, 2.0 * 16**1.1]) == pytest.approx(1.1)


def test_steps_in_time_lead_to_the_steady_friction_in_first_order(benchmarks: Benchmarks) -> None:
    maxwell = benchmarks("contact/maxwell")
    problems = benchmarks("contact/problems")

    surface = vf.contact.PeriodicSurface(problems.self_affine(32, points_per_shortest_wave=16.0), 1.0 / 32)
    steady = maxwell.steady_friction(surface)
    coarse, fine = (
        maxwell.steady_friction(surface, maxwell.time_step(surface, substeps)) - steady for substeps in (128, 256)
    )
    assert coarse / fine == pytest.approx(2.0, rel=0.02)  # of first order in Δt, up to its second
    needed = maxwell.substeps_needed(surface)
    assert abs(maxwell.steady_friction(surface, maxwell.time_step(surface, needed)) / steady - 1.0) <= 0.01


def test_maxwell_benchmark_without_its_peer(
    benchmarks: Benchmarks, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    given = ["--points", "32", "--verify", "16", "--peers", str(tmp_path)]
    own, peer = benchmarks.measured("contact/maxwell", *given)["cost"]
    assert "not installed" in capsys.readouterr().out
    assert own["friction"] > 0.0
    assert "error" in peer


@pytest.mark.slow
def test_curve_benchmark_measures_its_true_error(benchmarks: Benchmarks, capsys: pytest.CaptureFixture[str]) -> None:
    # the fast end of the curve, where coarse grids do
    arguments = ["--speeds", "2", "--slowest", "1e2", "--decades", "4", "--workers", "1", "--accuracy", "0.001"]
    results = benchmarks.measured("contact/curve", *arguments, "--check", "1")
    assert "failures" in capsys.readouterr().out
    (row,), points = results["rows"], results["points"]
    assert (row["speeds"], row["failures"], row["checked"]) == (2, 0, 1)
    assert 0.0 < row["worst_error"] == points[0]["true_error"] < 0.001
    assert row["worst_estimate"] <= 0.001
    assert row["wall_seconds"] > 0.0 < row["seconds"]


@pytest.mark.slow
def test_benchmark_of_repeated_runs_measures_coverage_and_width(
    benchmarks: Benchmarks, capsys: pytest.CaptureFixture[str]
) -> None:
    few = ["--seeds", "4", "--case", "1 % from step to step"]
    (row,) = benchmarks.measured("friction/repeated_runs", *few).values()
    assert "1 % from step to step" in capsys.readouterr().out
    for one in row.values():
        assert 0.7 < one["held"] <= 1.0  # of 20 intervals: 15 or fewer once in 400 times
        assert 0.7 < one["median width"] < 2.5
    with pytest.raises(SystemExit, match="are held"):
        benchmarks("friction/repeated_runs").main([*few, "--check", "101"])


@pytest.mark.apart
def test_benchmark_of_the_interface_counts_planted_laws_within_bands(
    benchmarks: Benchmarks, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(benchmarks("friction/interface"), "KINDS", ("constant", "power"))
    rows = benchmarks.measured("friction/interface", "--problems", "4")["rows"]
    assert "right law chosen" in capsys.readouterr().out
    for row in rows:
        assert row["refused"] == 0
        assert row["points"] > 0.5  # below a half in 1 of 70 such sets of four bands, which move as one


@pytest.mark.apart
def test_benchmark_of_total_friction_compares_it_with_that_of_the_planted_interface(
    benchmarks: Benchmarks, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    total = benchmarks("friction/total")

    monkeypatch.setattr(total, "TRUE", 8)
    monkeypatch.setattr(total, "OTHERS", 8)
    few = ["--scenes", "1", "--draws", "2", "--shapes", "cylinder", "rough"]
    rows = benchmarks.measured("friction/total", *few)["rows"]
    assert "within its 95 % band" in capsys.readouterr().out
    for row in rows:
        assert row["problems"] + row["refused"] == 2
        assert 0.0 < row["width"] < 0.5
        assert 0.0 <= row["held"] <= 1.0


@pytest.mark.apart
def test_benchmark_of_sweeps(benchmarks: Benchmarks) -> None:
    few = ["--speeds", "3", "--temperatures", "1", "--accuracy", "2e-2", "--check", "1", "--distinct", "10"]
    curve, gained, each = benchmarks.measured("study/sweeps", *few, "--workers", "1")["rows"]
    assert (curve["cases"], gained["cases"], each["cases"]) == (3, 24, 10)
    assert (curve["solved"], each["solved"]) == (3, 10)
    assert not any(row["failures"] for row in (curve, gained, each))
    assert curve["worst_error"] < 2e-2  # the accuracy
    rows = benchmarks.measured("study/costs", "--speeds", "1", "--accuracies", "2e-2")["rows"]
    assert [row["failures"] for row in rows] == [0] * 5
