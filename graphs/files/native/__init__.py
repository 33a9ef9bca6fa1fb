"""The native JSON formats."""
