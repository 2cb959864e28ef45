"""
Friction of another contact from its interface
==============================================

Coulomb friction of a dry contact is a shear stress of the interface on the contact area. Separated friction of a ball
and its solved contacts give that stress; a law fitted to it predicts the total friction of other loads and shapes, with
its parts: hysteresis of the rubber, and shear of the interface.
"""

# %%
# **Synthetic** Coulomb friction of a ball that rolls with 10 % of slip, with 2 % of noise,
# made from a planted interface.

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

import viscofric as vf
from viscofric import report

rubber, ball = vf.synthetic_fluoroelastomer(), vf.Ball(radius="9.525 mm")
planted = vf.friction.GaussianShearStress(
    "0.15 MPa", "1 mm/s", 1.2, shift=vf.Arrhenius("80 kJ/mol", reference="60 degC")
)
contacts = vf.predict_friction(
    rubber,
    ball,
    speeds=np.geomspace(0.02, 0.2, 6),
    temperatures=["45 degC", "60 degC", "75 degC"],
    load="5 N",
    accuracy=1e-2,
)
slip = 0.1 * contacts.speed
coulomb = planted(slip, contacts.temperature) / contacts.mean_pressure
noise = 0.02 * coulomb
measured = replace(
    contacts,
    coulomb=coulomb + noise * np.random.default_rng(7).standard_normal(len(contacts)),
    coulomb_error=noise,
    slip=slip,
    source="SYNTHETIC",
)

# %%
# The shear stress, and the laws that describe it. Each law has an activation energy of its own.

stress = vf.friction.shear_stress(measured, contacts, reference="60 degC")
laws = stress.compare_laws()
print(laws.explanation)
print(laws.best)

figure, axes = plt.subplots(figsize=(7.5, 4.6), layout="constrained")
fitted = [row.law for row in laws.rows if row.law is not None]
report.plot_shear_stress(axes, stress, sorted(fitted, key=lambda law: law is not laws.best), synthetic=True)
report.mark_synthetic([axes])

# %%
# Total friction of a cylinder in pure sliding, with its parts. The error bars have the errors of the law and of the
# solved contact; the shear stress is taken to be independent of pressure.

cylinder = vf.Cylinder(radius="3 mm")
case = {"temperatures": "60 degC", "load": "200 N/m", "accuracy": 1e-2}
friction = vf.predict_friction(rubber, cylinder, speeds=np.geomspace(1e-3, 2e-2, 6), **case, interface=laws.best)
print(*friction.notes, sep="\n")

figure, axes = plt.subplots(figsize=(7.5, 4.2), layout="constrained")
report.plot_friction_parts(axes, friction)
report.mark_synthetic([axes])

truth = vf.predict_friction(rubber, cylinder, speeds=friction.speed[[-1]], **case, interface=planted)
ratio = float(friction.total[-1] / truth.total[0])
error = float(friction.total_error[-1] / truth.total[0])
print(f"total friction over that of the planted interface: {ratio:.3f} ± {error:.3f}")

plt.show()
