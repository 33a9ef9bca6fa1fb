"""Running a command in this process."""

from __future__ import annotations

from click.testing import CliRunner

from synth.cli.main import main


def run(*words, code=0):
    result = CliRunner().invoke(main, [str(word) for word in words])
    assert result.exit_code == code, (result.output, result.exception)
    if code == 2:
        assert result.exception is None or isinstance(result.exception, SystemExit)
    return result
