"""Files read, judged and printed in processes of their own, a few at a time, which end with who asked.

Theory: docs/theory/viewer.md.
"""

from __future__ import annotations

import asyncio
import json
import re
import sys
from collections.abc import AsyncIterator, Sequence
from contextlib import suppress

__all__ = ["Engine", "beating", "file_name"]

_LONGEST = 120
"""Bytes of a name: file systems take 255 bytes, whatever the letters."""
_SECONDS = 120.0
_BEAT = 1.0
"""Seconds after which a blank line is sent, so that it is seen whether somebody still waits."""
_CHUNK = 1 << 16
_AT_ONCE = 2
_WAITING = b'{"doing": "waiting until others are done", "step": 0, "of": 4}\n'
"""What is said while as many processes run as may; four is the number of steps of `reading`."""
_FAILED = "it could not be read: the engine failed"


def file_name(given: str) -> str:
    r"""Return a name that is safe for a file: its last part, its extension kept.

    >>> file_name("../../etc/pass\x00wd.fold"), file_name("C:\\a b.cp"), file_name("..")
    ('pass_wd.fold', 'a b.cp', 'file')
    """
    last = re.split(r"[/\\]", given)[-1]
    made = re.sub(r"[^\w. ()+-]", "_", last).encode()[-_LONGEST:].decode(errors="ignore")
    return made.lstrip(".- ") or "file"


class Engine:
    """Modules of this package run on files, each in a process of its own."""

    def __init__(self) -> None:
        self._free = asyncio.Semaphore(_AT_ONCE)

    async def lines(self, module: str, words: Sequence[str], content: bytes) -> AsyncIterator[bytes]:
        """Yield what a module prints about a file, as it comes, and blank lines while there is nothing.

        Where as many processes run as may, the first line says that it waits.

        The process ends when nobody takes what is yielded any more, or it took too long.

        Parameters
        ----------
        module : str
            Its name in this package.
        words : sequence of str
            A safe name, and what else the module is told.
        content : bytes

        Yields
        ------
        bytes
            Lines of JSON, in pieces; the last has ``error`` if the process did not end well.
        """
        if self._free.locked():
            yield _WAITING
        async with self._free:
            process = await _begun(module, words)
            feeding = asyncio.create_task(_fed(process, content))
            try:
                async for piece in beating(_taken(process)):
                    yield piece
                if await process.wait():
                    yield _error(words[0], _FAILED)
            except TimeoutError:
                yield _error(words[0], f"stopped after {_SECONDS:g} seconds; `synth mobility` has no such limit")
            finally:
                await _ended(process, feeding)

    async def whole(self, module: str, words: Sequence[str], content: bytes) -> tuple[int, bytes]:
        """Return the status of a module run on a file, and all that it wrote.

        Parameters
        ----------
        module, words, content
            As of `lines`.
        """
        async with self._free:
            process = await _begun(module, words)
            feeding = asyncio.create_task(_fed(process, content))
            try:
                pieces = [piece async for piece in _taken(process)]
                return await process.wait(), b"".join(pieces)
            except TimeoutError:
                return 1, b""
            finally:
                await _ended(process, feeding)


async def beating(pieces: AsyncIterator[bytes]) -> AsyncIterator[bytes]:
    """Yield pieces of lines, and a blank line for each that is empty, but none within a line.

    Parameters
    ----------
    pieces : asynchronous iterator of bytes
    """
    between = True
    async for piece in pieces:
        if piece:
            between = piece.endswith(b"\n")
            yield piece
        elif between:
            yield b"\n"


async def _begun(module: str, words: Sequence[str]) -> asyncio.subprocess.Process:
    pipe = asyncio.subprocess.PIPE
    command = (sys.executable, "-m", f"{__package__}.{module}", *words)
    return await asyncio.create_subprocess_exec(
        *command, stdin=pipe, stdout=pipe, stderr=asyncio.subprocess.DEVNULL
    )


async def _fed(process: asyncio.subprocess.Process, content: bytes) -> None:
    assert process.stdin is not None
    with suppress(BrokenPipeError, ConnectionResetError):  # it ended before it had read all
        process.stdin.write(content)
        await process.stdin.drain()
    process.stdin.close()


async def _taken(process: asyncio.subprocess.Process) -> AsyncIterator[bytes]:
    """Yield what a process writes, and nothing now and then where it is silent."""
    assert process.stdout is not None
    loop = asyncio.get_running_loop()
    end = loop.time() + _SECONDS
    reading = asyncio.create_task(process.stdout.read(_CHUNK))
    try:
        while True:
            done, _ = await asyncio.wait([reading], timeout=_BEAT)
            if not done:
                yield b""
            elif piece := reading.result():
                yield piece
                reading = asyncio.create_task(process.stdout.read(_CHUNK))
            else:
                return
            if loop.time() > end:
                raise TimeoutError
    finally:
        reading.cancel()


async def _ended(process: asyncio.subprocess.Process, feeding: asyncio.Task[None]) -> None:
    feeding.cancel()
    if process.returncode is None:
        with suppress(ProcessLookupError):
            process.kill()
    await asyncio.gather(feeding, return_exceptions=True)
    await process.wait()


def _error(name: str, why: str) -> bytes:
    return b"\n" + json.dumps({"error": f"{name}: {why}"}).encode() + b"\n"
