"""The site needs no other host: a build whose pages ask one for a script, a style, a font or an image fails."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from pathlib import Path
from typing import TYPE_CHECKING

from sphinx.errors import ExtensionError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from sphinx.application import Sphinx

_ELSEWHERE = re.compile(r"^\s*(https?:)?//", re.IGNORECASE)
_IN_STYLE = re.compile(r"""(?:url\(|@import)\s*["']?\s*((?:https?:)?//[^"')\s;]+)""", re.IGNORECASE)
#: Links that a browser follows by itself; those of other kinds are for readers.
_FETCHED = {"stylesheet", "preload", "prefetch", "modulepreload", "preconnect", "dns-prefetch", "icon", "manifest"}
_SOURCES = ("src", "srcset", "data", "poster")


class _Requests(HTMLParser):
    """What a page asks other hosts for."""

    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note addresses that the browser fetches with the page."""
        given = {name: value or "" for name, value in attrs}
        names = [name for name in _SOURCES if name in given]
        if tag == "link" and _FETCHED & set(given.get("rel", "").lower().split()):
            names.append("href")
        self.found += [given[name] for name in names if _ELSEWHERE.match(given[name])]
        self.found += _IN_STYLE.findall(given.get("style", ""))


def requests_of_page(text: str) -> list[str]:
    """Return the addresses on other hosts that a page of HTML has a browser fetch."""
    reader = _Requests()
    reader.feed(text)
    styles = re.findall(r"<style[^>]*>(.*?)</style>", text, re.DOTALL | re.IGNORECASE)
    return reader.found + [address for style in styles for address in requests_of_style(style)]


def requests_of_style(text: str) -> list[str]:
    """Return the addresses on other hosts that a style sheet has a browser fetch."""
    return _IN_STYLE.findall(re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL))


def requests_of_site(folder: Path) -> Iterator[str]:
    """Yield each request to another host with the file that makes it."""
    for ending, requests in ((".html", requests_of_page), (".css", requests_of_style)):
        for path in sorted(folder.rglob(f"*{ending}")):
            for address in requests(path.read_text(encoding="utf-8", errors="replace")):
                yield f"{path.relative_to(folder)}: {address}"


def refuse(app: Sphinx, exception: Exception | None) -> None:
    """Fail if the finished site asks any other host for anything."""
    found = [] if exception or app.builder.format != "html" else list(requests_of_site(Path(app.outdir)))
    if found:
        raise ExtensionError("the site must not ask other hosts: " + "; ".join(found[:10]))


def setup(app: Sphinx) -> dict[str, bool]:
    """Look at the site when all of it is written."""
    app.connect("build-finished", refuse, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
