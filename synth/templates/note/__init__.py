"""The note of assembly: how a template is put together, in words, and a picture of the thing folded."""
