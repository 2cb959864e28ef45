"""Contacts that are solved in a moment, and a plan of them in two waves."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

import viscofric as vf
from viscofric.errors import ConvergenceError
from viscofric.friction.cases.case import Settings
from viscofric.friction.cases.indenter_case import IndenterCase
from viscofric.friction.cases.record import Failure, Record
from viscofric.friction.cases.solving import Task, solve_indenter

RUBBER = vf.Material.standard_linear_solid(E0=1e6, E_inf=1e7, tau=1e-3, poisson_ratio=0.5)


def task(speed: float, fields: bool = False) -> Task:
    case = IndenterCase(0, vf.Ball(radius=1e-2), 300.0, speed, 1.0)
    settings = Settings(0.05, sensitive=False, fields=frozenset())
    return case.task(RUBBER.modes_at(None), RUBBER.poisson_ratio, settings, fields=fields, label=f"{speed:.4g} m/s")


class TwoWaves:
    """First contacts at some speeds, then two at speeds that the answers tell."""

    def __init__(self, verb: Callable[..., Record] | None = None) -> None:
        self.first = [task(float(speed)) for speed in np.geomspace(0.1, 5.0, 6)]
        self.verb = verb  # that solves the contacts instead
        self.second: list[Task] = []
        self.known: dict[str, Record | Failure] = {}
        self.total = 8

    @property
    def done(self) -> int:
        return len(self.known)

    def wanted(self) -> Sequence[Task]:
        return self._wanted() if self.verb is None else [replace(one, verb=self.verb) for one in self._wanted()]

    def _wanted(self) -> Sequence[Task]:
        waiting = [one for one in self.first if one.key not in self.known]
        if waiting:
            return waiting
        if not self.second:
            # Depends on the order in which answers came, which is to be that in which they were wanted.
            found = [one.friction_coefficient for one in self.known.values() if isinstance(one, Record)]
            self.second = [task(1.0 + found[0] / found[-1]), task(2.0 + found[1])]
        return [one for one in self.second if one.key not in self.known]

    def receive(self, key: str, outcome: Record | Failure) -> None:
        assert key not in self.known
        self.known[key] = outcome

    def bits(self) -> list[tuple[str, str]]:
        """Return all that is known, to the last digit, in the order in which it became known."""
        return [
            (key, json.dumps(one.values()) if isinstance(one, Record) else str(one)) for key, one in self.known.items()
        ]


def solve_or_end(**contact: Any) -> Record:
    """Solve a contact, unless it is the one that ends its process."""
    if contact["speed"] < 0.11:
        os._exit(1)
    return solve_indenter(**contact)


def solve_some(**contact: Any) -> Record:
    """Solve a contact, unless it is one of those that fail."""
    if contact["speed"] < 0.11:
        raise ConvergenceError("it does not converge.")
    if contact["speed"] > 4.9:
        raise MemoryError("nobody thought of that")
    return solve_indenter(**contact)
