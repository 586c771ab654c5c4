"""Functions in the form of other packages."""
