"""Temperature ramps: glass transition, superposition of several frequencies by a law, of one by an assumed law."""
