"""Published results on the page: computed when somebody looks, as ``viscofric verify --published`` has them."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING

import pytest

from viscofric.verification.published import PUBLISHED
from viscofric.web.jobs import published
from web.contact_studies import Desk

if TYPE_CHECKING:
    from pathlib import Path

    from web.browser_tab import Tab


@pytest.mark.apart
def test_each_published_number_stands_beside_the_computed_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    desk = Desk(tmp_path)
    kept = [replace(check, compare=cache(lambda compare=check.compare: list(compare()))) for check in PUBLISHED]
    monkeypatch.setattr(published, "PUBLISHED", kept)
    found = desk.run(published, {})
    expected = {check.title: list(check.compare()) for check in kept}
    assert [one["title"] for one in found["checks"]] == list(expected)
    for one in found["checks"]:
        rows, numbers = one["table"]["rows"], expected[one["title"]]
        assert [row[:2] for row in rows] == [[number.case, number.quantity] for number in numbers]
        computed = [float(row[2]) for row in rows]  # of six digits
        assert computed == pytest.approx([number.computed for number in numbers], rel=1e-5)
        bare = [float(row[3].lstrip("≥≤ ")) for row in rows]
        assert bare == pytest.approx([number.expected for number in numbers], rel=1e-4)
        assert one["verdict"] == "agrees"
        assert any(check.source in " ".join(one["origin"]) for check in PUBLISHED)
    count = sum(map(len, expected.values()))
    assert found["said"].startswith(f"{count} of {count} ")
    assert next(message["done"] for event, message in desk.reported if event == "progress") == 0


@pytest.mark.slow  # a browser
@pytest.mark.apart
def test_published_results_are_computed_when_they_are_looked_at(tab: Tab) -> None:
    asked: list[str] = []
    tab.page.on("request", lambda request: asked.append(request.url.partition("/api/jobs/")[2]))
    tab.step("contact")
    tab.until("page.jobs.result('curve') !== null", 60.0)
    assert "published" not in asked
    assert tab.value("page.jobs.result('published')") is None
    place = tab.page.locator("#published")
    place.get_by_text("How we know").press("Enter")  # a summary is for keyboards, too
    tab.until("page.jobs.result('published') !== null", 60.0)
    assert asked.count("published") == 1
    assert place.locator("table").count() == len(PUBLISHED)
    place.get_by_text(PUBLISHED[0].title).first.click()
    assert PUBLISHED[0].source in place.inner_text()
    assert tab.findings() == []
    tab.screenshot("published")
