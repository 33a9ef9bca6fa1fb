"""Mechanisms as files: `formats` has a reader and a writer for each extension.

Crease patterns are in `patterns`, the project's own JSON in `native`, link-joint graphs without loops in `bare`.
Every failure is a `FileError` with its place; a file is written whole or not at all.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
