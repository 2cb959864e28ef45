"""A tab of a real Firefox on the page, driven through its own Marionette protocol."""

from __future__ import annotations

import itertools
import json
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

_NAMES = ("firefox", "firefox-esr")
_WIDTH, _HEIGHT = 1400, 900
_START = 60.0  # s that it may take to begin
_ERRORS = """
const [given] = arguments;
return Services.console.getMessageArray().filter((one) => one instanceof Ci.nsIScriptError)
  .filter(({ sourceName, flags }) => sourceName.startsWith(given) && !(flags & Ci.nsIScriptError.warningFlag))
  .map(({ errorMessage, lineNumber, sourceName }) => `${sourceName}:${lineNumber} ${errorMessage}`);
"""


def firefox_path() -> str | None:
    """Return where a Firefox is, if there is one."""
    return next((found for name in _NAMES if (found := shutil.which(name))), None)


class FirefoxTab:
    """An open tab; see https://firefox-source-docs.mozilla.org/testing/marionette/Protocol.html."""

    def __init__(self, port: int) -> None:
        self._numbers = itertools.count(1)
        self._socket = socket.create_connection(("127.0.0.1", port), timeout=60.0)
        self._stream = self._socket.makefile("rb")
        self._received()
        self.command("WebDriver:NewSession", capabilities={})

    def close(self) -> None:
        """Leave Firefox."""
        self._stream.close()
        self._socket.close()

    def _received(self) -> Any:
        digits = iter(lambda: self._stream.read(1), b":")
        return json.loads(self._stream.read(int(b"".join(digits))))

    def command(self, name: str, **parameters: Any) -> Any:
        """Send a command, and return its value."""
        text = json.dumps([0, next(self._numbers), name, parameters]).encode()
        self._socket.sendall(b"%d:%b" % (len(text), text))
        _, _, error, result = self._received()
        assert error is None, error
        return result.get("value") if isinstance(result, dict) else result

    def value(self, expression: str, *arguments: Any) -> Any:
        """Return what JavaScript finds in the document; ``given`` are the arguments."""
        script = f"const given = [...arguments]; return ({expression});"
        return self.command("WebDriver:ExecuteScript", script=script, args=list(arguments))

    def until(self, expression: str, seconds: float = 30.0) -> None:
        """Wait until JavaScript finds something to be true."""
        end = time.monotonic() + seconds
        while not self.value(expression):
            assert time.monotonic() < end, f"it never came true: {expression}"
            time.sleep(0.15)

    def errors(self, base: str) -> list[str]:
        """Return the errors of scripts of the page."""
        self.command("Marionette:SetContext", value="chrome")
        found = self.command("WebDriver:ExecuteScript", script=_ERRORS, args=[base])
        self.command("Marionette:SetContext", value="content")
        return found


@contextmanager
def firefox_tab(path: str, profile: Path) -> Iterator[FirefoxTab]:
    """Start a headless Firefox with a profile of its own."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    profile.mkdir(parents=True, exist_ok=True)
    (profile / "user.js").write_text(f'user_pref("marionette.port", {port});\n', encoding="utf-8")
    options = ("--headless", "--marionette", "--remote-allow-system-access", "--no-remote", "--profile", str(profile))
    process = subprocess.Popen([path, *options], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        with closing(_listening(port, time.monotonic() + _START)) as tab:
            tab.command("WebDriver:SetWindowRect", width=_WIDTH, height=_HEIGHT)
            yield tab
    finally:
        process.terminate()
        process.wait(_START)


def _listening(port: int, end: float) -> FirefoxTab:
    while True:
        try:
            return FirefoxTab(port)
        except ConnectionError:
            assert time.monotonic() < end, "Firefox does not listen"
            time.sleep(0.2)
