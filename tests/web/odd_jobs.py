"""A job that behaves as no job should, done by the processes of the page in tests."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict

from viscofric.errors import InputError
from viscofric.processes import Workers, call_all
from viscofric.web.jobs.context import Context


class Options(BaseModel):
    """What it is to do, and for how long or with how much."""

    model_config = ConfigDict(extra="forbid")

    do: Literal[
        "rest",
        "keep",
        "insist",
        "hold",
        "grow",
        "die",
        "fail",
        "leak",
        "refuse",
        "solve",
        "share",
        "report",
        "print",
        "write",
        "load",
    ]
    amount: float = 0.0


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    context.part({"process": os.getpid()})
    return ODD[options.do](options.amount, context)


def rest(amount: float, context: Context) -> dict[str, Any]:
    end = time.monotonic() + amount
    while time.monotonic() < end:
        time.sleep(0.01)
    return {"process": os.getpid()}


def keep(amount: float, context: Context) -> dict[str, Any]:
    """Send what was found when it is interrupted."""
    try:
        rest(amount, context)
    except KeyboardInterrupt:
        return {"kept": True}
    return {"kept": False}


def load(amount: float, context: Context) -> dict[str, Any]:
    """Import a module that takes its time."""
    import web.slow_module  # noqa: F401

    return {}


def insist(amount: float, context: Context) -> dict[str, Any]:
    """Do not let itself be interrupted."""
    end = time.monotonic() + amount
    while time.monotonic() < end:
        try:
            time.sleep(end - time.monotonic())
        except KeyboardInterrupt:
            continue
    return {}


def hold(amount: float, context: Context) -> dict[str, Any]:
    """Let no other thread of the process do anything."""
    time.sleep(0.05)  # its first words are sent
    return {"sum": sum(range(int(amount)))}


def grow(amount: float, context: Context) -> dict[str, Any]:
    return {"bytes": len(bytearray(int(amount)))}


def die(amount: float, context: Context) -> dict[str, Any]:
    os.kill(os.getpid(), signal.SIGKILL)
    return {}


def fail(amount: float, context: Context) -> dict[str, Any]:
    raise KeyError("odd\ud800")


def leak(amount: float, context: Context) -> dict[str, Any]:
    """Fail with a place on this machine in the words."""
    raise OSError(f"{context.cache / 'kept'} and {context.files / 'sweeps.csv'} are odd")


def refuse(amount: float, context: Context) -> dict[str, Any]:
    raise InputError(f"{context.files / 'sweeps.csv'}, line 3: conditions.load: is odd.", field="conditions.load")


def solve(amount: float, context: Context) -> dict[str, Any]:
    """Solve contacts that are large, one after the other."""
    import viscofric as vf

    rubber = vf.Material.standard_linear_solid(E0=1e6, E_inf=1e9, tau=1e-3, poisson_ratio=0.5)
    for number in range(int(amount)):
        vf.solve_steady(rubber, vf.Ball(radius="9.525 mm"), speed=1.0 + number, load="5 N", grid=1024)
        context.progress(number + 1, int(amount))
    return {}


def share(amount: float, context: Context) -> dict[str, Any]:
    """Have processes of its own at work."""
    with Workers(2) as workers:
        call_all(time.sleep, [{}] * 0, workers=workers)
        call_all(pause, [{"seconds": amount}] * 2, workers=workers)
    return {}


def pause(seconds: float) -> None:
    time.sleep(seconds)


def report(amount: float, context: Context) -> dict[str, Any]:
    """Say a lot."""
    for number in range(1_000):
        context.progress(number, 1_000, f"{number}")
    named = f"{context.files / 'sweeps.csv'}, line 3"
    return {"text": "x" * int(amount), "not a number": float("nan"), "numbers": (1, 2.5), "note": named}


def print_(amount: float, context: Context) -> dict[str, Any]:
    """Use what is the server's."""
    print("between the answers")
    os.write(1, b"between the answers\n")
    try:
        return {"read": input()}
    except EOFError:
        return {"read": None}


def write(amount: float, context: Context) -> dict[str, Any]:
    with (context.downloads / "result.txt").open("wb") as file:
        for _ in range(int(amount)):
            file.write(b"0" * 1_000_000)
    return {"written": True}


ODD: dict[str, Callable[[float, Context], dict[str, Any]]] = {
    "load": load,
    "rest": rest,
    "keep": keep,
    "insist": insist,
    "hold": hold,
    "grow": grow,
    "die": die,
    "fail": fail,
    "leak": leak,
    "refuse": refuse,
    "solve": solve,
    "share": share,
    "report": report,
    "print": print_,
    "write": write,
}
