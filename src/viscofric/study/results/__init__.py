"""Results of a study: their tree and file, export and comparison."""
