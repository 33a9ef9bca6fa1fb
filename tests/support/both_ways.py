"""``python -m both_ways``: each call of functions on lists in a few counts, made on arrays too, as machine code does it.

A process of its own, in which kernels are interpreted. It prints how many calls were compared, function by function.
"""

import json
from collections import Counter

import numpy as np

from enumerate.chains import ChainQuery, count_job
from enumerate.contracted import orbits, states
from enumerate.kernel import labelling
from enumerate.machine_code.kernels import _kernels
from enumerate.runner._run import total_of

OUTPUTS = {labelling._refine: (4, 5), states._step: (8,), states._slot_of: ()}
"""The functions on lists, and which of their arguments they write to."""
QUERIES = [ChainQuery(8, 1), ChainQuery(9, 2), ChainQuery(10, 1), ChainQuery(8, 1, inversions=True)]


def both(on_lists, on_arrays, calls):
    """Return a function that calls both, and holds them against each other."""

    def call(*arguments):
        copies = [a.copy() if isinstance(a, np.ndarray) else a for a in arguments]
        with np.errstate(over="ignore"):  # as machine code does
            expected = on_arrays(*copies)
        found = on_lists(*arguments)
        assert found == expected
        if found or on_lists is not states._step:  # after a step that cannot be nothing goes on
            assert all(np.array_equal(arguments[i], copies[i]) for i in OUTPUTS[on_lists])
        calls[on_arrays.__name__] += 1
        return found

    return call


def main():
    """Put both in the place of each function wherever it is named, count, and print the numbers of calls."""
    calls = Counter()
    for on_lists, on_arrays in _kernels.interpreted:
        if on_lists in OUTPUTS:
            for module in (labelling, orbits, states):
                if hasattr(module, on_arrays.__name__):
                    setattr(module, on_arrays.__name__, both(on_lists, on_arrays, calls))
    for query in QUERIES:
        total_of(count_job(query, "orbits"))
    print(json.dumps(calls))


if __name__ == "__main__":
    main()
