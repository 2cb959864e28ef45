"""Heights of surfaces from files: our own tables and grids, and the formats of the package SurfaceTopography."""
