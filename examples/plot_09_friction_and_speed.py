"""
Friction, predicted and measured (the paper's Figure 6)
=======================================================

A mini-traction machine rolls a ball on a rubber disc at several temperatures. The signs of the speeds separate its
traction force into Coulomb friction, which changes sign with the slip, and viscoelastic friction, which changes sign
with the motion of the rubber. The contact solver predicts the latter from the modulus alone, without adjustment.
"""

# %%
# Both measurements are **synthetic**: sweeps of a dynamic mechanical analyser, and runs of a traction machine,
# calculated for the built-in fluoroelastomer, with noise. First the runs: four configurations of signs, four
# replicates each.

from importlib.resources import files

import matplotlib.pyplot as plt

import viscofric as vf
from viscofric import report

example = files("viscofric") / "example"
measured = vf.separate(vf.read_mtm(example / "mtm.csv"))

# %%
# Then the material, from the sweeps, and its friction at the measured speeds and temperatures. Forty bootstrap samples
# of the material, within the errors of the sweeps, give the 95 % band of the prediction.

fit = vf.superpose(vf.read_dma(example / "dma.csv", deformation="tension"), reference="30 degC")
spectrum = vf.fit_retardation_spectrum(fit)
rubber = vf.Material(spectrum, shift=fit.shift_factors, poisson_ratio=0.5)

predicted = vf.predict_friction(
    rubber,
    vf.Ball(radius="9.525 mm"),
    speeds=measured.speeds,
    temperatures=measured.temperatures,
    load="10 N",
    accuracy=3e-3,
    samples=vf.sample_materials(fit, spectrum, samples=40, seed=1),
)

# %%
# Warm, viscoelastic friction falls with speed, as the loss modulus falls with frequency there; cold, it rises
# towards the glass transition. Points are the means of the replicates with the scatter of one standard deviation,
# lines the prediction with its band.

figure, axes = plt.subplots(figsize=(7.5, 5.2), layout="constrained")
report.plot_friction_curves(axes, predicted, measured)
report.mark_synthetic([axes])

# %%
# Agreement in numbers:

agreement = vf.compare(measured, predicted)
print(f"predicted minus measured: {100 * agreement.bias:+.2f} % on average, {100 * agreement.rms:.2f} % rms")
print(f"within twice the standard error: {100 * agreement.share_within_error:.0f} % of {agreement.points} points")

# %%
# Coulomb friction is a shear stress times the contact area over the load. The planted shear stress has a maximum over
# the logarithm of the slip speed, which a higher temperature moves to higher speeds.

figure, axes = plt.subplots(figsize=(7.5, 3.6), layout="constrained")
report.plot_coulomb_friction(axes, measured)
axes.set_ylim(0.0, 0.04)
report.mark_synthetic([axes])

friction = float(predicted.at_temperature("65 degC").viscoelastic[0])
print(f"predicted at 65 °C and {1e3 * predicted.speed[0]:.0f} mm/s: {friction:.5f}")

plt.show()
