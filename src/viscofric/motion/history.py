"""A history of load or depth, path and temperature: piecewise linear, with jumps, checked when it is made."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from viscofric.arguments import exactly_one
from viscofric.arrays import Array
from viscofric.contact.bodies import unit_direction
from viscofric.errors import InputError, check_choice, wrong_argument
from viscofric.motion.schedule import Schedule, make_schedule
from viscofric.notes import Note, Remedy
from viscofric.rheology.material import Material, insist_on_material
from viscofric.showing import Rows, Shown
from viscofric.units import Quantities, to_si_array, to_si_in_shape

#: What may be prescribed normal to the surface, with its unit.
CONTROLS = {"load": "N", "indentation": "m", "pressure": "Pa", "gap": "m"}
BEFORE = ("untouched", "at rest", "sliding")
#: First time after a kink, over the time to the next one.
_FIRST = 1e-4
#: Kind of contact -> what may be prescribed in it.
_CONTROLS_OF = {"point": ("load", "indentation"), "line": ("load", "indentation"), "periodic": ("pressure", "gap")}


@dataclass(frozen=True, eq=False)
class History(Shown):
    """Prescribed motion of an indenter, linear between the given times; a time given twice is a jump.

    Exactly one of load, indentation, pressure and gap is given.  Each of them, the speed and the temperature may be one
    value, which then holds throughout.  Without position and speed, the indenter stays where it is.

    Parameters
    ----------
    time : (n,) array of float, str or pint.Quantity
        s, never decreasing.  Of a time given twice, the first values hold before the jump and the second ones after it.
    load : float, str, pint.Quantity or (n,) array of them, optional
        Normal load, N, or N/m of a line contact; not below zero.
    indentation : float, str, pint.Quantity or (n,) array of them, optional
        Depth of the indenter's lowest point below the undeformed surface, m; above the surface if negative.
    pressure : float, str, pint.Quantity or (n,) array of them, optional
        Mean pressure of a periodic surface, Pa; not below zero.
    gap : float, str, pint.Quantity or (n,) array of them, optional
        Mean gap of a periodic surface, m; not below zero.
    position : (n,) or (n, 2) array of float, str or pint.Quantity, optional
        Along `direction`, or along x and y, m.  It does not jump.
    speed : float, str, pint.Quantity, or (n,) or (n, 2) array of them, optional
        Along `direction`, or along x and y, m/s, instead of the position, which then begins at zero.
    temperature : float, str, pint.Quantity or (n,) array of them, optional
        Of the whole material, K if a plain number.  May be left out for a material without a shift law.
    before : str
        What happened before the first time: ``"untouched"``: nothing; ``"at rest"``: the first load (or depth) has
        acted for an infinite time without motion; ``"sliding"``: also the first speed.
    direction : (float, float)
        Direction of a position or speed given along one line.

    Attributes
    ----------
    control : str
        Which of load, indentation, pressure and gap was given.
    load_unit : str
        ``"N"`` or ``"N/m"`` of a load given with a unit, else empty.

    Raises
    ------
    InputError
        If time goes back, values are missing, contradict each other or are out of range, or the position jumps.

    Examples
    --------
    A load put on at once, a dwell of 0.2 s, then sliding at 0.1 m/s:

    >>> import viscofric as vf
    >>> history = vf.motion.History(time=[0.0, 0.2, 0.2, 0.5], load="25 N", speed=[0.0, 0.0, 0.1, 0.1])
    >>> history.position[:, 0].round(6).tolist()
    [0.0, 0.0, 0.0, 0.03]
    """

    time: Array
    load: Array | None
    indentation: Array | None
    pressure: Array | None
    gap: Array | None
    position: Array
    speed: Array | None
    temperature: Array | None
    before: str
    direction: tuple[float, float]
    load_unit: str = field(default="", repr=False)

    def __init__(
        self,
        time: Quantities,
        load: Quantities | None = None,
        indentation: Quantities | None = None,
        pressure: Quantities | None = None,
        gap: Quantities | None = None,
        position: Quantities | None = None,
        speed: Quantities | None = None,
        temperature: Quantities | None = None,
        before: str = "untouched",
        direction: Sequence[float] = (1.0, 0.0),
    ) -> None:
        check_choice(before, "before", *BEFORE)
        toward = unit_direction(direction)
        seconds = _checked_time(time)
        count = len(seconds)
        unit = _load_unit(load)
        given = {"load": load, "indentation": indentation, "pressure": pressure, "gap": gap}
        control = exactly_one(**given)
        values = _column(given[control], unit if control == "load" and unit else CONTROLS[control], control, count)
        if control != "indentation" and np.any(values < 0.0):
            place = int(np.argmax(values < 0.0))
            raise _wrong_at(
                place,
                "negative-load",
                f"{control} = {values[place]:g} {unit or CONTROLS[control]} at time {seconds[place]:g} s: must not be "
                "below zero; adhesion is not part of the model.",
                argument=control,
            )
        kelvin = None if temperature is None else _column(temperature, "K", "temperature", count)
        if kelvin is not None and np.any(kelvin <= 0.0):
            said = f"temperature = {kelvin.min():g} K: must be above absolute zero."
            raise _wrong_at(int(np.argmin(kelvin)), "not-positive", said)
        if position is not None and speed is not None:
            raise InputError("position and speed: both given; give at most one of them.", code="give-one")
        velocity = None if speed is None else _in_plane(speed, "m/s", "speed", count, toward)
        path = _path(seconds, position, velocity, toward)
        if before == "sliding" and not np.any(_first_velocity(seconds, path, velocity)):
            raise InputError(
                "before = 'sliding': the speed at the first time is zero; give a position or a speed that moves from "
                "the first time on, or before = 'at rest'.",
                code="not-sliding",
            )
        for name in CONTROLS:
            object.__setattr__(self, name, values if name == control else None)
        fields: dict[str, Any] = {
            "time": seconds, "position": path, "speed": velocity, "temperature": kelvin, "before": before,
            "direction": toward, "load_unit": unit if control == "load" else "",
        }  # fmt: skip
        for name, value in fields.items():
            object.__setattr__(self, name, value)
        self.__post_init__()

    def _shown(self) -> Rows:
        return (
            ("time", self.time, "s"),
            ("load", self.load, self.load_unit),
            ("indentation", self.indentation, "m"),
            ("pressure", self.pressure, "Pa"),
            ("gap", self.gap, "m"),
            ("position", self.position, "m"),
            ("speed", self.speed, "m/s"),
            ("temperature", self.temperature, "°C"),
            ("before", self.before),
        )

    @property
    def control(self) -> str:
        """Which of load, indentation, pressure and gap was given."""
        return next(name for name in CONTROLS if getattr(self, name) is not None)

    @property
    def moves(self) -> bool:
        """Whether the position ever changes."""
        if np.any(self.position != self.position[0]):
            return True
        if self.speed is None:
            return False
        lasting = np.diff(self.time) > 0.0  # there and back within an interval
        return bool(np.any(self.speed[:-1][lasting] != 0.0) or np.any(self.speed[1:][lasting] != 0.0))

    def schedule(self, material: Material, kind: str) -> Schedule:
        """Return the history in SI units for one material, with its clock, for a kind of contact.

        Parameters
        ----------
        material : Material
        kind : str
            ``"point"``, ``"line"`` or ``"periodic"``.

        Returns
        -------
        Schedule
            For the solvers: what is prescribed at any time.

        Raises
        ------
        InputError
            If the contact cannot have what is prescribed, a temperature is outside the shift law, or it changes in a
            material with a vertical shift.
        """
        insist_on_material(material)
        check_choice(kind, "kind", *_CONTROLS_OF)
        if self.control not in _CONTROLS_OF[kind]:
            wanted = _CONTROLS_OF[kind]
            said = f"give {' or '.join(wanted)}."
            raise InputError(
                f"{self.control}: cannot be prescribed in a {kind} contact; ",
                code="wrong-control",
                remedy=Remedy(said, f"give {' or '.join(f'--{one}' for one in wanted)}.", said),
                values={"argument": self.control},
            )
        unit = {"point": "N", "line": "N/m"}.get(kind, "")
        if self.load_unit not in ("", unit):
            raise InputError(
                f"load: has the unit {self.load_unit}, but the load of a {kind} contact is in {unit}; give its loads "
                f"in {unit}.",
                code="wrong-unit",
            )
        return make_schedule(
            material, self.time, self.control, getattr(self, self.control), self.position, self.speed,
            self.temperature, self.before,
        )  # fmt: skip


def dense_times(history: History, count: int) -> list[float]:
    """Return so many times of a history, s: its own, twice at jumps, and others dense after each."""
    # Evenly spaced times if there are fewer than the history has.
    own: list[float] = history.time.tolist()
    lasting = sum(right > left for left, right in itertools.pairwise(own))
    if count < len(own):
        return [float(time) for time in np.linspace(own[0], own[-1], count)]
    each, more = divmod(count - len(own), lasting)
    times = own[:1]
    for start, end in itertools.pairwise(own):
        if end > start:
            times += (start + (end - start) * dense_parts(each + (more > 0))).tolist()
            more -= 1
        times.append(end)
    return times


def dense_parts(count: int) -> Array:
    """Return so many numbers between zero and one: half of them evenly spaced, the others by equal ratios below."""
    evenly = count - count // 2
    first = 1.0 / (evenly + 1)
    return np.append(np.geomspace(_FIRST, first, count // 2, endpoint=False), first * np.arange(1, evenly + 1))


def _wrong_at(index: int, code: str, sentence: str, **values: str) -> InputError:
    """Return an error about one point, with its index in the values."""
    return InputError(Note(code, sentence, values={"index": index, **values}))


def _checked_time(time: Quantities) -> Array:
    seconds = to_si_array(time, "s", "time")
    if len(seconds) < 2 or seconds[0] == seconds[-1]:
        raise wrong_argument(
            "time", time, "a history needs at least two different times, such as [0, '1 s'].", "too-few-points"
        )
    steps = np.diff(seconds)
    if np.any(steps < 0.0):
        place = int(np.argmax(steps < 0.0))
        raise _wrong_at(
            place + 1,
            "time-goes-back",
            f"time: goes back from {seconds[place]:g} s to {seconds[place + 1]:g} s; sort the history by time.",
        )
    if np.any((steps[1:] == 0.0) & (steps[:-1] == 0.0)):
        place = int(np.argmax((steps[1:] == 0.0) & (steps[:-1] == 0.0)))
        raise _wrong_at(
            place + 2,
            "repeated-time",
            f"time = {seconds[place]:g} s: is given more than twice; a jump has one point before it and one after it.",
        )
    return seconds


def _load_unit(load: Quantities | None) -> str:
    """Return the unit of a load written with one: the load of a line contact is per unit of length."""
    one: Any = load
    while isinstance(one, (list, tuple)) and one:
        one = one[0]
    if not (isinstance(one, str) or hasattr(one, "to")):
        return ""
    try:
        to_si_in_shape(one, "N", "load")
    except InputError as error:
        if error.code != "wrong-unit":
            raise
        to_si_in_shape(one, "N/m", "load")
        return "N/m"
    return "N"


def _column(values: Any, unit: str, name: str, count: int) -> Array:
    """Return one value for each time; a single one holds throughout."""
    array = to_si_in_shape(values, unit, name)
    if array.ndim == 0:
        return np.full(count, float(array))
    if array.shape != (count,):
        raise InputError(
            f"{name}: has the shape {array.shape}, but there are {count} times; give one value, or one for each time.",
            code="wrong-length",
        )
    return np.array(array, dtype=float)


def _in_plane(values: Any, unit: str, name: str, count: int, toward: tuple[float, float]) -> Array:
    """Return x and y for each time, (n, 2)."""
    array = to_si_in_shape(values, unit, name)
    if array.ndim == 2 and array.shape == (count, 2):
        return np.array(array, dtype=float)
    if array.ndim == 2:
        raise InputError(
            f"{name}: has the shape {array.shape}, but there are {count} times; give ({count},) values along the "
            f"direction, or ({count}, 2) along x and y.",
            code="wrong-length",
        )
    return np.asarray(_column(values, unit, name, count)[:, None] * np.asarray(toward))


def _path(time: Array, position: Any, velocity: Array | None, toward: tuple[float, float]) -> Array:
    """Return the position at each time, (n, 2)."""
    count = len(time)
    if velocity is not None:
        steps = 0.5 * (velocity[1:] + velocity[:-1]) * np.diff(time)[:, None]
        return np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])
    if position is None:
        return np.zeros((count, 2))
    path = _in_plane(position, "m", "position", count, toward)
    jumps = (np.diff(time) == 0.0) & np.any(np.diff(path, axis=0) != 0.0, axis=1)
    if np.any(jumps):
        place = int(np.argmax(jumps))
        raise _wrong_at(
            place + 1,
            "position-jump",
            f"position: jumps at time {time[place]:g} s; only loads, depths, speeds and temperatures may jump.",
        )
    return path


def _first_velocity(time: Array, path: Array, velocity: Array | None) -> Array:
    if velocity is not None:
        return np.asarray(velocity[0])
    first = int(np.argmax(np.diff(time) > 0.0))
    return np.asarray((path[first + 1] - path[first]) / (time[first + 1] - time[first]))


def staged_history(
    control: str,
    value: float,
    *,
    load_time: float = 0.0,
    dwell: float = 0.0,
    slide: float = 0.0,
    speed: float = 0.0,
    strokes: int = 1,
    temperature: float | None = None,
    before: str = "untouched",
    direction: Sequence[float] = (1.0, 0.0),
) -> History:
    """Return the history of loading (or indenting), dwell and sliding; SI."""
    # The load or depth rises to `value` in `load_time`, in a step if that is zero. Each of the `strokes`, in
    # alternating directions, has the length `slide`, m; zero: no sliding.
    time, values, speeds = [0.0], [0.0 if load_time else value], [0.0]

    def stage(duration: float, at: float) -> None:
        """Append a stage; a change of speed is a jump, and the first stage sets the first speed."""
        if at != speeds[-1] and len(time) > 1:
            time.append(time[-1])
            values.append(value)
            speeds.append(at)
        speeds[-1] = at
        time.append(time[-1] + duration)
        values.append(value)
        speeds.append(at)

    for duration in (load_time, dwell):
        if duration:
            stage(duration, 0.0)
    if slide:
        for stroke in range(strokes):
            stage(slide / speed, speed if stroke % 2 == 0 else -speed)
    if len(time) == 1:
        raise InputError("the history has no duration; give it a dwell, or a path and a speed.", code="too-few-points")
    return History(time, **{control: values}, speed=speeds, temperature=temperature, before=before, direction=direction)
