"""Whatever is asked of the addresses that the page's description lists, no answer is an error of the server."""

from __future__ import annotations

from collections import Counter
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, given, seed, settings
from hypothesis.errors import Unsatisfiable

if TYPE_CHECKING:
    from web.served_page import Server

CASES = 45  # for each address, right and wrong ones


def ask_at_random(server: Server, cases: int) -> Counter[int]:
    """Ask each address with what its description allows and with what it forbids; return how often by status."""
    import schemathesis  # most of a second, which those who do not run this test need not wait for
    from schemathesis import GenerationMode

    headers = {"Authorization": f"Bearer {server.token}"}
    schema = schemathesis.openapi.from_url(f"{server.base}/api/openapi.json", headers=headers)
    asked: Counter[int] = Counter()
    for found in schema.get_all_operations():
        operation = found.ok()
        for mode in (GenerationMode.POSITIVE, GenerationMode.NEGATIVE):

            @seed(2026)
            @settings(max_examples=cases, deadline=None, database=None, suppress_health_check=list(HealthCheck))
            @given(case=operation.as_strategy(generation_mode=mode))
            def ask(case: Any) -> None:
                answer = case.call(base_url=server.base, headers=headers, timeout=30.0)
                asked[answer.status_code] += 1
                assert answer.status_code < 500, case.as_curl_command()
                if answer.status_code >= 400:
                    assert answer.json()["message"]

            with suppress(Unsatisfiable):  # nothing can be wrong with an address without parameters
                ask()
    return asked


@pytest.mark.apart
def test_five_hundred_random_requests_are_answered(server: Server) -> None:
    asked = ask_at_random(server, CASES)
    assert asked.total() >= 500
    assert asked[200] >= 50
    assert asked[422] >= 50
