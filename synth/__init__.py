"""Dimensions and use of mechanisms, and the command line (``synth.cli``)."""
