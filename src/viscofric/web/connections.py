"""A connection to the page, which ends if its other end keeps the server waiting."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from uvicorn.protocols.http.h11_impl import H11Protocol

if TYPE_CHECKING:
    import asyncio

HEAD_WAIT, REPLY_WAIT = 30.0, 30.0  # s
_LEAST_TAKEN = 30_000  # bytes of a reply that a reader takes in the latter


class Connection(H11Protocol):
    """uvicorn's protocol, but a connection ends if a head does not come, or a reply is not taken, in time."""

    _waiting: asyncio.TimerHandle | None = None
    _sending: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Wait for a head."""
        super().connection_made(transport)
        transport.set_write_buffer_limits(0)  # writing is paused whenever the system does not take all
        self._wait()

    def data_received(self, data: bytes) -> None:
        """Go on with a request."""
        super().data_received(data)
        self._wait()

    def pause_writing(self) -> None:
        """Wait for the reader."""
        super().pause_writing()
        self._send(self.transport.get_write_buffer_size())

    def resume_writing(self) -> None:
        """Send more."""
        self._stop_sending()
        super().resume_writing()

    def connection_lost(self, exc: Exception | None) -> None:
        """Wait no longer."""
        self._stop_waiting()
        self._stop_sending()
        super().connection_lost(exc)

    def _wait(self) -> None:
        """Wait for a head from its first byte on, not from each."""
        cycle: Any = self.cycle  # None before a first request
        if cycle is not None and not cycle.response_complete:
            self._stop_waiting()
        elif self._waiting is None and not self.transport.is_closing():
            self._waiting = self.loop.call_later(HEAD_WAIT, self.transport.abort)

    def _stop_waiting(self) -> None:
        if self._waiting is not None:
            self._waiting.cancel()
            self._waiting = None

    def _send(self, left: int) -> None:
        self._sending = self.loop.call_later(REPLY_WAIT, self._check_sent, left)

    def _check_sent(self, before: int) -> None:
        """End the connection unless enough of a reply was taken; nothing is added to it meanwhile."""
        left = self.transport.get_write_buffer_size()
        if before - left < _LEAST_TAKEN:
            self.transport.abort()
        else:
            self._send(left)

    def _stop_sending(self) -> None:
        if self._sending is not None:
            self._sending.cancel()
            self._sending = None
