"""What the page can have computed: one module each, imported only by the processes that compute."""

from __future__ import annotations

from dataclasses import dataclass

_GB = 2**30


@dataclass(frozen=True)
class Kind:
    """A kind of job."""

    #: Where ``run(study, options, context) -> dict`` is, which raises `ViscofricError` in the user's words, and
    #: ``Options``, a pydantic model of its options
    module: str
    seconds: float = 600.0  # it is stopped when it takes longer than this
    #: Address space that the process may have while at it, bytes; half a gigabyte of it is the program itself
    memory: int = 4 * _GB


#: By the name in the address, ``/api/jobs/<name>``.
KINDS: dict[str, Kind] = {
    # sweeps and what is made of them
    "recognise": Kind("viscofric.web.jobs.recognise", seconds=60.0, memory=2 * _GB),
    "sweeps": Kind("viscofric.web.jobs.sweeps", seconds=60.0, memory=2 * _GB),
    "amplitude": Kind("viscofric.web.jobs.amplitude", seconds=120.0, memory=3 * _GB),
    "rubber": Kind("viscofric.web.jobs.rubber", seconds=300.0, memory=3 * _GB),
    "moduli": Kind("viscofric.web.jobs.moduli", seconds=300.0, memory=3 * _GB),
    "isotherm_misfit": Kind("viscofric.web.jobs.isotherm_misfit", seconds=60.0, memory=3 * _GB),
    # contacts and curves
    "contact": Kind("viscofric.web.jobs.contact", seconds=600.0, memory=6 * _GB),
    "curve": Kind("viscofric.web.jobs.curve", seconds=3600.0, memory=6 * _GB),
    "motion": Kind("viscofric.web.jobs.motion", seconds=3600.0, memory=6 * _GB),
    "history": Kind("viscofric.web.jobs.history", seconds=60.0, memory=2 * _GB),
    # measured friction
    "measured": Kind("viscofric.web.jobs.measured", seconds=120.0),
    "agreement": Kind("viscofric.web.jobs.agreement"),
    "master": Kind("viscofric.web.jobs.master", seconds=120.0),
    "identify": Kind("viscofric.web.jobs.identify"),
    # how it is known
    "published": Kind("viscofric.web.jobs.published", seconds=300.0),
    # what is taken away
    "open-run-file": Kind("viscofric.web.jobs.open_run_file", seconds=30.0, memory=2 * _GB),
    "export-run-file": Kind("viscofric.web.jobs.export_run_file", seconds=60.0, memory=2 * _GB),
    "export-study": Kind("viscofric.web.jobs.export_study", seconds=24 * 3600.0, memory=8 * _GB),
    "export-card": Kind("viscofric.web.jobs.export_card", seconds=120.0, memory=2 * _GB),
}

#: What a process imports before its first job, the most urgent first.
WARM = ("viscofric.contact.steady", "viscofric.study.run_file", "viscofric.web.jobs.warm")
#: What it imports when it has nothing else to do: the first figure and the curve need none of it.
LATER = ("xarray", "viscofric.web.jobs.sweeps", "viscofric.web.jobs.rubber")
