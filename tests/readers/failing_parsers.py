"""Parsers of workbooks that fail."""

from __future__ import annotations

import os
import time


def endless(path: str, data: bytes) -> None:
    time.sleep(60.0)


def dying(path: str, data: bytes) -> None:
    os.abort()
