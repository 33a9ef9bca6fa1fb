"""Making an atlas: what is in it, its rows, coordinates of its types, the file."""
