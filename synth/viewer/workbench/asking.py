"""Files read and judged in processes of their own, one after the other, which end with who asked.

Theory: docs/theory/viewer.md.
"""

from __future__ import annotations

import asyncio
import json
import re
import sys
from collections.abc import Awaitable, Callable, Sequence

__all__ = ["Judging", "are_edits", "file_name"]

_LONGEST = 120
_MOST_EDITS = 200
_SECONDS = 120.0
_LOOK = 0.25
"""Seconds between two looks whether somebody still waits."""
_AT_ONCE = 2
_COMMAND = (sys.executable, "-m", "synth.viewer.workbench.reading")


def file_name(given: str) -> str:
    r"""Return a name that is safe for a file: its last part, its extension kept.

    Examples
    --------
    >>> file_name("../../etc/pass\x00wd.fold"), file_name("C:\\a b.cp"), file_name("..")
    ('pass_wd.fold', 'a b.cp', 'file')
    """
    last = re.split(r"[/\\]", given)[-1]
    made = re.sub(r"[^\w. ()+-]", "_", last)[-_LONGEST:].lstrip(".- ")
    return made or "file"


def are_edits(given: Sequence[str]) -> bool:
    """Tell whether edits are of the kinds that are known, and not too many.

    Examples
    --------
    >>> are_edits(["lock:3", "remove:12"]), are_edits(["lock:-1"]), are_edits(["rm:1"])
    (True, False, False)
    """
    return len(given) <= _MOST_EDITS and all(re.fullmatch(r"(lock|remove):[0-9]{1,9}", edit) for edit in given)


class Judging:
    """Files judged, a few at a time."""

    def __init__(self) -> None:
        self._free = asyncio.Semaphore(_AT_ONCE)

    async def of(self, words: Sequence[str], content: bytes, gone: Callable[[], Awaitable[bool]]) -> bytes:
        """Return what a page shows of a file, as JSON.

        Parameters
        ----------
        words : sequence of str
            A safe name, and edits.
        content : bytes
        gone : callable
            Whether nobody waits for it any more; then it is stopped.

        Returns
        -------
        bytes
            JSON with ``shown`` or ``error``.
        """
        async with self._free:
            return await _judged(words, content, gone)


async def _judged(words: Sequence[str], content: bytes, gone: Callable[[], Awaitable[bool]]) -> bytes:
    pipe = asyncio.subprocess.PIPE
    process = await asyncio.create_subprocess_exec(
        *_COMMAND, *words, stdin=pipe, stdout=pipe, stderr=asyncio.subprocess.DEVNULL
    )
    answer = asyncio.create_task(process.communicate(content))
    try:
        why = await _watched(answer, gone)
        if why:
            return _error(words[0], why)
        out, _ = answer.result()
        return out if process.returncode == 0 else _error(words[0], "it could not be read: the engine failed")
    finally:
        if process.returncode is None:
            process.kill()
        await asyncio.gather(answer, return_exceptions=True)


async def _watched(answer: asyncio.Task[tuple[bytes, bytes]], gone: Callable[[], Awaitable[bool]]) -> str:
    """Wait for an answer; return why it is not waited for any longer, or nothing."""
    loop = asyncio.get_running_loop()
    end = loop.time() + _SECONDS
    while not answer.done():
        await asyncio.wait([answer], timeout=_LOOK)
        if answer.done():
            break
        if await gone():
            return "stopped"
        if loop.time() > end:
            return f"stopped after {_SECONDS:g} seconds; `synth mobility` has no such limit"
    return ""


def _error(name: str, why: str) -> bytes:
    return json.dumps({"error": f"{name}: {why}"}).encode()
