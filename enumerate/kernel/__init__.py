"""Compiled code that several enumerators share: maps, labels, ranks of many rows at a time.

Its functions work on arrays; ids and mechanisms are made of them in the rooms that list things.
"""
