"""The benchmark runs on the smallest of its problems and prints what it says."""

from __future__ import annotations

import runpy
from pathlib import Path

BENCHMARK = Path(__file__).resolve().parents[2] / "benchmarks" / "roughness" / "ensemble.py"


def test_benchmark_times_an_ensemble_and_the_theory(capsys):
    main = runpy.run_path(str(BENCHMARK))["main"]
    main(["--points", "64", "--speeds", "2", "--seeds", "1", "--workers", "1"])
    printed = capsys.readouterr().out
    assert "2 contacts of 64² points" in printed
    assert "Persson's theory at 2 speeds" in printed
    assert len(printed.splitlines()) == 5
