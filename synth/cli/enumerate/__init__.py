"""``synth enumerate``: a module for each subcommand."""
