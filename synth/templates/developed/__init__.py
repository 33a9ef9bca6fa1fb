"""Linkages on cones and cylinders as things: links in layers, as flat pieces that are rolled up and as solids."""
