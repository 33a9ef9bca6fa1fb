"""Pages as text: nothing in them runs but their own script, nothing ends the element it is in."""

import json
from base64 import b64encode
from hashlib import sha256
from html.parser import HTMLParser

import pytest

from graphs.errors import UnsolvableError
from graphs.mechanism.sheet import Sheet
from synth.making.viewer.page_data import shown_of
from synth.making.viewer.pages import json_in_html, page
from tests.support.commands import run

HOSTILE = "</script><script>alert(1)</script><!--<script>]]>\u2028&lt;\x00"


class Elements(HTMLParser):
    """Scripts, styles and metas of a page, as a browser sees them."""

    def __init__(self, text):
        super().__init__()
        self.found, self.inside = [], None
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        if tag in ("script", "style", "meta", "title"):
            self.found.append([tag, dict(attributes), ""])
            self.inside = None if tag == "meta" else self.found[-1]

    def handle_endtag(self, tag):
        self.inside = None

    def handle_data(self, data):
        if self.inside is not None:
            self.inside[2] += data


@pytest.fixture
def built(tmp_path):
    (tmp_path / "page.js").write_text("if (1 < 2 && 3 > 2) { console.log('é') }", encoding="utf-8")
    (tmp_path / "page.css").write_text("a > b { color: red }", encoding="utf-8")
    return tmp_path


@pytest.fixture
def vertex():
    corners = ((0, 0), (1, 0), (0.5, 1), (-1, 0), (0.5, -1))
    return Sheet(5, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)), corners)


def test_data_keep_every_letter_and_end_nothing():
    text = json_in_html({HOSTILE: [HOSTILE]})
    assert not set("<>&\u2028\u2029") & set(text)
    assert json.loads(text) == {HOSTILE: [HOSTILE]}


def test_a_hostile_name_is_text(built, vertex):
    parsed = Elements(page([shown_of(vertex, HOSTILE)], built=built)).found
    assert [tag for tag, _, _ in parsed if tag in ("script", "style")] == ["style", "script", "script"]
    (data,) = [text for tag, attributes, text in parsed if attributes.get("type") == "application/json"]
    (shown,) = json.loads(data)["shown"]
    assert shown["name"].startswith("</script>")
    assert "\x00" not in shown["name"]
    assert next(text for tag, _, text in parsed if tag == "title").startswith("</script>")


def test_the_policy_allows_this_script_and_style_alone(built, vertex):
    parsed = Elements(page([shown_of(vertex)], built=built)).found
    (policy,) = [one["content"] for tag, one, _ in parsed if one.get("http-equiv") == "Content-Security-Policy"]
    rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
    assert rules["default-src"] == "'none'"
    assert set(rules) == {"default-src", "script-src", "style-src", "img-src", "base-uri", "form-action"}
    for rule, tag in (("script-src", "script"), ("style-src", "style")):
        text = [text for name, _, text in parsed if name == tag][-1]
        assert rules[rule] == f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"


def test_pages_load_nothing(built, vertex):
    text = page([shown_of(vertex)], built=built)
    assert " src=" not in text
    assert " href=" not in text


def test_without_a_script_it_is_said_what_is_missing(tmp_path, vertex):
    with pytest.raises(UnsolvableError, match="install node and npm"):
        page([shown_of(vertex)], built=tmp_path / "none")


def test_the_command_writes_html_only(tmp_path, data):
    told = run("view", data / "patterns" / "bird-base.fold", "-o", tmp_path / "page.svg", code=2).output
    assert "expected .html" in told
    assert told.count("\n") == 1
