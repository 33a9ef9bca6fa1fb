"""Random linkages with joints of all kinds."""

import random

from graphs.joints.linkage import JointedLinkage, JointKind
from graphs.mechanism.sc import SCGraph


def random_jointed(seed):
    """Of 2 to 9 links, in rows and rings, some joined twice, some fixed; no places."""
    rng = random.Random(seed)
    links = [f"l{i}" for i in range(rng.randint(2, 9))]
    pairs = [(links[rng.randrange(max(0, i - 2), i)], links[i]) for i in range(1, len(links))]
    pairs += [tuple(rng.sample(links, 2)) for _ in range(rng.randint(0, 4))]
    chain = SCGraph(links, {f"j{i}": ends for i, ends in enumerate(pairs)}, ground=rng.choice([None, *links]))
    return JointedLinkage(chain, {joint: rng.choice(list(JointKind)) for joint in chain.joints})
