"""The contracted graphs with a number of loops, checked by the sum of their weights 1 / |Aut|.

    python benchmarks/contracted_weights.py LOOPS

writes benchmarks/results/contracted_weights-LOOPS.json: for each number of links how many graphs are listed
(`enumerate.contracted.graphs`, as counts of chains list them), the sum of their weights, and what it is in closed
form (`tests/support/weights_of_graphs.py`), which looks at no graph. Both methods that count chains take it that
these graphs are all there are, each once, and that their symmetries are known; chains of 20 links have nine loops.
Ends with status 1 where the sums differ.
"""

from __future__ import annotations

import json
import platform
import sys
from collections import Counter, defaultdict
from fractions import Fraction
from pathlib import Path
from time import process_time

from enumerate.contracted.graphs import cubic_graphs, descendants

sys.path.append(str(Path(__file__).parents[1] / "tests" / "support"))
from weights_of_graphs import total_weights, weight_of

RESULTS = Path(__file__).parent / "results"
_ANCESTORS = 32
"""Cubic graphs whose descendants are made together: some ten thousands of graphs with ten loops."""


def main() -> None:
    """List, add up, compare and write."""
    loops = int(sys.argv[1])
    start = process_time()
    graphs: Counter[int] = Counter()
    weights: defaultdict[int, Fraction] = defaultdict(Fraction)
    cubic = cubic_graphs(loops)
    for first in range(0, len(cubic), _ANCESTORS):
        for links, codes in descendants(cubic[first : first + _ANCESTORS], 2 * (loops - 1)):
            graphs[links] += len(codes)
            weights[links] += weight_of(codes, links)
    closed = total_weights(loops)
    equal = dict(weights) == closed
    figures = {
        "loops": loops,
        "python": platform.python_version(),
        "graphs": sum(graphs.values()),
        "equal": equal,
        "processor seconds": round(process_time() - start),
        "by_size": {
            links: {"graphs": graphs[links], "weight": str(weights[links]), "closed form": str(closed[links])}
            for links in closed
        },
    }
    (RESULTS / f"contracted_weights-{loops}.json").write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")
    print(f"{figures['graphs']} graphs with {loops} loops: the sums of weights {'agree' if equal else 'DIFFER'}")
    sys.exit(not equal)


if __name__ == "__main__":
    main()
