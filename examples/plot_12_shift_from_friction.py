"""
Shift factors from friction
===========================

Friction curves of neighbouring temperatures that overlap after a shift determine the shift factor
:math:`\\alpha(T)` by themselves, without DMA data. The result can be compared with the shift factors of the modulus.
"""

# %%
# Friction of a ball between 20 and 200 mm/s, **synthetic**: solved for the built-in fluoroelastomer at seven
# temperatures, with 1 % of noise. The temperatures are close enough for neighbouring curves to share some values.

import matplotlib.pyplot as plt
import numpy as np

import viscofric as vf
from viscofric import report

rubber = vf.synthetic_fluoroelastomer()
exact = vf.predict_friction(
    rubber,
    vf.Ball(radius="15 mm"),
    speeds=np.geomspace(0.02, 0.2, 8),
    temperatures=[f"{celsius} degC" for celsius in (40, 46, 52, 60, 68, 78, 90)],
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
# All temperatures are fitted at once by one smooth curve. Each shift factor has a standard error.

master = vf.shift_friction(measured, reference="60 degC")
found = master.shift_factors
print(master.overlap.sentence)

figure, (above, below) = plt.subplots(2, 1, figsize=(7.5, 7.4), layout="constrained")
report.plot_friction_curves(above, measurement=measured)
report.plot_friction_master_curve(below, measurement=master)
report.mark_synthetic([above])
report.mark_synthetic([below])

# %%
# The comparison with the law of the modulus from which the friction was computed tests the agreement within the errors.

agreement = vf.friction.compare_shift_factors(master, rubber.shift)
print(agreement)

figure, axes = plt.subplots(figsize=(7.0, 4.3), layout="constrained")
report.plot_shift_comparison(axes, found, rubber.shift)

# %%
# A law fitted to the factors interpolates and extrapolates in temperature:

law = found.law("wlf")
log10_at_90 = float(found.log10("90 degC"))
print(f"log10 α from 60 to 90 °C: {log10_at_90:.3f} from friction, ", end="")
print(f"{float(rubber.shift.at_reference('60 degC').log10('90 degC')):.3f} planted; as a law: {law}")

plt.show()
