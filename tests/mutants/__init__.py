"""Mutants: files with one operator or guard changed. Tests that pass with one of them do not hold that line."""
