"""``viscofric web`` at work: a port, a token, the browser, and an end that leaves nothing behind."""

from __future__ import annotations

import contextlib
import importlib.util
import signal
import socket
import sys
import threading
import webbrowser
from typing import TYPE_CHECKING, Any

from viscofric.errors import ViscofricError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path
    from types import FrameType

    import uvicorn

    from viscofric.web.access import Door
    from viscofric.web.children import Children
    from viscofric.web.workspace import Workspaces

PORT = 8765
_LOCAL = {"127.0.0.1", "localhost", "::1"}
_NO_EXTRA = 'The page needs packages that are not installed; get them with: pip install "viscofric[web]"'


def is_local(host: str) -> bool:
    """Whether only this machine can reach a server that is bound to a host."""
    return host in _LOCAL


def bound(host: str, port: int) -> socket.socket:
    """Return a listening socket at a port, or at a free one if that is taken."""
    for wanted in (port, 0):
        try:
            return _listening(host, wanted)
        except OSError as error:
            last = error
    raise ViscofricError(
        f"The page cannot be served at {host}:{port} ({last.strerror or last}).", code="not-served"
    ) from None


def _listening(host: str, port: int) -> socket.socket:
    family, kind, protocol, _, address = socket.getaddrinfo(
        host or None, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
    )[0]
    listening = socket.socket(family, kind, protocol)
    try:
        if sys.platform != "win32":  # where it would let two servers have one port
            listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listening.bind(address)
        listening.listen(100)
    except OSError:
        listening.close()
        raise
    return listening


def serve(
    host: str = "127.0.0.1",
    port: int = PORT,
    *,
    study: dict[str, Any] | None = None,
    files: dict[str, Path] | None = None,
    browser: bool = True,
    on_start: Callable[[str, int], object] | None = None,
) -> None:
    """Serve the page and its first files until an interrupt; `on_start` gets its address, token and all, and port."""
    from viscofric.web.access import Door
    from viscofric.web.children import Children
    from viscofric.web.workspace import Workspaces

    if not all(map(importlib.util.find_spec, ("fastapi", "uvicorn", "tomli_w"))):
        raise ViscofricError(_NO_EXTRA, code="not-installed")
    with contextlib.ExitStack() as stack, _stopped_by_signals() as stopping:
        listening = stack.enter_context(bound(host, port))
        door = Door(listening.getsockname()[1], host)
        children = Children()
        children.start()  # at once: it loads NumPy and the contact engine while this process loads the server
        stack.callback(children.close)
        workspaces = stack.enter_context(contextlib.closing(Workspaces(files)))
        # the browser starts meanwhile, too: its requests wait at the socket
        if on_start is not None:
            on_start(door.address, door.port)
        if browser:
            threading.Thread(target=webbrowser.open, args=(door.invite(),), daemon=True).start()
        server = _server(door, children, study, workspaces)
        stopping += [lambda: setattr(server, "should_exit", True), children.stop]
        if stopping.requested:  # and the exception was lost: Python drops those raised where it collects garbage
            raise KeyboardInterrupt
        server.run(sockets=[listening])


def _server(door: Door, children: Children, study: dict[str, Any] | None, workspaces: Workspaces) -> uvicorn.Server:
    """Return the server, which handles no signals itself."""
    import asyncio

    import uvicorn

    from viscofric.web.app import make_app
    from viscofric.web.connections import HEAD_WAIT, Connection
    from viscofric.web.start import start

    class Server(uvicorn.Server):
        async def startup(self, sockets: list[socket.socket] | None = None) -> None:
            children.attach()
            asyncio.get_running_loop().run_in_executor(None, start, study)  # loads what its first reply needs
            await super().startup(sockets)

        @contextlib.contextmanager
        def capture_signals(self) -> Iterator[None]:
            yield

    config = uvicorn.Config(
        make_app(door, workspaces, children, study),
        http=Connection,
        loop="asyncio",
        ws="none",
        lifespan="off",
        log_level="warning",
        access_log=False,
        server_header=False,
        proxy_headers=False,
        timeout_keep_alive=int(HEAD_WAIT),
        timeout_graceful_shutdown=2,
    )
    return Server(config)


class _Stopping(list["Callable[[], object]"]):
    """What is called when the program is to stop, and whether a signal arrived."""

    requested = False


@contextlib.contextmanager
def _stopped_by_signals() -> Iterator[_Stopping]:
    """Call what is in the list at an interrupt, a hangup or the wish to terminate; before there is any, raise."""
    stopping = _Stopping()

    def stop(number: int, frame: FrameType | None) -> None:
        stopping.requested = True
        if not stopping:
            raise KeyboardInterrupt
        for call in stopping:
            call()

    if threading.current_thread() is not threading.main_thread():
        yield stopping
        return
    names = ("SIGINT", "SIGTERM", "SIGHUP")
    before = {number: signal.signal(number, stop) for name in names if (number := getattr(signal, name, None))}
    try:
        yield stopping
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
