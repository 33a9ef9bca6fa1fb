"""The ``synth`` command and its subcommands.

Subcommands are imported when they run, or to show their help, and they import what they need when they are
called: ``synth --help`` loads neither networkx nor rich.
"""

import os
import sys
import traceback
from contextlib import suppress
from difflib import get_close_matches
from importlib import import_module
from typing import Any, NoReturn

import click

from graphs.errors import SynthedraError
from graphs.printing import plain
from synth.cli import options

_SECTIONS: dict[str, dict[str, str]] = {
    "Analyse motion": {
        "look": "Say in three sentences what a file is, how it moves, and what is wrong with it.",
        "mobility": "Report mobility, degrees of freedom and motion branches, with the evidence.",
        "fold": "Fold a crease pattern with rigid panels; list its folding branches.",
        "layers": "Check whether a crease pattern folds flat; count its layer orders.",
        "positions": "Find all assembly modes of a spherical or planar linkage at given inputs.",
        "explain": "Explain why a mechanism moves although counts say that it is rigid.",
        "advise": "Find joints to lock, or panels to crease, for a number of degrees of freedom.",
        "states": "Analyse compliant members: mobility in each compliance state, springs, frequencies.",
        "limits": "Find the joint limits that ride-alongs impose, and the truss they form when held.",
    },
    "Draw and make": {
        "draw": "Draw a crease pattern, a chain, an SC or SCD graph, or a polyhedron model.",
        "view": "Make an interactive page of a mechanism for any browser, or open the workbench.",
        "template": "Write a template at true scale, to cut out and fold.",
        "generate": "Make known patterns and linkages from their parameters.",
        "realise": "Give a type coordinates: as a flat sheet, as panels in space, or on a cone.",
        "design": "Find dimensions with which a mechanism moves as wished.",
        "task": "Find all types that can do a task, with dimensions, ranked.",
        "thicken": "Give panels a thickness, and move hinges so that the pattern still folds.",
    },
    "Edit, convert and identify": {
        "reduce": "Remove ride-alongs and adjunct addenda.",
        "edit": "Add creases, ride-alongs and loops; change centres; lock joints.",
        "convert": "Convert between file formats and kinds of mechanism; change centres.",
        "reconstruct": "Reconstruct the polyhedron model, vertex by vertex.",
        "id": "Print the canonical ids of a mechanism.",
    },
    "Enumerate": {
        "enumerate": "List or count all mechanisms of a kind.",
        "atlas": "Build, query, show and find all types up to a size, in one file.",
    },
    "Cones and cylinders": {
        "cone": "Map spherical linkages to cones; find which links move inward or outward.",
        "cylinder": "Map planar linkages to cylinders; find which links move inward or outward.",
    },
    "Guide a body through orientations": {
        "order": "Check whether a crank about a fixed axis guides a body through orientations in order.",
        "dyads": "Find the RR dyads that guide a body through orientations.",
        "fourbar": "Find the four-bars that guide their coupler through orientations.",
        "sixbar": "Find six-bars that guide a body through five orientations.",
    },
}
"""Headings of the help to subcommands with their lines in it: it is printed without loading them."""
_SHORT_HELP = {name: text for commands in _SECTIONS.values() for name, text in commands.items()}
_FILES = {
    "motion": ("fold", "positions", "explain", "advise", "states", "limits"),
    "drawing": ("draw", "view", "template"),
    "realise": ("generate", "realise"),
    "edit": ("reduce", "edit"),
    "convert": ("convert", "reconstruct", "id"),
    "surfaces": ("cone", "cylinder"),
    "guidance": ("order", "dyads", "fourbar", "sixbar"),
}
"""Files of `synth.cli.commands` that hold several commands; every other command has a file of its name."""

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
        return list(_SHORT_HELP)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in _SHORT_HELP:
            return None
        file = next((file for file, names in _FILES.items() if cmd_name in names), cmd_name)
        values = vars(import_module(f"synth.cli.commands.{file}")).values()
        command = next(value for value in values if isinstance(value, click.Command) and value.name == cmd_name)
        command.short_help = _SHORT_HELP[cmd_name]
        _let_cite(command, cmd_name)
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the commands under the headings of their sections, without loading them."""
        widest = max(map(len, _SHORT_HELP))
        for heading, commands in _SECTIONS.items():
            with formatter.section(heading):
                formatter.write_dl([(f"{name:{widest}}", text) for name, text in commands.items()])

    def main(self, *args: Any, **options: Any) -> Any:
        """Run a command; end with one line and an exit status if it fails. Help is printed here too."""
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
            if isinstance(error, SynthedraError | click.ClickException | click.exceptions.Exit | click.Abort):
                raise
            _end_with_fault(error, debug=ctx.params["debug"])


def _let_cite(command: click.Command, name: str) -> None:
    """Give a command, or those of a group, the option --cite, if its answers rest on sources."""
    from synth.citing import bibtex, sources_of

    if isinstance(command, click.Group):
        for inner, each in command.commands.items():
            _let_cite(each, f"{name} {inner}")
        return
    sources = sources_of(name)
    if not sources or any(option.name == "cite" for option in command.params):
        return

    def cite(ctx: click.Context, _parameter: click.Parameter, requested: bool) -> None:
        if requested and not ctx.resilient_parsing:
            click.echo(bibtex(sources))
            ctx.exit()

    help_text = "Print the sources on which the answer rests as BibTeX, and exit."
    command.params.append(
        click.Option(["--cite"], is_flag=True, is_eager=True, expose_value=False, callback=cite, help=help_text)
    )


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
    from importlib.metadata import PackageNotFoundError, version
    from platform import python_version

    from graphs.c_libraries import library, sources

    click.echo(f"synth, version {version('synthedra')}")
    parts = [f"Python {python_version()}"]
    for name in _VERSIONED:
        try:
            parts.append(f"{name} {version(name)}")
        except PackageNotFoundError:  # numba belongs to an extra
            parts.append(f"{name} not installed")
    click.echo(", ".join(parts))
    missing = [source.stem for source in sources() if library(source) is None]
    if missing:
        click.echo(f"not compiled, Python does the work: {', '.join(missing)}")
    ctx.exit()


@click.group(cls=_LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.option(
    "--version", is_flag=True, is_eager=True, expose_value=False, callback=_print_version,
    help="Show the versions of synth and of the packages that results depend on, and exit.",
)  # fmt: skip
@options.flag("--debug", "Print the traceback if the program itself fails (or set SYNTHEDRA_DEBUG=1).")
def main(debug: bool) -> None:
    """Analyse and enumerate spherical-system linkages: origami, pop-ups, cartons, conical mechanisms.

    \b
    Examples:
      synth mobility data/patterns/bird-base.fold
      synth fold data/patterns/bird-base.fold --drive 0=60 -o bird.fold
      synth view data/patterns/bird-base.fold -o bird.html
      synth enumerate chains --links 8 --dof 1
      synth cone map --angles 120,95,45,85

    Exit status: 0, done; 1, the answer is no; 2, bad input or usage, or output that cannot be written; 70, a fault
    of the program (please report it); 128 + n, stopped by signal n (130: Ctrl-C).

    \b
    Shell completion: add to ~/.bashrc (for zsh and fish: zsh_source, fish_source)
      eval "$(_SYNTH_COMPLETE=bash_source synth)"
    """
    del debug  # `_LazyGroup.invoke` reads it
