"""Forms of the material, the measurement, the history, and the solution of a study."""

from __future__ import annotations

import os

from viscofric.web.forms.fields import choice, field, left, number, when

#: Keys of [material] that say where it comes from; the one that is looked at is no part of the study.
SOURCE = [
    choice(
        "@sweeps.source",
        "Source of the material",
        "dma: Sweeps of a DMA or rheometer; creep: Creep tests; relaxation: Relaxation tests; "
        "ramps: Temperature ramps; master_curve: A master curve; file: A material file or a card; "
        "catalogue: The catalogue",
    )
]
#: What a file of tests may leave to the user.
QUESTIONS = [
    choice(
        "material.deformation",
        "Measured in",
        [
            [None, "– please select –"],
            ["tension", "tension: E′, E″"],
            ["compression", "compression: E′, E″"],
            ["bending", "bending: E′, E″"],
            ["shear", "shear: G′, G″"],
        ],
        help="Not stated in the file; the moduli differ by a factor of three.",
    ),
    field("material.modulus_unit", "Unit of the moduli", placeholder="e.g. MPa", help="Not stated in the file."),
    field(
        "material.temperature",
        "Temperature of the sweep",
        "temperature",
        list=True,
        help="Not stated in the file; of several files one temperature each, in their order: 145 °C, 160 °C.",
    ),
    field(
        "material.assumed_shift",
        "Assumed shift law",
        placeholder="e.g. 250 kJ/mol",
        help="One frequency determines no shift factor. An activation energy (250 kJ/mol), "
        "WLF 17.44, 51.6 K, -30 degC (C₁, C₂, their reference), or universal.",
    ),
    field("material.sheet", "Sheet", help="Name of the only sheet of the workbook to read."),
]
_REFERENCE = field(
    "material.reference_temperature",
    "Reference temperature",
    "temperature",
    help="The shift factor is 1 at this temperature.",
    also={"material.fixed_shift_factors": None},  # they are about the reference before
)
MAKING = [
    field("material.name", "Name"),
    _REFERENCE,
    number("material.poisson_ratio", "Poisson’s ratio", min=0, max=0.5, step=0.01, placeholder="0.5"),
]
_LAWS = [
    ["best", "the best law"],
    ["wlf", "WLF"],
    ["arrhenius", "Arrhenius"],
    ["vft", "VFT"],
    ["wlf+arrhenius", "WLF, Arrhenius below Tg"],
    ["polynomial", "polynomial in 1/T"],
]
SHIFT = [
    _REFERENCE,
    field(
        "material.leave_out_temperatures",
        "Leave out temperatures",
        "temperature",
        list=True,
        placeholder="none",
        help="Isotherms of the sweeps that are not used, e.g. 60 °C, 70 °C.",
    ),
    choice(
        "material.shift",
        "α(T) used",
        [["measured", "as measured"], *_LAWS],
        "measured",
        help="Measured factors are valid between the isotherms only; a law extrapolates.",
    ),
    choice(
        "material.vertical_shift",
        "Vertical shift b(T)",
        "none; free: fitted; density: density times temperature",
        "none",
    ),
]
AMPLITUDE = [
    number(
        "material.strain",
        "Scale the moduli to this tensile strain",
        min=0,
        max=10,
        placeholder="not scaled",
        help="A fraction: 0.05 is 5 %. An approximation by Kraus’s law, without 95 % bands.",
    ),
    number("material.measured_at", "Tensile strain of the frequency sweeps", min=0, max=10, placeholder="small"),
]
SPECTRUM = [
    choice(
        "material.spectrum",
        "Fit method",
        "non-negative: non-negative: smallest misfit; regularised: regularised: smooth; sparse: sparse: few modes",
        "non-negative",
        sets={
            "non-negative": {"material.spectrum": None, "material.modes": None},
            "regularised": {"material.modes": None},
            "sparse": {"material.tau_ratio": None},
        },
        help="Non-negative modes have the smallest misfit; regularised ones make a smooth spectrum; "
        "sparse ones are few, for finite elements.",
    ),
    number(
        "material.modes",
        "Largest number of modes",
        min=1,
        max=200,
        step=1,
        slider=[1, 60],
        placeholder="automatic",
        when=[{"material.spectrum": ["sparse"]}],
    ),
    left(
        {"material.spectrum": [None, "non-negative", "regularised"]},
        number("material.tau_ratio", "Ratio of neighbouring times", min=1.1, max=100, placeholder="e = 2.718"),
    ),
    number(
        "uncertainty.draws",
        "Bootstrap samples for the 95 % band",
        min=0,
        max=10000,
        step=1,
        placeholder="200",
        help="Refits to resampled data; 0 for no band.",
    ),
]
SEPARATION = [
    field(
        "measurement.zero",
        "Zero of the force cell",
        "load",
        placeholder="fitted, or as recorded",
        help="Reading without traction, if known.",
    ),
    field("measurement.zero_error", "Standard error of the zero", "load"),
    field(
        "measurement.coulomb",
        "Assumed Coulomb friction",
        "plain",
        placeholder="e.g. 0.05, or constant",
        help="If the slip has one direction only: a coefficient, or “constant” over the speed.",
    ),
    number("measurement.coulomb_error", "Standard error of Coulomb friction", min=0),
    field(
        "measurement.except_steps",
        "Steps to leave out",
        "plain",
        list=True,
        placeholder="e.g. 1, 3",
        help="For example unsteady steps.",
    ),
    field("measurement.sheet", "Sheet", help="Name of the sheet of a workbook to read."),
    choice("measurement.outliers", "Outliers", "keep; leave out", "keep"),
    number(
        "measurement.speed_tolerance",
        "Gap between speeds",
        placeholder="0.05",
        min=0,
        max=1,
        help="Relative; a smaller gap is scatter about the same nominal speed.",
    ),
    field("measurement.temperature_tolerance", "Gap between temperatures", unit="delta_degC", placeholder="1 K"),
]
#: Options of the job master, which are no part of the study, and which of its curves is shown.
MASTER = [
    choice(
        "@friction.beside", "Compare with", "rubber: the page's material; nothing: nothing (friction alone)", "rubber"
    ),
    choice(
        "@friction.shifted",
        "Shifted by",
        "rubber: the material's shift factors; found: shift factors from friction",
        "rubber",
    ),
    choice("@friction.law", "Law fitted to the shift factors from friction", [*_LAWS, ["none", "none"]], "best"),
]
_CONTACTS = ["indentation", "contact_area", "half_width"]
#: Options of the job identify, which are no part of the study.
IDENTIFY = [
    choice("@identify.shift", "Shift factors", "friction: found from friction; rubber: of the page's material"),
    choice(
        "@identify.anchor",
        "Anchor (fixes the magnitude of the modulus)",
        "rubber: |E| of the page's material at one frequency; modulus: a known modulus; "
        "indentation: indentation of the ball; contact_area: contact area; half_width: contact half-width; "
        "nothing: none: magnitude not identified",
        "rubber",
        help="Friction determines the shape of E(ω) but hardly its magnitude.",
    ),
    *when(
        {"@identify.anchor": ["modulus"]},
        field("@identify.modulus", "Modulus |E|", "modulus", placeholder="e.g. 8 MPa"),
        field("@identify.frequency", "Frequency of the modulus", "frequency", placeholder="e.g. 1 Hz"),
    ),
    *when(
        {"@identify.anchor": ["rubber"]},
        field("@identify.frequency", "Anchor frequency", "frequency", placeholder="1 Hz", otherwise="1 Hz"),
    ),
    *when(
        {"@identify.anchor": _CONTACTS},
        field("@identify.size", "Measured size", placeholder="e.g. 0.8 mm, or 12 mm^2"),
        field("@identify.speed", "Anchor speed", "speed", placeholder="e.g. 100 mm/s"),
        field("@identify.load", "Anchor load", "load", placeholder="e.g. 25 N"),
    ),
    *when(
        {"@identify.anchor": ["rubber", "modulus", *_CONTACTS]},
        field("@identify.temperature", "Anchor temperature", "temperature"),
    ),
    *when(
        {"@identify.anchor": ["modulus", *_CONTACTS]},
        number("@identify.error", "Relative standard error", min=0, max=1, placeholder="0.01"),
    ),
]
_IMPACT = {"@motion.preset": ["impact"]}
_ROWS = {"@motion.preset": ["hold", "start", "stop", "back"]}
#: What the job motion solves, which is no part of the study; the page knows what its contact lets prescribe.
MOTION = [
    choice(
        "@motion.preset",
        "Example",
        "hold: Press and hold; start: Start from rest; stop: Start and stop; back: Back and forth; "
        "impact: Impact of a mass",
    ),
    *when(
        _ROWS,
        choice("@motion.control", "Prescribed", []),
        choice("@motion.path", "Motion given as", "speed: Speed; position: Position"),
        choice("@motion.before", "Before the first time", "untouched; at rest; sliding"),
        number("@motion.coulomb", "Coulomb friction", min=0, step=0.01, placeholder="0"),
    ),
    *when(
        _IMPACT,
        number("@motion.impact.mass", "Mass (kg)", min=0, otherwise=0.033),
        number("@motion.impact.speed", "Speed (m/s)", min=0, otherwise=1),
        number("@motion.impact.gravity", "Gravity (m/s²)", otherwise=0),
        number("@motion.impact.rebounds", "Contacts to follow", min=1, step=1, otherwise=1),
    ),
    field("@motion.temperature", "Temperature", "temperature"),
]
HISTORY = when(
    {"history": True},
    field("history.load_time", "Time to load", "time", placeholder="0 s"),
    field("history.dwell", "Dwell, one or several", "time", list=True, placeholder="0 s"),
    field("history.slide", "Path of a stroke", "length", placeholder="no sliding"),
    number("history.strokes", "Strokes", min=1, step=1, placeholder="1"),
    field("history.file", "Table instead", placeholder="none"),
    number("history.points", "Stored times", min=2, step=1, placeholder="200"),
)
SOLVING = [
    number("solver.accuracy", "Accuracy of friction", min=1e-10, max=0.1, placeholder="0.001"),
    number("uncertainty.draws", "Bootstrap samples", min=0, step=1, placeholder="200"),
    choice("outputs.fields", "Stored pressure maps", "few: of a few cases; all: of all cases; none", "few"),
    number("@export.workers", "Processes", min=1, max=os.cpu_count() or 1, step=1, placeholder="1"),
]
_UNITS, _PROGRAMS = ["abaqus", "ansys", "ls-dyna"], ["abaqus", "ansys", "ls-dyna", "comsol", "comsol-branches"]
#: Options of the job export-card, which are no part of the study.
CARD = [
    choice(
        "@card.format",
        "Program",
        "abaqus: Abaqus; ansys: ANSYS; ls-dyna: LS-DYNA; comsol: COMSOL, parameters; "
        "comsol-branches: COMSOL, table of branches; json: viscofric (JSON)",
        "abaqus",
    ),
    *when(
        {"@card.format": _UNITS},
        choice("@card.modulus_unit", "Units of the model", "Pa: Pa, m, s, kg; MPa: MPa, mm, s, t", "Pa"),
        choice("@card.temperature_unit", "Temperatures of the model", "K: kelvin; degC: °C", "K"),
    ),
    *when(
        {"@card.format": ["abaqus"]}, choice("@card.domain", "Analysis", "time: time (Prony series); frequency", "time")
    ),
    *when(
        {"@card.format": _PROGRAMS},
        choice(
            "@card.law",
            "Shift law",
            [[None, "that of the material"], ["best", "the best law"], ["wlf", "WLF"], ["arrhenius", "Arrhenius"]],
            help="fits a law, since the programs accept no table of factors",
        ),
        number(
            "@card.poisson_ratio",
            "Poisson's ratio",
            min=0,
            max=0.5,
            placeholder="that of the material",
            help="ANSYS and LS-DYNA do not accept 0.5",
        ),
        field("@card.density", "Density", placeholder="none", help="e.g. 1800 kg/m^3; required for LS-DYNA"),
    ),
]
