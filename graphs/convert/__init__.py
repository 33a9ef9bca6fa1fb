"""One kind of mechanism made of another."""
