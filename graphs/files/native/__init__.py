"""The native JSON formats, each with its reader and its writer; schemas are in ``graphs/schema/``."""
