"""A job of the page that is served answers with its result."""

from __future__ import annotations

from typing import TYPE_CHECKING

from web.served_page import STUDY, messages_of

if TYPE_CHECKING:
    import httpx


def test_run_file_counts_the_cases(client: httpx.Client) -> None:
    speeds = {"from": "1 mm/s", "to": "1 m/s", "points": 7, "spacing": "log"}
    study = {**STUDY, "conditions": {"load": "25 N", "speed": speeds, "temperature": ["30 degC", "60 degC"]}}
    assert messages_of(client, "export-run-file", study)[-1]["result"]["cases"] == 14
