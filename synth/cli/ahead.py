"""``python -m synth.cli.ahead``: compile the code of large enumerations on all cores, before their first use."""

import os
import signal
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager, redirect_stdout
from multiprocessing import active_children
from pathlib import Path
from time import monotonic

import synth
from enumerate.machine_code.folders import MISSING, writable_base
from enumerate.machine_code.kernels import can_compile, compiled_here, use_machine_code
from graphs.errors import numbered
from synth.cli.main import main
from synth.cli.runner import cores

_SMALL = (
    "enumerate sc --links 8 --dof 1",
    "enumerate chains --links 8 --dof 1",
    "enumerate scd --links 4 --dof 3 --max-degree 3",
    "enumerate chains --links 6 --dof 1 --count",
    "enumerate conical --chain watt --ground 0 --slots 8",
    "enumerate sc --links 6 --dof 1 --count",
    "enumerate scd --links 4 --dof 1 --max-degree 4",
    "enumerate scd --links 4 --dof 1 --max-degree 4 --count",
    "cone behaviour --angles 120,95,45,85",
)
"""Commands that are fast once their code is compiled, and run the code of larger ones.

The first three take longest and have little in common: the SCD graphs of open chains need no list of SC graphs.
With eight links there are three loops, made of two.
"""


def compile_ahead() -> int:
    """Run small commands, one per core at a time, so that their code is kept; return how many functions are new.

    A function counts once for each type of arguments.
    """
    with ProcessPoolExecutor(cores()) as pool:
        try:
            with _deaf_to_interrupts():  # the processes that are started here inherit it
                counted = [*(pool.submit(_run, command) for command in _SMALL), pool.submit(_positions)]
            return sum(new.result() for new in counted)
        except KeyboardInterrupt:
            for worker in active_children():
                worker.kill()  # its finished functions are kept; while it compiles it handles no other signal
            raise


@contextmanager
def _deaf_to_interrupts() -> Iterator[None]:
    """Put off Ctrl-C, which would interrupt a pool while it starts."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _run(command: str) -> int:
    use_machine_code()
    before = compiled_here()
    workers = ["--workers", "1"] if command.startswith("enumerate") else []
    with Path(os.devnull).open("w", encoding="utf-8") as nowhere, redirect_stdout(nowhere):
        main([*command.split(), *workers], standalone_mode=False)
    return compiled_here() - before


def _positions() -> int:
    """Compile the search for assembly modes, for which commands need a file."""
    from synth.catalogue.patterns.hinged_rings import spherical_ring

    before = compiled_here()
    synth.positions(spherical_ring([1.0, 1.2, 0.9, 1.4]), drive={0: 0.1}, circuits=False)
    return compiled_here() - before


def _main() -> None:
    if not can_compile():
        sys.exit(f"nothing is compiled ahead: {MISSING}")
    folder = writable_base()
    if folder is None:
        sys.exit("nothing is compiled ahead: no folder to keep it in; try a folder of yours in SYNTHEDRA_CACHE")
    begin = monotonic()
    what = f"Compiling the code of enumerations once, on {numbered(cores(), 'core')}: a minute or two."
    try:
        print(f"{what} All else is ready: wait, or stop this with Ctrl-C.", flush=True)
        new = compile_ahead()
    except KeyboardInterrupt:
        sys.exit("stopped; the rest is compiled at its first use")
    print(f"{new or 'no'} functions were new; {monotonic() - begin:.0f} s; kept in {folder}")


if __name__ == "__main__":
    _main()
