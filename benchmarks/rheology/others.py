"""The peers' rows: each adapter runs in the peers' environment, in a process of its own with a time limit."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import cases
import measures

if TYPE_CHECKING:
    from cases import Case

    from viscofric.data import MasterCurve

HERE = Path(__file__).resolve().parent
#: Tool → adapter, task, whether the tool gives an uncertainty of each shift factor.
SHIFTERS: dict[str, tuple[str, str, bool]] = {
    "pyvisco 2.1.3": ("with_pyvisco.py", "shift", False),
    "mastercurves 0.2.3": ("with_mastercurves.py", "shift", True),
    "hermes-rheo 2.0.0": ("with_hermes_rheo.py", "shift", True),
    "RepTate 1.3.3": ("with_reptate.py", "shift", False),
}
FITTERS: dict[str, tuple[str, str]] = {
    "pyvisco 2.1.3": ("with_pyvisco.py", "spectrum"),
    "pyvisco 2.1.3, reduced": ("with_pyvisco.py", "reduced spectrum"),
    "hermes-rheo 2.0.0, 16 modes": ("with_hermes_rheo.py", "spectrum, 16 modes"),
    "hermes-rheo 2.0.0, 30 modes": ("with_hermes_rheo.py", "spectrum, 30 modes"),
    "pyReSpect-freq 2.0.0 (in hermes-rheo)": ("with_hermes_rheo.py", "pyrespect"),
}


class PeerError(Exception):
    """A peer gave no answer; the message says why."""


def python_of(environment: Path) -> Path:
    """Return the interpreter of the peers' environment."""
    return environment / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def shifting(tool: str, case: Case, environment: Path, limit: float) -> dict[str, Any]:
    """Have a peer shift the isotherms."""
    adapter, task, uncertainty = SHIFTERS[tool]
    row: dict[str, Any] = {"tool": tool, "uncertainty": uncertainty}
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "sweeps.csv"
        cases.write_sweeps(case.sweeps, source)
        try:
            answer = _ask(environment, adapter, task, source, limit)
        except PeerError as error:
            return row | {"error": str(error)}
    if len(answer["log10"]) != len(case.sweeps):
        return row | {"error": f"gave {len(answer['log10'])} factors for {len(case.sweeps)} isotherms"}
    row |= {"seconds": answer["seconds"], **measures.of_shifts(case, answer["log10"])}
    row["C1"], row["C2"] = measures.wlf_constants(case, answer["log10"])
    return row


def spectrum(tool: str, curve: MasterCurve, environment: Path, limit: float) -> dict[str, Any]:
    """Have a peer fit a spectrum to the master curve."""
    adapter, task = FITTERS[tool]
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "master_curve.csv"
        cases.write_master_curve(curve, source)
        try:
            answer = _ask(environment, adapter, task, source, limit)
        except PeerError as error:
            return {"tool": tool, "error": str(error)}
    return {"tool": tool, "seconds": answer["seconds"]} | measures.of_modes(
        curve, answer["E0"], answer["E"], answer["tau"]
    )


def _ask(environment: Path, adapter: str, task: str, source: Path, limit: float) -> dict[str, Any]:
    python = python_of(environment)
    if not python.is_file():
        raise PeerError("not installed; run benchmarks/rheology/make_peers.sh")
    target = source.with_name("answer.json")
    settings = {
        "OPENBLAS_NUM_THREADS": "1",
        "OMP_NUM_THREADS": "1",
        "QT_QPA_PLATFORM": "offscreen",
        "MPLBACKEND": "Agg",
    }
    command = [str(python), str(HERE / "peers" / adapter), task, str(source), str(target)]
    try:
        done = subprocess.run(
            command, env={**os.environ, **settings}, capture_output=True, text=True, timeout=limit, check=False
        )
    except subprocess.TimeoutExpired:
        raise PeerError(f"no answer within {limit:g} s") from None
    if done.returncode or not target.is_file():
        lines = done.stderr.strip().splitlines() or [f"exit status {done.returncode}"]
        raise PeerError(lines[-1][:160])
    answer: dict[str, Any] = json.loads(target.read_text(encoding="utf-8"))
    return answer
