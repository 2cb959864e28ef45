"""A measured indentation test: load and depth over time at one temperature."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from viscofric.arguments import text
from viscofric.arrays import Array
from viscofric.data import read_only
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError, check_choice
from viscofric.motion.history import CONTROLS
from viscofric.notes import Note
from viscofric.showing import Plotted, Rows
from viscofric.units import Quantities, Quantity, positive, to_si, to_si_array

#: What was prescribed in a test; the other one is the response.
Control: TypeAlias = Literal["load", "indentation"]
#: Prescribed quantity -> the response.
RESPONSE = {"load": "indentation", "indentation": "load"}
#: Fewest rows of a record.
LEAST_ROWS = 5


@dataclass(frozen=True, eq=False)
class IndentationRecord(Plotted):
    """Load and depth of an indenter over time at one temperature, on material that was never in contact before.

    Parameters
    ----------
    time : (n,) array of float, str or pint.Quantity
        s, never decreasing, at least five rows; a time given twice is a jump.
    load : (n,) array of float, str or pint.Quantity
        Normal load, N.  A first load above zero is applied as a step at `start`.
    indentation : (n,) array of float, str or pint.Quantity
        Depth of the indenter's lowest point below the undeformed surface, m.
    temperature : float, str or pint.Quantity
        K if a plain number.
    control : {"load", "indentation"}
        What was prescribed, and is taken as exact; linear between the rows.  The other one is the response: its values
        at equal times to those prescribed are fitted.
    error : float, str, pint.Quantity or (n,) array of them, optional
        Standard error of the response in every row, m or N, independent from row to row; if omitted, it is a
        constant fraction of the response, found from the residuals.
    start : float, str or pint.Quantity, optional
        Time of the first contact, s, not after the first row; that of the first row if left out.
    source : str
        Origin, such as a file's name.

    Raises
    ------
    InputError
        If time goes back, columns differ in length, or a value is no number of the right unit.

    Examples
    --------
    Creep of a ball under a load step of 1 N at time 0:

    >>> import numpy as np
    >>> import viscofric as vf
    >>> time = np.geomspace(0.01, 100.0, 40)
    >>> depth = 1e-4 * (1.0 + 0.2 * np.log10(time / 0.01))
    >>> creep = vf.friction.IndentationRecord(time, np.ones(40), depth, "23 degC", control="load", start=0.0)
    >>> len(creep)
    40
    """

    time: Array
    load: Array
    indentation: Array
    temperature: float
    control: Control
    error: Array | None
    start: float
    source: str

    def __init__(
        self,
        time: Quantities,
        load: Quantities,
        indentation: Quantities,
        temperature: Quantity,
        *,
        control: Control,
        error: Quantities | None = None,
        start: Quantity | None = None,
        source: str = "",
    ) -> None:
        check_choice(control, "control", *RESPONSE)
        seconds = to_si_array(time, "s", "time")
        columns = {"load": to_si_array(load, "N", "load"), "indentation": to_si_array(indentation, "m", "indentation")}
        if len(seconds) < LEAST_ROWS:
            raise InputError(
                f"time: a record has {LEAST_ROWS} rows at least, not {len(seconds)}.", code="too-few-points"
            )
        spread = None
        if error is not None:
            spread = to_si_array(error, CONTROLS[RESPONSE[control]], "error")
            spread = np.full(len(seconds), spread[0]) if len(spread) == 1 else spread
            columns["error"] = spread
        for name, column in columns.items():
            if len(column) != len(seconds):
                raise InputError(
                    f"{name}: has {len(column)} values, but there are {len(seconds)} times.", code="wrong-length"
                )
        steps = np.diff(seconds)
        if np.any(steps < 0.0) or seconds[-1] == seconds[0]:
            place = int(np.argmin(steps)) + 1
            said = f"time: goes back to {seconds[place]:g} s, or stands still; sort the record by time."
            raise InputError(Note("time-goes-back", said, values={"index": place}))
        begin = float(seconds[0]) if start is None else to_si(start, "s", "start")
        if begin > seconds[0]:
            raise InputError(
                f"start = {begin:g} s: lies after the first row, at {seconds[0]:g} s.", code="out-of-range"
            )
        if spread is not None and not np.all(spread > 0.0):
            raise InputError("error: must be above zero in every row.", code="not-positive")
        object.__setattr__(self, "time", read_only(seconds, "time"))
        for name in ("load", "indentation"):
            object.__setattr__(self, name, read_only(columns[name], name))
        object.__setattr__(self, "temperature", positive(temperature, "K", "temperature"))
        object.__setattr__(self, "control", control)
        object.__setattr__(self, "error", None if spread is None else read_only(spread, "error"))
        object.__setattr__(self, "start", begin)
        object.__setattr__(self, "source", text(source, "source"))

    def __len__(self) -> int:
        return len(self.time)

    def _shown(self) -> Rows:
        return (
            ("time", self.time, "s"),
            ("load", self.load, "N"),
            ("indentation", self.indentation, "m"),
            ("prescribed", self.control),
            ("temperature", self.temperature, "°C"),
            ("source", self.source or None),
        )

    def to_dataset(self) -> Dataset:
        """Return the record as a labelled data set along ``row``.

        ``time`` (s), ``load`` (N), ``indentation`` (m) and, where it is known, ``error`` of the response; the
        attributes are ``control``, ``temperature`` (K), ``start`` (s) and ``source``.
        """
        unit = CONTROLS[RESPONSE[self.control]]
        return dataset(
            "row",
            {
                "time": (self.time, "s", "time"),
                "load": (self.load, "N", "normal load"),
                "indentation": (self.indentation, "m", "indentation"),
                "error": None if self.error is None else (self.error, unit, "standard error of the response"),
            },
            attributes={
                "control": self.control,
                "temperature": self.temperature,
                "start": self.start,
                "source": self.source,
            },
        )
