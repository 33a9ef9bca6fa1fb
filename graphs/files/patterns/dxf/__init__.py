"""DXF: records of a file, shapes among them as straight pieces, sheets made of those; lines and words written."""
