"""Asking an atlas: conditions in words, statements under guard, reports, files found in it, rows written."""
