"""A site of an atlas: static pages to search, filter and fold, which work from a folder without a server."""
