"""What tests of the command line share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest


@pytest.fixture(scope="module", autouse=True)
def unrendered() -> Iterator[None]:
    """Let figures be drawn, but not turned into images, most of the time of a quick study.

    Tests of the report look at the images, and the commands of README.md write them.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("viscofric.report.figures.saving._encoded", lambda figure, form: form.encode())
        yield
