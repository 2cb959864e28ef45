"""Rise of temperature by moving sources of heat: discs and strips, maps on a grid, repeated passes on a track."""
