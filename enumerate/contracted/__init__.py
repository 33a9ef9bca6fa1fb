"""Contracted graphs and maps, and binary links placed on their joints."""
