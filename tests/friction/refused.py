"""What is refused is asserted by the code of its error, not by its sentence."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

import pytest

from viscofric.errors import InputError, ViscofricError

if TYPE_CHECKING:
    from collections.abc import Iterator


@contextmanager
def refused(code: str, kind: type[ViscofricError] = InputError) -> Iterator[pytest.ExceptionInfo[ViscofricError]]:
    """Expect an error of a kind with a code."""
    with pytest.raises(kind) as caught:
        yield caught
    assert caught.value.code == code, str(caught.value)
