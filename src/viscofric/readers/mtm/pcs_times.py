"""When the steps of an export began: dates and clock times as a Windows of any country prints them."""

from __future__ import annotations

import re
from datetime import datetime
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

_PRINTED = re.compile(
    r"(\d{1,4})[/.-](\d{1,2})[/.-](\d{1,4})[ T]+(\d{1,2}):(\d{2})(?::(\d{2}))?(?:[.,]\d+)?\s*([AP]M)?", re.IGNORECASE
)
_FIRST_YEAR, _LAST_YEAR = 1970, 2200


def start_times(printed: Sequence[str]) -> list[datetime | None]:
    """Return when steps began, None where it cannot be told.

    The day comes before the month, as in all samples, unless some date then is none and all are with the month
    first.

    Parameters
    ----------
    printed : sequence of str
        Date and clock time of each step: ``"23/03/2018 10:12:01"``.
    """
    day_first = [_moment(text, 0, 1) for text in printed]
    month_first = [_moment(text, 1, 0) for text in printed]
    return month_first if month_first.count(None) < day_first.count(None) else day_first


def _moment(text: str, day: int, month: int) -> datetime | None:
    found = _PRINTED.fullmatch(text.strip())
    if not found:
        return None
    date = [int(found[place]) for place in (1, 2, 3)]
    if len(found[1]) == 4:  # 2018-03-23
        year, parts = date[0], [date[2], date[1]]
    else:
        year, parts = date[2] + (2000 if date[2] < 100 else 0), date[:2]
    hour = int(found[4])
    if found[7]:
        if not 1 <= hour <= 12:
            return None
        hour = hour % 12 + (12 if found[7].upper() == "PM" else 0)
    if not _FIRST_YEAR <= year <= _LAST_YEAR:
        return None
    try:
        return datetime(year, parts[month], parts[day], hour, int(found[5]), int(found[6] or 0))
    except ValueError:
        return None
