"""The table of what is written: places that exist, formats under their own suffixes."""

from graphs.files.outputs import Format
from synth.exporters import EXPORTERS, Placed


def test_every_function_of_the_table_exists():
    formats = [one for table in EXPORTERS.values() for one in table.values()]
    assert len(formats) > 25
    for one in formats:
        assert isinstance(one.to_bytes, Placed), one.name
        assert callable(one.to_bytes.function)
        if isinstance(one.lost, Placed):
            assert callable(one.lost.function)


def test_formats_stand_under_their_suffixes():
    for kind, table in EXPORTERS.items():
        for key, one in table.items():
            assert isinstance(one, Format)
            assert one.suffix.startswith(".")
            assert key == one.suffix or kind == "models"
