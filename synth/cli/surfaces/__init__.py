"""``synth cone`` and ``synth cylinder``."""
