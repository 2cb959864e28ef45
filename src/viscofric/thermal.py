"""Thermal properties of bodies."""

from __future__ import annotations

from dataclasses import dataclass

from viscofric.arguments import text
from viscofric.errors import InputError, brief
from viscofric.showing import Rows, Shown
from viscofric.units import Quantity, positive, to_si


@dataclass(frozen=True)
class ThermalProperties(Shown):
    """Thermal properties of a body.

    Parameters
    ----------
    conductivity : float, str or pint.Quantity
        k, W/(m K).
    density : float, str or pint.Quantity
        ρ, kg/m³.
    heat_capacity : float, str or pint.Quantity
        c, J/(kg K).
    name : str
        Name of the body in sentences.

    Raises
    ------
    InputError
        If a value is not above zero.

    Examples
    --------
    >>> import viscofric as vf
    >>> steel = vf.ThermalProperties("46 W/m/K", "7810 kg/m**3", "475 J/kg/K", "bearing steel")
    >>> f"{steel.diffusivity:.2g} m²/s"
    '1.2e-05 m²/s'
    """

    conductivity: Quantity
    density: Quantity
    heat_capacity: Quantity
    name: str

    def __post_init__(self) -> None:
        for name, unit in (("conductivity", "W/m/K"), ("density", "kg/m**3"), ("heat_capacity", "J/kg/K")):
            object.__setattr__(self, name, positive(getattr(self, name), unit, name))
        text(self.name, "name")

    def _shown(self) -> Rows:
        return (
            ("name", self.name),
            ("conductivity", self.conductivity, "W/(m K)"),
            ("density", self.density, "kg/m³"),
            ("heat capacity", self.heat_capacity, "J/(kg K)"),
        )

    @property
    def volume_heat(self) -> float:
        """Heat capacity of a volume ρc, J/(m³ K)."""
        return float(self.density) * float(self.heat_capacity)

    @property
    def diffusivity(self) -> float:
        """κ = k/(ρc), m²/s."""
        return float(self.conductivity) / self.volume_heat


#: Typical handbook values at room temperature, not those of any one grade.
FILLED_RUBBER = ThermalProperties(0.28, 1150.0, 1700.0, "filled rubber")
PTFE = ThermalProperties(0.25, 2170.0, 1010.0, "PTFE")
STEEL = ThermalProperties(46.0, 7810.0, 475.0, "bearing steel")
#: By the names that a run file and the command line know.
BODIES = {body.name: body for body in (FILLED_RUBBER, PTFE, STEEL)}
BODIES["steel"] = BODIES.pop(STEEL.name)
_UNITS = {"conductivity": "W/m/K", "density": "kg/m**3", "heat_capacity": "J/kg/K", "diffusivity": "m**2/s"}
_EXAMPLE = "46 W/m/K, 7810 kg/m^3, 475 J/kg/K"


def body_of(written: str, name: str) -> ThermalProperties:
    """Return a body from text: a name of `BODIES`, or its conductivity with density and heat capacity or diffusivity.

    Quantities are recognised by their units, in any order: "46 W/m/K, 7810 kg/m^3, 475 J/kg/K", "46 W/m/K, 12 mm^2/s".
    `name` is that of the body in sentences.  Raises InputError if the text is neither.
    """
    known = {one.casefold(): body for one, body in BODIES.items()}
    if written.strip().casefold() in known:
        return known[written.strip().casefold()]
    found: dict[str, float] = {}
    for part in written.split(","):
        kind = _kind(part)
        if kind is None or kind in found:
            found = {}
            break
        found[kind] = positive(part, _UNITS[kind], name)
    if found.keys() == {"conductivity", "diffusivity"}:
        # Only the product of density and heat capacity counts.
        return ThermalProperties(found["conductivity"], found["conductivity"] / found["diffusivity"], 1.0, name)
    if found.keys() != {"conductivity", "density", "heat_capacity"}:
        raise InputError(
            f"{brief(written)} is not the name of a body ({', '.join(map(repr, BODIES))}) and not its conductivity "
            f"with density and heat capacity or with diffusivity, such as {_EXAMPLE!r}.",
            code="thermal-body",
        )
    return ThermalProperties(**found, name=name)


def _kind(part: str) -> str | None:
    """Return which property a quantity is by its unit, None if none."""
    for kind, unit in _UNITS.items():
        try:
            to_si(part, unit, kind)
        except InputError:
            continue
        return kind
    return None
