"""The addresses of the page: its files, the user's files, jobs and what they made."""

from __future__ import annotations

import asyncio
import gzip
import hashlib
import json
import mimetypes
from contextlib import aclosing
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from fastapi import Depends, FastAPI, Header, HTTPException, Query, Request, Response
from fastapi import Path as InAddress
from fastapi.exceptions import RequestValidationError
from fastapi.responses import FileResponse, JSONResponse
from pydantic import BaseModel, ConfigDict, Field, JsonValue
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException as StarletteHTTPException

from viscofric import __version__
from viscofric.errors import InputError
from viscofric.web.access import Access, Door
from viscofric.web.jobs import KINDS
from viscofric.web.limits import LARGEST_STUDY, Limits
from viscofric.web.workspace import KEY, LARGEST_UPLOAD, Workspace, Workspaces, checked_name

if TYPE_CHECKING:
    from collections.abc import AsyncIterator

    from starlette.types import ASGIApp, Receive, Scope, Send

    from viscofric.web.children import Children


_EXAMPLE = ("dma.csv", "mtm.csv")
_KIND = Annotated[str, InAddress(min_length=1, max_length=1_000, json_schema_extra={"enum": [*KINDS]})]
_ANY_NAME = Annotated[str, InAddress(min_length=1, max_length=1_000)]


class Refusal(BaseModel):
    """Why a request was refused, in one sentence."""

    message: str
    field: str | None = None


class Status(BaseModel):
    """How the server fares."""

    running: int = Field(description="Jobs at work or waiting.")
    version: str


class StoredFile(BaseModel):
    """A file of the user."""

    name: str
    size: int = Field(description="Bytes.")


class JobRequest(BaseModel):
    """What is to be computed."""

    model_config = ConfigDict(extra="forbid")

    study: dict[str, JsonValue] = Field({}, description="The tables of a run file.")
    options: dict[str, JsonValue] = Field({}, description="Of this kind of job.")


class PlainJSON(JSONResponse):
    """JSON in ASCII: what came in as half a character goes out as it came."""

    def render(self, content: Any) -> bytes:
        """Return the body."""
        return json.dumps(content, separators=(",", ":")).encode()


def make_app(door: Door, workspaces: Workspaces, children: Children, study: dict[str, Any] | None = None) -> ASGIApp:
    """Return the page as an ASGI application, which opens with this study, or with its own first one."""
    api = FastAPI(
        title="viscofric",
        version=__version__,
        docs_url=None,
        redoc_url=None,
        openapi_url="/api/openapi.json",
        default_response_class=PlainJSON,
        responses={422: {"model": Refusal}, 413: {"model": Refusal}, 400: {"model": Refusal}},
    )
    _refuse_in_one_sentence(api)
    _page(api, study)
    _files(api)
    _jobs(api, children)
    api.state.workspaces = workspaces

    def largest(path: str) -> int:
        return LARGEST_UPLOAD if path.startswith("/api/files/") else LARGEST_STUDY

    return Access(Limits(api, largest), door)


def _refuse_in_one_sentence(api: FastAPI) -> None:
    """Make every refusal one sentence."""

    @api.exception_handler(RequestValidationError)
    async def wrong(request: Request, error: RequestValidationError) -> Response:
        first = error.errors()[0]
        place = ".".join(str(part) for part in first["loc"][1:])
        return PlainJSON({"message": f"{place or 'body'}: {first['msg']}.", "field": place or None}, 422)

    @api.exception_handler(InputError)
    async def refused(request: Request, error: InputError) -> Response:
        return PlainJSON({"message": str(error), "field": None}, 422)

    @api.exception_handler(StarletteHTTPException)
    async def other(request: Request, error: StarletteHTTPException) -> Response:
        return PlainJSON({"message": str(error.detail), "field": None}, error.status_code, error.headers)


def _page(api: FastAPI, study: dict[str, Any] | None) -> None:
    @api.get("/", include_in_schema=False)
    def index(request: Request) -> Response:
        return _static(request, "index.html")

    @api.get("/static/{name:path}", include_in_schema=False)
    def static(request: Request, name: str) -> Response:
        return _static(request, name)

    @api.get("/api/start")
    def start() -> dict[str, JsonValue]:
        """Tell what a fresh page shows."""
        from viscofric.web.start import start

        return start(study)


def _static(request: Request, name: str) -> Response:
    file = static_file(name)
    if file is None:
        raise HTTPException(404, "There is no such file.")
    # kept by the browser, but requested each time: the reply is 304 unless another viscofric serves other files
    headers = {"etag": file.tag, "cache-control": "no-cache", "vary": "accept-encoding"}
    if file.tag in request.headers.get("if-none-match", ""):
        return Response(status_code=304, headers=headers)
    packed = file.packed and "gzip" in request.headers.get("accept-encoding", "")
    if packed:
        headers["content-encoding"] = "gzip"
    return Response(file.packed if packed else file.content, media_type=file.media_type, headers=headers)


def _of_header(request: Request, x_workspace: Annotated[str, Header(pattern=KEY)]) -> Workspace:
    workspaces: Workspaces = request.app.state.workspaces
    return workspaces.get(x_workspace)


def _of_query(request: Request, workspace: Annotated[str, Query(pattern=KEY)]) -> Workspace:
    workspaces: Workspaces = request.app.state.workspaces
    return workspaces.get(workspace)


_ByHeader = Annotated[Workspace, Depends(_of_header)]
_ByQuery = Annotated[Workspace, Depends(_of_query)]


def _listed(workspace: Workspace) -> list[StoredFile]:
    return [StoredFile(name=name, size=size) for name, size in workspace.listing()]


def _files(api: FastAPI) -> None:
    @api.get("/api/files")
    def list_files(workspace: _ByHeader) -> list[StoredFile]:
        """List the files of the workspace."""
        return _listed(workspace)

    @api.post("/api/files/example")
    def use_example(workspace: _ByHeader) -> list[StoredFile]:
        """Put the synthetic example's measurements there."""
        from importlib.resources import files

        for name in _EXAMPLE:
            workspace.store(name, (files("viscofric") / "example" / name).read_bytes())
        return _listed(workspace)

    body = {"content": {"application/octet-stream": {"schema": {"type": "string", "format": "binary"}}}}

    @api.put("/api/files/{name}", openapi_extra={"requestBody": body})
    async def store_file(name: _ANY_NAME, workspace: _ByHeader, request: Request) -> StoredFile:
        """Keep a file."""
        name = checked_name(name)
        content = await request.body()
        await run_in_threadpool(workspace.store, name, content)
        return StoredFile(name=name, size=len(content))

    @api.delete("/api/files/{name}", status_code=204, responses={404: {"model": Refusal}})
    def remove_file(name: _ANY_NAME, workspace: _ByHeader) -> None:
        """Remove a file."""
        if not workspace.remove(checked_name(name)):
            raise HTTPException(404, f"There is no file {name}.")

    @api.get(
        "/api/downloads/{name}",
        response_class=Response,
        responses={404: {"model": Refusal}, 200: {"content": {"application/octet-stream": {}}}},
    )
    def download(name: _ANY_NAME, workspace: _ByQuery) -> Response:
        """Fetch what a job made."""
        path = workspace.downloads / checked_name(name)
        if not path.is_file():
            raise HTTPException(404, f"There is no file {name}.")
        return FileResponse(path, filename=path.name, headers={"cache-control": "no-store"})


def _jobs(api: FastAPI, children: Children) -> None:
    @api.get("/api/status")
    async def status() -> Status:
        """Tell how the server fares."""
        return Status(running=children.running, version=__version__)

    @api.post(
        "/api/jobs/{kind}",
        response_class=Response,
        responses={404: {"model": Refusal}, 200: {"content": {NDJSON: {"schema": {"type": "string"}}}}},
    )
    async def run_job(kind: _KIND, job: JobRequest, workspace: _ByHeader) -> Response:
        """Have something computed; closing the connection cancels it."""
        if kind not in KINDS:
            raise HTTPException(404, f"There is no job {kind}; there are {', '.join(KINDS)}.")
        lines = children.run(kind, job.study, job.options, workspace.folder)
        return JobStream(workspace.while_at_work(lines))

    @api.post("/api/jobs/{number}/stop", status_code=204, responses={404: {"model": Refusal}})
    async def stop_job(number: Annotated[int, InAddress(ge=1, le=2**53)], workspace: _ByHeader) -> None:
        """Interrupt a job; it sends what it has found, or that it was cancelled."""
        if not children.interrupt(number, workspace.folder):
            raise HTTPException(404, f"There is no job {number} at work.")


ROOT = Path(__file__).parent / "static"
_PACKED = {".html", ".css", ".js", ".svg", ".json", ".txt"}
_TYPES = {".js": "text/javascript", ".css": "text/css", ".html": "text/html", ".svg": "image/svg+xml"}
_WORTH_PACKING = 1_000  # bytes


class StaticFile(NamedTuple):
    """A file of the page."""

    content: bytes
    packed: bytes  # by gzip; empty where it is not worth it
    media_type: str
    tag: str  # hash of the content


_known: dict[tuple[Path, int, int], StaticFile] = {}


def static_file(name: str) -> StaticFile | None:
    """Return a file of the folder ``static`` if a listing of the folder gives its name; else None."""
    path = {file.relative_to(ROOT).as_posix(): file for file in ROOT.rglob("*") if file.is_file()}.get(name)
    if path is None:
        return None
    status = path.stat()
    key = (path, status.st_mtime_ns, status.st_size)
    if key not in _known:
        content = path.read_bytes()
        packs = path.suffix in _PACKED and len(content) >= _WORTH_PACKING
        media_type = _TYPES.get(path.suffix) or mimetypes.guess_type(path.name)[0] or "application/octet-stream"
        if media_type.startswith("text/"):
            media_type += "; charset=utf-8"
        tag = f'"{hashlib.sha256(content).hexdigest()[:24]}"'
        _known[key] = StaticFile(content, gzip.compress(content, 6) if packs else b"", media_type, tag)
    return _known[key]


NDJSON = "application/x-ndjson"


class JobStream(Response):
    """The messages of a job, a line each, while the browser listens."""

    media_type = NDJSON

    def __init__(self, lines: AsyncIterator[bytes]) -> None:
        super().__init__()
        del self.headers["content-length"]
        self.headers["cache-control"] = "no-store"
        self._lines = lines

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Send the lines; stop the job as soon as the other end is gone."""
        await send({"type": "http.response.start", "status": 200, "headers": self.raw_headers})
        # a reader that is slower than the job must not keep the job's process from the next one
        lines: asyncio.Queue[bytes] = asyncio.Queue()
        job = asyncio.create_task(self._collect(lines))
        tasks = [asyncio.create_task(_send_all(lines, job, send)), asyncio.create_task(_gone(receive))]
        try:
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for task in (*tasks, job):
                task.cancel()
            await asyncio.gather(*tasks, job, return_exceptions=True)
        if not tasks[0].cancelled() and (error := tasks[0].exception()) is not None and not isinstance(error, OSError):
            raise error

    async def _collect(self, lines: asyncio.Queue[bytes]) -> None:
        try:
            async with aclosing(self._lines) as found:  # type: ignore[type-var]
                async for line in found:
                    lines.put_nowait(line)
        finally:
            lines.put_nowait(b"")


async def _send_all(lines: asyncio.Queue[bytes], job: asyncio.Task[None], send: Send) -> None:
    while line := await lines.get():
        await send({"type": "http.response.body", "body": line, "more_body": True})
    await job  # raises its error
    await send({"type": "http.response.body", "body": b""})


async def _gone(receive: Receive) -> None:
    while (await receive())["type"] != "http.disconnect":
        pass
