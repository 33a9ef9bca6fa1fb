"""``synth order``, ``dyads``, ``fourbar``."""
