"""How help is written, as far as that can be tested: sentences, options that exist, defaults."""

import re

import click
import pytest

from synth.cli.main import main

HEADLESS = {
    "Of",
    "At",
    "Or",
    "And",
    "By",
    "As",
    "In",
    "On",
    "From",
    "To",
    "Than",
    "Which",
    "What",
    "That",
    "Where",
}
"""Words with which no help begins: what it is about would have to be guessed."""
TELLS = re.compile(r"\b(told|tells?)\b(?!( \w+){0,3} apart)", re.IGNORECASE)
OPTION = re.compile(r"(?<![\w/.-])--?[a-z][a-z-]*")


def _commands(command, path):
    yield path, command
    if isinstance(command, click.Group):
        context = click.Context(command, info_name=path[-1])
        for name in command.list_commands(context):
            yield from _commands(command.get_command(context, name), (*path, name))


COMMANDS = dict(_commands(main, ("synth",)))
NAMES = [" ".join(path) for path in COMMANDS]


def _paragraphs(command):
    """Yield the paragraphs of a help that are no examples."""
    for text in re.split(r"\n\s*\n", command.help):
        if "\b" not in text:
            yield " ".join(text.split())


def _beginnings(command):
    """Yield what stands by itself: the first paragraph, the line in a list of commands, the help of each option."""
    yield next(_paragraphs(command))
    if command.short_help:
        yield command.short_help
    yield from (option.help for option in command.params if isinstance(option, click.Option))


def _texts(command):
    yield from _beginnings(command)
    yield from _paragraphs(command)


def _named(words):
    """Return the command that a line of words calls."""
    return COMMANDS[max((path for path in COMMANDS if tuple(words[: len(path)]) == path), key=len)]


def _spellings(command):
    return {name for option in command.params for name in (*option.opts, *option.secondary_opts)} | {
        "-h",
        "--help",
    }


@pytest.mark.parametrize("path", COMMANDS, ids=NAMES)
def test_help_is_made_of_sentences(path):
    for text in _texts(COMMANDS[path]):
        assert text, "an option without help"
        assert re.match(r"[A-Z\"-]|k1:|R is", text), text
        assert re.search(r"[.?!](  \[default: [^\]]+\])?$", text), text
        assert not re.search(r"\((s|es)\)", text), text
        assert not TELLS.search(text), text
    for text in _beginnings(COMMANDS[path]):
        assert text.split()[0] not in HEADLESS, text


@pytest.mark.parametrize("path", COMMANDS, ids=NAMES)
def test_help_names_options_that_exist(path):
    here = _spellings(COMMANDS[path])
    for text in _texts(COMMANDS[path]):
        other = {
            spelling
            for named in re.findall(r"`(synth [^`]+)`", text)
            for spelling in _spellings(_named(named.split()))
        }
        for option in OPTION.findall(text):
            assert option in here | other, (option, text)


@pytest.mark.parametrize("path", COMMANDS, ids=NAMES)
def test_examples_name_options_that_exist(path):
    for line in re.findall(r"^\s+(synth .+)$", COMMANDS[path].help, re.MULTILINE):
        for option in OPTION.findall(re.sub(r"\"[^\"]*\"| -\w{2,}", "", line)):
            assert option in _spellings(_named(line.split())), line


@pytest.mark.parametrize("path", COMMANDS, ids=NAMES)
def test_defaults_are_shown(path):
    for option in COMMANDS[path].params:
        if not isinstance(option, click.Option) or (option.is_flag and not option.secondary_opts):
            continue
        default = option.to_info_dict()["default"]
        if default not in (None, (), ""):
            assert option.show_default or "default" in option.help, option.name
