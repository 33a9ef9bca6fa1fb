"""BibTeX of sources: each entry is whole, each command with sources exists, and prints them in place of an answer."""

import re
from pathlib import Path

import click
import pytest
from commands import run

from synth.citing import CITED, ENTRIES, bibtex
from synth.cli.main import main


def test_entries_are_bibtex_whose_braces_close():
    text = bibtex(list(ENTRIES))
    assert re.findall(r"^@\w+\{(\w+),$", text, re.MULTILINE) == list(ENTRIES)
    assert text.count("{") == text.count("}")


@pytest.mark.parametrize("name", CITED)
def test_a_command_prints_its_sources(name):
    command: click.Command = main
    for word in name.split():
        command = command.get_command(click.Context(command), word)
        assert command is not None, name
    words = [*name.split(), *([next(iter(command.commands))] if isinstance(command, click.Group) else [])]
    assert run(*words, "--cite").output.rstrip() == bibtex(CITED[name])


def test_each_year_is_that_of_the_theory_pages():
    pages = "".join(page.read_text() for page in Path("docs/theory").glob("*.md"))
    for key, (_, fields) in ENTRIES.items():
        last = fields["author"].split(" and ")[0].split(",")[0].split(" ")[-1].replace("Jr.", "Bayardo")
        assert last in pages, key
        assert fields.get("year", "") in pages, key
