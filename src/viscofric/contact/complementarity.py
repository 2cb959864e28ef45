"""The contact problem on a grid: pressures and gaps are not negative, and never both positive.

Find p and the indentation δ with ::

    w = K p + h − δ,      w ≥ 0,  p ≥ 0,  w p = 0,      Σ p dA = F,  or δ given,

for a positive definite but nonsymmetric K.  Conjugate gradients do not apply.  The method is an active set
whose linear problems are solved inexactly by truncated generalised conjugate residuals (GCR) [1]_, with the
inverse of a periodic operator near K, restricted to the contact, as preconditioner.  With the load given, the
indentation is eliminated by projecting the mean out of residuals and search directions, so that the load never
changes within a linear solve.  Where K is nearly skew the set can cycle; see `viscofric.contact.free.proximal`.

The caller chooses the tolerance of the linear problems.  "without headway": a tenth of their initial residual at
first, ten times less whenever the number of wrongly classified cells does not halve, since loose solutions alone can
make the set cycle, and 1e-7 once there are none; suitable for one contact, however skew its operator.  "near the end":
a loose one while many cells are wrongly classified, a tight one once few are; suitable for rough surfaces, where tight
solutions on a wrong set make all spots overshoot.

.. [1] S. C. Eisenstat, H. C. Elman, M. H. Schultz, SIAM J. Numer. Anal. 20 (1983) 345.
"""

from __future__ import annotations

import functools
import math
import operator as operator_module
from dataclasses import dataclass, replace
from typing import Any, Literal, Protocol

import numpy as np

from viscofric.contact.arrays.backend import AnyArray, Backend, Cells
from viscofric.contact.extension import Extension

# Reduction of a linear residual while more than the given part of the contact's cells is wrongly classified.
_REDUCTIONS = ((0.02, 0.3), (0.0003, 0.1), (1e-5, 1e-2), (0.0, 1e-4))
_FIRST_REDUCTION = 1e-1
_LEAST_REDUCTION = 1e-7
# Part of an image that remains after orthogonalisation, below which it is orthogonalised again: rounding errors are as
# large.  They are on fine grids, where the compliance of long waves is a million times that of short ones.
_LITTLE = 0.1
# Part of the displacement of a change that is not a combination of others, below which it is only rounding errors.
_NOTHING_NEW = 1e-4
# Part of a change that must be left where cells have left the contact: otherwise its displacement is that of another.
_MOSTLY = 0.87
# Part of a gap from which on rounding errors in single precision matter to it.
_MUCH_LESS = 1e-3
# Part of the least residual so far below which there is headway.
_HEADWAY = 0.99
# Overlap, over the root mean square of the gap that known changes leave, from which on a cell beside joins the contact.
_CLEAR = 0.3
# Part of the contact up to which cells join that will overlap only after the step.
_FEW = 0.003
# Least length of a correction where many spots are solved, of that by the preconditioner.
_SHORTEST = 0.3
_DIRECTIONS = 40  # search directions that GCR keeps
_LINEAR_ITERATIONS = 100  # between two updates of the contact set


class ContactOperator(Protocol):
    """Interface of the influence operators."""

    backend: Backend
    products: int

    @property
    def dtype(self) -> Any:
        """Precision of the arrays that it returns."""

    def __call__(self, pressure: AnyArray) -> AnyArray:
        """Displacement under a pressure."""

    def precondition(self, residual: AnyArray) -> AnyArray:
        """Approximate inverse of the operator."""


@dataclass(frozen=True, eq=False)
class ComplementaritySolution:
    """Pressure and indentation with their residuals."""

    pressure: AnyArray  # (nx, ny), of the operator's backend
    displacement: AnyArray  # (nx, ny), of the operator's backend
    indentation: float
    converged: bool  # whether `complementarity` came below the tolerance
    # largest gap under pressure or overlap without it, over the indentation (or the given depth)
    complementarity: float
    load: float  # relative error of the load; zero where the indentation was given
    set_changes: int  # evaluations of the contact set
    linear_iterations: int  # GCR steps
    products: int  # with the operator
    linear: float = 0.0  # residual of the last linear problem, relative to its right-hand side

    def on_numpy(self, backend: Backend) -> ComplementaritySolution:
        """Return the same with NumPy's arrays."""
        return replace(self, pressure=backend.to_numpy(self.pressure), displacement=backend.to_numpy(self.displacement))


def solve_complementarity(
    operator: ContactOperator,
    height: AnyArray,
    load: float | None,
    guess: AnyArray,
    *,
    indentation: float | None = None,
    tolerance: float = 1e-8,
    most_products: int = 800,
    depth: float | None = None,
    inner: ContactOperator | None = None,
    patience: int | None = None,
    tighten: Literal["without headway", "near the end"] = "without headway",
    directions: int = _DIRECTIONS,
    extension: Extension | None = None,
    doubt: float = 0.0,
) -> ComplementaritySolution:
    """Solve the contact problem for a given load, or for a given indentation.

    Parameters
    ----------
    operator : ContactOperator
        Pressure to displacement; positive definite, symmetric or not.
    height : (nx, ny) array
        Indenter's height above its lowest point.
    load : float or None
        Sum of the pressures (that is F/dA), above zero; None where the indentation is given.
    guess : (nx, ny) array
        Pressures to start from; negative ones count as zero.
    indentation : float, optional
        δ, where no load is given; above zero unless `depth` is given.
    tolerance : float
        Largest violation of the gap conditions, relative to `depth`.
    most_products : int
        Products with the operator after which the solver gives up.
    depth : float, optional
        What the gap conditions are measured in; the indentation by default.
    inner : ContactOperator, optional
        What linear problems are solved with, in its precision; the operator itself by default.  Single precision
        costs half and no digits: residuals are formed with `operator`.
    patience : int, optional
        Looks at the contact set without a smaller residual after which the solver gives up.
    tighten : {"without headway", "near the end"}
        When linear problems are solved more tightly; see above.
    directions : int
        Search directions that are kept while a linear problem is solved: two numbers each for every cell in contact.
    extension : Extension, optional
        Of residuals beyond the contact before they are preconditioned; zeros by default.
    doubt : float
        Overlap below so many root mean square gaps under pressure does not make contact yet: where linear problems are
        not solved better than that, it says nothing about the set.

    Returns
    -------
    ComplementaritySolution
        Look at ``converged``: this function does not raise.  Unconverged, it is the best that was met.
    """
    inner = operator if inner is None else inner
    start, inner_start = operator.products, inner.products
    backend = operator.backend
    xp, height = backend.xp, backend.asarray(height)
    pressure = backend.positive_part(xp.asarray(backend.asarray(guess), copy=True))
    if load is not None and float(backend.largest(pressure)) == 0.0:
        pressure[height == xp.min(height)] = 1.0  # where contact begins
    pressure = _loaded_to(backend, pressure, load)
    displacement = operator(pressure)
    best: ComplementaritySolution | None = None
    set_changes = linear_iterations = since_best = 0
    linear, wrong_before = 0.0, None
    near_end = tighten == "near the end"
    reduction = _REDUCTIONS[0][1] if near_end else _FIRST_REDUCTION
    while True:
        set_changes += 1
        products = operator.products - start + (0 if inner is operator else inner.products - inner_start)
        state, gap, chosen, overlapping = _look(
            backend, pressure, displacement, height, load, indentation, depth, doubt
        )
        state_now = ComplementaritySolution(
            **state,
            pressure=pressure,
            displacement=displacement,
            converged=state["complementarity"] <= tolerance,
            set_changes=set_changes,
            linear_iterations=linear_iterations,
            products=products,
            linear=linear,
        )
        since_best += 1
        if best is None or state_now.complementarity < best.complementarity:
            best, since_best = state_now, 0
        spent = products >= most_products or (patience is not None and since_best >= patience)
        if state_now.converged or spent or not math.isfinite(state_now.complementarity):
            return best
        contact = backend.cells(chosen)
        unit = abs(state_now.indentation) if depth is None else depth
        gap = contact.gathered(gap)  # the rest of it is not needed, and large
        correction, steps, linear = solve_on_contact(
            inner, gap, contact, reduction=reduction, floor=0.5 * tolerance * unit, directions=directions,
            fixed_load=load is not None, extension=extension,
        )  # fmt: skip
        linear_iterations += steps
        values = contact.gathered(pressure) + correction
        wrong, cells = overlapping + int(xp.count_nonzero(values < 0.0)), len(contact)
        values = _loaded_to(backend, backend.positive_part(values), load)
        # Not into the old pressure, which may be the best so far.
        pressure = contact.inserted(backend.zeros(pressure.shape, pressure.dtype), values)
        del state_now, gap, chosen, contact, correction, values  # large, and no longer needed
        displacement = operator(pressure)
        if near_end:
            reduction = next(each for part, each in _REDUCTIONS if wrong > part * cells or part == 0.0)
        elif wrong == 0:
            reduction = _LEAST_REDUCTION
        elif wrong_before is not None and wrong > 0.5 * wrong_before:
            reduction = max(0.1 * reduction, _LEAST_REDUCTION)
        wrong_before = wrong


def solve_many_spots(
    operator: ContactOperator,
    height: AnyArray,
    load: float | None,
    guess: AnyArray,
    *,
    indentation: float | None,
    tolerance: float,
    most_products: int,
    inner: ContactOperator,
    patience: int,
    directions: int,
    extension: Extension,
    doubt: float,
) -> ComplementaritySolution:
    """Solve the contact of many spots, whose contact set is chosen anew at every step.

    A step removes from the gap under pressure what known changes of the pressure can remove, preconditions the rest,
    and cuts off pressures below zero.  A free cell beside the contact joins it if it overlaps, and would still do so
    after the step: the error of a spot's level says nothing about its edges.  While they are few, cells join that do
    not overlap yet, unless they have just left: otherwise wrong ones could come and go forever.  One product gives the
    displacement of the whole change: with it the gap is known, the set is looked at, and the next steps know one change
    more.  This is GCR one step late, whose directions outlive changes of the set; corrections are shorter where those
    before were too long.  Changes are in the precision of `inner`; what is returned as converged is confirmed with
    `operator`.

    Arguments as of `solve_complementarity`, with a depth of 1; of the latest changes as many as `directions` are kept.
    `doubt`: away from the contact, overlap below so many root mean square gaps under pressure does not make contact
    yet, since pressures are not known better.
    """
    start, inner_start, backend = operator.products, inner.products, operator.backend

    def spent() -> int:
        return operator.products - start + (0 if inner is operator else inner.products - inner_start)

    xp, height = backend.xp, backend.asarray(height)
    pressure = _loaded_to(backend, backend.positive_part(xp.asarray(backend.asarray(guess), copy=True)), load)
    contact = backend.cells(pressure > 0.0)
    loaded, values = contact.indices, contact.gathered(pressure)
    # In the precision of corrections: the gap of a guess is far from nothing.
    first = inner(contact.scattered(xp.astype(values, inner.dtype)))
    gap, confirmed = _gap(backend, xp.astype(first, pressure.dtype), height), False
    del first
    known = KnownChanges(contact, directions, inner.dtype, fixed_load=load is not None)
    change = image = None
    extended, collected = extension.on(contact), extension.collecting(contact)
    best, best_contact, best_values = math.inf, contact, values
    steps = since_best = 0
    before, reference = math.inf, 0.0
    length, fresh = 1.0, 0.0
    while True:
        now, level, chosen = _look_at_gap(backend, gap, loaded, indentation, doubt)
        if now <= tolerance and not confirmed:
            gap, confirmed = _gap(backend, operator(pressure), height), True
            continue
        reference = reference or now
        since_best = 0 if now < _HEADWAY * best else since_best + 1
        if now < best:
            best, best_contact, best_values = now, contact, values
        if now <= tolerance or spent() >= most_products or since_best >= patience or not math.isfinite(now):
            break
        former, pressed = contact, known.contact
        if loaded.shape[0] != len(pressed) or not bool(xp.all(loaded == pressed.indices)):
            pressed = backend.cells(backend.with_true(xp.zeros_like(chosen), loaded))
            extended = extension.on(pressed)
            known.move(pressed)
        if image is not None:
            fresh = known.add(former.scattered(change), image)
        residual = xp.astype(level - pressed.gathered(gap), inner.dtype)
        combined, residual, moved, missing = known.remove(_levelled(backend, residual, load))
        if fresh > 0.0:
            # The best length of the last correction is known now; the next one goes half of the way to it.
            length = min(1.0, max(_SHORTEST, length * (1.0 + 0.5 * missing / fresh)))
        enough = _CLEAR * _size(residual) / math.sqrt(len(pressed))
        contact, field = _joined(known, former, chosen, level, gap, extended(residual), moved, enough)
        collected = collected if contact is former else extension.collecting(contact)
        correction = length * collected(inner.precondition(field))
        old = contact.gathered(pressure)
        values = old + (_levelled(backend, correction, load) + contact.gathered(pressed.scattered(combined)))
        values = backend.positive_part(values)
        loaded = contact.indices[values > 0.0]
        if loaded.shape[0] == 0:
            break
        values = _loaded_to(backend, values, load)
        pressure = contact.inserted(pressure, values)  # all that was loaded is among these cells
        change = xp.astype(values - old, inner.dtype)
        # The last product is made with the operator, and one before it once the gap is much less than its changes were.
        confirmed = now * now <= tolerance * before or now <= _MUCH_LESS * reference
        before, image = now, None
        del chosen, field, old, residual, correction, combined
        if confirmed:
            reference, former_gap = now, gap
            gap = _gap(backend, operator(pressure), height)
            backend.in_parts(operator_module.isub, former_gap, gap)
            image = xp.astype(former_gap, inner.dtype)
            image *= -1.0
            del former_gap
        else:
            image = inner(contact.scattered(change))
            backend.in_parts(operator_module.iadd, gap, image)
        steps += 1
    if now > best or not confirmed or loaded.shape[0] == 0:
        pressure = best_contact.inserted(backend.zeros(pressure.shape, pressure.dtype), best_values)
        gap = _gap(backend, operator(pressure), height)
        best, level, _ = _look_at_gap(backend, gap, best_contact.indices[best_values > 0.0], indentation, doubt)
    return ComplementaritySolution(
        pressure=pressure,
        displacement=gap - height,
        indentation=level,
        converged=best <= tolerance,
        complementarity=best,
        load=0.0 if load is None else abs(float(backend.total(pressure)) / load - 1.0),
        set_changes=steps + 1,
        linear_iterations=steps,
        products=spent(),
    )


def _gap(backend: Backend, displacement: AnyArray, height: AnyArray) -> AnyArray:
    """Return the gap at an indentation of zero, in place of the displacement."""
    backend.in_parts(operator_module.iadd, displacement, height)
    return displacement


def _look_at_gap(
    backend: Backend, gap: AnyArray, loaded: AnyArray, indentation: float | None, doubt: float
) -> tuple[float, float, AnyArray]:
    """Return the largest violation of a gap at no indentation, the indentation, and the cells in contact.

    `loaded` are the indices of those under pressure.
    """
    xp = backend.xp
    under = xp.take(xp.reshape(gap, (-1,)), loaded)
    level = float(backend.total(under)) / loaded.shape[0] if indentation is None else indentation
    under = under - level
    enough = level - doubt * math.sqrt(float(under @ under) / max(loaded.shape[0], 1))
    chosen = xp.empty_like(gap, dtype=xp.bool)

    def overlapping(chosen: AnyArray, gap: AnyArray) -> AnyArray:
        chosen[...] = gap < enough
        return xp.min(gap)

    worst = level - min(backend.floats(*backend.in_parts(overlapping, chosen, gap)))
    if loaded.shape[0]:
        worst = max(worst, float(backend.largest(xp.abs(under))))
    return worst, level, backend.with_true(chosen, loaded)


class KnownChanges:
    """Changes of the pressure, and the displacements that they cause, at the cells in contact and at those beside them.

    The latter may come into contact next, and those that have left it may return: there, too, displacements must belong
    to their changes, since otherwise every change of the set spoils all that is known.
    """

    def __init__(self, contact: Cells, most: int, dtype: Any, *, fixed_load: bool) -> None:
        self.most, self.fixed_load = most, fixed_load
        self._take_place(contact)
        # One in each row, at the cells in contact and then at those beside them.  Images are orthonormal on the contact
        # and, with a load, have no mean there.
        self.changes = self.images = contact.backend.zeros((0, len(contact) + len(self.beside)), dtype)

    def _take_place(self, contact: Cells) -> None:
        self.contact, self.backend, self.xp = contact, contact.backend, contact.backend.xp
        near = [self.xp.roll(contact.chosen, step, axis=axis) for axis in (0, 1) for step in (1, -1)]
        self.beside = self.backend.cells(functools.reduce(operator_module.or_, near) & ~contact.chosen)

    def _gathered(self, field: AnyArray) -> AnyArray:
        return self.xp.concat([self.contact.gathered(field), self.beside.gathered(field)])

    def move(self, contact: Cells) -> None:
        """Go over to another contact, with the changes that are mostly on it.

        Cells that are new to it and to its surroundings have not changed.
        """
        xp, count, size = self.xp, len(self.contact), self.images.shape[1]
        number = xp.astype(xp.arange(1, size + 1), xp.int32)
        field = self.beside.inserted(self.contact.scattered(number[:count]), number[count:])
        self._take_place(contact)
        places = xp.astype(self._gathered(field), xp.int64)
        known, places = xp.astype(places > 0, self.images.dtype), xp.clip(places - 1, min=0)
        sizes = [_size(self.changes[row, :]) for row in range(self.changes.shape[0])]
        # One after the other, so that not both are there twice.
        self.changes = xp.take(self.changes, places, axis=1)
        self.changes *= known
        self.images = xp.take(self.images, places, axis=1)
        self.images *= known
        left = [_size(self.changes[row, : len(contact)]) >= _MOSTLY * size for row, size in enumerate(sizes)]
        if not all(left):
            rows = self.backend.asarray(np.flatnonzero(left))
            self.changes, self.images = (xp.take(kind, rows, axis=0) for kind in (self.changes, self.images))
        inside = self.images[:, : len(contact)]
        if self.fixed_load:
            self.images -= xp.mean(inside, axis=1)[:, None]
        try:
            factor = np.linalg.cholesky(self.backend.to_numpy(inside @ inside.T).astype(np.float64))
        except np.linalg.LinAlgError:
            self._forget()
            return
        again = xp.astype(self.backend.asarray(np.linalg.inv(factor)), self.images.dtype)
        self.changes = again @ self.changes
        self.images = again @ self.images

    def _forget(self) -> None:
        self.changes, self.images = self.changes[:0, :], self.images[:0, :]

    def add(self, change: AnyArray, image: AnyArray) -> float:
        """Add a change and its image, both (nx, ny), less what others have of them.

        Returns the size of what is new of the image.
        """
        xp, count = self.xp, len(self.contact)
        change, image = self._gathered(change), self._gathered(image)
        if self.fixed_load:
            image -= xp.mean(image[:count])
        # The oldest is left out first: of it the new one keeps its part.
        oldest = max(0, self.images.shape[0] - self.most + 1)
        self.changes, self.images = self.changes[oldest:, :], self.images[oldest:, :]
        first = length = _size(image[:count])
        for _ in range(2):
            whole = length
            overlaps = self.images[:, :count] @ image[:count]
            image -= overlaps @ self.images
            change -= overlaps @ self.changes
            length = _size(image[:count])
            if length > _LITTLE * whole:
                break
        if length <= _NOTHING_NEW * first:
            self._forget()
            return 0.0
        self.changes = xp.concat([self.changes, change[None, :] / length])
        self.images = xp.concat([self.images, image[None, :] / length])
        return length

    def remove(self, residual: AnyArray) -> tuple[AnyArray, AnyArray, AnyArray, float]:
        """Return the sum of changes that leaves least of a gap, and what it does.

        That is what it leaves, its displacement of the cells beside the contact, and how much of the last change is in
        it.  The gap is at the cells in contact, and is overwritten.
        """
        count = len(self.contact)
        parts = self.images[:, :count] @ residual
        moved = parts @ self.images
        residual -= moved[:count]
        return parts @ self.changes[:, :count], residual, moved[count:], float(parts[-1]) if parts.shape[0] else 0.0


def _joined(
    known: KnownChanges,
    before: Cells,
    chosen: AnyArray,
    level: float,
    gap: AnyArray,
    field: AnyArray,
    moved: AnyArray,
    enough: float,
) -> tuple[Cells, AnyArray]:
    """Return the contact with the cells that join it, and the field of what is to be corrected, with their overlap.

    `chosen` (nx, ny) are the cells that join away from the contact; the field is overwritten.  Those beside it have
    been `moved` by the known changes, and the correction will move them by about the field.  `before` is the contact
    of the step before.
    """
    backend, xp, pressed, beside = known.backend, known.xp, known.contact, known.beside
    expected, overlap = beside.gathered(field), xp.astype(level - beside.gathered(gap), field.dtype)
    joins = overlap - moved - expected > enough
    early = joins & (overlap <= 0.0)
    many = int(xp.count_nonzero(early)) >= _FEW * len(pressed)
    joins = joins & ~(early if many else early & beside.gathered(before.chosen))
    field = beside.inserted(field, xp.where(joins, overlap - moved, expected))
    far = backend.cells(chosen & ~(pressed.chosen | beside.chosen))
    if len(far):
        field = far.inserted(field, xp.astype(level - far.gathered(gap), field.dtype))
    if len(far) or bool(xp.any(joins)):
        return backend.cells(beside.inserted(chosen, joins)), field
    return pressed, field


def _size(values: AnyArray) -> float:
    return math.sqrt(float(values @ values))


def _levelled(backend: Backend, values: AnyArray, load: float | None) -> AnyArray:
    if load is not None:
        values -= backend.total(values) / values.shape[0]
    return values


def _loaded_to(backend: Backend, pressure: AnyArray, load: float | None) -> AnyArray:
    if load is not None:
        pressure *= load / float(backend.total(pressure))
    return pressure


def _look(
    backend: Backend,
    pressure: AnyArray,
    displacement: AnyArray,
    height: AnyArray,
    load: float | None,
    indentation: float | None,
    depth: float | None,
    doubt: float,
) -> tuple[dict[str, float], AnyArray, AnyArray, int]:
    """Return what a pressure comes to, its gap, the cells in contact, and how many free ones overlap."""
    xp = backend.xp
    gap, chosen = xp.empty_like(displacement), xp.empty_like(displacement, dtype=xp.bool)

    def opened(
        gap: AnyArray, chosen: AnyArray, pressure: AnyArray, displacement: AnyArray, height: AnyArray
    ) -> AnyArray:
        gap[...] = displacement + height
        chosen[...] = pressure > 0.0
        return gap[chosen]

    def settled(gap: AnyArray, chosen: AnyArray, pressure: AnyArray) -> tuple[float, float, float]:
        gap -= indentation
        overlapping = ~chosen & (gap < -level)
        chosen[...] = chosen | overlapping
        count = xp.astype(xp.count_nonzero(overlapping), gap.dtype)
        least, total, wrong = backend.floats(xp.min(gap), backend.total(pressure), count)
        return least, total, wrong

    under = xp.concat(backend.in_parts(opened, gap, chosen, pressure, displacement, height))
    if indentation is None:
        indentation = float(backend.total(under)) / under.shape[0] if under.shape[0] else math.nan
    under -= indentation
    level = doubt * math.sqrt(float(under @ under) / max(under.shape[0], 1))
    least, total, wrong = zip(*backend.in_parts(settled, gap, chosen, pressure), strict=True)
    worst = -float(np.min(least))
    if under.shape[0]:
        worst = max(worst, float(backend.largest(xp.abs(under))))
    state = {
        "indentation": indentation,
        "complementarity": worst / (abs(indentation) if depth is None else depth),
        "load": 0.0 if load is None else abs(sum(total) / load - 1.0),
    }
    return state, gap, chosen, int(sum(wrong))


def solve_on_contact(
    operator: ContactOperator,
    gap: AnyArray,
    contact: Cells,
    *,
    reduction: float,
    floor: float,
    directions: int,
    fixed_load: bool,
    extension: Extension | None = None,
) -> tuple[AnyArray, int, float]:
    """Correct the pressures on a fixed contact set until its gap is closed, or level for a fixed load.

    `gap` (n,) is at the cells of the set.  The iteration stops where the Euclidean norm of the gap over that at the
    start is below `reduction`, or the largest gap below `floor`; it keeps `directions` search directions.  With
    `fixed_load`, the corrections sum to zero, and the gap need be level only.  `extension`: see
    `solve_complementarity`.  Returns the correction (n,), the number of steps, and the relative residual.
    """
    backend, xp = operator.backend, operator.backend.xp

    def levelled(values: AnyArray) -> AnyArray:
        if fixed_load:
            values -= backend.total(values) / len(contact)
        return values

    unit = float(backend.largest(xp.abs(gap)))
    if unit == 0.0:
        return gap, 0, 0.0
    residual = xp.astype(gap / -unit, operator.dtype, copy=False)
    if fixed_load:
        residual -= backend.total(residual) / len(contact)
    first, largest = _sizes(backend, residual)
    left = first
    target, floor = reduction * first, floor / unit
    correction = xp.zeros_like(residual)
    # Directions z and their images A z, orthonormal among themselves, in a ring buffer that drops the oldest.
    kept: list[AnyArray] = []
    images: list[AnyArray] = []
    extended = contact.scattered if extension is None else extension.on(contact)
    collected = contact.gathered if extension is None else extension.collecting(contact)
    steps = 0
    while steps == 0 or (steps < _LINEAR_ITERATIONS and left > target and largest > floor):
        direction = levelled(collected(operator.precondition(extended(residual))))
        image = levelled(contact.gathered(operator(contact.scattered(direction))))
        length = math.sqrt(float(image @ image))
        for _ in range(2):
            whole = length
            overlaps = [other @ image for other in images]
            for overlap, other, its_direction in zip(overlaps, images, kept, strict=True):
                image -= overlap * other
                direction -= overlap * its_direction
            length = math.sqrt(float(image @ image))
            if length > _LITTLE * whole:
                break
        if length == 0.0:
            break
        image /= length
        direction /= length
        step = image @ residual
        correction += step * direction
        residual -= step * image
        left, largest = _sizes(backend, residual)
        if len(images) == directions:
            images[steps % directions], kept[steps % directions] = image, direction
        else:
            images.append(image)
            kept.append(direction)
        steps += 1
    return unit * correction, steps, left / first if first else 0.0


def _sizes(backend: Backend, values: AnyArray) -> tuple[float, float]:
    """Euclidean norm and largest modulus, brought from the device at once."""
    square, largest = backend.floats(values @ values, backend.largest(backend.xp.abs(values)))
    return math.sqrt(square), largest
