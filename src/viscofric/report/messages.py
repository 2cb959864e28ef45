"""Sentences that other parts of viscofric wrote, made ready for readers: rounded conditions, grouped failures."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from viscofric.report.numbers import short, speed

if TYPE_CHECKING:
    from collections.abc import Sequence

_NUMBER = r"[-−]?\d+(?:\.\d+)?(?:e[+-]?\d+)?"
# A condition such as "89.9995 °C, 19.9996 mm/s"
_CONDITION = re.compile(rf"({_NUMBER}) °C, ({_NUMBER}) (mm/s|m/s)")
# … and what else varies, as in "90 °C, 20 mm/s, 5 N, radius 5 mm"
_FAILURE = re.compile(rf"({_CONDITION.pattern}.*?): (.*)", re.DOTALL)
_MINUS = re.compile(r"(?<![\w.\-/])-(?=\d)")
_SHOWN_CONDITIONS = 6


def readable(sentence: str) -> str:
    """Return a sentence with its conditions rounded to what matters, and with true minus signs."""
    return _MINUS.sub("−", _CONDITION.sub(lambda match: _condition(*match.group(1, 2, 3)), sentence))


def _condition(temperature: str, number: str, unit: str) -> str:
    celsius = round(float(temperature.replace("−", "-")), 1) + 0.0
    metres_per_second = float(number.replace("−", "-")) * (1e-3 if unit == "mm/s" else 1.0)
    return f"{short(celsius, 4)} °C, {speed(metres_per_second)}"


def grouped_failures(failures: Sequence[str], most: int) -> list[str]:
    """Return failures as at most so many lines: those of one reason together, with their conditions.

    Parameters
    ----------
    failures : sequence of str
        ``"30 °C, 20 mm/s: reason"``; reasons that differ in numbers only count as one.
    most : int
        Lines at most; the last one says how many failures are not shown, if there are more kinds.
    """
    kinds: dict[str, list[tuple[str, str]]] = {}
    for failure in failures:
        match = _FAILURE.match(failure)
        where, reason = (readable(match[1]), match[5]) if match else ("", failure)
        kinds.setdefault(re.sub(_NUMBER, "#", reason), []).append((where, reason))
    lines = [_line(cases) for cases in kinds.values()]
    if len(lines) <= most:
        return lines
    shown = list(kinds.values())[: most - 1]
    left = len(failures) - sum(map(len, shown))
    return [*lines[: most - 1], f"{left} more cases, for other reasons: see the report."]


def _line(cases: list[tuple[str, str]]) -> str:
    reason = readable(cases[0][1])
    conditions = [where for where, _ in cases if where]
    if len(cases) == 1:
        return f"{conditions[0]}: {reason}" if conditions else reason
    shown = "; ".join(conditions[:_SHOWN_CONDITIONS])
    more = f"; and {len(conditions) - _SHOWN_CONDITIONS} more" if len(conditions) > _SHOWN_CONDITIONS else ""
    return f"{len(cases)} cases ({shown}{more}): {reason}" if conditions else f"{len(cases)} times: {reason}"
