"""
Thin layer on a rigid base
==========================

Rubber on a metal core, a coating, the disc of a tribometer: many rubber bodies are thin. A base supports the rubber
from below, so that indentation and friction are smaller. Which thickness is enough for the half-space assumption?
"""

# %%
# The same ball on the half-space, and on layers bonded to their base, from a quarter of the contact half-width to
# sixteen times as thick. The material is synthetic.

import matplotlib.pyplot as plt
import numpy as np

import viscofric as vf

rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
ball = vf.Ball(radius="10 mm")
contact = {"speed": "1 m/s", "load": "0.1 N", "accuracy": 3e-3}
half_space = vf.solve_steady(rubber, ball, **contact)

relative = np.geomspace(0.25, 16.0, 7)
thickness = relative * half_space.half_width  # m
layers = [vf.solve_steady(rubber, ball, layer=vf.Layer(one, bonded=True), **contact) for one in thickness]

# %%
# The friction of this material depends on the base much less than the indentation does: its memory length is 1 mm, no
# more than the contact's width, and energy is dissipated near the contact, but the rubber deforms far below it. On a
# layer of four half-widths (dashed) friction is 2.5 % lower and the indentation 24 % smaller, on one of eight 0.4 % and
# 13 %. The effect extends to thicker layers if the memory length exceeds the layer thickness, and if the material has
# many modes: the friction of the synthetic fluoroelastomer is up to 8 % lower on a layer of four half-widths.
# ``vf.check_assumptions(…, thickness=…)`` estimates the effect.

figure, axes = plt.subplots(figsize=(7.0, 4.3), layout="constrained")
for name, colour, marker, values, limit in (
    ("friction coefficient", "C0", "o", [one.friction_coefficient for one in layers], half_space.friction_coefficient),
    ("indentation", "C2", "s", [one.indentation for one in layers], half_space.indentation),
):
    axes.semilogx(relative, np.array(values) / limit, marker=marker, color=colour, label=name)
axes.axhline(1.0, color="0.5", linewidth=0.8)
axes.axvline(4.0, color="0.5", linewidth=0.8, linestyle="--")
axes.set_xticks(relative, [f"{one:g}" for one in relative], minor=False)
axes.set_xticks([], minor=True)
axes.set_ylim(0.0, 1.05)
axes.set_xlabel("thickness of the layer over half the width of the contact on the half-space")
axes.set_ylabel("of the value on the half-space")
axes.legend(frameon=False)

# %%
# The same in numbers:

for depth, one in zip(relative, layers, strict=True):
    friction, indentation = one.friction_coefficient, 1e3 * one.indentation
    print(f"{depth:5g} half widths: friction {friction:.5f}, indentation {indentation:.4f} mm")
print(f"on the half-space: friction {half_space.friction_coefficient:.5f}")
friction_on_thinnest = layers[0].friction_coefficient

plt.show()
