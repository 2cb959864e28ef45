"""The page is its user's alone: who else asks, from where and with how much, is refused in one sentence."""

from __future__ import annotations

import contextlib
import json
import re
import socket
import time
from contextlib import asynccontextmanager, contextmanager
from typing import TYPE_CHECKING, Any

import httpx
import pytest

from viscofric.web import connections
from viscofric.web.access import Door
from viscofric.web.limits import Limits
from web.own_loop import run_apart

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Iterator

    from web.served_page import Server

_SAFE = {
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-resource-policy": "same-origin",
}


@contextmanager
def raw(server: Server) -> Iterator[socket.socket]:
    """Connect as something that is no browser."""
    host, port = server.base.removeprefix("http://").split(":")
    with socket.create_connection((host, int(port)), timeout=10.0) as connection:
        yield connection


def said(connection: socket.socket) -> bytes:
    """Return all that comes until the connection is closed or rests."""
    found = b""
    connection.settimeout(2.0)
    try:
        while piece := connection.recv(65536):
            found += piece
    except TimeoutError:
        pass
    return found


def test_address_with_the_token_lets_the_browser_in(server: Server) -> None:
    with httpx.Client(base_url=server.base, trust_env=False) as browser:
        assert browser.get("/").status_code == 403
        welcome = browser.get(server.address)
        assert (welcome.status_code, welcome.headers["location"]) == (303, "/")
        cookie = welcome.headers["set-cookie"]
        assert "HttpOnly" in cookie
        assert server.token not in cookie
        assert "SameSite=Strict" in cookie
        assert cookie.startswith(f"viscofric-{server.base.rpartition(':')[2]}=")
        page = browser.get("/")
        assert page.status_code == 200
        assert "<title>viscofric" in page.text
        assert "running" in browser.get("/api/status").json()
        # followed from a page of another site, a redirection would not carry the cookie
        elsewhere = browser.get(server.address, headers={"Sec-Fetch-Site": "cross-site"})
        assert (elsewhere.status_code, elsewhere.headers["refresh"]) == (200, "0; url=/")


def test_invitation_opened_again_by_the_browser_that_used_it_shows_the_page(server: Server) -> None:
    """As a browser does that restores its tabs; the token in the address counts no more, the cookie does."""
    with httpx.Client(base_url=server.base, trust_env=False) as browser:
        browser.get(server.address)
        assert browser.get("/?token=used").status_code == 200
        browser.cookies.clear()
        assert browser.get("/?token=used").status_code == 403


@pytest.mark.parametrize("other", ['a={"x": 1}', "user[name]=1", "flag", "x=a b c", "=", "expires=5", 'q="', "a=1"])
def test_cookies_of_other_programs_at_this_host_are_passed_over(server: Server, other: str) -> None:
    """Browsers send the cookies of all ports of a host; some are no proper ones."""
    name = f"viscofric-{server.base.rpartition(':')[2]}"
    session = Door(0, token=server.token).session
    for cookies in (f"{other}; {name}={session}", f"{name}={session}; {other}"):
        assert httpx.get(f"{server.base}/", headers={"Cookie": cookies}, trust_env=False).status_code == 200
    for cookies in (f"{other}; {name}x={session}", f"x{name}={session}", f"{name}={session}x"):
        assert httpx.get(f"{server.base}/", headers={"Cookie": cookies}, trust_env=False).status_code == 403


@pytest.mark.parametrize("path", ["/", "/?token=wrong", "/?token=", "/static/js/main.js", "/api/start", "/nothing"])
@pytest.mark.parametrize("authorization", [None, "Bearer wrong", "Basic eDp5", "Bearer \xfc"])
def test_without_the_token_nothing_is_answered(server: Server, path: str, authorization: str | None) -> None:
    headers = {} if authorization is None else {"Authorization": authorization.encode("latin-1")}
    answer = httpx.get(server.base + path, headers=headers, trust_env=False)
    assert answer.status_code == 403
    assert "viscofric web" in answer.text
    assert answer.text.count(".") <= 1
    assert_safe(answer)


def assert_safe(answer: httpx.Response) -> None:
    assert _SAFE.items() <= dict(answer.headers).items()
    policy = answer.headers["content-security-policy"]
    assert "default-src 'none'" in policy
    assert "script-src 'self';" in policy
    assert "frame-ancestors 'none'" in policy
    assert "access-control-allow-origin" not in answer.headers
    assert "server" not in answer.headers


@pytest.mark.parametrize(
    ("host", "origin", "status"),
    [
        ("127.0.0.1:PORT", None, 200),
        ("localhost:PORT", "http://localhost:PORT", 200),
        ("127.0.0.1:PORT", "http://127.0.0.1:PORT", 200),
        ("evil.example:PORT", None, 403),
        ("127.0.0.1", None, 403),
        ("127.0.0.1:1", None, 403),
        ("127.0.0.1.evil.example:PORT", None, 403),
        ("", None, 403),
        ("127.0.0.1:PORT", "null", 403),
        ("127.0.0.1:PORT", "https://127.0.0.1:PORT", 403),
        ("127.0.0.1:PORT", "http://evil.example", 403),
        ("127.0.0.1:PORT", "http://127.0.0.1:1", 403),
    ],
)
def test_foreign_host_or_origin_is_refused(server: Server, host: str, origin: str | None, status: int) -> None:
    port = server.base.rpartition(":")[2]
    headers = {"Authorization": f"Bearer {server.token}", "Host": host.replace("PORT", port)}
    if origin is not None:
        headers["Origin"] = origin.replace("PORT", port)
    answer = httpx.get(f"{server.base}/api/status", headers=headers, trust_env=False)
    assert answer.status_code == status
    assert_safe(answer)


def test_server_for_all_hosts_answers_to_addresses_but_not_to_any_name() -> None:
    door = Door(8765, "0.0.0.0")
    assert door.address.startswith("http://127.0.0.1:8765/?token=")
    assert door.is_host("192.168.1.2:8765")
    assert door.is_host("[::1]:8765")
    assert door.is_host(f"{socket.gethostname()}:8765")
    assert not door.is_host("evil.example:8765")
    assert not Door(8765).is_host("192.168.1.2:8765")
    assert Door(80).is_host("127.0.0.1")
    assert Door(8765, "::1").address.startswith("http://[::1]:8765/")
    assert Door(8765, "::1").is_host("[::1]:8765")


def test_browser_is_invited_once() -> None:
    door = Door(8765)
    token = door.invite().partition("token=")[2]
    assert token != door.token
    assert not door.is_token(token)
    assert [door.opens(token), door.opens(token), door.opens(door.token), door.opens(door.token)] == [
        True,
        False,
        True,
        True,
    ]


def test_tokens_differ_and_are_long() -> None:
    tokens = {Door(1).token for _ in range(100)}
    assert len(tokens) == 100
    assert min(map(len, tokens)) >= 32


@pytest.mark.parametrize(
    "path", ["/static/../app.py", "/static/..%2fapp.py", "/static/%2e%2e/app.py", "/static//etc/passwd"]
)
def test_static_files_lead_nowhere_else(server: Server, path: str) -> None:
    with raw(server) as connection:
        head = f"GET /static/{path} HTTP/1.1\r\nHost: {server.base[7:]}\r\nAuthorization: Bearer {server.token}\r\n"
        connection.sendall(f"{head}Connection: close\r\n\r\n".encode())
        assert b" 404 " in said(connection).splitlines()[0]


def test_static_files_are_packed_and_sent_once(server: Server) -> None:
    with server.client() as client:
        first = client.get("/static/vendor/plotly-cartesian.min.js")
        assert first.headers["content-encoding"] == "gzip"
        assert first.headers["content-type"] == "text/javascript; charset=utf-8"
        again = client.get(first.url, headers={"If-None-Match": first.headers["etag"]})
        assert (again.status_code, again.content) == (304, b"")
        bare = client.get(first.url, headers={"Accept-Encoding": "identity"})
        assert bare.content == first.content
        assert "content-encoding" not in bare.headers


def test_page_asks_no_other_host(server: Server) -> None:
    """Not in what it loads; the policy that is sent with it forbids the rest."""
    foreign = re.compile(rb"""(?:src|href|url)\s*[=(]\s*["']?(?:https?:)?//(?!www\.w3\.org)""")
    with server.client() as client:
        for name in ("/", "/static/css/page.css", "/static/js/main.js"):
            assert not foreign.search(client.get(name).content), name


@pytest.mark.parametrize("chunked", [False, True], ids=["announced", "chunked"])
def test_body_that_is_too_large_is_refused_before_it_is_read(server: Server, chunked: bool) -> None:
    def forever() -> Iterator[bytes]:
        for _ in range(100):
            yield b"0" * 1_000_000

    with server.client(f"workspace-huge-{chunked}") as client:
        for path in ("/api/jobs/export-run-file", "/api/files/huge.csv", "/api/status"):
            method = "PUT" if "files" in path else "POST"
            content = forever() if chunked else b"0" * 20_000_001
            try:
                answer = client.request(method, path, content=content)
            except (httpx.WriteError, httpx.RemoteProtocolError, httpx.ReadError):
                continue  # the server hung up while we were sending
            assert answer.status_code in (405, 413)
        assert client.get("/api/files").json() == []
        assert client.put("/api/files/largest.csv", content=b"0" * 20_000_000).json()["size"] == 20_000_000


def test_slow_and_partial_requests_keep_nobody_waiting(server: Server) -> None:
    head = f"POST /api/jobs/recognise HTTP/1.1\r\nHost: {server.base[7:]}\r\nAuthorization: Bearer {server.token}\r\n"
    partial = [b"G", b"GET / HTTP/1.1\r\nHost: ", f"{head}Content-Length: 1000\r\n\r\n{{".encode(), b"\x16\x03\x01\x02"]
    open_ones = []
    try:
        for number in range(100):
            host, port = server.base[7:].split(":")
            connection = socket.create_connection((host, int(port)), timeout=10.0)
            connection.sendall(partial[number % len(partial)])
            open_ones.append(connection)
        begun = time.monotonic()
        with server.client() as client:
            assert client.get("/api/status").status_code == 200
        assert time.monotonic() - begun < 2.0
    finally:
        for connection in open_ones:
            connection.close()


@asynccontextmanager
async def served_at(application: object) -> AsyncIterator[tuple[tuple[str, int], set[Any]]]:
    """Serve an application with the page's protocol; give its address and the connections that it has."""
    import asyncio

    from uvicorn import Config
    from uvicorn.server import ServerState

    config = Config(application, http=connections.Connection, lifespan="off", ws="none", log_level="error")  # type: ignore[arg-type]
    config.load()
    loop = asyncio.get_running_loop()
    state = ServerState()
    made = await loop.create_server(lambda: config.http_protocol_class(config, state, {}), "127.0.0.1", 0)  # type: ignore[union-attr, call-arg]
    async with made:
        yield made.sockets[0].getsockname(), state.connections


def test_connections_whose_head_does_not_come_are_closed(monkeypatch: pytest.MonkeyPatch) -> None:
    import asyncio

    monkeypatch.setattr(connections, "HEAD_WAIT", 0.3)

    async def application(scope: object, receive: object, send: object) -> None:
        await asyncio.sleep(0.6)  # a reply that takes longer than a head may
        await send({"type": "http.response.start", "status": 204, "headers": []})  # type: ignore[operator]
        await send({"type": "http.response.body"})  # type: ignore[operator]

    async def ended(*parts: bytes) -> tuple[bytes, float]:
        """Send parts of a request, one each tenth of a second, and return the reply and when the connection ended."""
        loop = asyncio.get_running_loop()
        async with served_at(application) as (address, _):
            reading, writing = await asyncio.open_connection(*address)
            begun, found = loop.time(), b""
            for part in parts:
                writing.write(part)
                await asyncio.sleep(0.1)
            with contextlib.suppress(ConnectionError):
                found = await asyncio.wait_for(reading.read(100), 5.0)
            writing.close()
            return found, loop.time() - begun

    silent, dripped = run_apart(ended()), run_apart(ended(*[b"G", b"E", b"T", b" /", b" H", b"TTP"]))
    assert (silent[0], dripped[0]) == (b"", b"")
    assert 0.2 < silent[1] < 2.0
    assert dripped[1] < 2.0
    assert run_apart(ended(b"GET / HTTP/1.1\r\n", b"Host: a\r\n\r\n"))[0].startswith(b"HTTP/1.1 204")


@pytest.mark.apart
@pytest.mark.parametrize("pieces", [1, 200])
@pytest.mark.parametrize("taken", [0, 1, 400_000])
def test_reader_who_does_not_take_the_reply_is_disconnected(
    monkeypatch: pytest.MonkeyPatch, taken: int, pieces: int
) -> None:
    """Of a reader that takes so many bytes a few times a second; the third is slow, yet gets all."""
    import asyncio

    monkeypatch.setattr(connections, "REPLY_WAIT", 1.5)
    size = 8_000_000

    async def application(scope: object, receive: object, send: object) -> None:
        await send({"type": "http.response.start", "status": 200, "headers": []})  # type: ignore[operator]
        for _ in range(pieces):
            await send({"type": "http.response.body", "body": bytes(size // pieces), "more_body": True})  # type: ignore[operator]
        await send({"type": "http.response.body"})  # type: ignore[operator]

    async def reading() -> tuple[int, float]:
        """Return how much came, and how long the connection was kept, at most until all came."""
        loop = asyncio.get_running_loop()
        async with served_at(application) as (address, open_ones):
            with socket.socket() as connection:
                connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 500_000)
                connection.setblocking(False)
                await loop.sock_connect(connection, address)
                await loop.sock_sendall(connection, b"GET / HTTP/1.1\r\nHost: a\r\n\r\n")
                begun, came = loop.time(), 0
                await asyncio.sleep(0.1)
                while open_ones and came < size and loop.time() - begun < 20.0:
                    if taken:
                        came += len(await loop.sock_recv(connection, taken))
                    await asyncio.sleep(0.15)
                return came, loop.time() - begun

    came, kept = run_apart(reading())
    if taken > 1:
        assert came >= size
        assert kept > connections.REPLY_WAIT
    else:
        assert came < 1_000
        assert kept < 20.0


def test_job_that_ended_is_not_kept_by_its_reader() -> None:
    import asyncio
    from functools import partial

    from viscofric.web.app import JobStream

    async def work() -> list[dict[str, object]]:
        ended, gone = asyncio.Event(), asyncio.Event()
        sent: list[dict[str, object]] = []

        async def lines() -> AsyncIterator[bytes]:
            for number in range(3):
                yield b"%d\n" % number
            ended.set()

        async def send(message: dict[str, object]) -> None:
            if message["type"] == "http.response.body":
                await gone.wait()  # the reader takes nothing yet
            sent.append(message)

        async def receive() -> dict[str, object]:
            await asyncio.sleep(60.0)
            return {"type": "http.disconnect"}

        replying = asyncio.create_task(partial(JobStream(lines()), {}, receive)(send))  # type: ignore[arg-type]
        await asyncio.wait_for(ended.wait(), 10.0)
        gone.set()
        await replying
        return sent

    _, *bodies = run_apart(work())
    assert [one["body"] for one in bodies] == [b"0\n", b"1\n", b"2\n", b""]
    assert not bodies[-1].get("more_body")


def test_body_that_comes_byte_by_byte_is_given_up() -> None:
    import asyncio

    async def application(scope: object, receive: object, send: object) -> None:
        while (await receive())["more_body"]:  # type: ignore[operator]
            pass

    async def drip() -> dict[str, object]:
        await asyncio.sleep(0.01)
        return {"type": "http.request", "body": b"x", "more_body": True}

    reported: list[dict[str, object]] = []

    async def send(message: dict[str, object]) -> None:
        reported.append(message)

    scope = {"type": "http", "path": "/api/jobs/export-run-file", "headers": []}
    run_apart(Limits(application, lambda path: 10**6, pause=0.2)(scope, drip, send))  # type: ignore[arg-type]
    assert reported[0]["status"] == 408


def test_body_that_does_not_come_is_given_up() -> None:
    import asyncio

    async def application(scope: object, receive: object, send: object) -> None:
        await receive()  # type: ignore[operator]

    async def silence() -> dict[str, object]:
        await asyncio.sleep(30.0)
        return {}

    reported: list[dict[str, object]] = []

    async def send(message: dict[str, object]) -> None:
        reported.append(message)

    scope = {"type": "http", "path": "/api/jobs/export-run-file", "headers": []}
    run_apart(Limits(application, lambda path: 10, pause=0.05)(scope, silence, send))  # type: ignore[arg-type]
    assert reported[0]["status"] == 408
    assert "0.05 s" in json.loads(reported[1]["body"])["message"]  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"[]",
        b"null",
        b"{",
        b'{"study": 1}',
        b'{"study": {}, "more": 1}',
        b"[" * 100_000,
        b'{"study":' * 50_000,
        b'{"study": {"a": ' + b"9" * 10_000 + b"}}",
        b"\xff\xfe",
        b'{"\\ud800": 1}',
    ],
    ids=range(11),
)
def test_odd_bodies_are_refused_in_a_sentence(server: Server, body: bytes) -> None:
    with server.client("workspace-odd") as client:
        answer = client.post("/api/jobs/export-run-file", content=body, headers={"Content-Type": "application/json"})
        assert answer.status_code in (400, 422), answer.text
        assert answer.json()["message"]


@pytest.mark.parametrize(
    "study",
    [
        {"conditions": {"load": float("nan")}},
        {"material": None},
        {"\ud800": "\udfff"},
        {"material": {"dma": "../../secret.csv"}},
        {"material": {"dma": ["/etc/passwd"]}},
        {"material": {"file": "C:\\secret.json"}},
        {"material": {"dma": "**"}},
        {"measurement": {"mtm": ".."}},
        {"surface": {"file": "..\\secret.txt"}},
        {"material": [{"dma": "a.csv"}, {"dma": "x/../b.csv"}]},
        {"a": {"b": {"c": {"d": {"e": {"f": {"g": {"h": {"i": {"j": {"k": {"l": 1}}}}}}}}}}}},
    ],
    ids=range(11),
)
def test_odd_studies_end_in_a_sentence(server: Server, study: dict[str, object]) -> None:
    with server.client("workspace-odd") as client:
        content = json.dumps({"study": study})
        answer = client.post("/api/jobs/curve", content=content, headers={"Content-Type": "application/json"})
        last = json.loads(answer.text.splitlines()[-1])
        assert answer.status_code == 422 or last["event"] == "error"
        assert last["message"]
        assert answer.status_code == 422 or last["code"] != "internal-error"
