"""
Uncertainty of a prediction
===========================

Sweeps have noise and shift factors have errors. Bootstrap samples of the material within these errors give the
uncertainty of the friction. They do not cover frequencies that were not measured: there the spectrum is
extrapolated, and so is its band.
"""

# %%
# **Synthetic** sweeps of the built-in fluoroelastomer, with 1 % of noise. Of the 24 isotherms only those from 18 to 120
# °C are taken, as in a shortened test.

from importlib.resources import files

import matplotlib.pyplot as plt
import numpy as np

import viscofric as vf
from viscofric import report

sweeps = vf.read_dma(files("viscofric") / "example" / "dma.csv", deformation="tension")
few = vf.IsothermalSweeps(tuple(one for one in sweeps.isotherms if 290.0 < one.temperature < 400.0), "tension")
fit = vf.superpose(few, reference="30 degC")
spectrum = vf.fit_retardation_spectrum(fit)
rubber = vf.Material(spectrum, shift=fit.shift_factors, poisson_ratio=0.5)

# %%
# Each sample is a complete material: other shift factors, other noise, another spectrum. The band of the friction of a
# ball at 30 °C is part of the prediction.

samples = vf.sample_materials(fit, spectrum, samples=60, seed=3)
ball = vf.Ball(radius="9.525 mm")
contact = {"temperatures": "30 degC", "load": "5 N", "accuracy": 1e-2}
friction = vf.predict_friction(rubber, ball, speeds=np.geomspace(1e-7, 10.0, 17), samples=samples, **contact)
truth = vf.predict_friction(vf.synthetic_fluoroelastomer(), ball, speeds=friction.speeds, **contact)

# %%
# Contacts of radius a deform the rubber at frequencies around v/a. The sweeps cover the grey range.

middle = vf.solve_steady(rubber, ball, speed="1 mm/s", load="5 N", temperature="30 degC")
measured = middle.half_width * fit.master_curve.angular_frequency[[0, -1]]  # m/s

figure, (left, right) = plt.subplots(1, 2, figsize=(11.0, 4.4), layout="constrained")
report.plot_master_curve(left, fit.master_curve, spectrum, band=samples)
report.mark_synthetic([left])
right.axvspan(*measured, color="0.5", alpha=0.15, linewidth=0.0, label="frequencies of the sweeps")
band = friction.viscoelastic_lower, friction.viscoelastic_upper
right.fill_between(friction.speed, *band, color="C0", alpha=0.4, linewidth=0.0, label="95 % band")
right.semilogx(friction.speed, friction.viscoelastic, color="C0", label="predicted from the sweeps")
right.semilogx(truth.speed, truth.viscoelastic, "o", color="C1", markersize=4, label="true material")
right.set_xlabel("speed at 30 °C (m/s)")
right.set_ylabel("friction coefficient")
right.set_ylim(0.0, 0.036)
right.legend(loc="upper left", frameon=False)

# %%
# Well within the measured frequencies the prediction is accurate to a few per cent, as its band shows. At high speeds
# it is far off, and the band does not show it: the glass transition was not measured. The fit does show it: it states
# for both ends of the spectrum whether the sweeps reached them.

print("relaxed modulus extrapolated:", spectrum.fit.E0_extrapolated)
print("glassy modulus extrapolated: ", spectrum.fit.E_inf_extrapolated)

# %%
# The band is computed to first order, by one further linear solve for each contact. The test: twelve of the
# samples, each with its own contact solution:

members = [
    vf.solve_steady(one, ball, speed="1 mm/s", load="5 N", temperature="30 degC").friction_coefficient
    for one in samples.materials[:12]
]
here = vf.predict_friction(rubber, ball, speeds="1 mm/s", samples=samples, **contact)
standard_error = float(here.material_error[0] / here.viscoelastic[0])
spread = np.std(members, ddof=1) / here.viscoelastic[0]
print(f"standard error: {100 * standard_error:.2f} % from the band, {100 * spread:.2f} % from twelve contacts")

plt.show()
