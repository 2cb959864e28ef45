"""The peers' answers: each runs in an environment of its own, in a process of its own with a time limit."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

HERE = Path(__file__).resolve().parent
DEFAULT_ENVIRONMENT = HERE / ".peers"
#: Adapters in `peers`, one for each tool.
TOOLS = ("contact_mechanics", "tamaas")


class PeerError(Exception):
    """A peer gave no answer; the message says why."""


def python_of(environment: Path) -> Path:
    """Return the interpreter of the peers' environment."""
    return environment / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def ask(
    adapter: str, given: dict[str, Any], heights: np.ndarray, python: Path, limit: float
) -> list[tuple[dict[str, Any], dict[str, np.ndarray]]]:
    """Have a peer solve a contact.

    Parameters
    ----------
    adapter : str
        Name of a file in `peers`, without ``with_`` and its suffix.
    given : dict
        What the adapter needs to know.
    heights : (nx, ny) array
        Of the rigid surface, summits towards the solid.
    python : Path
        The interpreter that has the peer.
    limit : float
        Seconds of wall time.

    Returns
    -------
    list of (dict, dict)
        For each of the peer's solvers, what it tells of itself, and its arrays.

    Raises
    ------
    PeerError
        If there is no answer.
    """
    if not python.is_file():
        raise PeerError("not installed; run benchmarks/contact/make_peers.sh")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        np.save(folder / "heights.npy", heights)
        (folder / "given.json").write_text(json.dumps(given), encoding="utf-8")
        command = [str(python), str(HERE / "peers" / f"with_{adapter}.py"), name]
        settings = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
        try:
            done = subprocess.run(
                command, env={**os.environ, **settings}, capture_output=True, text=True, timeout=limit, check=False
            )
        except subprocess.TimeoutExpired:
            raise PeerError(f"no answer within {limit:g} s") from None
        if done.returncode or not (folder / "answer.json").is_file():
            lines = done.stderr.strip().splitlines() or [f"exit status {done.returncode}"]
            raise PeerError(lines[-1][:160])
        rows = json.loads((folder / "answer.json").read_text(encoding="utf-8"))
        answers = []
        for row in rows:
            with np.load(folder / row.pop("arrays")) as arrays:
                answers.append((row, dict(arrays)))
    return answers
