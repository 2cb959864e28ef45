"""Other programs as witnesses: a card's numbers in felupe and simcoon, and felupe's cylinder that slides on a layer."""

from __future__ import annotations

import felupe as fem
import numpy as np
import pytest
from felupe.math import cdya_ik, dya, identity, trace

from viscofric.verification.published.cards import card_material, card_numbers
from viscofric.verification.published.contacts import layer_contact

STRAIN = 1e-6


def maxwell(dε, εn, σn, ζn, E0, E, τ, ν, Δt, tangent):
    """Maxwell terms with one Poisson ratio, so that the bulk relaxes as the shear does; exact for linear strain."""
    eye = identity(dim=3, shape=(1, 1))
    mu, lam = 0.5 / (1.0 + ν), ν / ((1.0 + ν) * (1.0 - 2.0 * ν))
    decay = np.exp(-Δt / τ)
    gain = E * τ * (1.0 - decay) / Δt

    def hooke(strain):
        return 2.0 * mu * strain + lam * trace(strain) * eye

    terms = decay.reshape(-1, 1, 1, 1, 1) * ζn[0] + gain.reshape(-1, 1, 1, 1, 1) * hooke(dε)
    elasticity = (E0 + gain.sum()) * (2.0 * mu * cdya_ik(eye, eye) + lam * dya(eye, eye)) if tangent else None
    return elasticity, E0 * hooke(εn + dε) + terms.sum(axis=0), [terms]


RISE = 1e-8  # s, in which the strain is applied: much shorter, and felupe's 1 − exp(−Δt/τ) would lose its digits


def held_times():
    """Return the ends of increments: the strain's rise, then ten a decade."""
    return RISE * 10.0 ** np.arange(0.0, 11.05, 0.1)


def relaxed_modulus():
    """Return E(t) of the material behind the card for a strain that rises steadily within the first increment."""
    relaxation = card_material().spectrum.to_relaxation()
    rising = -np.expm1(-RISE / relaxation.tau) * relaxation.tau / RISE
    left = np.exp(-(held_times()[:, None] - RISE) / relaxation.tau)
    return relaxation.E0 + (relaxation.E * rising * left).sum(axis=1)


def relaxing_force(umat, loadcase):
    """Return the reaction of a unit cube at every end of an increment under a strain that is held."""
    mesh = fem.Cube(n=2)
    region = fem.RegionHexahedron(mesh)
    field = fem.FieldContainer([fem.Field(region, dim=3)])
    bounds, moved = loadcase(field)
    dof0, dof1 = fem.dof.partition(field, bounds)
    solid = fem.SolidBody(umat, field)
    bounds["move"].update(STRAIN)
    ext0 = fem.dof.apply(field, bounds, dof0)
    before, forces = 0.0, []
    for time in held_times():
        umat.kwargs["Δt"] = time - before
        # Forces of micronewtons on moduli of megapascals: round-off is what remains.
        found = fem.newtonraphson(items=[solid], dof0=dof0, dof1=dof1, ext0=ext0, verbose=0, tol=1e-6)
        force = fem.tools.force(found.x, found.fun, bounds["move"])
        forces.append(force[moved])
        before = time
    return np.array(forces)


def pulled(field):
    """One face pulled along x; the sides are free."""
    u = field[0]
    bounds = fem.dof.symmetry(u)
    return bounds | {"move": fem.Boundary(u, fx=1, skip=(0, 1, 1))}, 0


def sheared(field):
    """All nodes follow simple shear, u_x = γ y."""
    u = field[0]
    return {
        "move": fem.Boundary(u, fy=1, skip=(0, 1, 1)),
        "fixed": fem.Boundary(u, fy=0),
        "rest": fem.Boundary(u, fy=1, skip=(1, 0, 0)),
    }, 0


@pytest.mark.slow
def test_an_element_relaxes_as_the_card_says() -> None:
    modulus, ratio, prony, _ = card_numbers()
    g, τ = prony[:, 0], prony[:, 2]
    umat = fem.MaterialStrain(
        maxwell, E0=modulus * (1.0 - g.sum()), E=modulus * g, τ=τ, ν=ratio, Δt=1.0, statevars=((len(τ), 3, 3),)
    )
    assert relaxing_force(umat, pulled) == pytest.approx(STRAIN * relaxed_modulus(), rel=1e-6)


@pytest.mark.slow
def test_felupes_own_law_relaxes_in_shear_as_the_card_says() -> None:
    modulus, ratio, prony, _ = card_numbers()
    shear = modulus / (2.0 * (1.0 + ratio))
    bulk = modulus / (3.0 * (1.0 - 2.0 * ratio))
    g, τ = prony[:, 0], prony[:, 2]
    relaxed = shear * (1.0 - g.sum())
    umat = fem.MaterialStrain(
        fem.linear_elastic_viscoelastic,
        λ=bulk - 2.0 / 3.0 * relaxed,
        μ=relaxed,
        G=(shear * g).tolist(),
        τ=τ.tolist(),
        Δt=1.0,
        statevars=((len(τ), 3, 3),),
    )
    expected = STRAIN * relaxed_modulus() / (2.0 * (1.0 + ratio))
    assert relaxing_force(umat, sheared) == pytest.approx(expected, rel=1e-6)


# --- a cylinder on a bonded layer ------------------------------------------------------------------

THICKNESS, RADIUS, DEPTH = 4e-3, 1.0, 1e-6  # m


def graded(first, last, cell, growth, margin):
    """Return points with equal cells from first to last, and growing ones for a margin on both sides."""
    inner = np.arange(first, last + 0.5 * cell, cell)
    steps = cell * growth ** np.arange(1, 200)
    outer = np.cumsum(steps)
    outer = outer[: np.searchsorted(outer, margin) + 1]
    return np.concatenate([inner[0] - outer[::-1], inner, inner[-1] + outer])


def sliding_cylinder(cell, speed, distance):
    """Return load (N/m) and friction coefficient of a cylinder pressed into a layer, after it slid a distance."""
    x = graded(-2e-3, distance + 2e-3, cell, 1.15, 20e-3)
    depth = np.cumsum(np.concatenate([[0.0], cell * 1.15 ** np.arange(200)]))
    depth = depth[: np.searchsorted(depth, THICKNESS) + 1]
    y = THICKNESS * (1.0 - depth[::-1] / depth[-1])
    grid = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    i, j = np.meshgrid(np.arange(len(x) - 1), np.arange(len(y) - 1), indexing="ij")
    corner = (i * len(y) + j).ravel()
    cells = np.stack([corner, corner + len(y), corner + len(y) + 1, corner + 1], axis=1)
    axis = THICKNESS + RADIUS
    mesh = fem.Mesh(np.vstack([grid, [0.0, axis]]), cells, "quad")
    displacement = fem.FieldPlaneStrain(fem.RegionQuad(mesh), dim=2)
    field = fem.FieldContainer([displacement])
    umat = fem.MaterialStrain(
        maxwell,
        E0=1e6,
        E=np.array([4e6, 10e6]) if speed else np.zeros(2),
        τ=np.array([1e-3, 0.2e-3]),
        ν=0.4,
        Δt=cell / speed if speed else 1.0,
        statevars=((2, 3, 3),),
    )
    solid = fem.SolidBody(umat, field)
    contact = fem.ContactRigidCylinder(
        field,
        points=np.flatnonzero(mesh.points[:, 1] == THICKNESS),
        centerpoint=mesh.npoints - 1,
        radius=RADIUS,
        items=[solid],
        multiplier=10.0,
    )
    bounds = {
        "base": fem.Boundary(displacement, fy=0.0),
        "along": fem.Boundary(displacement, fy=axis, skip=(0, 1)),
        "down": fem.Boundary(displacement, fy=axis, skip=(1, 0)),
    }
    bounds["down"].update(-DEPTH)
    dof0, dof1 = fem.dof.partition(field, bounds)
    for step in range(round(distance / cell) + 1 if speed else 1):
        bounds["along"].update(step * cell)
        ext0 = fem.dof.apply(field, bounds, dof0)
        fem.newtonraphson(items=[solid, contact], dof0=dof0, dof1=dof1, ext0=ext0, verbose=0, tol=1e-6)
    along, down = np.asarray(contact.results.force.todense()).ravel()[-2:]
    return abs(down), abs(along / down)


@pytest.mark.slow
def test_a_cylinder_at_rest_on_a_layer() -> None:
    load, _ = layer_contact(0.0)
    for cell in (0.2e-3, 0.1e-3):
        assert sliding_cylinder(cell, 0.0, 1e-3)[0] == pytest.approx(load, rel=5e-3)


@pytest.mark.apart
def test_a_cylinder_that_slides_on_a_layer() -> None:
    load, friction = layer_contact(1.0)
    errors = []
    for cell in (0.2e-3, 0.1e-3):
        # Retarded displacements fade over about 3.6 mm.
        found = np.array(sliding_cylinder(cell, 1.0, 16e-3))
        errors.append(np.abs(found / [load, friction] - 1.0))
    assert np.all(errors[1] < 0.01), errors
    assert np.all(errors[1] < 0.7 * errors[0]), errors


# --- shear and bulk at a point ---------------------------------------------------------------------


def held_point(simcoon, per_decade):
    """Return shear and bulk modulus of simcoon's Maxwell law at 1e-8 … 100 s, for strains that are applied at once."""
    modular = pytest.importorskip("simcoon.modular")
    modulus, ratio, prony, _ = card_numbers()
    E, τ = modulus * prony[:, 0], prony[:, 2]
    branches = [
        (e, ratio, e * t / (3.0 * (1.0 - 2.0 * ratio)), e * t / (2.0 * (1.0 + ratio)))
        for e, t in zip(E, τ, strict=True)
    ]
    law = modular.viscoelastic_model(modulus, ratio, branches)
    points = 2  # sheared, and compressed
    properties = np.asfortranarray(np.repeat(np.array(law.props, dtype=float)[:, None], points, axis=1))
    state = np.zeros((int(law.nstatev), points), order="F")
    stress, strain, work = (np.zeros((size, points), order="F") for size in (6, 6, 4))
    change = np.zeros((6, points), order="F")
    change[3, 0], change[:3, 1] = STRAIN, STRAIN / 3.0
    unmoved = np.asfortranarray(np.repeat(np.eye(3)[:, :, None], points, axis=2))
    ends = np.concatenate([[1e-12], 10.0 ** (np.arange(-9 * per_decade, 2 * per_decade + 1) / per_decade)])
    moduli, before = [], 0.0
    for place, end in enumerate(ends):
        arguments = (strain, change, unmoved, unmoved, stress, unmoved, properties, state, before, end - before, work)
        stress, state, work, _ = simcoon.umat("MODUL", *arguments, n_threads=1, start=place == 0)
        strain, change, before = strain + change, np.zeros((6, points), order="F"), end
        if place > 1 and (place - 1) % (2 * per_decade) == per_decade:
            moduli.append((stress[3, 0] / STRAIN, stress[0, 1] / STRAIN))
    return np.array(moduli)


@pytest.mark.slow
def test_shear_and_bulk_relax_as_in_simcoon() -> None:
    simcoon = pytest.importorskip("simcoon", reason="has no wheel for this platform")
    _, ratio, _, _ = card_numbers()
    times = 10.0 ** np.arange(-8.0, 2.5, 2.0)
    relaxed = card_material().spectrum.to_relaxation().relaxation_modulus(times)
    expected = relaxed[:, None] / [2.0 * (1.0 + ratio), 3.0 * (1.0 - 2.0 * ratio)]
    coarse, fine = (held_point(simcoon, per_decade) / expected - 1.0 for per_decade in (50, 100))
    # Backward differences: first order in the increment, which is 2.3 % of the time at 100 a decade.
    assert np.all(np.abs(fine) < 0.005)
    assert np.abs(2.0 * fine - coarse).max() < 2e-4
