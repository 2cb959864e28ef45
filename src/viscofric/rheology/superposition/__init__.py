"""Time–temperature superposition: isotherms laid on one master curve, and whether they may be."""
