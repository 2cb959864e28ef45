"""The rheology benchmark runs without its peers and measures what it says."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import viscofric as vf
from viscofric.rheology.spectra.relaxation import RelaxationSpectrum

if TYPE_CHECKING:
    from collections.abc import Iterator

FOLDER = Path(__file__).resolve().parents[1] / "benchmarks" / "rheology"


@pytest.fixture
def benchmark_path(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Let the benchmark's files import each other, and forget them afterwards: their names are common ones."""
    before = set(sys.modules)
    monkeypatch.syspath_prepend(str(FOLDER))
    yield
    for name in set(sys.modules) - before:
        origin = getattr(sys.modules[name], "__file__", None) or ""
        if "benchmarks" in origin or Path(origin).name == "planted.py":
            del sys.modules[name]


def numbers_of(results: dict[str, Any], start: str) -> list[dict[str, Any]]:
    (rows,) = [rows for title, rows in results["tables"].items() if title.startswith(start)]
    return rows


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
    curve = vf.MasterCurve(omega, 1.1 * modulus.real, modulus.imag, np.full(50, 293.15), 293.15)
    found = measures.of_modes(curve, 1e6, [3e6, 5e7, 0.0], [1.0, 1e-3, 1e-4])
    assert found["modes"] == 2
    assert found["storage"] == pytest.approx(np.log10(1.1))
    assert found["loss"] == pytest.approx(0.0, abs=1e-12)
