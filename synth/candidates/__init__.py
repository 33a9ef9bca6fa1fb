"""Conical candidates evaluated."""
