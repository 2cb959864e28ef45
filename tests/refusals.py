"""Errors by what they are about."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from viscofric.errors import InputError, ViscofricError


@contextmanager
def refused(
    about: str, error: type[ViscofricError] = InputError, *, naming: str | tuple[str, ...] = ()
) -> Iterator[pytest.ExceptionInfo[ViscofricError]]:
    """Expect an error in one sentence.

    Parameters
    ----------
    about : str
        The code of the error, or the argument that the sentence names first.
    error : type, optional
        Of the error.
    naming : str or tuple of str, optional
        Arguments, values or places that the sentence must name.
    """
    with pytest.raises(error) as caught:
        yield caught
    message = str(caught.value)
    argument = re.match(r"\w*", message)
    assert about in (caught.value.code, argument and argument[0]), message
    assert [name for name in ((naming,) if isinstance(naming, str) else naming) if name not in message] == [], message
    assert "\n" not in message
    assert message.endswith((".", "?"))
