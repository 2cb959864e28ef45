"""Wrong run files: the change to a correct one, the codes of the errors by their places, and the message."""

from __future__ import annotations

from typing import NamedTuple

BALL = """
title = "a rubber"
[material]
dma = "dma.csv"
reference_temperature = "30 degC"
[indenter]
radius = "9.525 mm"
[conditions]
load = "25 N"
speed = { from = "20 mm/s", to = "200 mm/s", points = 3 }
temperature = ["30 degC", "60 degC"]
"""
TWO = 'temperature = ["30 degC", "60 degC"]'
MEASURED = f'{TWO}\n[measurement]\nmtm = "a.csv"'

_MATERIAL = '[material]\ncatalogue = "synthetic fluoroelastomer"\n'
GENERATED = """[surface]
hurst = 0.8
rms_slope = 0.2
rolloff = "200 um"
shortest = "40 um"
spacing = "10 um"
points = 32
seed = { from = 3, to = 5 }
"""
SCAN = '[surface]\nfile = "scan.csv"\nunit = "um"\nspacing = "5 um"\n'
INDENTER = '[indenter]\nradius = "5 mm"\n'
SURFACE = (
    _MATERIAL
    + GENERATED
    + """[conditions]
pressure = ["20 kPa", "50 kPa"]
speed = ["1 mm/s", "1 m/s"]
temperature = "30 degC"
"""
)
SWEEP = (
    _MATERIAL
    + """[indenter]
radius = ["5 mm", "10 mm"]

[conditions]
load = ["1 N", "4 N"]
speed = { from = "1 mm/s", to = "1 m/s", points = 4 }
temperature = ["30 degC", "60 degC", "90 degC"]
"""
)


class Wrong(NamedTuple):
    """A run file that is refused: `bad` replaces the first `good` of `base`, or is appended where `good` is empty."""

    base: str
    good: str
    bad: str
    codes: dict[str, str]
    message: str

    @property
    def text(self) -> str:
        assert self.good in self.base
        return self.base.replace(self.good, self.bad, 1) if self.good else self.base + self.bad


WRONG = [
    Wrong(
        BALL,
        'load = "25 N"',
        'load = "0 N"',
        {"conditions.load": "not-positive"},
        "conditions.load: '0 N': must be above zero; write, for example, '25 N'.",
    ),
    Wrong(
        BALL,
        'load = "25 N"',
        'load = "-3 N"',
        {"conditions.load": "not-positive"},
        "conditions.load: '-3 N': must be above zero; write, for example, '25 N'.",
    ),
    Wrong(
        BALL,
        'load = "25 N"',
        "load = 25",
        {"conditions.load": "value"},
        "conditions.load: 25 has no unit; write text such as '25 N', '100 mm/s', '30 degC'.",
    ),
    Wrong(
        BALL,
        'load = "25 N"',
        'load = "25 mm"',
        {"conditions.load": "wrong-unit"},
        "conditions.load: '25 mm': has the wrong kind of unit (millimeter); write, for example, '25 N'.",
    ),
    Wrong(
        BALL,
        'load = "25 N"',
        'laod = "25 N"',
        {"conditions.laod": "unknown-key"},
        "conditions.laod: unknown key; did you mean 'load'?",
    ),
    Wrong(
        BALL, "[indenter]", "[indentr]", {"indentr": "unknown-key"}, "indentr: unknown key; did you mean 'indenter'?"
    ),
    Wrong(
        BALL,
        'radius = "9.525 mm"',
        'radius = "big"',
        {"indenter.radius": "no-number"},
        "indenter.radius: 'big': has no number; write, for example, '9.525 mm'.",
    ),
    Wrong(
        BALL,
        '"20 mm/s"',
        '"0 mm/s"',
        {"conditions.speed.from": "not-positive"},
        "conditions.speed.from: '0 mm/s': must be above zero; write, for example, '100 mm/s'.",
    ),
    Wrong(
        BALL,
        "points = 3",
        "points = 1",
        {"conditions.speed.points": "greater-than-equal"},
        "conditions.speed.points: 1 is too small; it must be 2 or more.",
    ),
    Wrong(
        BALL,
        "points = 3",
        "point = 3",
        {"conditions.speed.point": "unknown-key"},
        "conditions.speed.point: unknown key; did you mean 'points'?",
    ),
    Wrong(
        BALL,
        '["30 degC", "60 degC"]',
        "[]",
        {"conditions.temperature": "too-short"},
        "conditions.temperature: is empty; give at least one value.",
    ),
    Wrong(
        BALL,
        '"60 degC"',
        '"-300 degC"',
        {"conditions.temperature[1]": "value"},
        "conditions.temperature[1]: '-300 degC' is below absolute zero.",
    ),
    Wrong(
        BALL,
        'dma = "dma.csv"',
        "",
        {"material": "contradiction"},
        'material: has no source of the material; give dma = "sweeps.csv" (or a master_curve, a file '
        "with a predefined material, or a name in the catalogue).",
    ),
    Wrong(
        BALL,
        'dma = "dma.csv"',
        'dma = "dma.csv"\nfile = "rubber.json"',
        {"material": "contradiction"},
        "material: dma and file are both given; give one of them.",
    ),
    Wrong(
        BALL,
        'dma = "dma.csv"',
        'catalogue = "PVB interlayer"\ntau_ratio = 2.0',
        {"material": "contradiction"},
        "material: tau_ratio cannot be chosen for a predefined material (catalogue).",
    ),
    Wrong(
        BALL,
        'reference_temperature = "30 degC"',
        "",
        {"material": "contradiction"},
        'material: reference_temperature is missing; it is the temperature of the master curve, e.g. "30 degC".',
    ),
    Wrong(
        BALL,
        'dma = "dma.csv"',
        'dma = "dma.csv"\nmodes = 12',
        {"material": "contradiction"},
        'material: modes needs spectrum = "sparse".',
    ),
    Wrong(
        BALL,
        'dma = "dma.csv"',
        'dma = "dma.csv"\nshift_factors = "a.csv"\nfixed_shift_factors = { "0 degC" = 1.2 }',
        {"material": "contradiction"},
        "material: shift_factors and fixed_shift_factors are both given; the first one contains all.",
    ),
    Wrong(
        BALL,
        'dma = "dma.csv"',
        'dma = "dma.csv"\nfixed_shift_factors = { "cold" = 1.2 }',
        {"material.fixed_shift_factors": "no-number"},
        "material.fixed_shift_factors: 'cold': has no number; write, for example, '30 degC'.",
    ),
    Wrong(
        BALL,
        'dma = "dma.csv"',
        'dma = "dma.csv"\npoisson_ratio = 0.6',
        {"material.poisson_ratio": "less-than-equal"},
        "material.poisson_ratio: 0.6 is too large; it must be 0.5 or less.",
    ),
    Wrong(
        BALL,
        'title = "a rubber"',
        'title = "a rubber',
        {"": "not-toml"},
        "study.toml, line 2, column 18: is not valid TOML: Illegal character '\\n'.",
    ),
    Wrong(
        BALL,
        'temperature = ["30 degC", "60 degC"]',
        'temperature = "30 degC"\nthickness = "0 mm"',
        {"conditions.thickness": "not-positive"},
        "conditions.thickness: '0 mm': must be above zero; write, for example, '9.525 mm'.",
    ),
    Wrong(
        BALL,
        TWO,
        f"{TWO}\n[measurement]",
        {"measurement": "contradiction"},
        'measurement: has no data; give mtm = "runs.txt" (or friction curves, curves = "curves.csv").',
    ),
    Wrong(
        BALL,
        TWO,
        f'{MEASURED}\ncurves = "b.csv"',
        {"measurement": "contradiction"},
        "measurement: mtm and curves are both given; give one of them.",
    ),
    Wrong(
        BALL,
        TWO,
        f"{MEASURED}\nzero = 0.1",
        {"measurement.zero": "value"},
        "measurement.zero: 0.1 has no unit; write text such as '25 N', '100 mm/s', '30 degC'.",
    ),
    Wrong(
        BALL,
        TWO,
        f'{MEASURED}\nzero_error = "0.1 N"',
        {"measurement": "contradiction"},
        "measurement: zero_error is the standard error of zero, which is not given.",
    ),
    Wrong(
        BALL,
        TWO,
        f'{MEASURED}\ncoulomb = "much"',
        {"measurement.coulomb": "value"},
        "measurement.coulomb: 'much' is neither a friction coefficient, such as 0.05, nor the word 'constant'.",
    ),
    Wrong(
        BALL,
        TWO,
        f'{MEASURED}\ncoulomb = "constant"\ncoulomb_error = 0.1',
        {"measurement": "contradiction"},
        "measurement: coulomb_error is the standard error of a coulomb number, which is not given.",
    ),
    Wrong(
        BALL,
        TWO,
        f'{MEASURED}\noutliers = "drop"',
        {"measurement.outliers": "literal-error"},
        "measurement.outliers: 'drop' is not known; expected keep or leave out.",
    ),
    Wrong(
        BALL,
        TWO,
        f"{MEASURED}\nspeed_tolerance = 2.0",
        {"measurement.speed_tolerance": "less-than"},
        "measurement.speed_tolerance: 2.0 is too large; it must be below 1.0.",
    ),
    Wrong(
        BALL,
        TWO,
        f'{TWO}\n[measurement]\ncurves = "b.csv"\nzero = "0.1 N"',
        {"measurement": "contradiction"},
        "measurement: zero cannot be chosen for friction curves, which are already separated.",
    ),
    Wrong(
        BALL, 'title = "a rubber"', "title = 3", {"title": "string-type"}, "title: 3 is not text; put text in quotes."
    ),
    Wrong(
        BALL,
        'radius = "9.525 mm"',
        'load = "25 N"\nradius = "1 mm"',
        {"indenter.load": "unknown-key"},
        "indenter.load: unknown key; it belongs in [conditions].",
    ),
    Wrong(
        BALL,
        'radius = "9.525 mm"',
        'shape = "bal"',
        {"indenter": "union-tag-invalid"},
        "indenter: shape = 'bal' is not known; did you mean 'ball'?",
    ),
    Wrong(
        BALL,
        'radius = "9.525 mm"',
        'shape = "cone"',
        {"indenter.angle": "missing"},
        "indenter.angle: is missing (angle between flank and undeformed surface; small for linear contact).",
    ),
    Wrong(
        BALL,
        'radius = "9.525 mm"',
        "shape = 5",
        {"indenter": "union-tag-not-found"},
        'indenter: shape is not text; write shape = "ball".',
    ),
    Wrong(
        BALL,
        'radius = "9.525 mm"',
        'radius = "1 mm"\npoisson_ratio = 0.2',
        {"indenter.poisson_ratio": "contradiction"},
        "indenter.poisson_ratio: is for an elastic indenter, but modulus is not given; a rigid one has none.",
    ),
    Wrong(
        BALL,
        "points = 3",
        "points = true",
        {"conditions.speed.points": "int-type"},
        "conditions.speed.points: true is not a whole number.",
    ),
    Wrong(
        BALL,
        "points = 3",
        "points = 3.5",
        {"conditions.speed.points": "int-type"},
        "conditions.speed.points: 3.5 is not a whole number.",
    ),
    Wrong(
        BALL,
        "points = 3",
        "points = 10_001",
        {"conditions.speed.points": "less-than-equal"},
        "conditions.speed.points: 10001 is too large; it must be 10,000 or less.",
    ),
    Wrong(
        BALL,
        "points = 3",
        'points = 3, spacing = "lin"',
        {"conditions.speed.spacing": "literal-error"},
        "conditions.speed.spacing: 'lin' is not known; did you mean 'linear'?",
    ),
    Wrong(
        BALL,
        'to = "200 mm/s"',
        'to = "20 mm/s"',
        {"conditions.speed.to": "contradiction"},
        "conditions.speed.to: is the same as from; give one value instead of a range.",
    ),
    Wrong(
        BALL,
        '"20 mm/s"',
        '"-20 mm/s"',
        {"conditions.speed.from": "not-positive"},
        "conditions.speed.from: '-20 mm/s': must be above zero; write, for example, '100 mm/s'.",
    ),
    Wrong(
        BALL,
        TWO,
        'temperature = { from = "1 degC", to = "2 degC", points = 2, spacing = "log" }',
        {"conditions.temperature.spacing": "literal-error"},
        "conditions.temperature.spacing: 'log' is not known; expected linear.",
    ),
    Wrong(
        BALL,
        TWO,
        'temperature = ["30 degC", "86 degF"]',
        {"conditions.temperature": "contradiction"},
        "conditions.temperature: contains the same value twice (entry 2).",
    ),
    Wrong(
        BALL,
        TWO,
        "temperature = true",
        {"conditions.temperature": "value"},
        "conditions.temperature: true has no unit; write text such as '25 N', '100 mm/s', '30 degC'.",
    ),
    Wrong(
        BALL,
        TWO,
        f'{TWO}\n[layer]\nthickness = "1 mm"\nbase = "glued"',
        {"layer.base": "literal-error"},
        "layer.base: 'glued' is not known; expected bonded or sliding.",
    ),
    Wrong(
        BALL,
        TWO,
        f'{TWO}\nthickness = "1 mm"\n[layer]\nthickness = "1 mm"',
        {"conditions.thickness": "contradiction"},
        "conditions.thickness: checks the half-space assumption, which does not apply with [layer]; leave it out.",
    ),
    Wrong(
        BALL, '"dma.csv"', '"a\\u0000b"', {"material.dma": "value"}, "material.dma: 'a\\x00b' is not a valid file name."
    ),
    Wrong(
        BALL,
        '"dma.csv"',
        f'''"{300 * "x"}"''',
        {"material.dma": "value"},
        "material.dma: 'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx… "
        "is not a valid file name.",
    ),
    Wrong(
        BALL,
        '"dma.csv"',
        '"/**/*"',
        {"material.dma": "value"},
        "material.dma: '/**/*' searches all folders; use a pattern such as 'sweeps/*.txt'.",
    ),
    Wrong(
        BALL,
        '"dma.csv"',
        '["dma.csv", 3]',
        {"material.dma[1]": "path-type"},
        "material.dma[1]: 3 is not text; expected the name of a file.",
    ),
    Wrong(
        BALL,
        '"dma.csv"',
        '"dma.csv"\npoisson_ratio = nan',
        {"material.poisson_ratio": "finite-number"},
        "material.poisson_ratio: nan is not a finite number.",
    ),
    Wrong(
        BALL,
        "[indenter]",
        '[outputs]\nformats = ["csv", "xls"]\n[indenter]',
        {"outputs.formats[1]": "literal-error"},
        "outputs.formats[1]: 'xls' is not known; did you mean 'excel'?",
    ),
    Wrong(
        BALL,
        "[indenter]",
        '[cluster]\nmemory = "8 mm"\nwalltime = "2 h"\n[indenter]',
        {"cluster.memory": "wrong-unit"},
        "cluster.memory: '8 mm': has the wrong kind of unit (millimeter); write, for example, '8 GB'.",
    ),
    Wrong(
        BALL,
        "[indenter]",
        '[uncertainty]\nseed = "x"\n[indenter]',
        {"uncertainty.seed": "int-type"},
        "uncertainty.seed: 'x' is not a whole number.",
    ),
    Wrong(
        SURFACE,
        GENERATED,
        "",
        {"indenter": "contradiction"},
        "indenter: is missing; give it, or [surface] for a rough surface.",
    ),
    Wrong(
        SURFACE,
        GENERATED,
        GENERATED + INDENTER,
        {"surface": "contradiction"},
        "surface: is given besides [indenter]; a study has one of them.",
    ),
    Wrong(
        SURFACE,
        GENERATED,
        INDENTER,
        {"conditions.pressure": "contradiction"},
        "conditions.pressure: is not for an indenter; give load instead, such as '25 N'.",
    ),
    Wrong(
        SURFACE,
        'pressure = ["20 kPa", "50 kPa"]',
        'load = "5 N"',
        {"conditions.load": "contradiction"},
        "conditions.load: is not for a [surface]; give pressure instead, such as '50 kPa'.",
    ),
    Wrong(
        SURFACE,
        'pressure = ["20 kPa", "50 kPa"]',
        "",
        {"conditions.pressure": "contradiction"},
        "conditions.pressure: is missing; a [surface] needs one, such as '50 kPa'.",
    ),
    Wrong(
        SURFACE,
        "[conditions]",
        '[measurement]\nmtm = "a.csv"\n[conditions]',
        {"measurement": "contradiction"},
        "measurement: needs a ball, but there is a rough [surface].",
    ),
    Wrong(
        SURFACE,
        "hurst = 0.8\n",
        "",
        {"surface": "contradiction"},
        'surface: has no source; give file = "scan.csv", or the hurst exponent of a generated surface.',
    ),
    Wrong(
        SURFACE,
        "hurst = 0.8",
        'hurst = 0.8\nfile = "a.csv"',
        {
            "surface.hurst": "contradiction",
            "surface.rms_slope": "contradiction",
            "surface.rolloff": "contradiction",
            "surface.shortest": "contradiction",
            "surface.points": "contradiction",
            "surface.seed": "contradiction",
        },
        "6 things are wrong:\n"
        "  surface.hurst: is for a generated surface, but there is a file; leave it out.\n"
        "  surface.rms_slope: is for a generated surface, but there is a file; leave it out.\n"
        "  surface.rolloff: is for a generated surface, but there is a file; leave it out.\n"
        "  surface.shortest: is for a generated surface, but there is a file; leave it out.\n"
        "  surface.points: is for a generated surface, but there is a file; leave it out.\n"
        "  … and 1 more.",
    ),
    Wrong(
        SURFACE,
        "hurst = 0.8",
        'hurst = 0.8\nprepare = ["fill"]',
        {"surface.prepare": "contradiction"},
        "surface.prepare: is for a surface read from a file; leave it out.",
    ),
    Wrong(
        SURFACE,
        "seed = { from = 3, to = 5 }",
        "",
        {"surface.seed": "contradiction"},
        "surface.seed: is missing; a generated surface needs it, e.g. seed = 1.",
    ),
    Wrong(
        SURFACE,
        "seed = { from = 3, to = 5 }",
        "seed = [1, 2, 1]",
        {"surface.seed": "contradiction"},
        "surface.seed: contains the same value twice (entry 3).",
    ),
    Wrong(
        SURFACE,
        "{ from = 3, to = 5 }",
        "{ from = 3, to = 3 }",
        {"surface.seed.to": "contradiction"},
        "surface.seed.to: must lie above from, by less than 10,000.",
    ),
    Wrong(
        SURFACE,
        "{ from = 3, to = 5 }",
        "{ from = 3, top = 5 }",
        {"surface.seed.top": "unknown-key"},
        "surface.seed.top: unknown key; did you mean 'to'?",
    ),
    Wrong(
        SURFACE,
        "{ from = 3, to = 5 }",
        "-1",
        {"surface.seed": "greater-than-equal"},
        "surface.seed: -1 is too small; it must be 0 or more.",
    ),
    Wrong(
        SURFACE,
        "rms_slope = 0.2",
        "",
        {"surface.rms_height": "contradiction"},
        "surface.rms_height: give rms_height or rms_slope, one of them.",
    ),
    Wrong(
        SURFACE,
        "rms_slope = 0.2",
        'rms_slope = 0.2\nrms_height = "1 um"',
        {"surface.rms_height": "contradiction"},
        "surface.rms_height: give rms_height or rms_slope, not both.",
    ),
    Wrong(
        SURFACE,
        'spacing = "10 um"',
        'spacing = "30 um"',
        {"surface.shortest": "contradiction"},
        "surface.shortest: 4e-05 m is not above two points of the grid, 6e-05 m; use about eight.",
    ),
    Wrong(
        SURFACE,
        'rolloff = "200 um"',
        'rolloff = "1 mm"',
        {"surface.shortest": "contradiction"},
        "surface.shortest: 4e-05 m, rolloff 0.001 m and longest 0.00032 m must increase in this order; "
        "the longest is the period by default.",
    ),
    Wrong(
        SURFACE,
        "points = 32",
        "points = [32, 32, 32]",
        {"surface.points": "too-long"},
        "surface.points: has 3 entries; at most 2 can be given.",
    ),
    Wrong(
        SURFACE,
        "hurst = 0.8",
        "hurst = 1.8",
        {"surface.hurst": "less-than-equal"},
        "surface.hurst: 1.8 is too large; it must be 1.0 or less.",
    ),
    Wrong(
        SURFACE, "hurst", "hurts", {"surface.hurts": "unknown-key"}, "surface.hurts: unknown key; did you mean 'hurst'?"
    ),
    Wrong(
        SURFACE,
        "[surface]",
        "[surfaces]",
        {"surfaces": "unknown-key"},
        "surfaces: unknown key; did you mean 'surface'?",
    ),
    Wrong(
        SURFACE,
        GENERATED,
        SCAN + 'prepare = ["fil"]\n',
        {"surface.prepare[0]": "value"},
        "surface.prepare[0]: 'fil' is not a preparation step; did you mean 'fill'?",
    ),
    Wrong(
        SURFACE,
        GENERATED,
        SCAN + 'prepare = "window 2"\n',
        {"surface.prepare": "value"},
        "surface.prepare: 'window 2': expected a fraction of each length up to 0.5, such as 'window 0.1'.",
    ),
    Wrong(
        SWEEP,
        "",
        '[sweep]\ntogether = [["load", "temperature"]]',
        {"sweep.together[0]": "contradiction"},
        "sweep.together[0]: axes that vary together need the same number of values, but load has 2, temperature has 3.",
    ),
    Wrong(
        SWEEP,
        "",
        '[sweep]\ntogether = [["laod", "radius"]]',
        {"sweep.together[0][0]": "contradiction"},
        "sweep.together[0][0]: 'laod' is not an axis of this study; did you mean 'load'?",
    ),
    Wrong(
        SWEEP,
        "",
        '[sweep]\ntogether = [["thickness", "radius"]]',
        {"sweep.together[0][0]": "contradiction"},
        "sweep.together[0][0]: 'thickness' is not an axis of this study; the axes are material, radius, "
        "load, temperature, speed.",
    ),
    Wrong(
        SWEEP,
        "",
        '[sweep]\ntogether = [["load", "radius"], ["load", "speed"]]',
        {"sweep.together[1][0]": "contradiction"},
        "sweep.together[1][0]: 'load' is named twice; an axis belongs to one group.",
    ),
    Wrong(
        SWEEP,
        "",
        '[sweep]\ntogether = [["load"]]',
        {"sweep.together[0]": "too-short"},
        "sweep.together[0]: has 1 entry; at least 2 are needed.",
    ),
    Wrong(
        SWEEP,
        "",
        '[layer]\nthickness = ["1 mm", "1 mm"]',
        {"layer.thickness": "contradiction"},
        "layer.thickness: contains the same value twice (entry 2).",
    ),
    Wrong(
        SWEEP,
        "",
        '[measurement]\nmtm = "a.csv"',
        {"measurement": "contradiction"},
        "measurement: needs one ball, but indenter.radius has 2 values.",
    ),
    Wrong(
        SWEEP,
        "",
        "[cluster]\nqueue = 'q'",
        {"cluster.memory": "missing", "cluster.walltime": "missing"},
        "2 things are wrong:\n"
        "  cluster.memory: is missing (memory of a job).\n"
        "  cluster.walltime: is missing (time limit of a job; another job takes over its unfinished "
        "cases).",
    ),
]
#: Text that is not TOML for a run file, the code of the error, and the message after the name of the file.
NO_TOML = [
    ('title = "a\n', "not-toml", ", line 1, column 11: is not valid TOML: Illegal character '\\n'."),
    ("a = 1\na = 2\n", "not-toml", ", line 2, column 6: a key is given twice in the same table."),
    (
        "[solver]\n[solver]\n",
        "not-toml",
        ", line 2, column 8: the table [solver] is given twice, or has keys in two places.",
    ),
    ("[material", "not-toml", ", at its end: is not valid TOML: Expected ']' at the end of a table declaration."),
    ("a = " + "[" * 5000, "too-deep", ": lists or tables are nested too deeply for a run file."),
    (".".join("a" * 5000) + " = 1", "too-deep", ": lists or tables are nested too deeply for a run file."),
    ("a = " + "9" * 5000, "not-toml", ": a whole number has thousands of digits."),
    ("#" * 1000001, "too-long", ": has more than 1,000,000 characters; is this a run file?"),
]
