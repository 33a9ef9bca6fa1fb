"""``synth completion``: names of commands and options completed by the shell."""

from __future__ import annotations

import os
from pathlib import Path

import click

from synth.cli.output import FORCE

__all__ = ["completion"]

_SHELLS = ("bash", "zsh", "fish")


@click.command("completion", short_help="Print or install a shell completion script.")
@click.argument("shell", type=click.Choice(_SHELLS))
@click.option(
    "--install", is_flag=True, help="Write the script to the folder where the shell looks for it, for this user."
)
@FORCE
def completion(shell: str, install: bool, force: bool) -> None:
    """Print or install a script with which a shell completes the names of commands, options and files.

    With --install the script is written to the user's folder of completion scripts, and is active in the next
    shell.

    \b
    Examples:
      synth completion bash --install
      synth completion zsh > _synth
    """
    from graphs.files.atomic import write_text

    script = _script_for(shell)
    if not install:
        click.echo(script)
        return
    place = _place_of(shell)
    place.parent.mkdir(parents=True, exist_ok=True)
    write_text(place, script, force=force)
    click.echo(f"written: {place}")
    if shell == "zsh":
        click.echo(f"zsh looks there if its .zshrc has: fpath+=({place.parent}); autoload -U compinit; compinit")


def _script_for(shell: str) -> str:
    from click.shell_completion import get_completion_class

    from synth.cli.main import main

    of_shell = get_completion_class(shell)
    assert of_shell is not None, shell
    made = of_shell(main, {}, "synth", "_SYNTH_COMPLETE")
    return made.source_template % made.source_vars()


def _place_of(shell: str) -> Path:
    """Return where a shell looks for scripts of a user: XDG folders; zsh has none of its own, so ~/.zfunc."""
    home = Path.home()
    if shell == "bash":
        shared = Path(os.environ.get("XDG_DATA_HOME") or home / ".local" / "share")
        return shared / "bash-completion" / "completions" / "synth"
    if shell == "fish":
        own = Path(os.environ.get("XDG_CONFIG_HOME") or home / ".config")
        return own / "fish" / "completions" / "synth.fish"
    return home / ".zfunc" / "_synth"
