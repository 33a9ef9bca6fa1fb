"""The ``synth`` command: each subcommand reads, calls one function, and prints."""
