"""Replies of the page's server, with the headers that keep it private; refusals in one sentence."""

from __future__ import annotations

from typing import TYPE_CHECKING

from starlette.datastructures import MutableHeaders
from starlette.responses import JSONResponse, PlainTextResponse, Response

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
HEADERS = {
    "content-security-policy": _CONTENT,
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
}
#: Headers of a reply that comes from no page of the server.
UNKEPT = {**HEADERS, "cache-control": "no-store"}


def with_headers(send: Send, program: str) -> Send:
    """Add to every reply the headers that keep the page private, and the name of this run of the server."""

    async def sending(message: Message) -> None:
        if message["type"] == "http.response.start":
            MutableHeaders(scope=message).update({**HEADERS, "x-program": program})
        await send(message)

    return sending


def refusal(scope: Scope, status: int, words: str) -> Response:
    """Return the reply of a sentence, as JSON to a script."""
    headers = {**UNKEPT, "connection": "close"}
    if scope["path"].startswith("/api/"):
        return JSONResponse({"message": words}, status, headers)
    return PlainTextResponse(f"{words}\n", status, headers)
