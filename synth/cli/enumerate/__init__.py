"""``synth enumerate``."""
