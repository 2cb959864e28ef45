"""Displacement around one loaded cell: half-space and layer, point and line, with the material's memory."""
