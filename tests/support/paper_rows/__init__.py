"""What the five papers print, row by row: where, how it is asked here, the figure printed, and what ours has to be.

`docs/papers.py` writes docs/papers.md from these rows, `tests/papers/test_page.py` runs each and holds the page to them.
"""
