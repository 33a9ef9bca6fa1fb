"""``synth mobility``, ``reduce``, ``edit``, ``convert``, ``reconstruct``."""
