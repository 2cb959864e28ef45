"""Bad arguments to every public name: each ends in one sentence of viscofric, or in a result that they do not spoil.

`CALLS` holds one good call of each name that takes arguments; `test_every_public_name_is_attacked` asks for new ones.
"""

from __future__ import annotations

import atexit
import dataclasses
import functools
import inspect
import io
import tempfile
import time
import warnings
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from test_docstrings import PUBLIC, RETURNED, methods
from viscofric.errors import LONGEST_SENTENCE

EXAMPLE = files("viscofric") / "example"
CYLINDER = vf.Cylinder("10 mm")
N = 6
X = 1e-4 * (np.arange(8) - 3.5)
Q = np.geomspace(1e3, 1e5, 20)
SPEED = np.geomspace(0.02, 2.0, N)
MADE = {"shape": (16, 16), "spacing": "10 um", "seed": 1, "aspect": 1.0, "angle": 0.0, "exact": True}
COLUMNS = {
    "speed": SPEED,
    "temperature": np.full(N, 300.0),
    "load": np.full(N, 5.0),
    "viscoelastic": np.full(N, 0.02),
    "viscoelastic_error": np.full(N, 2e-4),
    "viscoelastic_scatter": np.full(N, 4e-4),
    "replicates": np.full(N, 9),
}
MORE_COLUMNS = (
    *("coulomb", "coulomb_error", "coulomb_scatter", "consistency", "consistency_error", "slip", "offset"),
    *("material_error", "viscoelastic_lower", "viscoelastic_upper", "viscoelastic_freedom", "coulomb_freedom"),
    *("mean_pressure", "mean_pressure_error", "within_measured_frequencies"),
)
#: Columns of friction curves that hold pure numbers.
PURE_COLUMNS = {*MORE_COLUMNS, "viscoelastic", "viscoelastic_error", "viscoelastic_scatter"} - {
    *("slip", "offset", "mean_pressure", "mean_pressure_error")
}
READINGS = {
    "disc_speed": np.array([-0.1, -0.1, 0.1, 0.1]),
    "ball_speed": np.array([-0.15, -0.05, 0.15, 0.05]),
    "traction_force": np.array([0.6, -1.4, -0.4, 1.6]),
    "load": np.full(4, 25.0),
    "temperature": np.full(4, 303.15),
    "replicate": np.ones(4),
}


@functools.cache
def rubber():
    return vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")


@functools.cache
def shifted():
    return vf.Material(rubber().spectrum, shift=wlf())


def steel():
    return vf.ThermalProperties(46.0, 7810.0, 475.0, "steel")


@functools.cache
def polynomial():
    return vf.InversePolynomial([5000.0, 1e6], 300.0, fitted_range=(280.0, 380.0))


def wlf():
    return vf.WLF(9.0, 100.0, 300.0, covariance=np.diag([0.1, 1.0]), fitted_range=(280.0, 380.0))


@functools.cache
def omega():
    return np.geomspace(1.0, 1e3, 12)


@functools.cache
def factors():
    kelvin = np.linspace(300.0, 340.0, 6)
    return vf.ShiftFactors(kelvin, wlf().log10(kelvin), 300.0, np.diag([0.0, *np.full(5, 1e-4)]))


@functools.cache
def sweeps():
    kelvin = (290.0, 300.0, 310.0)
    moduli = [shifted().complex_modulus(omega(), T) for T in kelvin]
    return vf.IsothermalSweeps(
        tuple(vf.Isotherm(T, omega(), E.real, E.imag) for T, E in zip(kelvin, moduli, strict=True))
    )


@functools.cache
def superposition():
    return vf.superpose(sweeps(), 300.0)


def steps(deformation="tension"):
    time = np.array([1.0, 10.0, 100.0, 1000.0])
    return vf.readers.StepTests((vf.readers.StepTest(300.0, time, 1e-7 * time**0.1),), "creep", deformation)


@functools.cache
def master_curve():
    modulus = rubber().complex_modulus(np.geomspace(1.0, 1e5, 20))
    return vf.readers.MasterCurve(np.geomspace(1.0, 1e5, 20), modulus.real, modulus.imag, np.full(20, 300.0), 300.0)


@functools.cache
def ramps():
    kelvin = np.arange(270.0, 330.0, 2.0)
    moduli = {omega: rubber().spectrum.complex_modulus(omega * wlf()(kelvin)) for omega in (6.0, 60.0)}
    return vf.readers.TemperatureRamps(
        tuple(vf.readers.TemperatureRamp(omega, kelvin, E.real, E.imag) for omega, E in moduli.items())
    )


def eyring():
    arrhenius = vf.Arrhenius(9e4, 300.0)
    return vf.friction.EyringShearStress(
        2e-26, 1e-6, shift=arrhenius, covariance=np.diag([1e-54, 1e-14, 1e6]), **stress_fit()
    )


def stress_fit():
    return {
        "fitted_speeds": (0.01, 1.0),
        "fitted_temperatures": (290.0, 310.0),
        "fitted_pressures": (1e5, 1e6),
        "notes": ("a note",),
    }


@functools.cache
def rubbed():
    mean = {"mean_pressure": np.full(N, 3e5), "mean_pressure_error": np.zeros(N)}
    coulomb = {"coulomb": 0.3 * SPEED**0.1, "coulomb_error": np.full(N, 3e-3), "slip": SPEED}
    return vf.FrictionCurves(**COLUMNS, **coulomb, **mean)


def kraus():
    return vf.rheology.KrausLaw(6e6, 5e6, 0.02, 0.6, 5e5, 4e5, 6.0, 300.0)


def payne():
    strain = np.geomspace(1e-3, 0.3, 12)
    modulus = kraus().complex_modulus(strain)
    return vf.readers.AmplitudeSweep(strain, modulus.real, modulus.imag, 6.0, 300.0, "shear")


@functools.cache
def samples():
    return vf.sample_materials(superposition(), samples=20)


@functools.cache
def contact():
    return vf.solve_steady(shifted(), CYLINDER, speed=1.0, load=1e3, temperature=300.0, accuracy=1e-2)


@functools.cache
def curves():
    solved = [vf.solve_steady(shifted(), CYLINDER, speed=v, load=1e3, temperature=300.0, accuracy=1e-2) for v in SPEED]
    found = vf.FrictionCurves.from_solutions(solved)
    return dataclasses.replace(found, viscoelastic_error=0.01 * found.viscoelastic, replicates=np.full(N, 9))


@functools.cache
def shifting():
    kelvin = np.repeat([300.0, 305.0, 310.0], 8)
    speed = np.tile(np.geomspace(0.02, 0.2, 8), 3)
    friction = 0.01 * (1.0 + (wlf()(kelvin) * speed / 0.02) ** -0.4)
    return vf.FrictionCurves(speed, kelvin, np.full(24, 25.0), friction, 1e-2 * friction, np.zeros(24), np.ones(24))


@functools.cache
def friction_master_curve():
    return vf.shift_friction(shifting(), shift=wlf())


def record(**settings):
    time = np.geomspace(0.01, 10.0, 12)
    depth = 1e-4 * (1.0 + 0.1 * np.log10(time / 0.01))
    return vf.friction.IndentationRecord(time, np.ones(12), depth, 300.0, control="load", start=0.0, **settings)


@functools.cache
def from_indentation():
    return vf.identify_from_indentation(record(), vf.Ball(1e-2), modes=8, samples=20)


def made(**settings):
    return vf.self_affine(0.8, **MADE | settings, shortest="40 um", rms_slope=0.1)


@functools.cache
def road():
    return made()


@functools.cache
def rough_contact():
    return vf.solve_periodic(rubber(), road().to_surface(), speed=0.1, pressure=5e3)


@functools.cache
def rough_friction():
    return vf.predict_rough_friction(rubber(), [road(), made(seed=2)], speeds=0.1, pressure=5e3)


@functools.cache
def spectrum():
    return vf.roughness.PowerSpectrum.self_affine(0.8, longest=1e-3, shortest=1e-5, rms_slope=0.5)


@functools.cache
def scan():
    x = np.linspace(0.0, 1.0, 33)
    return vf.Topography(3e-6 * x + 1e-6 * np.cos(16.0 * np.pi * x), spacing=1e-5)


@functools.cache
def runs():
    return vf.readers.TractionRuns(
        **READINGS, step=[0, 0, 1, 1], steps=(vf.readers.TractionStep(0), vf.readers.TractionStep(1))
    )


STUDY = """[material]
catalogue = "synthetic fluoroelastomer"
[indenter]
radius = "9.525 mm"
[conditions]
load = "5 N"
speed = "0.1 m/s"
temperature = "60 degC"
[solver]
accuracy = 5e-2
[uncertainty]
draws = 0
"""


@functools.cache
def written():
    """Files that the readers read, written once into a folder that is removed at the end."""
    folder = tempfile.TemporaryDirectory(prefix="viscofric-arguments-")
    atexit.register(folder.cleanup)
    at = Path(folder.name)
    (at / "curve.csv").write_text("frequency (Hz),E' (MPa),E'' (MPa)\n0.01,3.1,0.2\n1,3.6,0.5\n100,5.2,1.6\n")
    (at / "creep.csv").write_text("T (degC),t (s),J (1/MPa)\n25,1,0.1\n25,10,0.12\n25,100,0.15\n25,1000,0.2\n")
    np.savetxt(at / "scan.csv", [[0.0, 1.0, 0.5], [0.2, 0.8, 0.1]], delimiter=",")
    vf.write_card(rubber(), at / "rubber.json", "json")
    vf.write_friction_curves(curves(), at / "friction.csv")
    (at / "history.csv").write_text("time (s),position (mm)\n0,0\n1,20\n", encoding="utf-8")
    rows = "".join(f"{n},1,{100 + n}\n" for n in range(6))
    (at / "rebound.csv").write_text("speed (m/s),restitution (1)\n1,0.6\n2,0.5\n", encoding="utf-8")
    stiffness = "frequency (Hz),storage stiffness (N/m),loss stiffness (N/m)\n1,9e3,1e3\n10,1e4,2e3\n"
    (at / "oscillation.csv").write_text(stiffness, encoding="utf-8")
    (at / "indentation.csv").write_text("time (s),load (N),indentation (um)\n" + rows, encoding="utf-8")
    factors().save(at / "alpha.csv")
    rows = "".join(f"20,1,{0.1 * 2**n},{5 - 0.3 * n},0.5\n" for n in range(10))
    (at / "payne.csv").write_text("T (degC),f (Hz),strain amplitude (%),G' (MPa),G'' (MPa)\n" + rows)
    (at / "study.toml").write_text(STUDY)
    return at


@functools.cache
def results():
    vf.run_study(at("study.toml"))
    return at("study.results")


def at(name):
    return str(written() / name)


class AcceptedError(Exception):
    """Arguments were checked, and the computation has begun."""


def stop(*_):
    raise AcceptedError


def on_cells():
    return {"x": X, "y": X, "pressure": np.full((8, 8), 1e5)}


def modes():
    return {"E_inf": 1e7, "C": np.array([9e-7]), "tau": np.array([1e-3])}


def at_frequencies():
    return {"angular_frequency": np.array([10.0, 1e2])}


def card_settings():
    return {
        "path": at("rubber.json"),
        "format": "json",
        "modulus_unit": None,
        "time_unit": None,
        "temperature_unit": None,
    }


#: method of a spectrum -> its arguments
OF_SPECTRA = {
    "complex_modulus": at_frequencies(),
    "compliance": at_frequencies(),
    "creep_compliance": {"time": np.array([1e-3, 1.0])},
    "relaxation_modulus": {"time": np.array([1e-3, 1.0])},
    "relaxation_density": {"time": np.array([1e-3, 1.0])},
    "retardation_density": {"time": np.array([1e-3, 1.0])},
    "shifted": {"alpha": 2.0, "b": 1.0},
}


def table():
    return {"temperatures": [300.0, 320.0], "log10_values": [0.0, -1.0], "reference": 300.0, "covariance": np.eye(2)}


def fitted():
    return {"covariance": np.eye(2), "fitted_range": (290.0, 350.0), "bounded": True}


# fmt: off
#: name -> the arguments of one good call, all of them as keywords; of a method with the object that it belongs to
CALLS: dict[str, Any] = {
    "Backend": lambda: {"name": "scipy", "threads": 1},
    "highest_von_mises": lambda: {**on_cells(), "poisson_ratio": 0.5},
    "line_stress": lambda: {"x": X, "pressure": np.full(8, 1e5), "depths": np.array([1e-4, 2e-4]), "poisson_ratio":
        0.5},
    "stress_at": lambda: {**on_cells(), "points": np.full((2, 3), 1e-4), "poisson_ratio": 0.5},
    "stress_layer": lambda: {**on_cells(), "depth": 1e-4, "poisson_ratio": 0.5},
    "stress_plane": lambda: {**on_cells(), "depths": np.array([1e-4]), "poisson_ratio": 0.5, "across": 0.0},
    "surface_displacement": lambda: {**on_cells(), "x": 100.0 * X, "y": 100.0 * X, **modes(), "speed": 1.0,
        "poisson_ratio": 0.5, "layer": None, "behind": 1e-4, "ahead": 1e-4, "beside": 1e-4},
    "surface_power": lambda: {"x": X, "pressure": np.full((8, 8), 1e5), "displacement": np.eye(8), "speed": 1.0},
    "HeightMap": lambda: {"z": (X[:, None] ** 2 + X**2) / 20e-3, "spacing": 1e-4},
    "Profile": lambda: {"z": X**2 / 20e-3, "spacing": 1e-4},
    "Ball": lambda: {"radius": 1e-2},
    "Cylinder": lambda: {"radius": 1e-2},
    "Layer": lambda: {"thickness": 1e-3, "bonded": True},
    "Layer.yielding": lambda: (vf.Layer(1e-3), {"wave_number": np.array([1e3, 1e4]), "poisson_ratio": 0.5}),
    "solve_periodic": lambda: {"material": rubber(), "surface": road().to_surface(), "speed": 0.1, "pressure": 5e3,
        "gap": None, "temperature": None, "direction": (1.0, 0.0), "layer": None, "indenter_modulus": 1e9,
        "indenter_poisson_ratio": 0.3, "coulomb": 0.1, "tolerance": 1e-6, "most_products": 1000, "backend": "scipy",
        "heating": None},
    "PeriodicSurface": lambda: {"z": 1e-6 * np.cos(0.25 * np.pi * np.arange(8)), "spacing": 1e-4},
    "Cone": lambda: {"angle": 0.1},
    "Ellipsoid": lambda: {"radius_x": 1e-2, "radius_y": 2e-2},
    "FlatPunch": lambda: {"radius": 1e-3},
    "solve_steady": lambda: {"material": rubber(), "indenter": CYLINDER, "speed": 1.0, "load": 1e3, "indentation": None,
        "temperature": None, "accuracy": 3e-2, "tolerance": 1e-7, "finest": 2048, "window": None, "grid": None,
        "indenter_modulus": 1e9, "indenter_poisson_ratio": 0.3, "layer": None, "backend": "scipy", "direction": (1.0,
        0.0), "coulomb": 0.1, "derivatives": False, "heating": None},
    "History": lambda: {"time": np.array([0.0, 0.1, 0.2]), "load": np.array([0.0, 1.0, 0.5]), "indentation": None,
        "pressure": None, "gap": None, "position": np.zeros(3), "speed": None, "temperature": 300.0, "before":
        "untouched", "direction": (1.0, 0.0)},
    "read_history": lambda: {"path": at("history.csv"), "load": 1.0, "indentation": None, "pressure": None, "gap":
        None, "speed": None, "temperature": 300.0, "before": "untouched", "direction": (1.0, 0.0), "columns": {},
        "sheet": None},
    "History.schedule": lambda: (vf.motion.History([0.0, 0.1], load=1.0, temperature=[300.0, 310.0]),
        {"material": shifted(),
        "kind": "point"}),
    "solve_transient": lambda: {"material": shifted(), "indenter": vf.Ball(1e-2),
        "history": vf.motion.History([0.0, 0.1], load=[0.0, 1.0], temperature=300.0),
        "times": np.array([0.05, 0.1]), "accuracy": 1e-2, "layer": None,
        "indenter_modulus": 1e9, "indenter_poisson_ratio": 0.3, "progress": None, "resume": None, "heating": None,
        "coulomb": 0.1},
    "solve_cycle": lambda: {"material": shifted(), "indenter": vf.Ball(1e-2),
        "one_period": vf.motion.History([0.0, 0.1, 0.2], load=[0.5, 1.0, 0.5], temperature=300.0),
        "accuracy": 1e-2, "layer": None, "indenter_modulus": 1e9,
        "indenter_poisson_ratio": 0.3, "coulomb": 0.1, "most_periods": 60, "times": None, "progress": None},
    "solve_impact": lambda: {"material": shifted(), "indenter": vf.Ball(1e-2), "mass": 0.03, "speed": 0.1, "gravity":
        9.81, "rebounds": 1, "temperature": 300.0, "accuracy": 1e-3, "indenter_modulus": 1e9, "indenter_poisson_ratio":
        0.3},
    "restitution_curve": lambda: {"material": shifted(), "indenter": vf.Ball(1e-2), "speeds": [0.1], "temperatures":
        [300.0], "mass": 0.03, "gravity": 0.0, "accuracy": 1e-3, "indenter_modulus": 1e9, "indenter_poisson_ratio":
        0.3},
    "TransientSolution.pressure_at": lambda: (vf.motion.solve_transient(rubber(), vf.Ball(1e-2),
        vf.motion.History([0.0, 0.1],
        load=1.0), times=[0.1]), {"time": 0.1}),
    "TransientSolution.save_state": lambda: (vf.motion.solve_transient(rubber(), vf.Ball(1e-2),
        vf.motion.History([0.0, 0.1],
        load=1.0), times=[0.1]), {"path": "state.npz"}),
    "Isotherm": lambda: {"temperature": 300.0, "angular_frequency": np.array([1.0, 10.0]), "storage_modulus":
        np.array([3e6, 4e6]), "loss_modulus": np.array([3e5, 4e5]), "strain_amplitude": np.array([1e-3, 1e-3])},
    "IsothermalSweeps": lambda: {"isotherms": sweeps().isotherms, "deformation": "tension", "source": "", "notes": (),
        "format": ""},
    "MasterCurve": lambda: {"angular_frequency": np.array([1.0, 10.0]), "storage_modulus": np.array([3e6, 4e6]),
        "loss_modulus": np.array([3e5, 4e5]), "temperature": np.full(2, 300.0), "reference": 300.0, "notes": ()},
    "TemperatureRamp": lambda: {"angular_frequency": 6.0, "temperature": np.array([290.0, 300.0]), "storage_modulus":
        np.array([4e6, 3e6]), "loss_modulus": np.array([4e5, 3e5])},
    "TemperatureRamps": lambda: {"ramps": ramps().ramps, "deformation": "tension", "heating_rate": 0.05, "source": "",
        "notes": (), "format": ""},
    "TemperatureRamps.between": lambda: (ramps(), {"lowest": 280.0, "highest": 300.0}),
    "TemperatureRamps.in_tension": lambda: (
        vf.readers.TemperatureRamps(ramps().ramps, "shear"), {"poisson_ratio": 0.5}),
    "superpose_ramps": lambda: {"ramps": vf.readers.TemperatureRamps(ramps().ramps, "shear"), "reference": 300.0,
        "law": "arrhenius", "assumed": None, "poisson_ratio": 0.5, "vertical": None},
    "glass_transition": lambda: {"ramp": ramps().ramps[0], "by": "tan delta"},
    "AmplitudeSweep": lambda: {"strain_amplitude": np.array([0.01, 0.1]), "storage_modulus": np.array([4e6, 3e6]),
        "loss_modulus": np.array([4e5, 3e5]), "angular_frequency": 6.0, "temperature": 300.0, "deformation": "shear",
        "source": "", "notes": (), "format": ""},
    "AmplitudeSweep.in_tension": lambda: (payne(), {"poisson_ratio": 0.5}),
    "fit_kraus": lambda: {"sweep": payne()},
    "KrausLaw": lambda: {"storage_linear": 6e6, "storage_large": 3e6, "critical_strain": 0.02, "exponent": 0.6,
        "loss_peak": 6e5, "loss_large": 4e5, "angular_frequency": 6.0, "temperature": 300.0, "deformation": "tension",
        "covariance": None, "strain_range": None},
    "KrausLaw.complex_modulus": lambda: (kraus(), {"strain": np.array([0.01, 0.1])}),
    "KrausLaw.tensile_strain": lambda: (kraus(), {"strain": 0.01}),
    "contact_strain": lambda: {"slope": 0.1},
    "material_at_strain": lambda: {"material": shifted(), "law": kraus(), "strain": 0.03, "measured_at": 0.02},
    "solve_at_contact_strain": lambda: {"material": shifted(), "law": kraus(), "indenter": CYLINDER, "speed": 0.0,
        "load": 1e3, "temperature": 300.0, "measured_at": None, "accuracy": 1e-2},
    "TractionRuns": lambda: {**READINGS, "source": "", "notes": (), "zero_force": np.zeros(4), "time": np.arange(4.0),
        "step": np.array([0, 0, 1, 1]), "track_radius": np.full(4, 0.02), "steps": (vf.readers.TractionStep(0),
        vf.readers.TractionStep(1))},
    "TractionRuns.select": lambda: (runs(), {"rows": np.array([0, 1]), "steps": 0, "except_steps": None}),
    "compare": lambda: {"measured": curves(), "predicted": curves()},
    "read_friction_curves": lambda: {"path": at("friction.csv"), "columns": {}, "sheet": None},
    "write_friction_curves": lambda: {"curves": curves(), "path": at("friction again.csv")},
    "check_assumptions": lambda: {"material": shifted(), "indenter": CYLINDER, "curves": curves(), "thickness": 1e-2,
        "layer": None, "contact_radius": np.full(N, 1e-3), "rubber": vf.ThermalProperties(0.28, 1150.0, 1700.0,
        "rubber"), "counterbody": vf.ThermalProperties(0.25, 2170.0, 1010.0, "PTFE")},
    "FrictionCurves": lambda: {**COLUMNS, **{name: np.full(N, 0.01) for name in MORE_COLUMNS}, "viscoelastic_upper":
        np.full(N, 0.03), "viscoelastic_freedom": np.full(N, 8.0), "coulomb_freedom": np.full(N, 8.0), "source": "",
        "within_measured_frequencies": np.ones(N), "notes": (), "load_unit": "N", "assumption": ""},
    "FrictionCurves.from_solutions": lambda: (vf.FrictionCurves, {"solutions": [contact()], "source": "predicted"}),
    "FrictionCurves.interval": lambda: (curves(), {"level": 0.9, "of": "viscoelastic"}),
    "FrictionCurves.at_temperature": lambda: (curves(), {"temperature": 300.0}),
    "FrictionCurves.at_load": lambda: (curves(), {"load": 1e3}),
    "ThermalProperties": lambda: {"conductivity": 0.3, "density": 1e3, "heat_capacity": 1e3, "name": "rubber"},
    "Heating": lambda: {"rubber": steel(), "counterface": steel(), "coulomb": 0.3, "slip": 0.1, "track_radius": 0.02,
        "passes": 3, "average": "loss", "branch": "cold", "nominal_radius": 5e-3},
    "MovingHeatSource": lambda: {"power": 1.0, "size": 1e-3, "speed": 0.1, "body": steel(), "shape": "disc",
        "distribution": "uniform"},
    "MovingHeatSource.temperature_at": lambda: (vf.heat.MovingHeatSource(1.0, 1e-3, 0.1, steel()), {"x": [0.0, 1e-4],
        "y":
        0.0}),
    "surface_temperature": lambda: {"heat": np.eye(4), "spacing": 1e-4, "body": steel(), "speed": 0.1, "time": None,
        "thickness": 1e-3, "base": "insulated", "periodic": False},
    "track_temperature": lambda: {"power": 1.0, "body": steel(), "radius": 1e-3, "track_radius": 0.02, "speed": 10.0,
        "passes": [0, 1, 10], "thickness": 0.01, "base": "isothermal", "distribution": "hertz"},
    "ContactAnchor": lambda: {"speed": 0.02, "temperature": 300.0, "load": 1e3, "indentation": None, "contact_area":
        None, "half_width": 1e-3, "error": 0.01},
    "ModulusAnchor": lambda: {"modulus": 8e6, "angular_frequency": 6.0, "temperature": 300.0, "part": "magnitude",
        "error": 0.01},
    "citations": lambda: {"results": rubber()},
    "identify_material": lambda: {"curves": curves(), "indenter": CYLINDER, "load": 1e3, "shift": None, "anchor": None,
        "prior": None, "prior_band": None, "prior_error": 0.02,
        "level_error": 0.0, "common_error": 0.0, "drift_error": 0.0, "coulomb_level_error": 0.0,
        "temperature_error": 0.0, "reference": 300.0, "poisson_ratio": 0.5, "modes": 12,
        "levels": (1.0, 2.0), "limit": 0.05, "samples": 20, "seed": 0, "accuracy": 3e-2, "name": "", "progress": stop,
        "workers": 1},
    "IndentationRecord": lambda: {"time": np.arange(5.0), "load": np.ones(5), "indentation": np.full(5, 1e-4),
        "temperature": 300.0, "control": "load", "error": 1e-6, "start": 0.0, "source": ""},
    "read_indentation": lambda: {"path": at("indentation.csv"), "control": "load", "temperature": 300.0, "error": 1e-6,
        "start": 0.0, "columns": {}, "sheet": None},
    "identify_from_indentation": lambda: {"records": record(), "indenter": vf.Ball(1e-2), "shift": None, "reference":
        300.0, "poisson_ratio": 0.5, "indenter_modulus": 1e9, "indenter_poisson_ratio": 0.3, "radius_error": 0.01,
        "load_error": 0.01, "zero_error": 1e-7, "modes": 8, "limit": 0.05, "samples": 20, "seed": 0, "name": ""},
    "ReboundRecord": lambda: {"speed": np.array([1.0, 2.0]), "temperature": 300.0, "mass": 0.03, "error": 0.01,
        "restitution": np.array([0.6, 0.5]), "contact_time": np.array([1e-3, 9e-4]), "peak_force": np.array([9.0, 9.9]),
        "indentation": np.array([1e-4, 2e-4]), "gravity": 0.0, "source": ""},
    "OscillationRecord": lambda: {"angular_frequency": np.array([1.0, 2.0]), "storage_stiffness": np.array([9e3, 1e4]),
        "loss_stiffness": np.array([1e3, 2e3]), "temperature": 300.0, "indentation": 1e-4, "amplitude": 1e-6, "error":
        0.01, "source": ""},
    "read_rebound": lambda: {"path": at("rebound.csv"), "mass": 0.03, "error": 0.01, "temperature": 300.0, "gravity":
        0.0, "columns": {}, "sheet": None},
    "read_oscillation": lambda: {"path": at("oscillation.csv"), "indentation": 1e-4, "amplitude": 1e-6, "error": 0.01,
        "temperature": 300.0, "columns": {}, "sheet": None},
    "Identified.standard_error": lambda: (from_indentation(), {"angular_frequency": np.array([1.0]), "relative": None}),
    "Identified.to_dataset": lambda: (from_indentation(), {"angular_frequency": np.array([1.0])}),
    "predict_friction": lambda: {"material": shifted(), "indenter": CYLINDER, "speeds": [0.1, 1.0], "temperatures":
        [300.0], "load": 1e3, "loads": None,
        "samples": None, "interface": eyring(), "slip": 0.1, "accuracy": 3e-2, "workers": 1,
        "progress": None, "finest": 2048, "heating": None, "exact": False},
    "shear_stress": lambda: {"curves": rubbed(), "contacts": rubbed(), "shift": None, "reference": 300.0,
        "level_error": 0.0, "area_error": 0.0},
    "ShearStress.law": lambda: (vf.friction.shear_stress(rubbed(), rubbed()), {"kind": "power"}),
    "ShearStress.to_dataset": lambda: (vf.friction.shear_stress(rubbed(), rubbed()), {"law": eyring()}),
    "ConstantShearStress": lambda: {"stress": 3e5, "shift": None, "covariance": np.eye(1), **stress_fit()},
    "PowerShearStress": lambda: {"stress": 3e5, "exponent": 0.2, "speed": 0.1, "shift": wlf(), "covariance": np.eye(2),
        **stress_fit()},
    "EyringShearStress": lambda: {"activation_volume": 2e-26, "speed": 1e-6, "shift": wlf(), "covariance": np.eye(2),
        **stress_fit()},
    "GaussianShearStress": lambda: {"peak": 3e5, "speed": 0.1, "width": 2.0, "shift": wlf(), "covariance": np.eye(3),
        **stress_fit()},
    "InterfaceLaw.standard_error": lambda: (eyring(), {"speed": np.array([0.1, 1.0]), "temperature": 300.0}),
    "InterfaceLaw.interval": lambda: (eyring(), {"speed": 0.1, "temperature": [300.0], "level": 0.95}),
    "InterfaceLaw.extrapolates": lambda: (eyring(), {"speed": [0.1], "temperature": 300.0}),
    "InterfaceLaw.to_dataset": lambda: (eyring(), {"speeds": [0.1], "temperatures": [300.0]}),
    "shift_friction": lambda: {"curves": shifting(), "shift": None, "reference": 300.0, "vertical_shift": None,
        "indenter": None, "load": None, "level_error": 0.0},
    "FrictionMasterCurve.standard_error": lambda: (friction_master_curve(), {"speed": np.array([0.05]), "temperature":
        305.0, "load": 25.0}),
    "FrictionMasterCurve.covers": lambda: (friction_master_curve(), {"speed": np.array([0.05]), "temperature": 305.0,
        "load": 25.0}),
    "compare_shift_factors": lambda: {"found": factors(), "other": wlf()},
    "separate": lambda: {"runs": vf.readers.TractionRuns(**READINGS), "zero": None, "coulomb": None, "outliers": "keep",
        "speed_tolerance": 0.05, "temperature_tolerance": 1.0},
    "read_dma": lambda: {"paths": EXAMPLE / "dma.csv", "deformation": "tension", "temperature": None, "modulus_unit":
        None, "columns": None, "sheet": None, "leave_out_temperatures": [333.15]},
    "read_ramps": lambda: {"paths": EXAMPLE / "dma.csv", "deformation": "tension", "direction": None, "heating_rate":
        0.05, "modulus_unit": None, "columns": {}, "sheet": None},
    "read_amplitude_sweep": lambda: {"paths": at("payne.csv"), "deformation": "shear", "temperature": None,
        "modulus_unit": None, "columns": {}, "sheet": None},
    "read_mtm": lambda: {"paths": EXAMPLE / "mtm.csv", "thermometer": "lube", "columns": None, "sheet": None},
    "read_master_curve": lambda: {"path": at("curve.csv"), "reference": 300.0, "deformation": "tension",
        "poisson_ratio": 0.5, "modulus_unit": None, "columns": None, "sheet": None},
    "open_card": lambda: card_settings(),
    "read_card": lambda: card_settings(),
    "write_card": lambda: {"material": shifted(), "path": at("card"), "format": "abaqus", "poisson_ratio": 0.49,
        "density": 1e3, "temperature_unit": "K", "domain": "time", "material_id": 1, "modulus_unit": "Pa",
        "law": None},
    "catalogue_material": lambda: {"name": "synthetic fluoroelastomer"},
    "Material": lambda: {"spectrum": rubber().spectrum, "shift": wlf(), "poisson_ratio": 0.5, "name": "",
        "vertical_shift": None, "citation": "", "synthetic": False},
    "Material.standard_linear_solid": lambda: (vf.Material, {"E0": 1e6, "E_inf": 1e7, "tau": 1e-3, "poisson_ratio":
        0.5}),
    "Material.at": lambda: (shifted(), {"temperature": 310.0}),
    "Material.at_reference": lambda: (shifted(), {"reference": 310.0}),
    "Material.notes_at": lambda: (shifted(), {"temperature": 310.0}),
    "Material.modes_at": lambda: (shifted(), {"temperature": 310.0}),
    "Material.complex_modulus": lambda: (shifted(), {"angular_frequency": np.array([1.0, 2.0]), "temperature": 310.0}),
    "Arrhenius": lambda: {"activation_energy": 1e5, "reference": 300.0, **fitted(), "covariance": np.eye(1),
        "rivals": np.array([[0.2, 900.0, 200.0]])},
    "InversePolynomial": lambda: {"coefficients": [5000.0, 1e6], "reference": 300.0, **fitted()},
    "VFT": lambda: {"B": 800.0, "T0": 200.0, "reference": 300.0, **fitted()},
    "WLF": lambda: {"C1": 9.0, "C2": 100.0, "reference": 300.0, **fitted()},
    "WLFArrhenius": lambda: {"C1": 17.0, "C2": 51.0, "glass_transition": 255.0, "reference": 300.0, **fitted(),
        "covariance": np.eye(3)},
    "ShiftLaw.log10": lambda: (wlf(), {"temperature": np.array([300.0, 310.0])}),
    "ShiftLaw.standard_error": lambda: (wlf(), {"temperature": 310.0}),
    "ShiftLaw.extrapolates": lambda: (wlf(), {"temperature": [310.0]}),
    "ShiftLaw.valid_at": lambda: (wlf(), {"temperature": [310.0], "above_pole": 1.0}),
    "ShiftLaw.values_at": lambda: (wlf(), {"temperatures": [310.0]}),
    "ShiftLaw.covariance_at": lambda: (wlf(), {"temperatures": [310.0]}),
    "KrausLaw.to_dataset": lambda: (kraus(), {"strain": [1e-3, 0.1]}),
    "ShiftLaw.to_dataset": lambda: (wlf(), {"temperatures": [310.0]}),
    "ParametricLaw.gradient": lambda: (wlf(), {"temperature": [310.0]}),
    "ParametricLaw.with_parameters": lambda: (wlf(), {"parameters": np.array([9.0, 100.0])}),
    "ShiftFactors": lambda: {**table(), "notes": ()},
    "ShiftFactors.to_dataset": lambda: (factors(), {"temperatures": [310.0]}),
    "ShiftFactors.at_reference": lambda: (factors(), {"reference": 305.0}),
    "ShiftFactors.save": lambda: (factors(), {"path": at("saved.csv")}),
    "WLF.at_reference": lambda: (wlf(), {"reference": 310.0}),
    "InversePolynomial.at_reference": lambda: (polynomial(), {"reference": 310.0}),
    "InversePolynomial.with_parameters": lambda: (polynomial(), {"parameters": [4e3, 1e6]}),
    "DensityShift.at_reference": lambda: (vf.rheology.DensityShift(300.0), {"reference": 310.0}),
    "VerticalShiftFactors.at_reference": lambda: (vf.rheology.VerticalShiftFactors(**table()), {"reference": 305.0}),
    "PowerSpectrum.rms_height": lambda: (spectrum(), {"shortest": 2e-5}),
    "PowerSpectrum.rms_curvature": lambda: (spectrum(), {"shortest": 2e-5}),
    "FrictionCurves.select": lambda: (curves(), {"keep": np.ones(len(curves()), dtype=bool)}),
    "ShiftFactors.law": lambda: (factors(), {"kind": "wlf", "above": None, "degree": None}),
    "ShiftFactors.compare_laws": lambda: (factors(), {"above": 295.0}),
    "read_shift_factors": lambda: {"path": at("alpha.csv"), "reference": 300.0, "inverse": False, "columns": None,
        "sheet": None},
    "DensityShift": lambda: {"reference": 300.0, "expansion": 6e-4},
    "OneTemperature": lambda: {"reference": 300.0},
    "VerticalShift.log10": lambda: (vf.rheology.DensityShift(300.0), {"temperature": np.array([300.0, 310.0])}),
    "VerticalShift.to_dataset": lambda: (vf.rheology.DensityShift(300.0), {"temperatures": [310.0]}),
    "VerticalShiftFactors": lambda: table(),
    "VerticalShiftFactors.to_dataset": lambda: (vf.rheology.VerticalShiftFactors(**table()), {"temperatures": [310.0]}),
    "ModulusTable": lambda: {"angular_frequency": np.array([1.0, 10.0]), "storage_modulus": np.array([3e6, 4e6]),
        "loss_modulus": np.array([3e5, 4e5]), "extrapolate": "refuse", "notes": ()},
    "ModulusTable.from_master_curve": lambda: (vf.rheology.ModulusTable, {"master_curve": master_curve(),
        "resolution": 0.05,
        "extrapolate": "refuse"}),
    "ModulusTable.complex_modulus": lambda: (vf.rheology.ModulusTable.from_master_curve(master_curve()),
        at_frequencies()),
    "ModulusTable.compliance": lambda: (vf.rheology.ModulusTable.from_master_curve(master_curve()), at_frequencies()),
    "ModulusTable.shifted": lambda: (vf.rheology.ModulusTable.from_master_curve(master_curve()), {"alpha": 2.0,
        "b": 1.0}),
    "RelaxationSpectrum": lambda: {"E0": 1e6, "E": np.array([9e6]), "tau": np.array([1e-4])},
    **{f"RelaxationSpectrum.{name}": functools.partial(lambda name: (rubber().spectrum.to_relaxation(),
        OF_SPECTRA[name]), name) for name in OF_SPECTRA},
    "RetardationSpectrum": lambda: {"E0": 1e6, **modes(), "fit": None},
    **{f"RetardationSpectrum.{name}": functools.partial(lambda name: (rubber().spectrum, OF_SPECTRA[name]), name) for
        name in OF_SPECTRA},
    "RetardationSpectrum.master_curve_dataset": lambda: (rubber().spectrum, {"master_curve": master_curve()}),
    "fit_retardation_spectrum": lambda: {"master_curve": master_curve(), "tau_ratio": 3.0, "method": "non-negative",
        "modes": None, "regularisation": None, "largest_error": None},
    "check_superposition": lambda: {"fit": superposition()},
    "StepTest": lambda: {"temperature": 300.0, "time": np.array([1.0, 10.0]), "response": np.array([1e-7, 2e-7]),
        "unit": ""},
    "StepTest.thinned": lambda: (steps().tests[0], {"per_decade": 20}),
    "StepTests": lambda: {"tests": steps().tests, "kind": "creep", "deformation": "tension", "source": "", "notes": (),
        "format": ""},
    "StepTests.in_tension": lambda: (steps("shear"), {"poisson_ratio": 0.5}),
    "StepTests.thinned": lambda: (steps(), {"per_decade": 20}),
    "StepMasterCurve": lambda: {"time": np.array([1.0, 10.0]), "response": np.array([1e-7, 2e-7]),
        "temperature": np.full(2, 300.0), "reference": 300.0, "kind": "creep", "notes": ()},
    "RetardationSpectrum.step_curve_dataset": lambda: (rubber().spectrum, {"curve": vf.readers.StepMasterCurve(
        np.array([1.0, 10.0]), np.array([1e-7, 2e-7]), np.full(2, 300.0), 300.0, "creep")}),
    "read_step_tests": lambda: {"paths": at("creep.csv"), "kind": None, "deformation": "tension", "temperature": None,
        "response_unit": None, "columns": None, "sheet": None},
    "superpose": lambda: {"sweeps": sweeps(), "reference": 300.0, "poisson_ratio": 0.5, "vertical": None, "shift": None,
        "fixed": None, "by": "both", "weights": (1.0, 0.5)},
    "MaterialSamples.modulus_band": lambda: (samples(), {**at_frequencies(), "temperature": 300.0, "level": 0.9}),
    "MaterialSamples.to_dataset": lambda: (samples(), {**at_frequencies(), "temperature": 300.0, "level": 0.9}),
    "MaterialSamples.spectrum_band": lambda: (samples(), {"level": 0.9}),
    "MaterialSamples.band": lambda: (samples(), {"value": lambda one: one.spectrum.E0, "level": 0.9}),
    "sample_materials": lambda: {"fit": superposition(), "spectrum": None, "samples": 20, "seed": 0, "law": None,
        "poisson_ratio": 0.5, "name": ""},
    "RoughFriction.interval": lambda: (rough_friction(), {"level": 0.9, "of": "viscoelastic"}),
    "predict_rough_friction": lambda: {"material": rubber(), "surfaces": road(), "speeds": [0.1], "pressure": 5e3,
        "temperatures": None, "interface": vf.friction.ConstantShearStress(3e5), "workers": 1, "progress": None,
        "tolerance": 1e-6, "heating": None},
    "self_affine": lambda: {"hurst": 0.8, **MADE, "shortest": 4e-5, "longest": 1.6e-4, "rolloff": None, "rms_height":
        None, "rms_slope": 0.1},
    "surface_from_spectrum": lambda: {"spectrum": spectrum(), **MADE},
    "line_spectrum": lambda: {"topography": road(), "axis": "x", "per_decade": 12},
    "power_spectrum": lambda: {"topography": road(), "per_decade": 12},
    "contact_statistics": lambda: {"solution": rough_contact()},
    "pressure_distribution": lambda: {"solution": rough_contact(), "edges": np.array([0.0, 1e4, 1e6])},
    "persson_theory": lambda: {"material": rubber(), "spectrum": spectrum(), "speeds": [0.1], "pressure": 1e5,
        "temperatures": None, "gamma": 0.5, "thermal": None, "heating": None,
        "interface": vf.friction.ConstantShearStress(3e5),
        "macroasperity_area": 0.3, "accuracy": 1e-2},
    "read_topography": lambda: {"path": at("scan.csv"), "unit": "um", "spacing": 2e-6, "channel": None, "missing": -1.0,
        "lines": "x"},
    "friction_by_wavelength": lambda: {"solution": rough_contact(), "edges": [1e-5, 4e-5, 1e-4], "per_decade": 6},
    "LineSpectrum": lambda: {"wave_number": Q, "density": 1e-10 * Q**-1.6},
    "LineSpectrum.moment": lambda: (vf.roughness.LineSpectrum(Q, 1e-10 * Q**-1.6), {"order": 2.0}),
    "PowerSpectrum": lambda: {"wave_number": Q, "density": 1e-10 * Q**-3.6, "anisotropy": 0.2},
    "PowerSpectrum.moment": lambda: (spectrum(), {"order": 2.0}),
    "PowerSpectrum.limited": lambda: (spectrum(), {"shortest": 2e-5, "longest": 5e-4}),
    "PowerSpectrum.rms_slope": lambda: (spectrum(), {"shortest": 2e-5}),
    "PowerSpectrum.scaled": lambda: (spectrum(), {"rms_height": None, "rms_slope": 0.2}),
    "PowerSpectrum.self_affine": lambda: (vf.roughness.PowerSpectrum, {"hurst": 0.8, "longest": 1e-3,
        "shortest": 1e-5, "rolloff":
        5e-4, "rms_height": None, "rms_slope": 0.1}),
    "Topography": lambda: {"heights": 1e-6 * np.eye(4), "spacing": 1e-5, "periodic": False, "name": "", "history": ()},
    "Topography.crop": lambda: (road(), {"x": (0.0, 8e-5), "y": None}),
    "Topography.fill": lambda: (road(), {"method": "harmonic"}),
    "Topography.keep_wavelengths": lambda: (road(), {"shortest": 5e-5, "longest": 2e-4}),
    "Topography.remove": lambda: (road(), {"what": "tilt"}),
    "Topography.resample": lambda: (road(), {"spacing": 2e-5}),
    "Topography.to_indenter": lambda: (scan(), {"shape": CYLINDER}),
    "Topography.window": lambda: (scan(), {"edge": 0.1}),
    "compare_results": lambda: {"first": curves(), "second": curves(), "tolerance": 1e-2},
    "load_study": lambda: {"path": at("study.toml")},
    "open_results": lambda: {"path": results()},
    "StudyResults.export": lambda: (vf.open_results(results()), {"form": "csv", "path": at("tables")}),
    "StudyResults.to_csv": lambda: (vf.open_results(results()), {"path": at("tables")}),
    "run_study": lambda: {"path": at("study.toml"), "output": results(), "resume": True, "workers": None,
        "scheduler": None, "finished_only": False},
}
# fmt: on


def good_call(name):
    """Return the callable of a name, and the arguments of its good call."""
    entry = CALLS[name]()
    if not isinstance(entry, tuple):
        return PUBLIC[name], entry
    owner, arguments = entry
    return getattr(owner, name.split(".")[1]), arguments


def call(function, arguments):
    several = [
        key
        for key, one in inspect.signature(function).parameters.items()
        if one.kind is inspect.Parameter.VAR_POSITIONAL
    ]
    named = {key: value for key, value in arguments.items() if key not in several}
    return function(*(arguments[key] for key in several), **named)


#: Names that take no argument, classes to derive from, and what needs a workbook of an instrument.
WITHOUT_CALL = {
    "catalogue",
    "synthetic_fluoroelastomer",
    "InterfaceLaw",
    "ShiftLaw",
    "VerticalShift",
    "read_vendor_law",
}
#: What takes seconds, for what its good call needs.
SLOW = {
    "StudyResults.export",
    "StudyResults.to_csv",
    "open_results",
    "run_study",
}
#: argument -> what it may be, where its annotation does not say it
KINDS = {
    "fitted_range": "numbers", "coefficients": "numbers", "log10_values": "numbers", "levels": "numbers",
    "temperature of ShiftLaw": "numbers", "prior_band": "numbers", "direction": "numbers", "except_steps": "numbers",
    "steps of TractionRuns.select": "numbers", "rows": "numbers", "x of Topography.crop": "numbers",
    "temperature of read_dma": "numbers", "temperature of read_step_tests": "numbers", "temperatures": "numbers",
    "progress": "function", "value": "function", "spacing": "pair", "zero": "pair",
    "coulomb": "pair", "covariance": "numbers", "window": "numbers", "y of Topography.crop": "numbers",
    "temperature of ParametricLaw": "numbers", "parameters": "numbers", "tolerance of predict_rough_friction": "number",
    "layer": "number",
    "finest of predict_friction": "number", "scheduler": "text", "notes": "texts", "history": "texts",
}  # fmt: skip
#: Columns in which NaN stands for what was not measured.
WITH_GAPS = {"strain_amplitude", "zero_force", "time", "track_radius", "heights"}
#: Right, or nothing of viscofric: heights called missing are NaN, a file may keep its temperatures, tables have a place
#: without a path, and what a user's own function raises is the user's.
RIGHT = {
    ("read_topography", "missing", "0"),
    ("read_topography", "missing", "1"),
    ("read_dma", "temperature", "list of None"),
    ("read_step_tests", "temperature", "list of None"),
    ("read_amplitude_sweep", "temperature", "list of None"),
    ("StudyResults.to_csv", "path", "None"),
    ("FrictionCurves.select", "keep", "booleans"),
    ("surface_from_spectrum", "spectrum", "class"),
}


def kind_of(name, key, given, annotation):
    """Return what an argument is: one number or many of them, a pair, a flag, text, a path, a function or an object."""
    for place in (key, f"{key} of {name}", f"{key} of {name.split('.')[0]}"):
        if place in KINDS:
            return KINDS[place]
    plain = annotation.removesuffix(" | None")
    if plain == "bool":
        return "flag"
    if "Path" in plain:
        return "path"
    if plain == "str" or plain.startswith(("Literal", "Deformation", "Extrapolation", "Method", "Part", "CardFormat")):
        return "text"
    if plain in {"float", "int", "Quantity"}:
        return "number"
    if isinstance(given, np.ndarray) or plain.startswith(("Quantities", "ArrayLike", "Array", "Any")):
        return "numbers"
    return "object"


class Thing:
    """Neither a number nor text."""

    def __repr__(self):
        return "Thing()"


#: What is no number, nor several.
NO_NUMBERS = {
    "complex": 1.0 + 2.0j,
    "NumPy's complex": np.complex128(1.0 + 2.0j),
    "complex array": np.array([1.0 + 2.0j]),
    "masked": np.ma.masked,
    "masked array": np.ma.array([1.0, 2.0], mask=[False, True]),
    "NaN": float("nan"),
    "too large": 10**400,
    "word": "abc",
    "thing": Thing(),
    "ragged": [[1.0, 2.0], [3.0]],
}
MORE_NO_NUMBERS = {
    "complex array without dimensions": np.array(1.0 + 2.0j),
    "masked array without dimensions": np.ma.array(1.0, mask=True),
    "unknown unit": "1 xyz",
    "bytes": b"1",
    "class": float,
    "words": ["abc", "def"],
    "array of words": np.array(["abc"]),
    "dictionary": {"a": 1.0},
    "set": {1.0},
    "date": np.datetime64("2020-01-01"),
    "duration": np.timedelta64(1, "s"),
    "list of too large": [10**400],
    "list of None": [None],
    "list of NaN": [float("nan")],
    "list of masked": [1.0, np.ma.masked],
}
SEVERAL = {"nothing in it": [], "two": [1.0, 2.0], "two in an array": np.array([1.0, 2.0]), "true": True}
OBJECTS = {
    "number": 3.0,
    "word": "abc",
    "thing": Thing(),
    "NaN": float("nan"),
    "masked": np.ma.masked,
    "dictionary": {"a": 1},
}
MORE_OBJECTS = {"list": [3.0], "array": np.array([1.0]), "complex": 1j, "class": float, "bytes": b"a", "true": True}
NO_FUNCTION = {key: one for key, one in (OBJECTS | MORE_OBJECTS).items() if key != "class"}
NO_TEXT = {key: one for key, one in (OBJECTS | MORE_OBJECTS).items() if key != "word"}
NO_FLAG = {"word": "no", "two": 2, "NaN": float("nan"), "list": [], "array": np.array([True, False]), "thing": Thing()}
NO_PATH = {**{key: one for key, one in NO_TEXT.items() if key != "bytes"}, "nothing": "", "null": "a\0b"}
#: What may be right: then nothing of the result is NaN.
PERHAPS = {
    "-1": -1,
    "-5.0": -5.0,
    "0": 0,
    "1": 1,
    "10.0": 10.0,
    "infinite": float("inf"),
    "huge": 1e300,
    "tiny": 1e-300,
    "denormal": 1e-310,
    "largest": 1e100,
    "smallest": 1e-100,
}


def spoiled(good, gaps):
    """Return copies of an array with what is no number in its first place; NaN too, where there may be no gaps."""
    array = np.asarray(good)
    first = np.arange(array.size).reshape(array.shape) == 0
    bad = {
        "complex copy": array + 1j,
        "masked copy": np.ma.array(array, mask=first),
        "words": array.astype(str),
        "booleans": array > 0.0,
        "thing in it": np.where(first, Thing(), array.astype(object)),
        "too large in it": np.where(first, 10**400, array.astype(object)),
    }
    return bad if gaps else {**bad, "NaN in it": np.where(first, np.nan, array)}


def resized(good):
    """Return copies of an array that may be of the wrong shape or sign, or too large."""
    array = np.asarray(good, dtype=float)
    first = np.arange(array.size).reshape(array.shape) == 0
    return {
        "one too many": np.concatenate([array, array[:1]]),
        "one more dimension": np.stack([array, array]),
        "nothing": [],
        "negative": -array,
        "infinite in it": np.where(first, np.inf, array),
        "denormal in it": np.where(first, 1e-310, array),
        "smallest in it": np.where(first, 1e-100, array),
        "largest in it": np.where(first, 1e100, array),
    }


def bad_values(name, key, good, parameter, *, everything):
    """Return values that must be refused, and those that may be right, by what is wrong with them."""
    annotation = str(parameter.annotation)
    kind = kind_of(name, key, good, annotation)
    numbers = NO_NUMBERS | (MORE_NO_NUMBERS if everything else {})
    refused = {
        "number": numbers | SEVERAL,
        "numbers": numbers,
        "pair": numbers,
        "flag": NO_FLAG,
        "text": NO_TEXT,
        "texts": {**NO_TEXT, "word": "abc"},
        "path": NO_PATH,
        "function": NO_FUNCTION,
        "object": OBJECTS | (MORE_OBJECTS if everything else {}),
    }[kind]
    optional = parameter.default is None or annotation.endswith("None") or parameter.kind is parameter.VAR_KEYWORD
    refused = refused if optional else {**refused, "None": None}
    perhaps = PERHAPS if kind == "number" else {}
    if kind == "numbers" and isinstance(good, np.ndarray) and good.ndim:
        refused = refused | spoiled(good, key in WITH_GAPS)
        if "strain" in key or key in PURE_COLUMNS:  # a pure number may be text, such as "0.5 %"
            del refused["words"]
        perhaps = resized(good)
    if key in WITH_GAPS:
        refused = {place: one for place, one in refused.items() if "NaN" not in place}
    return refused, perhaps if everything else {}


def holds_nan(value, depth=0):
    """Tell whether there is NaN in a result, or in what it holds."""
    if isinstance(value, (float, complex, np.ndarray)):
        array = np.asarray(value)
        return array.dtype.kind in "fc" and bool(np.isnan(array).any())
    if depth > 3:
        return False
    if isinstance(value, (tuple, list)):
        return any(holds_nan(one, depth + 1) for one in value)
    if dataclasses.is_dataclass(value):
        return any(holds_nan(getattr(value, field.name), depth + 1) for field in dataclasses.fields(value))
    return False


def outcome(function, arguments):
    """Return what is wrong with how a call ends, or "result"; None if it is refused in one sentence of viscofric."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.filterwarnings("ignore", category=UserWarning)  # of what a card cannot hold
            result = call(function, arguments)
    except AcceptedError:
        return "result"
    except vf.ViscofricError as error:
        said = str(error)  # no array or object is printed in full
        return None if "\n" not in said and len(said) <= LONGEST_SENTENCE else f"not one sentence: {said[:100]}"
    except Exception as error:  # noqa: BLE001 - any other is what is looked for
        return f"{type(error).__name__}: {error}"[:100]
    return "NaN in the result" if holds_nan(result) else "result"


def defects(name, *, everything):
    """Attack every argument of a name; return how many calls were made and those that end badly."""
    function, good = good_call(name)
    usual = outcome(function, good)
    assert usual in {"result", "NaN in the result"}, usual
    parameters = inspect.signature(function).parameters
    anything = inspect.Parameter("settings", inspect.Parameter.VAR_KEYWORD, annotation="object")
    calls, found = 0, []
    for key, value in good.items():
        refused, perhaps = bad_values(name, key, value, parameters.get(key, anything), everything=everything)
        for place, bad in (refused | perhaps).items():
            calls += 1
            end = outcome(function, {**good, key: bad})
            right = {None} if place in refused else {None, "result", usual}
            if end not in right and (name, key, place) not in RIGHT:
                found.append(f"{key} = {place}: {end}")
    return calls, found


@pytest.fixture(autouse=True)
def _own_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("name", [name for name in CALLS if name not in SLOW])
def test_bad_arguments_are_refused_in_one_sentence(name):
    assert defects(name, everything=False)[1] == []


@pytest.mark.exhaustive
@pytest.mark.parametrize("name", CALLS)
def test_no_bad_argument_ends_in_nonsense(name):
    assert defects(name, everything=True)[1] == []


#: Units that some number of the public names has, and percent of pure numbers.
UNITS = (
    *("%", "m", "N", "N/m", "m/s", "K", "Pa", "s", "rad/s", "rad", "delta_degC", "J/mol", "kg", "m/s**2", "W/m/K"),
    *("kg/m**3", "J/kg/K", "1/m", "m**3", "m**4", "1/Pa", "K/s", "W", "W/m**2", "m**2", "1/K", "percent/K"),
)
#: Counts and places, directions, and rows and matrices of pure numbers or of several units; the response of a step test
#: is a compliance or a modulus, by the kind that the tests together have.
WITHOUT_UNIT = {
    "threads", "most_products", "finest", "most_periods", "rebounds", "replicate", "replicates", "step", "rows",
    "steps", "modes", "samples", "seed", "workers", "material_id", "per_decade", "shape", "passes of track_temperature",
    "direction", "covariance", "coefficients", "parameters", "log10_values", "weights", "response",
    "rivals",
}  # fmt: skip


def with_unit(value, unit):
    """Return numbers as text with a unit, in their shape."""
    if isinstance(value, (np.ndarray, list, tuple)):
        return [with_unit(one, unit) for one in value]
    return f"{float(100.0 * value if unit == '%' else value)!r} {unit}"


def is_number(value):
    """Tell whether a value is one plain number or several."""
    if isinstance(value, (list, tuple)):
        return bool(value) and all(map(is_number, value))
    if isinstance(value, np.ndarray):
        return value.size > 0 and value.dtype.kind in "fi"
    return isinstance(value, (float, int)) and not isinstance(value, bool)


def taken(function, arguments):
    """Return whether a call takes its arguments; any error but viscofric's own ends the test."""
    try:
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", category=UserWarning)
            call(function, arguments)
    except AcceptedError:
        return True
    except vf.ViscofricError:
        return False
    return True


#: Units that numbers of a name had before: most numbers of one name have one unit, wherever they are.
UNIT_OF = {}


@pytest.mark.parametrize("name", [name for name in CALLS if name not in SLOW])
def test_text_with_a_unit_is_taken_wherever_a_number_is(name):
    """All numbers of a call at once, if each has its usual unit here, too; else one after the other."""
    function, good = good_call(name)
    numbers = [key for key, value in good.items() if is_number(value) and not {key, f"{key} of {name}"} & WITHOUT_UNIT]

    def find_unit(key):
        units = sorted(UNITS, key=lambda unit: unit != UNIT_OF.get(key))
        found = next((unit for unit in units if taken(function, {**good, key: with_unit(good[key], unit)})), None)
        assert found, f"{key} = {good[key]!r}"
        UNIT_OF[key] = found

    new = [key for key in numbers if key not in UNIT_OF]
    for key in new:
        find_unit(key)
    if new != numbers and not taken(function, {**good, **{key: with_unit(good[key], UNIT_OF[key]) for key in numbers}}):
        for key in numbers:
            find_unit(key)


def test_every_public_name_is_attacked():
    wanted = {name for name in PUBLIC if name not in RETURNED and not issubclass_of_error(name)}
    wanted |= {name for name, _ in methods() if "." in name}
    assert wanted - set(CALLS) == WITHOUT_CALL
    for name in set(CALLS) & wanted:
        function, good = good_call(name) if name not in SLOW else (None, None)
        if function is not None:
            left_out = set(inspect.signature(function).parameters) - set(good) - {"settings", "progress"}
            assert not left_out, f"{name}: {left_out}"


def issubclass_of_error(name):
    return inspect.isclass(PUBLIC[name]) and issubclass(PUBLIC[name], Exception)


@pytest.mark.parametrize(
    ("what", "ask"),
    [
        ("a grid of a contact", lambda: vf.solve_steady(rubber(), vf.Ball(1e-2), speed=1.0, load=1.0, grid=10**9)),
        ("a made surface", lambda: made(shape=(10**9, 10**9))),
        ("a made profile", lambda: made(shape=10**9)),
        ("heights resampled", lambda: road().resample(1e-14)),
        ("classes of pressure", lambda: vf.roughness.pressure_distribution(rough_contact(), 10**12)),
        ("a window of a field", lambda: vf.contact.surface_displacement(
            **on_cells(), **modes(), speed=1.0, poisson_ratio=0.5, behind=1e9
        )),
    ],
)  # fmt: skip
def test_what_no_memory_holds_is_refused_before_it_is_asked_for(what, ask):
    before = time.perf_counter()
    with pytest.raises(vf.InputError):
        ask()
    assert time.perf_counter() - before < 1.0, what  # s; what is asked for would take hours


def test_a_numpy_header_of_ten_trillion_heights_is_refused_before_memory_is_asked_for(tmp_path):
    header = io.BytesIO()
    np.lib.format.write_array_header_1_0(header, {"descr": "<f8", "fortran_order": False, "shape": (10**13,)})
    (tmp_path / "scan.npy").write_bytes(header.getvalue() + bytes(80))
    with refused("damaged", vf.DataFileError, naming="1e+13"):
        vf.read_topography(tmp_path / "scan.npy", spacing=1e-6)
