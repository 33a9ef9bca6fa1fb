"""Pieces: flat sheets as they lie; panels in space unfolded to nets, with tabs; cuts made once."""
