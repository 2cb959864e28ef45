"""Bodies of requests have a bearable size and pace."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from starlette.datastructures import Headers

from viscofric.web.access import refusal

if TYPE_CHECKING:
    from collections.abc import Callable

    from starlette.types import ASGIApp, Message, Receive, Scope, Send

LARGEST_STUDY = 4_000_000  # bytes, of a job's body
_BODY_WAIT, _LEAST_RATE = 30.0, 1e4  # s for a body that was announced, and longer for what comes at so many bytes/s


class Limits:
    """Refuses bodies larger than `largest` of their path (bytes), or that do not come within a pause (s) and rate."""

    def __init__(self, app: ASGIApp, largest: Callable[[str], int], pause: float = _BODY_WAIT) -> None:
        self.app, self.largest, self.pause = app, largest, pause

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        most = self.largest(scope["path"])
        too_large = refusal(scope, 413, f"The body has more than {most / 1e6:g} MB.")
        announced = Headers(scope=scope).get("content-length", "0")
        if announced.isdecimal() and int(announced[:20]) > most:
            await too_large(scope, receive, send)
            return
        body = _Body(receive, most, self.pause)
        replied = _Replied(send)
        try:
            await self.app(scope, body.receive, replied.send)
        except _TooLarge:
            if not replied.begun:
                await too_large(scope, receive, send)
        except _TooSlow:
            if not replied.begun:
                words = f"The body came too slowly: after {self.pause:g} s, at least {_LEAST_RATE / 1e3:g} kB/s."
                await refusal(scope, 408, words)(scope, receive, send)


class _TooLarge(BaseException):
    """More of a body came than may."""


class _TooSlow(BaseException):
    """A body does not come."""


class _Body:
    def __init__(self, receive: Receive, most: int, pause: float) -> None:
        self._receive, self._left, self._more = receive, most, True
        self._end = asyncio.get_running_loop().time() + pause

    async def receive(self) -> Message:
        if not self._more:
            return await self._receive()
        try:
            async with asyncio.timeout_at(self._end):
                message = await self._receive()
        except TimeoutError:
            raise _TooSlow from None
        if message["type"] == "http.request":
            came = len(message.get("body", b""))
            self._left -= came
            self._end += came / _LEAST_RATE
            self._more = message.get("more_body", False)
            if self._left < 0:
                raise _TooLarge
        return message


class _Replied:
    def __init__(self, send: Send) -> None:
        self._send, self.begun = send, False

    async def send(self, message: Message) -> None:
        self.begun = True
        await self._send(message)
