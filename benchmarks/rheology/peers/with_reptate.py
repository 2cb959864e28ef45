"""RepTate: its automatic shift, E' and E'' jointly, each isotherm onto the curve made so far.

RepTate is a program with windows.  Its automatic shift is a method of one of them that asks little of the window, so it
is run here on a plain object that holds the data; the numbers are RepTate's own.
"""

from __future__ import annotations

import sys
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy
from exchange import Sweep, main, sweeps, timed

scipy.interp = np.interp  # RepTate imports this name, which newer SciPy no longer lends from NumPy

from RepTate.theories.TheoryTTS_Automatic import TheoryTTSShiftAutomatic  # noqa: E402

sys.excepthook = sys.__excepthook__  # RepTate would show errors in a window …
np.seterrcall(lambda *_: None)  # … and write there about divisions by zero, after which it goes on

if TYPE_CHECKING:
    from pathlib import Path


class Sheet:
    """What the method needs of RepTate's window."""

    get_cases = TheoryTTSShiftAutomatic.get_cases
    func_fitTTS_one = TheoryTTSShiftAutomatic.func_fitTTS_one  # noqa: N815 (its name there)
    do_fit = TheoryTTSShiftAutomatic.do_fit

    def __init__(self, given: list[Sweep], reference: float) -> None:
        files = [
            SimpleNamespace(
                file_parameters={"Mw": 0.0, "T": sweep.temperature},
                file_name_short=str(number),
                data_table=SimpleNamespace(data=np.stack(sweep[1:], axis=1)),
                isshifted=[False],
            )
            for number, sweep in enumerate(given)
        ]
        self.parent_dataset = SimpleNamespace(files=files)
        self.parameters = {"T": SimpleNamespace(value=reference), "vert": SimpleNamespace(value=False)}
        self.shiftParameters: dict[str, tuple[float, float]] = {}

    def Qprint(self, *_: Any) -> None:
        """Print nothing."""

    def do_calculate(self, *_: Any, **__: Any) -> None:
        """Draw nothing."""


def shift_factors(path: Path) -> dict[str, Any]:
    given = sweeps(path)
    temperatures = np.array([sweep.temperature for sweep in given])
    reference = float(temperatures[np.argmin(np.abs(temperatures - 20.0))])

    def work() -> Sheet:
        sheet = Sheet(given, reference)
        sheet.do_fit("")
        return sheet

    sheet, seconds = timed(work)
    return {"log10": [sheet.shiftParameters[str(place)][0] for place in range(len(given))], "seconds": seconds}


if __name__ == "__main__":
    main({"shift": shift_factors})
