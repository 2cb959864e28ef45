"""Errors by what they are about."""

from __future__ import annotations

import re
from contextlib import contextmanager
from typing import TYPE_CHECKING

import pytest

from viscofric.errors import InputError, ViscofricError

if TYPE_CHECKING:
    from collections.abc import Iterator


@contextmanager
def refused(about: str, error: type[ViscofricError] = InputError) -> Iterator[pytest.ExceptionInfo[ViscofricError]]:
    """Expect an error in one sentence, with this code or about this argument, which is named first."""
    with pytest.raises(error) as caught:
        yield caught
    message = str(caught.value)
    argument = re.match(r"\w*", message)
    assert about in (caught.value.code, argument and argument[0]), message
    assert "\n" not in message
    assert message.endswith((".", "?"))
