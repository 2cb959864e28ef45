"""Messages about a job, each a line of JSON."""

from __future__ import annotations

import json
from typing import Any, NamedTuple


class Message(NamedTuple):
    """What a process says of a job: the event, and all of it as a line of JSON."""

    event: str
    line: bytes


def line(event: str, **more: Any) -> bytes:
    """Return a message of the server itself, as a line of JSON."""
    return json.dumps({"event": event, **more}).encode() + b"\n"
