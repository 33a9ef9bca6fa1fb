"""The workbench: the page served on this machine, with Python behind it that reads and judges what is dropped.

`guard` lets nobody else in, `app` has what is served, `asking` reads a file in a process of its own (`reading`),
which can be stopped, `serving` begins and ends. Theory: docs/theory/viewer.md.
"""
