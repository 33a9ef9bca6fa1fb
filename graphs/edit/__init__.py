"""Edits of SC and SCD graphs, with the change of mobility they predict."""
