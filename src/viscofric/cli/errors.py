"""Errors of viscofric as the command line tells them: one sentence, no traceback."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from collections.abc import Iterator


@contextmanager
def told() -> Iterator[None]:
    """Turn what viscofric raises on purpose into a message and exit status 1."""
    from viscofric.errors import ViscofricError

    try:
        yield
    except ViscofricError as error:
        raise click.ClickException(str(error)) from error
