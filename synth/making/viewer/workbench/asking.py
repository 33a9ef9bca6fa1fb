"""Files read, answered about and printed in processes of their own, which end with the request.

Theory: docs/theory/viewer.md.
"""

import asyncio
import json
import re
import sys
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager, suppress

_LONGEST = 120
"""Bytes of a name: file systems take 255 bytes, whatever the letters."""
_SECONDS = 120.0
_BEAT = 1.0
"""Seconds after which a blank line is sent, which shows whether anybody still waits."""
_CHUNK = 1 << 16
_AT_ONCE = 2
_WAITING = b'{"doing": "waiting until others are done", "step": 0, "of": 4}\n'
"""Sent while as many processes run as may; four is the number of steps of `reading`."""
_FAILED = "the file could not be read: the engine failed"


def file_name(text: str) -> str:
    r"""Return a name that is safe for a file: its last part, its extension kept."""
    last = re.split(r"[/\\]", text)[-1]
    name = re.sub(r"[^\w. ()+-]", "_", last).encode()[-_LONGEST:].decode(errors="ignore")
    return name.lstrip(".- ") or "file"


class Engine:
    """Tasks of `reading` run on files, each in a process of its own, a few at a time."""

    def __init__(self) -> None:
        self._free = asyncio.Semaphore(_AT_ONCE)

    async def lines(self, task: str, words: Sequence[str], content: bytes) -> AsyncIterator[bytes]:
        """Yield what a task prints about a file, as it comes, and blank lines while there is nothing.

        The words are a safe name and options of the task. If too many processes run already, the first line says
        that it waits. The pieces are those of lines of JSON; the last line has ``error`` if the process failed.
        The process ends when nobody takes what is yielded any more, or it took too long.
        """
        if self._free.locked():
            yield _WAITING
        async with self._running(task, words, content) as process:
            try:
                async for piece in beating(_taken(process)):
                    yield piece
                if await process.wait():
                    yield _error(words[0], _FAILED)
            except TimeoutError:
                yield _error(words[0], f"stopped after {_SECONDS:g} seconds; `synth mobility` has no such limit")

    async def whole(self, task: str, words: Sequence[str], content: bytes) -> tuple[int, bytes]:
        """Return the status of a task run on a file, and all that it wrote."""
        async with self._running(task, words, content) as process:
            try:
                pieces = [piece async for piece in _taken(process)]
                return await process.wait(), b"".join(pieces)
            except TimeoutError:
                return 1, b""

    @asynccontextmanager
    async def _running(
        self, task: str, words: Sequence[str], content: bytes
    ) -> AsyncIterator[asyncio.subprocess.Process]:
        """Start a process when one may run, feed it the content, and end it at last."""
        async with self._free:
            process = await _begun(task, words)
            feeding = asyncio.create_task(_fed(process, content))
            try:
                yield process
            finally:
                await _ended(process, feeding)


async def beating(pieces: AsyncIterator[bytes]) -> AsyncIterator[bytes]:
    """Yield pieces of lines, and a blank line for each that is empty, but none within a line."""
    between = True
    async for piece in pieces:
        if piece:
            between = piece.endswith(b"\n")
            yield piece
        elif between:
            yield b"\n"


async def _begun(task: str, words: Sequence[str]) -> asyncio.subprocess.Process:
    pipe = asyncio.subprocess.PIPE
    command = (sys.executable, "-m", f"{__package__}.reading", task, *words)
    return await asyncio.create_subprocess_exec(*command, stdin=pipe, stdout=pipe, stderr=asyncio.subprocess.DEVNULL)


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
