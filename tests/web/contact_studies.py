"""Studies of contacts that tests of the page share, and how a job is run in this process."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType
from typing import Any

from viscofric.web.jobs.context import Context
from web.figure_columns import drawn

CONDITIONS = {
    "load": "25 N",
    "speed": {"from": "20 mm/s", "to": "200 mm/s", "points": 6},
    "temperature": ["30 degC", "60 degC"],
}
BALL: dict[str, Any] = {
    "title": "A ball on a synthetic rubber",
    "material": {"catalogue": "synthetic fluoroelastomer"},
    "indenter": {"shape": "ball", "radius": "9.525 mm"},
    "conditions": CONDITIONS,
    "solver": {"accuracy": 1e-2},
}
CYLINDER = {
    **BALL,
    "indenter": {"shape": "cylinder", "radius": "9.525 mm"},
    "conditions": {**CONDITIONS, "load": "2 N/mm"},
}
ROUGH = {
    **{name: table for name, table in BALL.items() if name != "indenter"},
    "surface": {
        "hurst": 0.8,
        "rms_slope": 0.2,
        "shortest": "80 um",
        "rolloff": "640 um",
        "points": 128,
        "spacing": "10 um",
        "seed": 1,
    },
    "conditions": {**{name: value for name, value in CONDITIONS.items() if name != "load"}, "pressure": "0.5 MPa"},
}


class Desk:
    """Runs jobs in this process, and keeps what they tell.

    Parameters
    ----------
    folder : Path
        Of the workspace.
    """

    def __init__(self, folder: Path) -> None:
        self.reported: list[tuple[str, dict[str, Any]]] = []
        self.context = Context(*(folder / name for name in ("files", "downloads", "cache")), self._keep)
        for place in (self.context.files, self.context.downloads, self.context.cache):
            place.mkdir()

    def _keep(self, event: str, message: dict[str, Any]) -> None:
        self.reported.append((event, message))

    def run(self, job: ModuleType, study: dict[str, Any], **options: Any) -> dict[str, Any]:
        """Run a job from nothing, and return its result."""
        self.reported.clear()
        found: dict[str, Any] = job.run(study, job.Options(**options), self.context)
        return drawn(found)

    @property
    def parts(self) -> list[dict[str, Any]]:
        """Parts of the result of the last job, in their order."""
        return [message["part"] for event, message in self.reported if event == "part"]
