"""Thermal properties of bodies."""

from __future__ import annotations

from dataclasses import dataclass

from viscofric.arguments import text
from viscofric.units import Quantity, positive


@dataclass(frozen=True)
class ThermalProperties:
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
