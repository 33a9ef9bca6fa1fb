"""Follow every link of the site that `make docs` has built: pages, pictures, downloads, and places in pages.

Links to other sites are listed with ``--others``, not followed: the site is built without a network.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

SITE = Path(__file__).resolve().parent / "_build" / "html"


@dataclass
class Page(HTMLParser):
    """What a page of the site links to, and the places in it that can be linked to.

    Attributes
    ----------
    links, places : set of str
    """

    links: set[str] = field(default_factory=set)
    places: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        super().__init__()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Take what an element names."""
        del tag
        for name, value in attrs:
            if value and name in ("href", "src"):
                self.links.add(value)
            elif value and name == "id":
                self.places.add(value)


def main() -> None:
    """Print the links that lead nowhere; the exit status says whether there are any."""
    pages = {place: _page(place) for place in sorted(SITE.rglob("*.html"))}
    if not pages:
        sys.exit(f"{SITE}: no site; `make docs` builds it")
    if "--others" in sys.argv:
        print(*sorted({link for page in pages.values() for link in page.links if _is_elsewhere(link)}), sep="\n")
        return
    lost = [f"{place.relative_to(SITE)}: {link}" for place in pages for link in _lost(place, pages)]
    print(f"{sum(len(page.links) for page in pages.values())} links of {len(pages)} pages, {len(lost)} lead nowhere")
    sys.exit("\n".join(lost) or 0)


def _page(place: Path) -> Page:
    page = Page()
    page.feed(place.read_text(encoding="utf-8"))
    return page


def _is_elsewhere(link: str) -> bool:
    return bool(urlsplit(link).scheme or urlsplit(link).netloc)


def _lost(place: Path, pages: dict[Path, Page]) -> Iterator[str]:
    """Yield the links of a page that lead nowhere."""
    for link in sorted(pages[place].links):
        if _is_elsewhere(link):
            continue
        parts = urlsplit(link)
        there = (place.parent / unquote(parts.path)).resolve() if parts.path else place
        if not there.exists() or (
            parts.fragment and there in pages and unquote(parts.fragment) not in pages[there].places
        ):
            yield link


if __name__ == "__main__":
    main()
