"""Commands on things in space: folding."""
