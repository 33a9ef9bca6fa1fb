"""The ``synth`` command and its subcommands.

Subcommands are imported when they run, or to show their help, and they import what they need when they are
called: ``synth --help`` loads neither networkx nor rich.
"""

from __future__ import annotations

import os
import sys
import traceback
from contextlib import suppress
from difflib import get_close_matches
from importlib import import_module
from pathlib import Path
from typing import Any, NoReturn

import click

from graphs.printing import plain
from synth.cli.options import FORCE

__all__ = ["NamedGroup", "completion", "main"]

_SECTIONS: dict[str, dict[str, str]] = {
    "Analyse motion": {
        "mobility": "synth.cli.commands.mobility:mobility",
        "fold": "synth.cli.commands.motion:fold",
        "positions": "synth.cli.commands.motion:positions",
        "explain": "synth.cli.commands.motion:explain",
        "advise": "synth.cli.commands.motion:advise",
        "states": "synth.cli.commands.motion:states",
        "limits": "synth.cli.commands.motion:limits",
    },
    "Draw and make": {
        "draw": "synth.cli.commands.drawing:draw",
        "view": "synth.cli.commands.drawing:view",
        "template": "synth.cli.commands.drawing:template",
        "generate": "synth.cli.commands.realise:generate",
        "realise": "synth.cli.commands.realise:realise",
    },
    "Edit, convert and identify": {
        "reduce": "synth.cli.commands.edit:reduce_command",
        "edit": "synth.cli.commands.edit:edit",
        "convert": "synth.cli.commands.convert:convert",
        "reconstruct": "synth.cli.commands.convert:reconstruct",
        "id": "synth.cli.commands.convert:id_command",
    },
    "Enumerate": {
        "enumerate": "synth.cli.commands.enumerate:enumerate_group",
        "atlas": "synth.cli.commands.atlas:atlas_group",
    },
    "Cones and cylinders": {
        "cone": "synth.cli.commands.surfaces:cone_group",
        "cylinder": "synth.cli.commands.surfaces:cylinder_group",
    },
    "Guide a body through orientations": {
        "order": "synth.cli.commands.guidance:order",
        "dyads": "synth.cli.commands.guidance:dyads",
        "fourbar": "synth.cli.commands.guidance:fourbar",
    },
    "Set up": {
        "completion": "synth.cli.main:completion",
    },
}
"""Headings of the help to names of subcommands, and where these are."""

_COMMANDS = {name: place for section in _SECTIONS.values() for name, place in section.items()}

_VERSIONED = ("numpy", "scipy", "networkx", "numba", "shapely")
"""Packages whose versions matter to results."""
_INTERRUPTED = 130
"""Exit status after Ctrl-C, as shells count."""
_FAULT = 70
"""Exit status of a fault of the program (EX_SOFTWARE of sysexits.h): 1 is an answer, 2 a fault of the input."""
_DEBUG_VARIABLE = "SYNTHEDRA_DEBUG"
"""Set to 1, it has the same effect as --debug."""
_LONGEST_FAULT = 300
"""Letters of an exception that are printed."""


class NamedGroup(click.Group):
    """A group that lists commands without loading them, and suggests the nearest name for one that is unknown."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command of the first word; fail with the nearest name if there is none."""
        name = args[0]
        unknown = not name.startswith("-") and self.get_command(ctx, name) is None
        if unknown and not ctx.resilient_parsing:
            near = get_close_matches(name, self.list_commands(ctx), 1)
            ctx.fail(f"No such command {plain(name)!r}" + (f". Did you mean {near[0]!r}?" if near else ""))
        return super().resolve_command(ctx, args)


class _LazyGroup(NamedGroup):
    """The group of all subcommands, which are imported when they are looked up."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(_COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in _COMMANDS:
            return None
        module, name = _COMMANDS[cmd_name].split(":")
        command = getattr(import_module(module), name)
        assert isinstance(command, click.Command)
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the commands under the headings of their sections."""
        widest = max(map(len, _COMMANDS))
        room = formatter.width - 6 - widest
        for heading, names in _SECTIONS.items():
            commands = ((name, self.get_command(ctx, name)) for name in names)
            with formatter.section(heading):
                rows = [(f"{name:{widest}}", entry.get_short_help_str(room)) for name, entry in commands if entry]
                formatter.write_dl(rows)

    def main(self, *args: Any, **options: Any) -> Any:
        """Run a command; end with one line and an exit status if it fails. Help is printed here too."""
        from graphs.errors import SynthedraError
        from synth.cli.output import ReaderGoneError

        try:
            return super().main(*args, **options)
        except ReaderGoneError as gone:
            sys.exit(gone.status)
        except SynthedraError as error:
            click.echo(str(error), err=True)
            sys.exit(2)

    def invoke(self, ctx: click.Context) -> Any:
        try:
            return super().invoke(ctx)
        except KeyboardInterrupt as stop:  # click would end with 1, which is an answer
            click.echo("stopped", err=True)
            sys.exit(getattr(stop, "status", _INTERRUPTED))
        except Exception as error:
            from graphs.errors import SynthedraError

            if isinstance(error, SynthedraError | click.ClickException | click.exceptions.Exit | click.Abort):
                raise
            _end_with_fault(error, debug=ctx.params["debug"])


def _end_with_fault(error: Exception, *, debug: bool) -> NoReturn:
    """Print an exception that nobody foresaw, a fault of the program, on one line, and end.

    With `debug`, or if `_DEBUG_VARIABLE` is 1, the traceback is printed before it.
    """
    with suppress(OSError):  # standard error may be what failed
        if debug or os.environ.get(_DEBUG_VARIABLE) == "1":
            traceback.print_exception(error)
        fault = plain(f"{type(error).__name__}: {error}", _LONGEST_FAULT)
        hint = "" if debug else "; `synth --debug COMMAND ...` prints where"
        click.echo(
            f"synth: fault of the program, not of the input: {fault}; please report it with the command and its "
            f"files to the developers of synthedra (CONTRIBUTING.md, Reporting a fault){hint}",
            err=True,
        )
    sys.exit(_FAULT)


def _print_version(ctx: click.Context, _parameter: click.Parameter, requested: bool) -> None:
    """Print the version, and those of the packages that results depend on, and end."""
    if not requested or ctx.resilient_parsing:
        return
    from importlib.metadata import version
    from platform import python_version

    click.echo(f"synth, version {version('synthedra')}")
    parts = [f"Python {python_version()}", *(f"{name} {version(name)}" for name in _VERSIONED)]
    click.echo(", ".join(parts))
    ctx.exit()


@click.group(cls=_LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.option(
    "--version", is_flag=True, is_eager=True, expose_value=False, callback=_print_version,
    help="Show the versions of synth and of the packages that results depend on, and exit.",
)  # fmt: skip
@click.option(
    "--debug", is_flag=True, help="Print the traceback if the program itself fails (or set SYNTHEDRA_DEBUG=1)."
)
def main(debug: bool) -> None:
    """Type synthesis of spherical-system linkages: origami, pop-ups, cartons, conical mechanisms.

    \b
    Examples:
      synth mobility data/patterns/bird-base.fold
      synth fold data/patterns/bird-base.fold --drive 0=60 -o bird.fold
      synth view data/patterns/bird-base.fold -o bird.html
      synth enumerate chains --links 8 --dof 1
      synth cone map --angles 120,95,45,85

    Exit status: 0, done; 1, the answer is no; 2, bad input or usage, or output that cannot be written; 70, a fault
    of the program, please report it; 128 + n, stopped by signal n (130: Ctrl-C).
    """
    del debug  # `_LazyGroup.invoke` reads it


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

    completer = get_completion_class(shell)
    assert completer is not None, shell
    completion_of_synth = completer(main, {}, "synth", "_SYNTH_COMPLETE")
    return completion_of_synth.source_template % completion_of_synth.source_vars()


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
