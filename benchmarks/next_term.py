"""What a count of chains of one freedom costs, from a random sample of its contracted graphs.

    python benchmarks/next_term.py LINKS [CUBIC GRAPHS [GRAPHS OF A SIZE]]

writes benchmarks/results/next_term-LINKS.json. Each contracted graph comes from one cubic graph
(`enumerate.contracted.graphs`). Of the cubic graphs, in the order in which they are made, one is drawn of each of
some hundred equal stretches, each equally likely, by a seed that is fixed, and all that comes of them is made:
their number of graphs of a size, times the length of a stretch, is an estimate without bias of how many there are.
Of the graphs of each size that were made some are drawn again and counted on by both methods: mean processor
times, and mean numbers of chains. Errors are standard errors as if cubic graphs were drawn from all (stretches
make them smaller), and for the second draw between graphs, as if the two were independent. Where few graphs hold
most of the chains, a sample without them makes both the estimate and its error too small. Times are of one
process; what else the machine did at the time is told by its load.

For 18 links, where all is known, `number` and `graphs` can be held against what is counted: 1535380884 and
311757.
"""

from __future__ import annotations

import json
import os
import platform
import sys
from collections import defaultdict
from collections.abc import Callable
from functools import partial
from pathlib import Path
from time import process_time
from typing import Any, NamedTuple

import numpy as np

from enumerate.chains.counting import count_by_burnside, count_by_orbits
from enumerate.contracted.graphs import cubic_graphs, descendants
from enumerate.machine_code.kernels import use_machine_code
from graphs.types import Bytes, Floats

RESULTS = Path(__file__).parent / "results"
SEED = 20
DAY = 86_400
MOST = 2
"""Longest string of a chain of one freedom."""


class Sample(NamedTuple):
    """What comes of some cubic graphs.

    Attributes
    ----------
    codes : mapping
        Of each number of links the graphs.
    numbers : mapping
        Of each number of links how many graphs come of each cubic one.
    making : float
        Processor seconds for each graph.
    """

    codes: dict[int, Bytes]
    numbers: dict[int, Floats]
    making: float


class Counted(NamedTuple):
    """What counting on some graphs of each size gave: chains, and processor seconds, of each graph."""

    chains: dict[int, Floats]
    seconds: dict[str, dict[int, Floats]]


def drawn(cubic: Bytes, n: int, wanted: int, dice: np.random.Generator) -> Sample:
    """Draw cubic graphs, one of each stretch of neighbours, and make all that comes of them."""
    list(descendants(cubic[:1], n))  # compiled by then
    codes, numbers = defaultdict(list), defaultdict(lambda: np.zeros(wanted))
    stretches = np.linspace(0, len(cubic), wanted + 1)
    start = process_time()
    for i in range(wanted):
        place = int(dice.uniform(stretches[i], stretches[i + 1]))
        for links, made in descendants(cubic[place : place + 1], n):
            codes[links].append(made)
            numbers[links][i] = len(made)
    making = (process_time() - start) / sum(sum(map(len, made)) for made in codes.values())
    return Sample({links: np.concatenate(rows) for links, rows in codes.items()}, dict(numbers), making)


def each(count: Callable[[Bytes], int], codes: Bytes) -> tuple[Floats, Floats]:
    """Return of each graph the number of chains and the processor seconds."""
    count(codes[:1])  # compiled by then
    found, seconds = np.empty(len(codes)), np.empty(len(codes))
    for i in range(len(codes)):
        start = process_time()
        found[i] = count(codes[i : i + 1])
        seconds[i] = process_time() - start
    return found, seconds


def counted(sample: Sample, links: int, wanted: int, dice: np.random.Generator) -> Counted:
    """Count on some graphs of each size by both methods, which must agree."""
    chains: dict[int, Floats] = {}
    seconds: dict[str, dict[int, Floats]] = {"orbits": {}, "burnside": {}}
    for n, codes in sample.codes.items():
        some = codes[dice.permutation(len(codes))[:wanted]]
        chains[n], seconds["orbits"][n] = each(partial(by_orbits, n, links), some)
        same, seconds["burnside"][n] = each(partial(by_burnside, n, links), some)
        if (same != chains[n]).any():
            sys.exit(f"the methods do not agree on graphs with {n} links")
        print(n, len(codes), len(some), *(f"{m} {1e6 * s[n].mean():.0f} us" for m, s in seconds.items()), flush=True)
    return Counted(chains, seconds)


def by_orbits(n: int, links: int, codes: Bytes) -> int:
    """Return the number of chains of some graphs."""
    return count_by_orbits(codes, n, links, MOST, False)


def by_burnside(n: int, links: int, codes: Bytes) -> int:
    """Return the number of chains of some graphs."""
    return count_by_burnside(codes, n, links, MOST, False)


def total(cubic: int, values: dict[int, Floats], numbers: dict[int, Floats]) -> dict[str, float]:
    """Return the sum over sizes of (number of graphs) (mean of a value), with its standard error.

    Parameters
    ----------
    cubic : int
        Number of cubic graphs.
    values : mapping
        Of each size the values of the graphs that were drawn.
    numbers : mapping
        Of each size how many graphs came of each cubic graph.
    """
    of_cubic = sum((numbers[n] * values[n].mean() for n in numbers), np.zeros(1))  # what each cubic graph brings
    between = (cubic * of_cubic.std(ddof=1)) ** 2 / len(of_cubic)
    within = sum(
        (cubic * numbers[n].mean()) ** 2 * values[n].var(ddof=1) / len(values[n]) for n in numbers if len(values[n]) > 1
    )
    return {"estimate": float(f"{cubic * of_cubic.mean():.4g}"), "error": float(f"{(between + within) ** 0.5:.2g}")}


def figures_of(cubic: int, sample: Sample, found: Counted) -> dict[str, Any]:
    """Return what is estimated."""
    costs = {method: total(cubic, values, sample.numbers) for method, values in found.seconds.items()}
    graphs = total(cubic, {n: np.ones(1) for n in sample.numbers}, sample.numbers)
    return {
        "graphs": {
            **graphs,
            "made": sum(map(len, sample.codes.values())),
            "microseconds to make one": round(1e6 * sample.making, 1),
        },
        "number": total(cubic, found.chains, sample.numbers),
        "processor seconds to count": costs,
        "workers for a day": {
            method: round((cost["estimate"] + graphs["estimate"] * sample.making) / DAY, 1)
            for method, cost in costs.items()
        },
        "by_size": {
            n: {
                "graphs drawn": len(found.chains[n]),
                "graphs": round(cubic * sample.numbers[n].mean()),
                **{f"microseconds, {method}": round(1e6 * s[n].mean()) for method, s in found.seconds.items()},
                "chains of a graph": round(found.chains[n].mean(), 1),
            }
            for n in sample.codes
        },
    }


def main() -> None:
    """Draw, count and write."""
    use_machine_code()
    links, ancestors, wanted = [*map(int, sys.argv[1:]), *(400, 400)[len(sys.argv) - 2 :]]
    loops = (links - 2) // 2
    dice = np.random.default_rng(SEED)
    start = process_time()
    cubic = cubic_graphs(loops)
    making = process_time() - start
    ancestors = min(ancestors, len(cubic))
    sample = drawn(cubic, 2 * (loops - 1), ancestors, dice)
    figures = {
        "links": links,
        "python": platform.python_version(),
        "load": round(os.getloadavg()[0], 1),
        "cubic graphs": {"number": len(cubic), "drawn": ancestors, "seconds to make": round(making, 1)},
        **figures_of(len(cubic), sample, counted(sample, links, wanted, dice)),
    }
    (RESULTS / f"next_term-{links}.json").write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")
    print(json.dumps({key: value for key, value in figures.items() if key != "by_size"}, indent=2))


if __name__ == "__main__":
    main()
