"""
How sure is a prediction?
=========================

Sweeps have noise and shift factors have errors. Drawing the rubber again and again within them tells what they leave
open in the friction. It tells nothing of frequencies that were never measured: there a spectrum is a guess, and so is
its band.
"""

# %%
# **Synthetic** sweeps of the built-in fluoroelastomer, with 1 % of noise. Of the 26 isotherms only those from 20 to 120
# °C are taken, as if there had been no time for more.

from importlib.resources import files

import matplotlib.pyplot as plt
import numpy as np

import viscofric as vf
from viscofric import report
from viscofric.report.house_style import BLUE, GREY, VERMILION, mark_synthetic

sweeps = vf.read_dma(files("viscofric") / "example" / "dma.csv", deformation="tension")
few = vf.IsothermalSweeps(tuple(one for one in sweeps.isotherms if 290.0 < one.temperature < 400.0), "tension")
fit = vf.superpose(few, reference="30 degC")
spectrum = vf.fit_retardation_spectrum(fit.master_curve)
rubber = vf.Material(spectrum, shift=fit.shift_factors, poisson_ratio=0.5)

# %%
# Each draw is a whole rubber: other shift factors, other noise, another spectrum. What they leave of the friction of a
# ball at 30 °C comes with the prediction.

samples = vf.sample_materials(fit, spectrum, samples=60, seed=3)
ball = vf.Ball(radius="9.525 mm")
contact = {"temperatures": "30 degC", "load": "5 N", "accuracy": 1e-2}
friction = vf.predict_friction(rubber, ball, speeds=np.geomspace(1e-7, 10.0, 17), samples=samples, **contact)
truth = vf.predict_friction(vf.synthetic_fluoroelastomer(), ball, speeds=friction.speeds, **contact)

# %%
# Contacts of radius a ask for frequencies around v/a. On grey, those were measured.

middle = vf.solve_steady(rubber, ball, speed="1 mm/s", load="5 N", temperature="30 degC")
measured = middle.half_width * fit.master_curve.angular_frequency[[0, -1]]  # m/s

figure, (left, right) = plt.subplots(1, 2, figsize=(11.0, 4.4), layout="constrained")
report.plot_master_curve(left, fit.master_curve, spectrum, band=samples)
mark_synthetic([left])
right.axvspan(*measured, color=GREY, alpha=0.15, linewidth=0.0, label="frequencies of the sweeps")
band = friction.viscoelastic_lower, friction.viscoelastic_upper
right.fill_between(friction.speed, *band, color=BLUE, alpha=0.4, linewidth=0.0, label="its 95 % band")
right.semilogx(friction.speed, friction.viscoelastic, color=BLUE, label="predicted from the sweeps")
right.semilogx(truth.speed, truth.viscoelastic, "o", color=VERMILION, markersize=4, label="of the true rubber")
right.set_xlabel("speed at 30 °C (m/s)")
right.set_ylabel("friction coefficient")
right.set_ylim(0.0, 0.036)
right.legend(loc="upper left", frameon=False)

# %%
# Well within the measured frequencies the prediction is good to a few per cent, and its band says so. At high speeds it
# goes wrong by far, and the band does not know: the glass transition was not measured. What knows is the fit, which
# says of both ends of the spectrum whether the sweeps reached them.

print("rubber plateau extrapolated:", spectrum.fit.E0_extrapolated)
print("glass modulus extrapolated: ", spectrum.fit.E_inf_extrapolated)

# %%
# The band is found to first order, by one further linear solve for each contact. Is that enough? Twelve of the drawn
# rubbers, each with a contact of its own:

members = [
    vf.solve_steady(one, ball, speed="1 mm/s", load="5 N", temperature="30 degC").friction_coefficient
    for one in samples.materials[:12]
]
here = vf.predict_friction(rubber, ball, speeds="1 mm/s", samples=samples, **contact)
standard_error = float(here.material_error[0] / here.viscoelastic[0])
spread = np.std(members, ddof=1) / here.viscoelastic[0]
print(f"standard error: {100 * standard_error:.2f} % from the band, {100 * spread:.2f} % from twelve contacts")

plt.show()
