"""Parallel platforms: a base and a top joined by legs with joints of all kinds."""
