"""The workbench: the page served on this machine, with Python behind it that reads the files dropped on it.

`app` serves the page and lets nobody else in, `asking` runs `reading` on a file, in a process of its own that can
be stopped. Theory: docs/theory/viewer.md.
"""
