"""What surfaces say to people: the sentences of their errors."""

import numpy as np
import pytest

import viscofric as vf

HOLES = vf.Topography([[0.0, np.nan], [1e-6, 0.0]], 1e-6, periodic=True, name="road")
SCAN = vf.Topography(1e-6 * np.random.default_rng(0).random((8, 8)), 1e-6, name="scan")
LINE = vf.Topography(1e-7 * np.cos(np.arange(20)), 1e-5)
MADE = {"hurst": 0.8, "shape": (16, 16), "spacing": "2 um", "shortest": "9 um", "seed": 0}
SENTENCES = [
    (
        HOLES.to_surface,
        "missing-heights",
        "topography 'road': 1 of its 4 heights are missing; fill them first, with fill('harmonic') or fill('nearest').",
    ),
    (
        lambda: SCAN.keep_wavelengths(shortest=1e-6),
        "not-periodic",
        (
            "topography 'scan' is not periodic, so its Fourier series would ring at the edges; first use window(), "
            "which tapers its edges to the mean, or mirror(), which appends its mirror images."
        ),
    ),
    (
        SCAN.mirror().keep_wavelengths,
        "give-one",
        "shortest, longest: neither given; give the shortest wavelength to keep, the longest, or both.",
    ),
    (
        lambda: LINE.to_indenter(vf.Ball("5 mm")),
        "line-or-map",
        "shape = Ball(radius: 5 mm): a line scan is roughness on a shape such as a Cylinder.",
    ),
    (
        lambda: vf.roughness.power_spectrum(LINE),
        "line-scan",
        "power_spectrum needs a map of heights; line_spectrum takes line scans.",
    ),
    (
        lambda: vf.roughness.power_spectrum(vf.Topography(np.diag([1.0, 1.0]), 1.0)),
        "too-few-points",
        (
            "the surface has no waves of the lengths that its grid holds in all directions; a power spectrum needs "
            "several: give more points."
        ),
    ),
    (
        lambda: vf.self_affine(**MADE),
        "give-one",
        "rms_height and rms_slope: neither given; give exactly one of them.",
    ),
    (
        lambda: vf.self_affine(**(MADE | {"shortest": "2 um"}), rms_slope=0.1),
        "wave-too-short",
        "shortest = 2e-06 m: must be longer than 4e-06 m, two points of the grid (eight are good for a contact).",
    ),
    (
        lambda: vf.roughness.PowerSpectrum([1e3, 1e4], [1.0, 1.0]).limited(longest=1e-6),
        "no-wave",
        "the power spectrum reaches from wavelength 0.0006283 to 0.006283 m; no part of it lies between the cut-offs.",
    ),
]


@pytest.mark.parametrize(("act", "code", "sentence"), SENTENCES, ids=[code for _, code, _ in SENTENCES])
def test_errors_say_what_is_wrong_and_what_to_do(act, code, sentence):
    with pytest.raises(vf.ViscofricError) as caught:
        act()
    assert caught.value.code == code
    assert str(caught.value) == sentence
