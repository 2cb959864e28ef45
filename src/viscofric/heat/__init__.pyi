from viscofric.heat.maps import surface_temperature as surface_temperature
from viscofric.heat.result import ContactHeating as ContactHeating
from viscofric.heat.result import TransientHeating as TransientHeating
from viscofric.heat.sources import MovingHeatSource as MovingHeatSource
from viscofric.heat.track import track_temperature as track_temperature
