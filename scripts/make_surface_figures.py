"""Make the figures of docs/guide/surfaces.md: a rough surface, where it touches, and friction beside Persson's theory.

The surfaces and the rubber are made up.  Some 200 contacts of 256² points: about a minute of two cores.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

import viscofric as vf
from viscofric.report.figures.rough import (
    plot_contact_map,
    plot_friction_by_wavelength,
    plot_power_spectra,
    plot_rough_friction,
    plot_topography,
)
from viscofric.report.figures.saving import save_picture
from viscofric.report.figures.style import INK, looks, new_figure, speed_ticks

FIGURES = Path(__file__).resolve().parent.parent / "docs" / "figures"
POINTS, SPACING, SHORTEST = 256, 4e-6, 32e-6
PRESSURE, TEMPERATURE = "50 kPa", "30 degC"
WAVES = {"longest": POINTS * SPACING, "rolloff": 250e-6, "shortest": SHORTEST, "rms_slope": 0.2}


def road(seed: int) -> vf.Topography:
    return vf.self_affine(0.8, shape=(POINTS, POINTS), spacing=SPACING, seed=seed, **WAVES)


def main() -> None:
    rubber = vf.synthetic_fluoroelastomer()
    one = road(1)
    spectrum = vf.roughness.PowerSpectrum.self_affine(0.8, **WAVES)
    solved = {
        f"{speed:g} m/s": vf.solve_periodic(
            rubber, one.to_surface(), speed=speed, pressure=PRESSURE, temperature=TEMPERATURE
        )
        for speed in (1e-3, 0.1, 10.0)
    }
    speeds = np.geomspace(1e-4, 10.0, 12)
    found = vf.predict_rough_friction(
        rubber, [road(seed) for seed in range(8)], speeds=speeds, temperatures=TEMPERATURE, pressure=PRESSURE, workers=2
    )
    fine = np.geomspace(1e-4, 10.0, 60)
    asked = {"speeds": fine, "temperatures": TEMPERATURE, "pressure": PRESSURE}
    theories = {
        f"Persson, γ = {gamma:g}": vf.persson_theory(rubber, spectrum, gamma=gamma, **asked) for gamma in (0.5, 1.0)
    }
    wide = vf.roughness.PowerSpectrum.self_affine(
        0.8, longest="5 mm", rolloff="3 mm", shortest="2 um", rms_height="0.1 mm"
    )
    cut = ["200 um", "20 um", "2 um"]
    limited = [vf.persson_theory(rubber, wide.limited(shortest=length), **asked) for length in cut]

    def surface() -> object:
        solution, figure = solved["0.1 m/s"], new_figure(8.6, 3.9)
        left, right = figure.subplots(1, 2)
        for axes, (mesh, label) in ((left, plot_topography(left, one)), (right, plot_contact_map(right, solution))):
            figure.colorbar(mesh, ax=axes, label=label)
        touching = f"{100.0 * solution.contact_area_fraction:.3g} % in contact, μ = {solution.friction_coefficient:.3g}"
        right.set_title(touching, fontsize=9, loc="left", color=INK)
        return figure

    def scales() -> object:
        figure = new_figure(8.6, 3.7)
        left, right = figure.subplots(1, 2)
        plot_power_spectra(left, {"made of": spectrum, "of the heights": vf.roughness.power_spectrum(one)})
        plot_friction_by_wavelength(
            right, {name: vf.roughness.friction_by_wavelength(one) for name, one in solved.items()}
        )
        return figure

    def curves() -> object:
        figure = new_figure(8.6, 3.7)
        left, right = figure.subplots(1, 2)
        plot_rough_friction(left, found, theories)
        plot_rough_friction(right, found, {"Persson": next(iter(theories.values()))}, area=True)
        return figure

    def cut_offs() -> object:
        figure = new_figure()
        axes = figure.subplots()
        for look, theory, text in zip(looks(len(cut)), limited, cut, strict=True):
            label = f"waves down to {text.replace('um', 'µm')}"
            drawn = {"color": look.colour, "linestyle": look.dashes, "label": label}
            axes.plot(theory.speed, theory.friction_coefficient[0], **drawn)
        axes.set(xscale="log", xlabel="speed (m/s)", ylabel="friction coefficient")
        axes.set_ylim(bottom=0.0)
        speed_ticks(axes.xaxis)
        axes.legend()
        return figure

    for name, draw in {
        "rough_contact": surface,
        "rough_scales": scales,
        "rough_friction": curves,
        "rough_cut_offs": cut_offs,
    }.items():
        save_picture(FIGURES / f"{name}.svg", draw, name=name, synthetic=True)  # type: ignore[arg-type]
    np.set_printoptions(precision=3, suppress=True)
    for name, theory in theories.items():
        # Interpolated where it was not asked for: 60 speeds in five decades.
        ratio = (
            np.interp(np.log(speeds), np.log(fine), theory.friction_coefficient[0]) / found.mean_friction_coefficient[0]
        )
        print(f"{name}: friction over that solved {ratio}")
    area = (
        np.interp(np.log(speeds), np.log(fine), next(iter(theories.values())).contact_area_fraction[0])
        / found.mean_area[0]
    )
    print(f"speeds {speeds}; solved {found.mean_friction_coefficient[0]}, areas {found.mean_area[0]}")
    print(f"area over that solved {area}; stretch {found.stretch.mean(axis=-1)[0]}")


if __name__ == "__main__":
    main()
