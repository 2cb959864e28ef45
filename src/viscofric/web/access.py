"""Who may use the page: the user who started it, from the page itself."""

from __future__ import annotations

import hmac
import ipaddress
import re
import secrets
import socket
from dataclasses import dataclass, field
from functools import cache
from typing import TYPE_CHECKING
from urllib.parse import parse_qs

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import HTMLResponse, JSONResponse, PlainTextResponse, RedirectResponse, Response

if TYPE_CHECKING:
    from starlette.types import ASGIApp, Message, Receive, Scope, Send


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


_HOST = re.compile(r"(?P<name>\[[^\[\]]+\]|[^:\[\]]+)(?::(?P<port>\d{1,5}))?")
_EVERYWHERE = {"0.0.0.0", "::", ""}
_NO_TOKEN = (
    "This page is for the person who started it: open the address that 'viscofric web' printed, which holds a token."
)
_FOREIGN = "This request comes from another page or names another host; open the address that 'viscofric web' printed."


@dataclass(frozen=True)
class Door:
    """What a request must show to be let in."""

    port: int
    host: str = "127.0.0.1"  # that the server is bound to
    token: str = field(default_factory=lambda: secrets.token_urlsafe(24))
    #: Name of this run of the server, by which a page notices that it was started again
    program: str = field(default_factory=lambda: secrets.token_hex(8))
    #: Further tokens, each good for one use: other users of the machine can read the command lines of browsers
    invitations: set[str] = field(default_factory=set)

    @property
    def session(self) -> str:
        """Value of the cookie: derived from the token, which cannot be found from it."""
        return hmac.digest(self.token.encode(), b"cookie", "sha256").hex()

    @property
    def cookie(self) -> str:
        """Name of the cookie: browsers keep one for all ports of a host."""
        return f"viscofric-{self.port}"

    @property
    def address(self) -> str:
        """What the user opens."""
        return self._address(self.token)

    def invite(self) -> str:
        """Return an address that can be opened once."""
        self.invitations.add(invitation := secrets.token_urlsafe(24))
        return self._address(invitation)

    def _address(self, token: str) -> str:
        host = "127.0.0.1" if self.host in _EVERYWHERE else self.host
        return f"http://{f'[{host}]' if ':' in host else host}:{self.port}/?token={token}"

    def is_host(self, value: str) -> bool:
        """Whether a Host header names this server, by an address that nobody else can have made a name for."""
        found = _HOST.fullmatch(value)
        if found is None or (found["port"] or "80") != str(self.port):
            return False
        name = found["name"].strip("[]").lower()
        if name in {"127.0.0.1", "localhost", self.host.lower()} - {""}:
            return True
        if self.host not in _EVERYWHERE:
            return False
        if name in _own_names():
            return True
        try:
            ipaddress.ip_address(name)
        except ValueError:
            return False
        return True

    def is_origin(self, value: str) -> bool:
        """Whether an Origin header names a page of this server."""
        scheme, _, host = value.partition("://")
        return scheme == "http" and self.is_host(host)

    def is_token(self, value: str) -> bool:
        """Whether this is the token, in a time that does not depend on how much of it matches."""
        return secrets.compare_digest(value.encode("utf-8", "replace"), self.token.encode())

    def is_session(self, value: str) -> bool:
        """Whether this is the value of the cookie, in such a time too."""
        return secrets.compare_digest(value.encode("utf-8", "replace"), self.session.encode())

    def opens(self, value: str) -> bool:
        """Whether an address with this may be opened; an invitation is used up by it."""
        if value in self.invitations:
            self.invitations.remove(value)
            return True
        return self.is_token(value)


class Access:
    """Lets in only requests of the user's own page, and gives every reply the headers that keep it private."""

    def __init__(self, app: ASGIApp, door: Door) -> None:
        self.app, self.door = app, door

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
            return
        if scope["type"] != "http":
            return
        headers = Headers(scope=scope)
        refused = self._refused(scope, headers)
        if isinstance(refused, str):
            await refusal(scope, 403, refused)(scope, receive, send)
        elif refused:
            await self._welcome(headers)(scope, receive, send)
        else:
            await self.app(scope, receive, with_headers(send, self.door.program))

    def _refused(self, scope: Scope, headers: Headers) -> str | bool:
        """Return why a request is refused; True if it brings the token in its address, False if it is let in."""
        origin = headers.get("origin")
        if not self.door.is_host(headers.get("host", "")) or (origin is not None and not self.door.is_origin(origin)):
            return _FOREIGN
        if scope["path"] == "/" and scope["method"] == "GET":
            given = parse_qs(scope["query_string"].decode("latin-1")).get("token")
            if given and self.door.opens(given[0]):
                return True
        scheme, _, bearer = headers.get("authorization", "").partition(" ")
        if scheme.lower() == "bearer" and self.door.is_token(bearer.strip()):
            return False
        return False if self.door.is_session(_cookie(headers, self.door.cookie)) else _NO_TOKEN

    def _welcome(self, headers: Headers) -> Response:
        """Hand out the cookie and lead to the page.

        A link on another page (a terminal in a browser) makes the browser hold back the cookie from a redirection,
        but not from what this reply itself requests.
        """
        reply: Response = RedirectResponse("/", 303, UNKEPT)
        if headers.get("sec-fetch-site") == "cross-site":
            page = '<!doctype html><title>viscofric</title><a href="/">viscofric</a>'
            reply = HTMLResponse(page, headers={**UNKEPT, "refresh": "0; url=/"})
        reply.headers["set-cookie"] = f"{self.door.cookie}={self.door.session}; Path=/; HttpOnly; SameSite=Strict"
        return reply


def _cookie(headers: Headers, name: str) -> str:
    """Return the value of a cookie; those of other programs at this host, which may be anything, are passed over."""
    for one in headers.get("cookie", "").split(";"):
        key, _, value = one.strip().partition("=")
        if key == name:
            return value
    return ""


@cache
def _own_names() -> set[str]:
    """Return the names of this machine; looked up once, as the network may be slow."""
    return {socket.gethostname().lower(), socket.getfqdn().lower()}
