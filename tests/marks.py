"""Marks of parameters."""

from __future__ import annotations

from typing import Any

import pytest


def slow(*values: Any) -> list[Any]:
    """Return parameters that are left out with ``-m "not slow"``, where others show the same; a tuple is several."""
    return [pytest.param(*(one if isinstance(one, tuple) else (one,)), marks=pytest.mark.slow) for one in values]


def apart(*values: Any) -> list[Any]:
    """Return further parameters of what others show already, for ``-m apart``; a tuple is several."""
    return [pytest.param(*(one if isinstance(one, tuple) else (one,)), marks=pytest.mark.apart) for one in values]
