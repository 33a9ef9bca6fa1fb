"""Pages in notebooks: a widget by anywidget, a still picture where there is none."""

import sys

import pytest

import synth
from graphs.errors import UnsolvableError
from synth.making.viewer.page_data import shown_of
from synth.making.viewer.pages import ViewPage


@pytest.fixture(scope="module")
def page(data):
    return ViewPage("<p>the page</p>", (shown_of(synth.read(data / "patterns" / "bird-base.fold"), "bird"),))


def test_the_widget_holds_the_page(page):
    pytest.importorskip("anywidget")
    widget = page.widget(height=420)
    state = widget.get_state()
    assert (state["html"], state["height"]) == ("<p>the page</p>", 420)
    assert 'sandbox", "allow-scripts' in state["_esm"]


def test_without_anywidget_it_says_what_to_install(page, monkeypatch):
    monkeypatch.setitem(sys.modules, "anywidget", None)
    with pytest.raises(UnsolvableError, match=r"pip install 'synthedra\[notebook\]'"):
        page.widget()


def test_a_still_picture_is_beside_the_page(page):
    bundle = page._repr_mimebundle_()
    assert bundle["image/svg+xml"].startswith("<svg")
    assert bundle["text/html"].startswith("<iframe")
