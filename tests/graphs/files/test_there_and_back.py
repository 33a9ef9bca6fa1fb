"""Crease patterns by other people, to every format and back: equal numbers, or a line that says what is lost."""

import pytest
from real_patterns import names_of_patterns

from graphs.answer.mobility import counts_and_ranks
from graphs.errors import FileError, InvariantError, UnsolvableError
from graphs.files.formats import WRITERS, read, write

COUNTS = ("class", "links", "joints", "loops", "centres", "mobility")
POSE = ("dof", "h", "certainty", "flat")
OF_THE_POSE = ("coordinates of", "the distances of welded points", "other frame")
"""In a line that tells that the freedoms at the pose are lost, or what they hang on."""
SMALL = (*names_of_patterns(710), "ossvg_simpleVertex.svg")
PATTERNS = [name if name in SMALL else pytest.param(name, marks=pytest.mark.slow) for name in names_of_patterns()]


def numbers(mechanism):
    """The counts with the exact mobility, and the freedoms as it lies."""
    told = counts_and_ranks(mechanism).to_json()
    exact, pose = told["exact"], told["pose"]
    counts = [*(told[key] for key in COUNTS), exact and exact["mobility"]]
    return counts, pose and [pose[key] for key in POSE]


def refused_in_one_line(error, given, path):
    """A refusal is one line and leaves nothing; what is then written all the same says what it lost."""
    assert len(str(error).splitlines()) == 1
    assert not path.exists()
    if "--lossy" in str(error):
        assert write(given, path, lossy=True)


def there_and_back(given, answer, path):
    """Write what was read, read it again, and compare the numbers; tell whether it could be written."""
    try:
        lost = write(given, path)
    except UnsolvableError as error:
        refused_in_one_line(error, given, path)
        return False
    counts, pose = answer
    counts_again, pose_again = numbers(read(path))
    assert counts_again == counts, lost
    told = [line for line in lost for part in OF_THE_POSE if part in line]
    assert pose_again == pose or told, (pose, pose_again, lost)
    return True


@pytest.mark.parametrize("name", PATTERNS or ["a folder of patterns"])
def test_patterns_by_other_people_are_the_same_in_every_format(name, fold_folder, tmp_path):
    try:
        given = read(fold_folder / name)
        answer = numbers(given)
    except (FileError, InvariantError) as error:
        assert len(str(error).splitlines()) == 1
        return
    written = {suffix: there_and_back(given, answer, tmp_path / f"a{suffix}") for suffix in WRITERS}
    assert written[".json"]
    assert written[".fold"]
