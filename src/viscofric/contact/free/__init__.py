"""The isolated contact: window, nested grids, estimates of the errors, edges."""
