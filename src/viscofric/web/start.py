"""What a fresh page shows: a study of the synthetic rubber, the catalogue, and the limits of requests."""

from __future__ import annotations

import copy
from typing import Any

_SHIFT = "Factor by which temperature multiplies all relaxation times, relative to the reference temperature."
_FREQUENCY = "Frequency at which the contact deforms the rubber, by its speed v and half its length a."
_IMBALANCE = "Work of the forces minus stored and dissipated energy, relative; zero for an exact solution."
_MISFIT = "Root mean square of log₁₀ of fitted over measured values; 0.01 decades are 2.3 %."

#: Label on the page -> definition.
GLOSSARY: dict[str, str] = {
    # data
    "measured in": "Deformation of the specimen: tension, compression or bending for E′ and E″, shear for G′ and G″.",
    "isotherms": "Sweeps at one temperature each.",
    "frequencies": "Temperature ramps at one frequency each.",
    "tests": "Step tests at one temperature each.",
    "points": "Readings that are used; repeated ones are averaged.",
    "flagged": "Readings that were left out, or that are far off their neighbours; the table below names each.",
    "material": "Name of the material, from its file, the catalogue, or as given.",
    "reference": "Temperature at which the shift factor is 1.",
    # shift
    "overlap": "Root mean square misfit of the shifted isotherms where they overlap, in decades.",
    "figure of merit": "Distance of neighbouring isotherms in tan δ against |E*|, over expected scatter; good to 1.",
    "E′ against E″": "Whether E′ and E″ are those of one causal material, by the Kramers–Kronig relations.",
    "α(T) used": f"Shift factors of the material model: as measured, or a law fitted to them. {_SHIFT}",
    # spectrum
    "E₀, relaxed": "Relaxed modulus: Young's modulus at zero frequency.",
    "E∞, glassy": "Glassy modulus: Young's modulus at infinite frequency.",
    "modes": "Terms of the retardation spectrum: compliances, each with its retardation time.",
    "misfit of E′, E″": _MISFIT,
    "misfit of the step tests": _MISFIT,
    "Poisson’s ratio": "Ratio of lateral contraction to extension, constant in the model.",
    # contact
    "Viscoelastic friction coefficient": "Friction force over load, here from hysteresis (rolling resistance) alone.",
    "Indentation": "Approach of the indenter to the undeformed surface far away.",
    "Contact area": "Area with pressure above zero.",
    "Friction coefficient from the pressure": "From the pressure on the slopes of the indenter, without extrapolation.",
    "Friction coefficient from the dissipation": "From the energy that the rubber loses; both agree on fine grids.",
    "Friction force": "Viscoelastic friction coefficient times load, against the motion.",
    "Dissipated power": "Friction force times speed: the energy that the rubber turns into heat per time.",
    "Normal load": "Force that presses the indenter into the rubber.",
    "Leading edge ahead of the axis": "Distance along the motion from the indenter's axis to the front of the contact.",
    "Trailing edge behind the axis": "Distance along the motion from the indenter's axis to the rear of the contact.",
    "Half-width across the motion": "Half of the contact's width across the motion.",
    "Largest contact pressure": "Largest pressure between indenter and rubber.",
    "Largest contact pressure, not resolved: at least": "Largest pressure on this grid; finer ones find a larger one.",
    "Mean contact pressure": "Normal load over contact area.",
    "Friction force per length": "Force against the motion per length of the cylinder.",
    "Dissipated power per length": "Friction force times speed, per length of the cylinder.",
    "Normal load per length": "Force that presses the cylinder into the rubber, per length.",
    "Width of the contact along the motion": "From the rear to the front of the contact.",
    "Coulomb friction, only as shear": "Shear over pressure in the contact; its own force is not in the friction.",
    "Mean pressure": "Load over the area of the surface.",
    "Mean gap between the surfaces": "Mean distance of the two surfaces.",
    "Distance that the surface has moved since the first touch": "Its approach to the undeformed rubber.",
    "Mean pressure on the points in contact": "Load over the area with pressure above zero.",
    "Largest contact pressure on this grid": "Largest pressure on any point; with smaller waves or cells it is larger.",
    "Dissipated power per area": "Energy that the rubber turns into heat per time and area of the surface.",
    "Contact area fraction on this grid": "Points under pressure over all; with smaller waves or cells it is another.",
    "Centre of pressure along the direction": "Distance from the indenter's axis to the resultant of the pressure.",
    "Lateral guiding force over load, left of the direction": "Force across the motion that keeps it straight.",
    "Frequency v/(2πa)": _FREQUENCY,
    "Frequency v/a": _FREQUENCY,
    "Shift factor α(T)": _SHIFT,
    "Loss tangent tan δ at v/a": "Ratio E″/E′ at the frequency of the contact.",
    "Storage modulus E′ at v/a": "Stress in phase with the strain, over the strain, at the frequency of the contact.",
    "Energy balance error": _IMBALANCE,
    "Points along an edge": "Points of the grid or of the surface along its longer edge in this solution.",
    "Frequency of the longest wave": "Speed over the longest wavelength of the surface: the slowest deformation.",
    "Frequency of the shortest wave": "Speed over the shortest wavelength of the surface: the fastest deformation.",
    # motion
    "Restitution": "Speed of the mass after the contact over its speed before.",
    "Contact time": "Time from the first touch to the separation.",
    "Largest force": "Largest normal force during the contact.",
    "Largest indentation": "Largest approach of the indenter during the contact.",
    "Load at the end": "Normal load at the last time.",
    "Indentation at the end": "Approach of the indenter at the last time.",
    "Largest friction coefficient": "Largest magnitude of friction force over normal load.",
    "Friction coefficient at the end": "Friction force over normal load at the last time.",
    # measurement
    "Prediction minus measurement": "Root mean square of the relative difference of predicted and measured friction.",
    # export
    "cases": "Combinations of material, shape, load, speed and temperature that the study computes.",
    "warnings": "What limits the validity of results; each is listed below.",
}


#: What the page opens with, as a run file would say it; a curve that is there in a second or two.
FIRST_STUDY: dict[str, Any] = {
    "title": "Friction of a synthetic fluoroelastomer",
    "data_origin": "synthetic",
    "material": {"catalogue": "synthetic fluoroelastomer"},
    "indenter": {"shape": "ball", "radius": "9.525 mm"},
    "conditions": {
        "load": "10 N",
        "speed": {"from": "1 mm/s", "to": "10 m/s", "points": 25, "spacing": "log"},
        "temperature": ["30 degC", "60 degC", "90 degC"],
    },
    "solver": {"accuracy": 1e-2},
}


def start(study: dict[str, Any] | None = None) -> dict[str, Any]:
    """Return what the page requests first; `study`: the run file's tables it opens with, instead of the first study."""
    from importlib.metadata import version

    from viscofric.web.forms import FORMS
    from viscofric.web.forms.contact import SHAPES
    from viscofric.web.workspace import LARGEST_UPLOAD, MOST_FILES

    return {
        "version": version("viscofric"),
        "study": copy.deepcopy(FIRST_STUDY if study is None else study),
        "catalogue": rubbers(),
        "limits": {"upload": LARGEST_UPLOAD, "files": MOST_FILES},
        "forms": FORMS,
        "shapes": SHAPES,
        "glossary": GLOSSARY,
    }


def rubbers() -> list[dict[str, Any]]:
    """Return the rubbers of the catalogue."""
    from viscofric.rheology.catalogue import catalogue

    return [
        {"name": entry.name, "synthetic": entry.kind == "SYNTHETIC", "description": f"{entry.holds} {entry.citation}"}
        for entry in catalogue()
    ]
