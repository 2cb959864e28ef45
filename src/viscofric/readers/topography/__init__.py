"""Heights of surfaces from files: our own tables and grids, and what the package SurfaceTopography reads."""
