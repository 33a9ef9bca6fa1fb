"""Groups of commands that are looked up by name, and say which name is near where there is none."""

from __future__ import annotations

from difflib import get_close_matches

import click

from graphs.printing import plain

__all__ = ["NamedGroup"]


class NamedGroup(click.Group):
    """A group whose commands need not be loaded to be listed; `list_commands` and `get_command` find them."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command of the first word; one that is not known gets the name it is nearest to."""
        name = args[0]
        unknown = not name.startswith("-") and self.get_command(ctx, name) is None
        if unknown and not ctx.resilient_parsing:
            near = get_close_matches(name, self.list_commands(ctx), 1)
            ctx.fail(f"No such command {plain(name)!r}." + (f" Did you mean {near[0]!r}?" if near else ""))
        return super().resolve_command(ctx, args)
