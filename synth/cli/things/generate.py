"""``synth generate``: known patterns and linkages by their parameters."""

from __future__ import annotations

from math import degrees, radians
from typing import TYPE_CHECKING, Any

import click

from synth.cli.groups import NamedGroup
from synth.cli.output import FORCE, about, check_output, console, print_json, table, tell_lost, tell_written

if TYPE_CHECKING:
    from synth.patterns.generator import Generator, Parameter

__all__ = ["generate"]


class _Generators(NamedGroup):
    """A command for each generator; they are looked up when one is asked for."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        from synth.patterns.catalogue import GENERATORS

        return list(GENERATORS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        from synth.patterns.catalogue import GENERATORS

        return _command(GENERATORS[cmd_name]) if cmd_name in GENERATORS else None


@click.group(
    cls=_Generators,
    invoke_without_command=True,
    short_help="Make known patterns and linkages from their parameters.",
)
@click.option("--list", "listed", is_flag=True, help="List all generators with their parameters and sources.")
@click.option("--json", "as_json", is_flag=True, help="Print the list as JSON.")
@click.pass_context
def generate(ctx: click.Context, listed: bool, as_json: bool) -> None:
    """Make a known pattern or linkage: miura, waterbomb, bennett, kaleidocycle, box-pop-up and others.

    Every other command reads the file that a generator writes. Angles are in degrees, lengths in any unit.

    \b
    Examples:
      synth generate --list
      synth generate miura --help
      synth generate miura --rows 4 --columns 5 --fold 60 -o miura.fold
      synth generate kaleidocycle --solids 8 -o ring.json
    """
    if ctx.invoked_subcommand is not None:
        return
    if not listed and not as_json:
        click.echo(ctx.get_help())
        return
    from synth.patterns.catalogue import GENERATORS

    if as_json:
        print_json([_described(one) for one in GENERATORS.values()])
        return
    rows = table("name", "what", "parameters", "source")
    for one in GENERATORS.values():
        names = " ".join(p.name for p in one.parameters)
        rows.add_row(one.name, one.title, f"{names}; {one.relations}" if one.relations else names, one.source)
    console().print(rows)


def _described(generator: Generator) -> dict[str, Any]:
    return {
        "name": generator.name,
        "title": generator.title,
        "parameters": [
            {
                "name": one.name,
                "unit": "degrees" if one.unit == "angle" else one.unit,
                **{key: _written(one, getattr(one, key)) for key in ("default", "least", "most")},
                "meaning": one.meaning,
            }
            for one in generator.parameters
        ],
        "relations": generator.relations,
        "foldable": generator.foldable,
        "conditions": generator.conditions,
        "source": generator.source,
    }


def _command(generator: Generator) -> click.Command:
    """Return the command of one generator, an option for each of its parameters."""
    options: list[click.Parameter] = [
        click.Option(
            [f"--{one.name}"],
            type=int if one.unit == "count" else float,
            metavar={"count": "N", "length": "LENGTH", "angle": "DEGREES"}[one.unit],
            help=f"{one.meaning[0].upper()}{one.meaning[1:]}, from {one.told(one.least)} to {one.told(one.most)}."
            f"  [default: {one.told(one.default)}]",
        )
        for one in generator.parameters
    ]
    if generator.foldable:
        options.append(
            click.Option(
                ["--fold"],
                type=float,
                metavar="DEGREES",
                help="Fold the crease that moves most to this angle; equivalent creases fold alike if they can.",
            )
        )
    written = ".fold, .obj or another format" if generator.foldable else ".json, or .fold if it has panels"
    options.append(click.Option(["-o", "--output"], metavar="OUT", help=f"File to write: {written}."))
    options.append(click.Option(["--json", "as_json"], is_flag=True, help="Print the answer as JSON."))

    def run(fold: float | None = None, output: str | None = None, **given: Any) -> None:
        _run(generator, fold, output, **given)

    relations = f" Limits on parameters: {generator.relations}." if generator.relations else ""
    text = (
        f"{generator.title}.\n\n"
        f"Condition for its degrees of freedom: {generator.conditions}.{relations} Source: {generator.source}."
    )
    return FORCE(
        click.Command(generator.name, params=options, callback=run, help=text, short_help=f"{generator.title}.")
    )


def _run(
    generator: Generator,
    fold: float | None,
    output: str | None,
    *,
    force: bool,
    as_json: bool,
    **given: float | None,
) -> None:
    from graphs.files.formats import write
    from synth.patterns.generated import generate as made_by

    check_output(output, force=force)
    angles = {one.name for one in generator.parameters if one.unit == "angle"}
    values = {
        name: radians(value) if name in angles else value for name, value in given.items() if value is not None
    }
    with about(generator.name):
        made = made_by(generator.name, fold=None if fold is None else radians(fold), **values)
    lost = () if output is None else write(made.mechanism, output, force=force)
    if as_json:
        print_json({**made.to_json(), "output": output})
        return
    click.echo(str(made))
    tell_lost(lost)
    tell_written(output)


def _written(parameter: Parameter, value: float) -> float:
    return round(degrees(value), 9) if parameter.unit == "angle" else value
