"""Layers of panels in space, where only some lie on each other.

A sheet at a configuration, the planes in which panels overlap and their images as one (`planes`), and the orders in
which they lie there (`orders`).
"""
