"""The words of tables of friction curves: fields, their units and headings."""

from __future__ import annotations

from viscofric.readers.dma.names import COEFFICIENT, FREQUENCY, FRICTION_FORCE, LOAD, LUBRICANT, TEMPERATURE
from viscofric.readers.headings import Vocabulary

_SPEEDS = (
    *("v", "velocity", "sliding speed", "sliding velocity", "disc speed", "disk speed", "linear speed", "lin. speed"),
    *("track speed", "rotational speed", "gleitgeschwindigkeit", "geschwindigkeit", "vitesse", "vitesse de glissement"),
    *("velocidad", "velocidad de deslizamiento", "velocità", "velocità di strisciamento", "snelheid", "glijsnelheid"),
    *("速度", "滑动速度", "すべり速度"),
)
#: field -> (SI unit, empty for a pure number; the heading written; other headings accepted)
COLUMNS: dict[str, tuple[str, str, tuple[str, ...]]] = {
    "speed": ("m/s", "speed", _SPEEDS),
    "temperature": ("K", "temperature", ("T", "temp", "temp.")),
    "load": ("N", "load", ("F", "Fz", "fz", *sorted(LOAD))),
    "viscoelastic": (
        "",
        "viscoelastic friction",
        ("viscoelastic", "viscoelastic friction coefficient", "mu viscoelastic", *COEFFICIENT),
    ),
    "viscoelastic_error": ("", "viscoelastic friction standard error", ("viscoelastic error", "friction error")),
    "viscoelastic_scatter": ("", "viscoelastic friction scatter", ("viscoelastic scatter",)),
    "viscoelastic_freedom": ("", "viscoelastic friction degrees of freedom", ("viscoelastic freedom",)),
    "replicates": ("", "replicates", ("repetitions", "repeats")),
    "coulomb": ("", "Coulomb friction", ("coulomb", "coulomb friction", "coulomb friction coefficient", "mu coulomb")),
    "coulomb_error": ("", "Coulomb friction standard error", ("coulomb friction standard error", "coulomb error")),
    "coulomb_scatter": ("", "Coulomb friction scatter", ("coulomb friction scatter", "coulomb scatter")),
    "coulomb_freedom": (
        "",
        "Coulomb friction degrees of freedom",
        ("coulomb friction degrees of freedom", "coulomb freedom"),
    ),
    "consistency": ("", "consistency", ()),
    "consistency_error": ("", "consistency standard error", ("consistency error",)),
    "slip": ("m/s", "slip", ("slip speed", "slip velocity")),
    "offset": ("N", "offset", ("zero",)),
    "mean_pressure": ("Pa", "mean contact pressure", ("contact pressure",)),
    "mean_pressure_error": ("Pa", "mean contact pressure error", ()),
    "material_error": ("", "material standard error", ("material error", "friction material error")),
    "viscoelastic_lower": ("", "viscoelastic friction lower limit", ("viscoelastic lower", "friction lower")),
    "viscoelastic_upper": ("", "viscoelastic friction upper limit", ("viscoelastic upper", "friction upper")),
    "within_measured_frequencies": ("", "within measured frequencies", ()),
}
#: From one end of a motion to and fro to the other; an amplitude may be half of it.
_STROKE = frozenset(
    {"stroke", "stroke length", "hub", "hublänge", "schwingweite", "course", "carrera", "corsa", "冲程", "行程"}
)
#: The two directions of motion: how columns and rows of each are called.
DIRECTIONS = {
    "forward": frozenset(
        {"forward", "forwards", "fwd", "forth", "positive", "vorwärts", "hin", "aller", "+", "+1", "1"}
    ),
    "backward": frozenset(
        {"backward", "backwards", "bwd", "back", "reverse", "negative", "rückwärts", "zurück", "retour"}
    )
    | {"-", "−", "-1", "2"},
}
_DIRECTION = frozenset(
    {"direction", "sliding direction", "stroke direction", "direction of motion", "direction of sliding", "richtung"}
    | {"gleitrichtung", "bewegungsrichtung", "dirección", "direzione"}
)
#: Quantities that may have a column for each direction.
OF_DIRECTIONS = {
    "viscoelastic friction": frozenset({"viscoelastic friction", "friction", *COLUMNS["viscoelastic"][2]}),
    "friction force": FRICTION_FORCE,
}

#: The words of tables of friction curves; a frequency and a stroke give the speed.
CURVES = Vocabulary(
    "a table of friction curves",
    {heading.lower(): frozenset({heading, heading.lower(), *others}) for _, heading, others in COLUMNS.values()}
    | {"temperature": TEMPERATURE, "track radius": frozenset({"track radius", "wear track radius"})}
    | {"friction force": FRICTION_FORCE, "lubricant": LUBRICANT, "frequency": FREQUENCY, "stroke": _STROKE}
    | {"direction": _DIRECTION}
    | {
        f"{what} {direction}": frozenset(f"{name} {word}" for name in names for word in words if word.isalpha())
        for what, names in OF_DIRECTIONS.items()
        for direction, words in DIRECTIONS.items()
    },
    needed=(
        ("speed", "stroke"),
        ("temperature",),
        ("load",),
        (*OF_DIRECTIONS, *(f"{what} {direction}" for what in OF_DIRECTIONS for direction in DIRECTIONS)),
    ),
    example="friction curves have 'speed (mm/s)', 'temperature (degC)', 'load (N)' and 'viscoelastic friction'",
    key="measurement.columns",
    offered=(
        ("speed", "mm/s"),
        ("temperature", "degC"),
        ("load", "N"),
        ("stroke", "mm"),
        ("viscoelastic friction", ""),
        ("viscoelastic friction standard error", ""),
        ("coulomb friction", ""),
    ),
    logarithms=True,
    means=frozenset({"viscoelastic friction"}),
    conditions=("temperature", "load", "speed"),
    from_above=("temperature", "load", "speed"),
    alone="viscoelastic friction",
    several="titled",
)

#: Column -> unit, long name; the load's are those of `FrictionCurves.to_dataset`.
LABELS = {
    "speed": ("m/s", "speed at which the rubber is deformed"),
    "temperature": ("K", "temperature"),
    "slip": ("m/s", "magnitude of the sliding velocity"),
    "viscoelastic": ("1", "viscoelastic friction coefficient"),
    "viscoelastic_error": ("1", "standard error of the viscoelastic friction coefficient"),
    "viscoelastic_scatter": ("1", "standard deviation of the viscoelastic friction coefficient"),
    "replicates": ("1", "repetitions"),
    "coulomb": ("1", "Coulomb friction coefficient"),
    "coulomb_error": ("1", "standard error of the Coulomb friction coefficient"),
    "coulomb_scatter": ("1", "standard deviation of the Coulomb friction coefficient"),
    "consistency": ("1", "residual of the sign configurations, relative to the load"),
    "consistency_error": ("1", "standard error of the residual"),
    "offset": ("N", "zero reading of the force cell"),
    "material_error": ("1", "standard error of the friction coefficient due to material uncertainty"),
    "viscoelastic_lower": ("1", "lower end of the 95 % band of the friction coefficient"),
    "viscoelastic_upper": ("1", "upper end of the 95 % band of the friction coefficient"),
    "within_measured_frequencies": ("1", "1: reduced frequency αv/a within the measured range; 0: beyond it"),
    "mean_pressure": ("Pa", "mean contact pressure"),
    "mean_pressure_error": ("Pa", "error estimate of the mean contact pressure"),
    "viscoelastic_freedom": ("1", "degrees of freedom behind the standard error of viscoelastic friction"),
    "coulomb_freedom": ("1", "degrees of freedom behind the standard error of Coulomb friction"),
}
LOADS = {"N": "normal load", "N/m": "normal load per length"}
