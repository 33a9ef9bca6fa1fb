"""Small parts of the room, each by an example."""

from synth.making.viewer.pages import json_in_html
from synth.making.viewer.workbench.app import Place
from synth.making.viewer.workbench.asking import file_name
from synth.making.viewer.workbench.reading import are_edits


def test_example_of_json_in_html():
    assert json_in_html({"</script><!--": "&\u2028"}) == '{"\\u003c/script\\u003e\\u003c!--":"\\u0026\\u2028"}'


def test_example_of_address():
    assert Place(8000, "secret").address == "http://127.0.0.1:8000/secret/"


def test_example_of_file_name():
    assert (file_name("../../etc/pass\x00wd.fold"), file_name("C:\\a b.cp"), file_name("..")) == (
        "pass_wd.fold",
        "a b.cp",
        "file",
    )


def test_example_of_are_edits():
    assert (
        are_edits(["lock:3", "crease:12~0.5,-1e-3", "ride-alongs"]),
        are_edits(["lock:-1"]),
        are_edits(["rm:1"]),
    ) == (True, False, False)
