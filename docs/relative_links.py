"""Check that a built site can stand in any folder of any host: its own links are relative, and lead to files of it.

python docs/relative_links.py SITE
"""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class _Links(HTMLParser):
    """The targets of links, scripts, style sheets and pictures of a page."""

    def __init__(self) -> None:
        super().__init__()
        self.targets: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Keep what a tag leads to."""
        del tag
        self.targets += [value for name, value in attrs if name in ("href", "src") and value]


def faults_of(site: Path) -> list[str]:
    """Return a line for each link of a page that is absolute, leaves the site, or leads to no file of it."""
    faults = []
    for page in sorted(site.rglob("*.html")):
        links = _Links()
        links.feed(page.read_text(encoding="utf-8"))
        for target in dict.fromkeys(links.targets):
            parts = urlsplit(target)
            if parts.scheme or parts.netloc or not parts.path:
                continue
            place = (page.parent / unquote(parts.path)).resolve()
            if parts.path.startswith("/"):
                faults.append(f"{page.relative_to(site)}: {target} is absolute")
            elif not place.is_relative_to(site.resolve()):
                faults.append(f"{page.relative_to(site)}: {target} leaves the site")
            elif not place.exists():
                faults.append(f"{page.relative_to(site)}: {target} is missing")
    return faults


if __name__ == "__main__":
    found = faults_of(Path(sys.argv[1]))
    for fault in found:
        print(fault)
    sys.exit(bool(found))
