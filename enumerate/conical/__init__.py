"""All conical candidates: cyclic orders of the joints of a chain."""
