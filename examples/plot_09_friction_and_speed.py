"""
Friction, predicted and measured (the paper's Figure 6)
=======================================================

A mini-traction machine rolls a ball on a rubber disc at several temperatures. With the signs of the speeds, its
traction force is parted into Coulomb friction, which turns with the slip, and viscoelastic friction, which turns with
the rubber. The latter is also what a contact solver predicts from the modulus alone, without anything to adjust.
"""

# %%
# Both measurements are **synthetic**: sweeps of a dynamic mechanical analyser, and runs of a traction machine,
# calculated for the built-in fluoroelastomer, with noise. First the runs: four configurations of signs, eight
# replicates each.

from importlib.resources import files

import matplotlib.pyplot as plt

import viscofric as vf
from viscofric import report
from viscofric.report.house_style import mark_synthetic

example = files("viscofric") / "example"
measured = vf.separate(vf.read_mtm(example / "mtm.csv"))

# %%
# Then the rubber, from the sweeps, and with it the friction at the measured speeds and temperatures. Drawing the rubber
# forty times within the errors of the sweeps gives the 95 % band of the prediction.

fit = vf.superpose(vf.read_dma(example / "dma.csv", deformation="tension"), reference="30 degC")
spectrum = vf.fit_retardation_spectrum(fit.master_curve)
rubber = vf.Material(spectrum, shift=fit.shift_factors, poisson_ratio=0.5)

predicted = vf.predict_friction(
    rubber,
    vf.Ball(radius="9.525 mm"),
    speeds=measured.speeds,
    temperatures=measured.temperatures,
    load="25 N",
    accuracy=3e-3,
    samples=vf.sample_materials(fit, spectrum, samples=40, seed=1),
)

# %%
# Viscoelastic friction falls with speed, and rises with temperature: in this window the loss modulus falls with
# frequency. Points are the means of the replicates with the scatter of one standard deviation, lines the prediction
# with its band.

figure, axes = plt.subplots(figsize=(7.5, 5.2), layout="constrained")
report.plot_friction_curves(axes, predicted, measured)
mark_synthetic([axes])

# %%
# How well do they agree?

agreement = vf.compare(measured, predicted)
print(f"predicted less measured: {100 * agreement.bias:+.2f} % in the mean, {100 * agreement.rms:.2f} % rms")
print(f"within twice the standard error: {100 * agreement.share_within_error:.0f} % of {agreement.points} points")

# %%
# Coulomb friction, the other part, knows nothing of speed and temperature here; 0.045 was put in.

figure, axes = plt.subplots(figsize=(7.5, 3.6), layout="constrained")
report.plot_coulomb_friction(axes, measured)
axes.set_ylim(0.0, 0.05)
mark_synthetic([axes])

friction = float(predicted.at_temperature("60 degC").viscoelastic[0])
print(f"predicted at 60 °C and {1e3 * predicted.speed[0]:.0f} mm/s: {friction:.5f}")

plt.show()
