"""
Material identified from friction
=================================

Friction at several speeds and temperatures depends on the modulus over many decades of frequency. The inverse problem
infers the spectrum whose contacts have the measured friction. Friction hardly determines the magnitude of the modulus,
since a stiffer rubber with slightly more loss has the same friction; therefore one known modulus is given.
"""

# %%
# **Synthetic** friction of the built-in fluoroelastomer with 1 % of noise, as in the example on shift factors.

import matplotlib.pyplot as plt
import numpy as np

import viscofric as vf
from viscofric import report

planted = vf.synthetic_fluoroelastomer()
ball = vf.Ball(radius="15 mm")
exact = vf.predict_friction(
    planted,
    ball,
    speeds=np.geomspace(0.02, 0.2, 6),
    temperatures=[f"{celsius} degC" for celsius in (40, 46, 52, 60, 68)],
    load="20 N",
    accuracy=1e-2,
)
noise = 0.01 * exact.viscoelastic
measured = vf.FrictionCurves(
    speed=exact.speed,
    temperature=exact.temperature,
    load=exact.load,
    viscoelastic=exact.viscoelastic + noise * np.random.default_rng(4).standard_normal(len(exact)),
    viscoelastic_error=noise,
    viscoelastic_scatter=3.0 * noise,
    replicates=np.full(len(exact), 9),
    source="SYNTHETIC",
)

# %%
# The anchor is a single measurement of the modulus: \|E\| at 1 Hz and 60 °C. Shift factors are
# found in the same fit.

modulus = abs(planted.complex_modulus(2.0 * np.pi, "60 degC"))
anchor = vf.friction.ModulusAnchor(modulus, "1 Hz", "60 degC")
found = vf.identify_material(measured, indenter=ball, anchor=anchor, reference="60 degC", samples=40, accuracy=3e-3)
print(found)

# %%
# The identified modulus with its 95 % band; grey are the frequencies over which friction determines it to 5 %. The
# dashed lines are the planted material.

figure, axes = plt.subplots(figsize=(7.5, 4.8), layout="constrained")
report.plot_identified_modulus(axes, found, vf.Material(planted.modes_at("60 degC"), name="planted"))
report.mark_synthetic([axes])

# %%
# The identified material can be used like any other. Its friction, at the measured points and between them:

figure, axes = plt.subplots(figsize=(7.5, 4.6), layout="constrained")
report.plot_friction_curves(axes, found.friction, measured)
report.mark_synthetic([axes])

middle = np.sqrt(found.identified.low * found.identified.high)
ratio = float(abs(found.material.complex_modulus(middle)) / abs(planted.complex_modulus(middle, "60 degC")))
print(f"|E| at {middle:.1f} rad/s over the planted one: {ratio:.3f}")

plt.show()
