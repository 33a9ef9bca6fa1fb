"""What links and joints are called: types that every room uses."""

from __future__ import annotations

from collections.abc import Hashable, Mapping

__all__ = ["JointId", "Joints", "LinkId"]

JointId = Hashable
"""Name of a joint: text or a number, or anything hashable."""

LinkId = Hashable
"""Name of a link."""

Joints = Mapping[JointId, tuple[LinkId, LinkId]]
"""The joints of a graph: the two links of each."""
