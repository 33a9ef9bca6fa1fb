"""``python -m synth.cli``: the ``synth`` command."""

from synth.cli.main import main

if __name__ == "__main__":
    main(prog_name="synth")
