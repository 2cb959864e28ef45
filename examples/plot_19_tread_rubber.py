"""
Tread rubber on a rough track
=============================

Friction of a tread rubber from 1e-6 to 10 m/s: its hysteresis from solved contacts and from Persson's theory with the
same inputs, the friction of the interface on the contact area, and heat, which moves and lowers the maximum.
"""

# %%
# The built-in **synthetic** tread rubber slides on three generated tracks with waves of 256 to 8 µm. The interface has
# a given, **synthetic** law of shear stress, whose level has a standard error of 10 %.

import matplotlib.pyplot as plt
import numpy as np

import viscofric as vf
from viscofric import report
from viscofric.report.figures.rough import plot_friction_by_cut_off, plot_rough_friction
from viscofric.report.figures.style import mark_synthetic

rubber = vf.catalogue_material("synthetic tread rubber")
waves = {"rolloff": "64 um", "shortest": "8 um", "rms_slope": 0.25}
tracks = [vf.self_affine(0.8, shape=(256, 256), spacing="1 um", seed=seed, **waves) for seed in range(3)]
spectrum = vf.PowerSpectrum.self_affine(0.8, longest="256 um", **waves)
interface = vf.GaussianShearStress(
    "0.3 MPa",
    "6 mm/s",
    2.0,
    shift=vf.Arrhenius("90 kJ/mol", reference="20 degC"),
    covariance=np.diag([0.03e6**2, 0.0, 0.0]),
)
contact = {"temperatures": "20 degC", "pressure": "0.4 MPa"}

# %%
# **Two methods.** Points are solved contacts, lines Persson's theory with the spectrum of the tracks. Up to the maximum
# solved friction lies between two versions of the theory. Beyond it, where less than 2 % of the surface touches, the
# theory misses the fall of friction.

solved = vf.predict_rough_friction(rubber, tracks, speeds=np.geomspace(1e-6, 10.0, 15), **contact, interface=interface)
speeds = np.geomspace(1e-6, 10.0, 43)
theories = {
    f"Persson, γ = {gamma:g}": vf.persson_theory(rubber, spectrum, speeds=speeds, gamma=gamma, **contact)
    for gamma in (0.5, 1.0)
}
figure, (left, right) = plt.subplots(1, 2, figsize=(11.0, 4.3), layout="constrained")
plot_rough_friction(left, solved, theories)
plot_rough_friction(right, solved, {"Persson": theories["Persson, γ = 1"]}, area=True)
mark_synthetic([left, right])

# %%
# **Two parts.** Friction of the interface is its shear stress on the solved contact area. It is the larger part at low
# speed, where the area is large. The bars contain the scatter of the tracks and the error of the law.

figure, axes = plt.subplots(figsize=(7.5, 4.2), layout="constrained")
report.plot_friction_parts(axes, solved)
mark_synthetic([axes])
print(*solved.notes, sep="\n")

# %%
# **Heat.** Contacts on one of the tracks now have the temperature to which friction heats them, with the mean heat of
# a nominal contact of 10 mm radius. Each is the isothermal one at a lower reduced speed. The maximum falls because
# warming outruns the speed.

bodies = {
    "rubber": vf.ThermalProperties("0.25 W/m/K", "1200 kg/m**3", "1600 J/kg/K", "rubber"),
    "counterface": vf.ThermalProperties("2.5 W/m/K", "2650 kg/m**3", "800 J/kg/K", "granite"),
}
heating = vf.Heating(**bodies, nominal_radius="10 mm")
few = np.geomspace(1e-4, 10.0, 6)
warm = vf.predict_rough_friction(rubber, tracks[0], speeds=few, **contact, interface=interface, heating=heating)
figure, axes = plt.subplots(figsize=(7.5, 4.2), layout="constrained")
plot_rough_friction(axes, {"isothermal": solved, "heated": warm})
mark_synthetic([axes])
for speed, rise in zip(few, warm.temperature_rise[0].mean(axis=-1), strict=True):
    print(f"{speed:8.2g} m/s: {rise:5.2f} K warmer")

# %%
# A road also has waves up to millimetres, too long to be solved together with the short ones. Flash temperatures of the
# theory, by the loss alone and with Coulomb friction of 0.3, move the maximum to lower speed and lower it.

road = vf.PowerSpectrum.self_affine(0.8, longest="8 mm", rolloff="4 mm", shortest="4 um", rms_slope=0.4)
heatings = {
    "isothermal": None,
    "heated by the loss": vf.Heating(**bodies),
    "and by Coulomb friction": vf.Heating(**bodies, coulomb=0.3),
}
theories = [vf.persson_theory(rubber, road, speeds=speeds[::3], heating=one, **contact) for one in heatings.values()]
figure, axes = plt.subplots(figsize=(7.5, 4.2), layout="constrained")
plot_friction_by_cut_off(axes, theories, list(heatings))
mark_synthetic([axes])
for name, theory in zip(heatings, theories, strict=True):
    friction = theory.friction_coefficient[0]
    print(f"{name}: at most {friction.max():.3f}, at {theory.speed[friction.argmax()]:.2g} m/s")

# %%
# In full contact the theory is exact. The difference is that between the integral of the spectrum and the sum over the
# waves of a track.

pressed = {"speeds": "1 mm/s", "temperatures": "20 degC", "pressure": "100 MPa"}
full = vf.predict_rough_friction(rubber, tracks[0], **pressed)
exact = vf.persson_theory(rubber, spectrum, **pressed)
ratio = float(exact.friction_coefficient[0, 0] / full.friction_coefficient[0, 0, 0])
print(f"full contact: theory over solution {ratio:.4f}")

plt.show()
