"""The check of a built site: links that would break on another host are named."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "docs"))

from relative_links import faults_of


def test_links_of_a_site(tmp_path):
    (tmp_path / "deep").mkdir()
    (tmp_path / "index.html").write_text(
        '<a href="deep/page.html#part"><a href="https://example.org/x"><img src="/absolute.png">'
        '<a href="../outside.html"><a href="none.html"><a href="#here">'
    )
    (tmp_path / "deep" / "page.html").write_text('<a href="../index.html">')
    assert faults_of(tmp_path) == [
        "index.html: /absolute.png is absolute",
        "index.html: ../outside.html leaves the site",
        "index.html: none.html is missing",
    ]
