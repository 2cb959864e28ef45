"""Forms of the contact: shape, load, layer, conditions, interface and heat."""

from __future__ import annotations

from typing import Any

from viscofric.web.forms.fields import Field, choice, field, left, number, spread, switch, when

_POINTS, _ROUGH = ["ball", "ellipsoid", "cone"], ["made", "scan"]
_SMOOTH = [*_POINTS, "cylinder"]


def _elastic(table: str, noun: str) -> list[Field]:
    modulus, ratio = f"{table}.modulus", f"{table}.poisson_ratio"
    return [
        switch(f"Elastic {noun}", {modulus: "200 GPa", ratio: None}),
        *when(
            {modulus: True},
            field(modulus, "Young's modulus", "modulus"),
            number(ratio, "Poisson's ratio", min=0, max=0.5, step=0.01, placeholder="0.3"),
        ),
    ]


#: What each shape begins with; the page keeps what a study had of another shape.
SHAPES: dict[str, Any] = {
    "ball": {"indenter": {"shape": "ball", "radius": "9.525 mm"}, "load": "10 N"},
    "cylinder": {"indenter": {"shape": "cylinder", "radius": "9.525 mm"}, "load": "2 N/mm"},
    "ellipsoid": {"indenter": {"shape": "ellipsoid", "radius_x": "5 mm", "radius_y": "10 mm"}, "load": "25 N"},
    "cone": {"indenter": {"shape": "cone", "angle": "10 deg"}, "load": "25 N"},
    "made": {
        "surface": {
            "hurst": 0.8,
            "rms_slope": 0.2,
            "shortest": "80 um",
            "rolloff": "640 um",
            "points": 128,
            "spacing": "10 um",
            "seed": 1,
        },
        "pressure": "0.5 MPa",
    },
    "scan": {"surface": {"file": "", "prepare": ["fill", "remove tilt", "window"]}, "pressure": "0.5 MPa"},
}
SHAPE = [
    choice(
        "indenter.shape",
        "Shape",
        "ball: Ball; cylinder: Cylinder (line contact); ellipsoid: Ellipsoid; cone: Cone; "
        "made: Rough surface, generated; scan: Rough surface, measured",
        id="contact-shape",
    ),
    *when({"shape": ["ball", "cylinder"]}, field("indenter.radius", "Radius", "length", slider=[1e-4, 1])),
    *when(
        {"shape": ["ellipsoid"]},
        field("indenter.radius_x", "Radius along the motion", "length"),
        field("indenter.radius_y", "Radius across", "length"),
    ),
    *when(
        {"shape": ["cone"]}, field("indenter.angle", "Angle of the flank", "angle", help="to the undeformed surface")
    ),
    *when(
        {"shape": ["made"]},
        number("surface.hurst", "Hurst exponent", min=0, max=1, step=0.05),
        number("surface.rms_slope", "Rms slope", min=0, step=0.01),
        field("surface.rolloff", "Roll-off wavelength", "length"),
        field("surface.shortest", "Shortest wavelength", "length"),
        number("surface.points", "Points along an edge", min=8, step=1),
        field("surface.spacing", "Spacing of points", "length"),
        number("surface.seed", "Seed", min=0, step=1, help="of the random number generator"),
    ),
]
SCAN = when(
    {"shape": ["scan"]},
    field("surface.file", "File", placeholder="none yet"),
    choice(
        "surface.prepare",
        "Preparation",
        "fill: fill gaps; remove tilt; remove curvature; window: window the edges",
        **{"as": "ticks"},
    ),
    field("surface.unit", "Unit of heights", placeholder="from the file"),
    field("surface.spacing", "Spacing of points", "length", placeholder="from the file"),
)
LOAD = [
    *when({"shape": _POINTS}, spread("conditions.load", "Load", "load", slider=[0.01, 1e4])),
    *when({"shape": ["cylinder"]}, spread("conditions.load", "Load per length", "line_load", slider=[10, 1e6])),
    *when(
        {"shape": _ROUGH},
        spread("conditions.pressure", "Mean pressure", "pressure", slider=[1e3, 1e8]),
        field("conditions.direction", "Direction of motion", "angle", placeholder="along x"),
    ),
    *when({"shape": _SMOOTH}, *_elastic("indenter", "indenter")),
    *when({"shape": _ROUGH}, *_elastic("surface", "surface")),
    switch("Layer on a rigid base", {"layer": {"thickness": "2 mm"}}),
    *when(
        {"layer": True},
        field("layer.thickness", "Thickness", "length"),
        choice("layer.base", "Base", "bonded; sliding: sliding, no friction", "bonded"),
    ),
]
CONDITIONS = [
    spread("conditions.speed", "Speed", "speed", otherwise={"to": "1 m/s", "points": 25}),
    spread(
        "conditions.temperature",
        "Temperature",
        "temperature",
        spacing=["linear"],
        otherwise={"to": "90 degC", "points": 3},
    ),
    choice(
        "solver.accuracy",
        "Accuracy",
        [[0.05, "5 %"], [0.02, "2 %"], [0.01, "1 %"], [1e-3, "0.1 %"], [1e-4, "0.01 %, slow"]],
        1e-3,
        help="numerical; the band shows the material's uncertainty",
    ),
]

#: What each law of the interface begins with.
_LAWS: dict[str, dict[str, Any]] = {
    "constant": {"stress": "0.1 MPa"},
    "power": {"stress": "0.1 MPa", "exponent": 0.1, "speed": "1 mm/s"},
    "eyring": {"activation_volume": "20 nm**3", "speed": "1 um/s"},
    "gaussian": {"peak": "0.1 MPa", "width": 2, "speed": "10 mm/s"},
    "best": {},
}
_CONSTANTS = [
    field("interface.stress", "Shear stress", "pressure"),
    field("interface.peak", "Largest shear stress", "pressure"),
    number("interface.exponent", "Exponent", min=-1, step=0.01),
    number("interface.width", "Width in decades", min=0, step=0.1),
    field("interface.activation_volume", "Activation volume"),
    field("interface.speed", "At the slip speed", "speed"),
]


def _of_laws(one: Field) -> Field:
    key = one["path"].removeprefix("interface.")
    return left({"interface.law": [law for law, constants in _LAWS.items() if key in constants]}, one)


INTERFACE = [
    switch("Friction of a dry interface", {"interface": {"law": "power", **_LAWS["power"]}}),
    *when(
        {"interface": True},
        choice(
            "interface.law",
            "Law of the shear stress",
            "constant; power: power of the slip speed; eyring: Eyring; gaussian: Gaussian (Persson); "
            "best: fitted to measured Coulomb friction",
            "best",
            sets={
                law: {**dict.fromkeys(one["path"] for one in _CONSTANTS)}
                | {f"interface.{key}": value for key, value in constants.items()}
                for law, constants in _LAWS.items()
            },
        ),
        *map(_of_laws, _CONSTANTS),
        field("interface.slip", "Slip speed", "speed", placeholder="the speed, as in pure sliding"),
    ),
]
_PASSED = [{"heating.track_radius": True}, {"heating.passes": True}]
_TRACK = {"heating.track_radius": "20 mm", "heating.passes": 100}
# Where an interface makes the heat, Coulomb friction and its slip are those of the interface.
HEATING = [
    switch("Friction heats the contact", {"heating": {"counterface": "steel"}}),
    *when(
        {"heating": True},
        field(
            "heating.counterface",
            "Thermal properties of the indenter",
            help="steel, PTFE (typical handbook values), or 46 W/m/K, 7810 kg/m^3, 475 J/kg/K",
        ),
        field("heating.rubber", "Thermal properties of the rubber", placeholder="filled rubber"),
        left({"interface": False}, number("heating.coulomb", "Coulomb friction", min=0, step=0.01, placeholder="0")),
        left({"interface": False}, field("heating.slip", "Sliding velocity", "speed", placeholder="the speed")),
        left(
            {"shape": _ROUGH},
            field(
                "heating.nominal_radius",
                "Radius of the nominal contact",
                "length",
                placeholder="mean heat left out",
                help="The mean heat of this round area of the surface counts too.",
            ),
        ),
        switch(
            "Circular track",
            _TRACK,
            help="The rubber is passed again and again, as on a disc.",
            when=[{"shape": _POINTS}, *_PASSED],
        ),
        field("heating.track_radius", "Radius of the track", "length", when=_PASSED),
        field(
            "heating.passes",
            "Earlier passes",
            "plain",
            help="A whole number, or inf for the final state.",
            when=_PASSED,
        ),
        choice(
            "heating.average",
            "Temperature of the rubber",
            "loss: where the loss is released; contact: mean of the face",
            "loss",
        ),
        choice(
            "heating.branch",
            "Thermal branch",
            "cold: cold: the speed rises; hot: hot: the speed falls",
            "cold",
            help="for contacts that have two states",
        ),
    ),
]
