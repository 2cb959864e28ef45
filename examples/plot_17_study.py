"""
A study on several workers
==========================

A study is a run file that lists all varied quantities, each with its unit. Its contacts
are distributed over processes, stored as they are solved, and collected in one labelled data set. The results are the
same to the last digit for any number of workers.
"""

# %%
# Two balls, two loads, three temperatures and nine speeds, on the built-in **synthetic** fluoroelastomer. Not all of
# the 108 cases are solved: temperatures share one curve over :math:`\alpha(T)\,v`, and contacts of different balls and
# loads are similar, so that most are interpolated within the requested accuracy.

from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib.pyplot as plt

import viscofric as vf

RUN_FILE = """
title = "Two balls under two loads"
data_origin = "synthetic"

[material]
catalogue = "synthetic fluoroelastomer"

[indenter]
radius = ["9.525 mm", "20 mm"]

[conditions]
load = ["2 N", "10 N"]
speed = { from = "10 mm/s", to = "1 m/s", points = 9 }
temperature = ["30 degC", "60 degC", "90 degC"]

[solver]
accuracy = 1e-2
"""

# %%
# The same on the command line is ``viscofric run study.toml --workers 2``, which also writes a report. An interrupted
# study is continued with ``resume=True``.

with TemporaryDirectory() as folder:
    run_file = Path(folder) / "study.toml"
    run_file.write_text(RUN_FILE, encoding="utf-8")
    results = vf.run_study(run_file, workers=2)
    cases = results.dataset.load()

print(f"{cases['interpolated'].size} cases, {int(cases['interpolated'].sum())} of them interpolated")
print("axes:", ", ".join(f"{name} ({size})" for name, size in cases.sizes.items()))

# %%
# The data set is an xarray data set: cases are selected by their coordinates.

figure, panels = plt.subplots(1, 2, figsize=(10.0, 4.2), sharey=True, layout="constrained")
for axes, radius in zip(panels, cases["radius"].values, strict=True):
    for temperature, colour in zip(cases["temperature"].values, ("C0", "C1", "C2"), strict=True):
        for load, style in ((2.0, "--"), (10.0, "-")):
            mu = cases["friction_coefficient"].sel(radius=radius, load=load, temperature=temperature)
            name = f"{temperature - 273.15:.0f} °C, {load:.0f} N"
            axes.semilogx(1e3 * mu["speed"], mu, color=colour, linestyle=style, label=name)
    axes.set_title(f"ball of radius {1e3 * radius:g} mm", fontsize=10)
    axes.set_xlabel("speed (mm/s)")
panels[0].set_ylabel("friction coefficient")
panels[0].set_ylim(bottom=0.0)
panels[1].legend(frameon=False, fontsize=8)

# %%
# One of the interpolated cases, solved directly:

here = cases.sel(radius=20e-3, load=10.0, temperature=333.15).isel(speed=4)
friction = float(here["friction_coefficient"])
alone = vf.solve_steady(
    vf.synthetic_fluoroelastomer(), vf.Ball("20 mm"), speed=float(here["speed"]), load="10 N", temperature="60 degC"
)
print(f"at 60 °C and 100 mm/s: {friction:.5f} in the study, {alone.friction_coefficient:.5f} solved directly")

# %%
# ``vf.citations(results)`` lists the papers behind the results; ``vf.citations(results).bibtex()`` gives them as
# BibTeX.

print(vf.citations(results))

plt.show()
