"""The ``synth`` command and its subcommands.

Subcommands are imported when they run, or to show their help, and they import what they need when they are
called: ``synth --help`` loads neither networkx nor rich.
"""

from __future__ import annotations

import sys
from importlib import import_module
from typing import Any

import click

from synth.cli.groups import NamedGroup

__all__ = ["main"]

_SECTIONS: dict[str, dict[str, str]] = {
    "Analyse motion": {
        "mobility": "synth.cli.graphs.mobility:mobility",
        "fold": "synth.cli.things.fold:fold",
        "positions": "synth.cli.things.positions:positions",
        "explain": "synth.cli.things.explain:explain",
        "advise": "synth.cli.things.advise:advise",
        "states": "synth.cli.compliance.states:states",
        "limits": "synth.cli.compliance.limits:limits",
    },
    "Draw and make": {
        "draw": "synth.cli.things.draw:draw",
        "view": "synth.cli.things.view:view",
        "template": "synth.cli.things.template:template",
        "generate": "synth.cli.things.generate:generate",
        "realise": "synth.cli.things.realise:realise",
    },
    "Edit, convert and identify": {
        "reduce": "synth.cli.graphs.reduce:reduce_command",
        "edit": "synth.cli.graphs.edit:edit",
        "convert": "synth.cli.graphs.convert:convert",
        "reconstruct": "synth.cli.graphs.reconstruct:reconstruct",
        "id": "synth.cli.graphs.id:id_command",
    },
    "Enumerate": {
        "enumerate": "synth.cli.enumerate.group:enumerate_group",
        "atlas": "synth.cli.enumerate.atlas:atlas_group",
    },
    "Cones and cylinders": {
        "cone": "synth.cli.surfaces.cone:cone_group",
        "cylinder": "synth.cli.surfaces.cylinder:cylinder_group",
    },
    "Guide a body through orientations": {
        "order": "synth.cli.guidance.order:order",
        "dyads": "synth.cli.guidance.dyads:dyads",
        "fourbar": "synth.cli.guidance.fourbar:fourbar",
    },
    "Set up": {
        "completion": "synth.cli.completion:completion",
    },
}
"""Headings of the help to names of subcommands, and where these are."""

_COMMANDS = {name: place for section in _SECTIONS.values() for name, place in section.items()}


_TOLD = ("numpy", "scipy", "networkx", "numba", "shapely")
"""Packages whose versions matter to results."""

_INTERRUPTED = 130
"""Exit status after Ctrl-C, as shells count."""


class _LazyGroup(NamedGroup):
    """A group that finds its subcommands by name."""

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
        """Write the commands by what they are for."""
        widest = max(map(len, _COMMANDS))
        room = formatter.width - 6 - widest
        for heading, names in _SECTIONS.items():
            commands = ((name, self.get_command(ctx, name)) for name in names)
            with formatter.section(heading):
                formatter.write_dl(
                    [(f"{name:{widest}}", one.get_short_help_str(room)) for name, one in commands if one]
                )

    def main(self, *args: Any, **options: Any) -> Any:
        """Run, and end with one line and a status where something is in the way; help is printed here too."""
        from graphs.errors import SynthedraError
        from synth.cli.streams import ReaderGoneError

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
            from synth.cli.unforeseen import end_with_fault

            end_with_fault(error, debug=ctx.params["debug"])


def _told_version(ctx: click.Context, parameter: click.Parameter, asked: bool) -> None:
    """Print the version, and those of what results depend on, and end."""
    del parameter
    if not asked or ctx.resilient_parsing:
        return
    from importlib.metadata import version
    from platform import python_version

    click.echo(f"synth, version {version('synthedra')}")
    parts = [f"Python {python_version()}", *(f"{name} {version(name)}" for name in _TOLD)]
    click.echo(", ".join(parts))
    ctx.exit()


@click.group(cls=_LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.option(
    "--version",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_told_version,
    help="Show the versions of synth and of the packages that results depend on, and exit.",
)
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
    del debug  # looked at where a fault is caught
