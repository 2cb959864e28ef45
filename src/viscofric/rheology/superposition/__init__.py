"""Time–temperature superposition: isotherms shifted onto one master curve, and whether superposition holds."""
