"""Closed forms with which the numerical contact is compared."""

from viscofric.contact.reference.foundation import (
    RollingFoundationContact,
    rolling_foundation_ball,
    rolling_foundation_line,
)
from viscofric.contact.reference.hertz import (
    HertzContact,
    HertzEllipticContact,
    HertzLineContact,
    hertz_ball,
    hertz_ellipse,
    hertz_line,
)
from viscofric.contact.reference.hunter import HunterContact, hunter_line
from viscofric.contact.reference.layers import (
    ThinLayerContact,
    foundation_modulus,
    incompressible_ball,
    incompressible_line,
    winkler_ball,
    winkler_line,
)
from viscofric.contact.reference.punches import ConeContact, FlatPunchContact, flat_punch, sneddon_cone
from viscofric.contact.reference.speed_limits import high_speed_friction, high_speed_line_friction, low_speed_friction
from viscofric.contact.reference.wavy import (
    CrossedWaves,
    FullContactWave,
    WavyContact,
    crossed_waves,
    full_contact_wave,
    westergaard,
)

__all__ = [
    "ConeContact",
    "CrossedWaves",
    "FlatPunchContact",
    "FullContactWave",
    "HertzContact",
    "HertzEllipticContact",
    "HertzLineContact",
    "HunterContact",
    "RollingFoundationContact",
    "ThinLayerContact",
    "WavyContact",
    "crossed_waves",
    "flat_punch",
    "foundation_modulus",
    "full_contact_wave",
    "hertz_ball",
    "hertz_ellipse",
    "hertz_line",
    "high_speed_friction",
    "high_speed_line_friction",
    "hunter_line",
    "incompressible_ball",
    "incompressible_line",
    "low_speed_friction",
    "rolling_foundation_ball",
    "rolling_foundation_line",
    "sneddon_cone",
    "westergaard",
    "winkler_ball",
    "winkler_line",
]
