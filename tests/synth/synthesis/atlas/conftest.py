"""A small atlas that the tests of this folder ask."""

from __future__ import annotations

from pathlib import Path

import pytest

from synth.synthesis.atlas.atlas_file import Atlas, open_atlas
from synth.synthesis.atlas.building import AtlasPlan, build_atlas


@pytest.fixture(scope="session")
def small_atlas(tmp_path_factory: pytest.TempPathFactory) -> Atlas:
    """Return an atlas of types of up to six links, without coordinates."""
    place: Path = tmp_path_factory.mktemp("atlas") / "small.sqlite"
    build_atlas(place, AtlasPlan(6, realised=False))
    return open_atlas(place)


@pytest.fixture(scope="session")
def real_atlas(tmp_path_factory: pytest.TempPathFactory) -> Atlas:
    """Return an atlas of types of up to four links, realised."""
    place: Path = tmp_path_factory.mktemp("atlas") / "real.sqlite"
    build_atlas(place, AtlasPlan(4, creases=2, orders_of=()))
    return open_atlas(place)
