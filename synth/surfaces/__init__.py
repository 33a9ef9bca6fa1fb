"""Linkages mapped to right cones and cylinders."""
