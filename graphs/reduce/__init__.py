"""Reduction: ride-alongs and dyads taken off, Assur groups."""
