"""What the pages of a site have in common: their head, and what they may load."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from graphs.printing import plain

__all__ = ["document"]

_POLICY = (
    "default-src 'none'; script-src 'self' file:; style-src 'self' file: 'unsafe-inline'; "
    "img-src 'self' file: blob: data:; base-uri 'none'; form-action 'none'"
)
"""Own scripts, styles and pictures, and nothing else; no requests to anywhere."""

_DOCUMENT = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
{styles}
</head>
<body>
{body}
</body>
</html>
"""


def document(title: str, styles: Sequence[str], body: str) -> str:
    """Return a page of a site with an HTML body.

    The title is plain text, escaped here; style sheets are paths from the page.
    """
    sheets = "\n".join(f'<link rel="stylesheet" href="{place}">' for place in styles)
    return _DOCUMENT.format(policy=_POLICY, title=escape(plain(title, 200)), styles=sheets, body=body)
