"""Reading and writing mechanisms as files; start at :mod:`graphs.files.formats`."""
