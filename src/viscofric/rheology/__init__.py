"""From sweeps to a material: shift factors, master curve, retardation spectrum; material cards of other programs."""
