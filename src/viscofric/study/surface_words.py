"""What the results of a study on a rough surface say of the surface, and of what does not go with one."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from viscofric.friction.assumption_check import AssumptionCheck
from viscofric.notes import Note
from viscofric.study.cases.surfaces import MadeSurface, surface_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.study.cases.surface_case import SurfaceCase
    from viscofric.study.cases.sweep import Sweep
    from viscofric.study.run_file.settings import UncertaintyTable
    from viscofric.study.run_file.study import Study

# The compliance of a wave as long as a bonded or sliding layer is thick is that of a half-space within 1 %.
_THICKEST_WAVE = 1.0


_NO_BANDS = Note(
    "no-bands",
    "Friction on a rough surface has no linearised 95 % bands, which are found for indenters only; [uncertainty] "
    "members solves every case with rubbers drawn from the sweeps, and several seeds show how friction scatters from "
    "surface to surface.",
)


def uncertainty_of(study: Study) -> UncertaintyTable:
    """Return [uncertainty] as far as it goes with what slides: linearised bands are found for indenters only."""
    if study.indenter is not None:
        return study.uncertainty
    return study.uncertainty.model_copy(update={"draws": 0})


def surface_notes(study: Study) -> list[Note]:
    """Return what is not found on a rough surface, one sentence each."""
    if study.indenter is not None or study.uncertainty.draws == 0:
        return []
    return [_NO_BANDS]


def surface_setting(study: Study, sweep: Sweep) -> dict[str, Any]:
    """Return the attributes that results have of the surface: in words, and by its numbers."""
    first: Any = sweep.cases[0]
    topography = first.surface.topography()
    many = f", {len(study.body.axes['seed'])} seeds" if len(study.body.axes.get("seed", ())) > 1 else ""
    elastic = "" if study.body.modulus is None else f", of E = {study.body.modulus:.4g} Pa"
    nx, ny = topography.shape
    kind = "self-affine" if isinstance(first.surface, MadeSurface) else "measured"
    points = f"profile of {nx} points" if ny == 1 else f"{nx} × {ny} points"
    words = (
        f"{kind} rough surface ({points}, period {1e3 * topography.size[0]:.4g} mm, rms height "
        f"{1e6 * topography.rms_height:.4g} µm, rms slope {topography.rms_slope:.4g}{many}){elastic}"
    )
    return {
        "indenter": words,
        "surface_steps": json.dumps(list(topography.history), ensure_ascii=False),
        "surface_rms_height": topography.rms_height,
        "surface_rms_slope": topography.rms_slope,
    }


def surface_checks(study: Study, cases: Sequence[SurfaceCase]) -> list[AssumptionCheck]:
    """Check whether the rubber is a half-space to the longest wave; steep slopes are told by the contacts' warnings."""
    thickness = study.conditions.thickness
    if thickness is None or not cases:
        return []
    period = max(n * d for n, d in zip(*_grid(cases[0]), strict=True) if n > 1)
    longest = cases[0].surface.wavelengths[1] if isinstance(cases[0].surface, MadeSurface) else period
    value = longest / thickness
    holds = value <= _THICKEST_WAVE
    sentence = (
        f"The longest wave of the surface, {1e3 * longest:.3g} mm, is {value:.2g} times as long as the rubber is "
        "thick; "
        + ("the rubber is a half-space to it." if holds else "give the rubber's thickness as a [layer] instead.")
    )
    return [AssumptionCheck("half-space", value, _THICKEST_WAVE, holds, sentence)]


def _grid(case: SurfaceCase) -> tuple[tuple[int, int], tuple[float, float]]:
    surface = surface_of(case.surface)
    return surface.shape, surface.spacing
