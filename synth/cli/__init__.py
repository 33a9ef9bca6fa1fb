"""The ``synth`` command."""
