"""The benchmarks run without their peers, on the smallest of their problems, and measure what they say."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from viscofric.rheology.spectra.retardation import RelaxationSpectrum

BENCHMARKS = Path(__file__).resolve().parents[1] / "benchmarks"


@pytest.fixture
def benchmark_path(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Let the rheology benchmark's files import each other."""
    yield from _importable("rheology", monkeypatch)


@pytest.fixture
def contact_path(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Let the contact benchmarks' files import each other."""
    yield from _importable("contact", monkeypatch)


@pytest.fixture
def motion_path(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Let the benchmark of contacts over time be imported."""
    yield from _importable("motion", monkeypatch)


def _importable(folder: str, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Put a folder on the path, and forget its files afterwards: their names are common ones."""
    before = set(sys.modules)
    monkeypatch.syspath_prepend(str(BENCHMARKS / folder))
    yield
    for name in set(sys.modules) - before:
        origin = getattr(sys.modules[name], "__file__", None) or ""
        if "benchmarks" in origin or Path(origin).name == "planted.py":
            del sys.modules[name]


def numbers_of(results: dict[str, Any], start: str) -> list[dict[str, Any]]:
    (rows,) = [rows for title, rows in results["tables"].items() if title.startswith(start)]
    return rows


@pytest.mark.apart
@pytest.mark.usefixtures("benchmark_path")
def test_benchmark_without_peers_and_without_real_data(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("VISCOFRIC_REAL_DATA", str(tmp_path / "nowhere"))
    import run

    run.main(["--seeds", "0", "--json", str(tmp_path / "results" / "rheology.json")])
    printed = capsys.readouterr().out
    assert "viscofric, sparse, 16 modes" in printed
    assert "left out: acrylic 468MP" in printed
    results = json.loads((tmp_path / "results" / "rheology.json").read_text(encoding="utf-8"))
    (shifting,) = numbers_of(results, "shifting")
    # 1 % noise is 0.0043 decades; the difference of a point and one interpolated between two has 1.2 to 1.4 times it
    assert 0.004 < shifting["joint"] < 0.008
    # … and a shift that rests on 17 points of 1 % each is known to a few thousandths of a decade at its neighbour
    assert shifting["error"] < 0.02
    assert shifting["C1"] == pytest.approx(10.04, rel=0.03)  # planted; the coldest isotherm lies below Tg
    spectra = numbers_of(results, "spectrum")
    assert [row["tool"] for row in spectra] == [f"viscofric, {name}" for name in run.own.SPECTRA]
    assert all(row["storage"] < 0.02 for row in spectra)
    (conversion,) = numbers_of(results, "retardation")
    assert conversion["error"] < 1e-10


@pytest.mark.usefixtures("benchmark_path")
def test_peer_that_is_not_there_leaves_its_reason_in_the_table(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    import cases
    import others
    import run

    row = others.shifting("RepTate 1.3.3", cases.planted_case(), tmp_path, 10.0)
    assert "make_peers.sh" in row["error"]
    run.print_table("shifting: planted", [row])
    assert "not installed" in capsys.readouterr().out


@pytest.mark.usefixtures("benchmark_path")
def test_true_shift_factors_have_no_error_and_wrong_ones_have_theirs() -> None:
    import cases
    import measures

    case = cases.planted_case()
    true = case.truth.log10_alpha(case.sweeps.temperatures, case.reference)
    assert measures.of_shifts(case, true)["error"] == 0.0
    assert measures.of_shifts(case, true + 0.25)["error"] == pytest.approx(0.25)
    constants = measures.wlf_constants(case, true)
    # planted 10.04 and 89.6 K at 20 °C (rounded); only the coldest isotherm lies below Tg, where WLF does not hold
    assert constants == pytest.approx((10.04, 89.6), rel=0.01)


@pytest.mark.usefixtures("benchmark_path")
def test_spectra_of_peers_are_measured_as_prony_series() -> None:
    import measures

    omega = np.geomspace(1e-2, 1e4, 50)
    series = RelaxationSpectrum(1e6, [3e6, 5e7], [1.0, 1e-3])
    modulus = series.complex_modulus(omega)
    curve = vf.readers.MasterCurve(omega, 1.1 * modulus.real, modulus.imag, np.full(50, 293.15), 293.15)
    found = measures.of_modes(curve, 1e6, [3e6, 5e7, 0.0], [1.0, 1e-3, 1e-4])
    assert found["modes"] == 2
    assert found["storage"] == pytest.approx(np.log10(1.1))
    assert found["loss"] == pytest.approx(0.0, abs=1e-12)


def read(path: Path) -> dict[str, Any]:
    return json.loads(path.read_text(encoding="utf-8"))


@pytest.mark.usefixtures("contact_path")
def test_ball_benchmark_counts_products_and_transforms(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import ball

    ball.main(["--cells", "128", "--memory", "1", "--json", str(tmp_path / "new" / "ball.json")])
    assert "vτ/a0 = 1 " in capsys.readouterr().out
    results = read(tmp_path / "new" / "ball.json")
    assert results["measured_with"]["viscofric"] == vf.__version__
    (row,) = results["rows"]
    assert row["cells"] == 128
    assert 1 < row["finest_products"] < row["products"]
    assert row["residual"] <= 1e-8
    assert row["fft_pairs"] == pytest.approx(row["seconds"] / row["seconds_per_pair"])
    # 0.1305 a0/R on finer grids, and a0/R = 0.05
    assert row["friction"] == pytest.approx(0.05 * 0.1305, rel=2.0 * row["relative_error"])
    assert row["relative_error"] < 2e-3


@pytest.mark.usefixtures("contact_path")
def test_ball_benchmark_measures_the_price_of_digits(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import ball

    ball.main(["--accuracy", "2e-2", "--speeds", "2", "--json", str(tmp_path / "digits.json")])
    assert "accuracy 0.02" in capsys.readouterr().out
    rows = read(tmp_path / "digits.json")["rows"]
    assert len(rows) == len(ball.RUBBERS)
    for row in rows:
        assert row["solved"] == 2
        assert 0.0 < row["median"] <= row["most"]
        assert row["stated"] <= 2e-2


@pytest.mark.slow
@pytest.mark.usefixtures("contact_path")
def test_benchmark_of_stated_errors_compares_each_of_them(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import stated_errors

    stated_errors.main(["--first", "1", "--count", "1", "--json", str(tmp_path / "errors.json")])
    assert "stated errors of 1 random contacts" in capsys.readouterr().out
    results = read(tmp_path / "errors.json")
    assert results["unsolved"] == []
    numbers = {row["number"]: row for row in results["rows"]}
    # A cylinder: its load is given, and it has no width.
    assert numbers.keys() == {
        "friction", "indentation", "area", "front", "rear", "max pressure", "centre of pressure", "derivatives",
    }  # fmt: skip
    assert all(row["apart"] > 0.0 for row in numbers.values())  # two different grids
    assert all(row["within"] == (row["worst"] <= 1.0) for row in results["summary"])
    stated_errors.main(["--periodic", "--first", "1012", "--count", "1", "--json", str(tmp_path / "rough.json")])
    (row,) = read(tmp_path / "rough.json")["rows"]
    assert row["number"] == "friction"
    assert 0.0 < row["apart"] < 0.01 * row["size"]  # nearly in full contact


@pytest.mark.usefixtures("motion_path")
def test_benchmark_of_errors_over_time_goes_on_with_a_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import stated_errors

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
@pytest.mark.usefixtures("contact_path")
def test_backend_benchmark_measures_what_is_there_and_names_what_is_not(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    import backends

    monkeypatch.setitem(sys.modules, "cupy", None)
    names = ["scipy", "scipyx2", "cupy"]
    backends.main(["--sizes", "32", "--backends", *names, "--repeats", "1", "--json", str(tmp_path / "backends.json")])
    assert "left out: backend = 'cupy'" in capsys.readouterr().out
    rows = read(tmp_path / "backends.json")["rows"]
    assert [row["backend"] for row in rows] == ["scipy", "scipyx2"] * 2
    assert rows[0]["FFTs"] == rows[1]["FFTs"]
    assert rows[2]["products"] == rows[3]["products"]
    assert all(row[what] > 0.0 for row in rows for what in ("elastic", "ball") if what in row)


def test_benchmark_of_octaves_compares_two_methods(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.syspath_prepend(str(BENCHMARKS / "roughness"))
    import octaves

    monkeypatch.setattr(octaves, "SPEEDS", (1e-6,))
    octaves.main(["--shortest", "32", "--seeds", "1", "--json", str(tmp_path / "octaves.json")])
    assert "theory over solution" in capsys.readouterr().out
    (row,) = read(tmp_path / "octaves.json")["rows"]
    assert row["area"] > 0.7
    assert 0.95 < row["half_ratio"] < row["full_ratio"] < 1.2  # 0.98 and 1.12 with three surfaces


@pytest.mark.usefixtures("contact_path")
def test_rough_benchmark_leaves_a_reason_where_a_peer_is_missing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    import rough

    rough.main(["--sizes", "32", "--peers", str(tmp_path), "--json", str(tmp_path / "rough.json")])
    assert "not installed; run benchmarks/contact/make_peers.sh" in capsys.readouterr().out
    elastic, viscoelastic, *peers = read(tmp_path / "rough.json")["rows"]
    assert len(peers) == 2
    assert elastic["ratio"] == 1.0
    assert elastic["friction"] == 0.0 < viscoelastic["friction"]
    assert max(elastic["residual"], viscoelastic["residual"]) <= 1e-8


@pytest.mark.usefixtures("contact_path")
def test_residual_of_the_rough_benchmark_is_that_of_the_pressures() -> None:
    import problems
    import rough

    surface = problems.rough_surface(32)
    pressure = problems.elastic_rough(surface).pressure
    assert rough.residual(pressure, surface) <= 2e-8  # the solver's own measure, at another mean gap
    spoilt = pressure.copy()
    spoilt[np.unravel_index(pressure.argmax(), pressure.shape)] *= 1.01
    assert rough.residual(spoilt, surface) > 1e-4


@pytest.mark.apart
@pytest.mark.usefixtures("contact_path")
def test_scaling_benchmark_gives_exponents_and_memory(tmp_path: Path) -> None:
    import scaling

    scaling.main(["--sizes", "64", "128", "--problems", "elastic", "--json", str(tmp_path / "scaling.json")])
    small, large = read(tmp_path / "scaling.json")["rows"]
    assert (small["points"], large["points"]) == (64, 128)
    assert large["exponent"] == pytest.approx(np.log(large["seconds"] / small["seconds"]) / np.log(4.0))
    # At least pressure, displacement and heights; less than what a matrix would take.
    assert all(3.0 < row["arrays"] < 64**2 for row in (small, large))
    assert large["megabytes"] > small["megabytes"]


@pytest.mark.slow
@pytest.mark.usefixtures("contact_path")
def test_random_rough_contacts_are_all_counted(tmp_path: Path) -> None:
    import random_rough

    random_rough.main(["--contacts", "6", "--json", str(tmp_path / "random.json")])
    (row,) = read(tmp_path / "random.json")["rows"]
    assert row["contacts"] == 6
    assert row["failed"] == 0
    assert 10 < row["median"] <= row["most"] <= row["largest"] <= row["total"]


@pytest.mark.usefixtures("contact_path")
@pytest.mark.slow
def test_the_sliding_ball_is_within_the_tolerances_of_its_table() -> None:
    import sliding_ball

    for _, published, tolerance, friction, error, seconds in sliding_ball.rows(accuracy=1e-2):
        assert friction == pytest.approx(published, rel=tolerance)
        assert 0.0 <= error <= 1e-2 * friction
        assert seconds > 0.0


@pytest.mark.usefixtures("contact_path")
def test_growth_is_the_exponent_of_a_power_law() -> None:
    import measuring

    assert measuring.growth([1e4, 4e4, 16e4], [2.0, 2.0 * 4**1.1, 2.0 * 16**1.1]) == pytest.approx(1.1)


@pytest.mark.usefixtures("contact_path")
def test_steps_in_time_lead_to_the_steady_friction_in_first_order() -> None:
    import maxwell
    import problems

    surface = vf.contact.PeriodicSurface(problems.self_affine(32, points_per_shortest_wave=16.0), 1.0 / 32)
    steady = maxwell.steady_friction(surface)
    coarse, fine = (
        maxwell.steady_friction(surface, maxwell.time_step(surface, substeps)) - steady for substeps in (128, 256)
    )
    assert coarse / fine == pytest.approx(2.0, rel=0.02)  # of first order in Δt, up to its second
    needed = maxwell.substeps_needed(surface)
    assert abs(maxwell.steady_friction(surface, maxwell.time_step(surface, needed)) / steady - 1.0) <= 0.01


@pytest.mark.usefixtures("contact_path")
def test_maxwell_benchmark_without_its_peer(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import maxwell

    maxwell.main(["--points", "32", "--verify", "16", "--peers", str(tmp_path), "--json", str(tmp_path / "m.json")])
    assert "not installed" in capsys.readouterr().out
    own, peer = read(tmp_path / "m.json")["cost"]
    assert own["friction"] > 0.0
    assert "error" in peer


@pytest.mark.slow
@pytest.mark.usefixtures("contact_path")
def test_curve_benchmark_measures_its_true_error(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import curve

    # the fast end of the curve, where coarse grids do
    arguments = ["--speeds", "2", "--slowest", "1e2", "--decades", "4", "--workers", "1", "--accuracy", "0.001"]
    curve.main([*arguments, "--check", "1", "--json", str(tmp_path / "curve.json")])
    assert "failures" in capsys.readouterr().out
    results = read(tmp_path / "curve.json")
    (row,), points = results["rows"], results["points"]
    assert (row["speeds"], row["failures"], row["checked"]) == (2, 0, 1)
    assert 0.0 < row["worst_error"] == points[0]["true_error"] < 0.001
    assert row["worst_estimate"] <= 0.001
    assert row["wall_seconds"] > 0.0 < row["seconds"]


@pytest.mark.slow
def test_benchmark_of_repeated_runs_measures_coverage_and_width(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.syspath_prepend(str(BENCHMARKS / "friction"))
    import repeated_runs

    few = ["--seeds", "4", "--case", "1 % from step to step", "--json", str(tmp_path / "runs.json")]
    repeated_runs.main(few)
    assert "1 % from step to step" in capsys.readouterr().out
    (row,) = read(tmp_path / "runs.json").values()
    for one in row.values():
        assert 0.7 < one["held"] <= 1.0  # of 20 intervals: 15 or fewer once in 400 times
        assert 0.7 < one["median width"] < 2.5
    with pytest.raises(SystemExit, match="are held"):
        repeated_runs.main([*few, "--check", "101"])


@pytest.mark.apart
def test_benchmark_of_the_interface_counts_planted_laws_within_bands(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.syspath_prepend(str(BENCHMARKS / "friction"))
    import interface

    monkeypatch.setattr(interface, "KINDS", ("constant", "power"))
    interface.main(["--problems", "4", "--json", str(tmp_path / "interface.json")])
    assert "right law chosen" in capsys.readouterr().out
    for row in read(tmp_path / "interface.json")["rows"]:
        assert row["refused"] == 0
        assert row["points"] > 0.5  # below a half in 1 of 70 such sets of four bands, which move as one


@pytest.mark.slow
@pytest.mark.apart
def test_benchmark_of_total_friction_compares_it_with_that_of_the_planted_interface(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.syspath_prepend(str(BENCHMARKS / "friction"))
    import total

    monkeypatch.setattr(total, "TRUE", 8)
    monkeypatch.setattr(total, "OTHERS", 8)
    few = ["--scenes", "1", "--draws", "2", "--shapes", "cylinder", "rough"]
    total.main([*few, "--json", str(tmp_path / "total.json")])
    assert "within its 95 % band" in capsys.readouterr().out
    for row in read(tmp_path / "total.json")["rows"]:
        assert row["problems"] + row["refused"] == 2
        assert 0.0 < row["width"] < 0.5
        assert 0.0 <= row["held"] <= 1.0


@pytest.mark.apart
@pytest.mark.usefixtures("contact_path")
def test_benchmark_of_sweeps(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(BENCHMARKS / "study"))
    import costs
    import sweeps

    target = tmp_path / "sweeps.json"
    few = ["--speeds", "3", "--temperatures", "1", "--accuracy", "2e-2", "--check", "1", "--distinct", "10"]
    sweeps.main([*few, "--workers", "1", "--json", str(target)])
    curve, gained, each = json.loads(target.read_text(encoding="utf-8"))["rows"]
    assert (curve["cases"], gained["cases"], each["cases"]) == (3, 24, 10)
    assert (curve["solved"], each["solved"]) == (3, 10)
    assert not any(row["failures"] for row in (curve, gained, each))
    assert curve["worst_error"] < 2e-2  # the accuracy
    costs.main(["--speeds", "1", "--accuracies", "2e-2", "--json", str(target)])
    rows = json.loads(target.read_text(encoding="utf-8"))["rows"]
    assert [row["failures"] for row in rows] == [0] * 5
