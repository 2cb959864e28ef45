"""Errors by their codes."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Iterator

    from viscofric.errors import ViscofricError


@contextlib.contextmanager
def refused(kind: type[ViscofricError], code: str) -> Iterator[None]:
    """Expect an error of a kind, with a code."""
    with pytest.raises(kind) as caught:
        yield
    assert caught.value.code == code
