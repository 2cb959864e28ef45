"""Replies of the page's server, with the headers that keep it private; refusals in one sentence."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from starlette.types import Message, Scope, Send

_CONTENT = "; ".join(
    [
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self'",
        "style-src-attr 'unsafe-inline'",  # the library of the figures sets attributes; its sheet is ours (index.html)
        "img-src 'self' data: blob:",
        "font-src 'self'",
        "connect-src 'self'",
        "base-uri 'none'",
        "form-action 'none'",
        "frame-ancestors 'none'",
    ]
)
HEADERS = [
    (b"content-security-policy", _CONTENT.encode()),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cross-origin-resource-policy", b"same-origin"),
]


def headers_of(scope: Scope) -> dict[str, str]:
    """Return the headers of a request, by their names in small letters."""
    return {name.decode("latin-1").lower(): value.decode("latin-1") for name, value in scope["headers"]}


def with_headers(send: Send, program: str) -> Send:
    """Add to every reply the headers that keep the page private, and the name of this run of the server."""

    async def sending(message: Message) -> None:
        if message["type"] == "http.response.start":
            message["headers"] = [*message.get("headers", ()), *HEADERS, (b"x-program", program.encode())]
        await send(message)

    return sending


async def refuse(scope: Scope, send: Send, status: int, words: str) -> None:
    """Reply with a sentence, as JSON to a script."""
    as_json = scope["path"].startswith("/api/")
    body = json.dumps({"message": words}) if as_json else words + "\n"
    kind = b"application/json" if as_json else b"text/plain; charset=utf-8"
    await reply(send, status, body.encode(), [(b"content-type", kind), (b"connection", b"close")])


async def reply(send: Send, status: int, body: bytes, headers: list[tuple[bytes, bytes]]) -> None:
    """Send a whole reply."""
    more = [(b"content-length", str(len(body)).encode()), (b"cache-control", b"no-store"), *HEADERS]
    await send({"type": "http.response.start", "status": status, "headers": [*headers, *more]})
    await send({"type": "http.response.body", "body": body})
