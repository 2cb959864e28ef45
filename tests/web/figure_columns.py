"""What jobs say is drawn of their results, read as the page reads it."""

from __future__ import annotations

import re
from typing import Any


def value_at(found: Any, path: str) -> Any:
    """Return what a result has at a path such as ``isotherms[2].loss_modulus``."""
    for part in re.findall(r"[^.\[\]]+", path):
        found = found[int(part) if isinstance(found, list) else part]
    return found


def drawn(found: dict[str, Any]) -> dict[str, Any]:
    """Return the result of a job; all columns of its figures are there, as long as their x, and x and y are named."""
    for name, figure in found.get("figures", {}).items():
        assert figure["x"]["label"], name
        assert figure["y"]["label"], name
        for trace in figure["traces"]:
            columns = {key: trace[key] for key in ("x", "y", "lower", "upper", "error") if key in trace}
            read = {key: value_at(found, one) if isinstance(one, str) else one for key, one in columns.items()}
            assert {len(column) for column in read.values()} == {len(read["x"])}, (name, trace)
    return found
