"""Mechanisms for simulators: rigid bodies, a tree of hinges, and what closes the loops that the tree leaves open.

`assembly_of` makes bodies of anything that has coordinates; `write_model` writes them in the format of a simulator.
Files: `bodies` (plates, shells and bars, mass and inertia), `shells` (links on cones and cylinders), `assembly` (bodies
and hinges at a configuration, the tree), `connections` (which points of the cut hinges have to be held together),
`mjcf`, `urdf`, `sdf`, `usd`, `step`, `tables` (motions for control), `writing` (a record for each format). Guide:
docs/guides/simulate.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
