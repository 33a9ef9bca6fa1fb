"""Placements of binary links on the joints of a contracted graph, looked at one by one."""


def is_moving(x, ends, sets, needs):
    """Tell whether joints of every rigid set hold as many binary links as it needs, two on a joint at most."""
    joints = list(zip(x, ends.tolist(), strict=True))
    return all(
        sum(min(held, 2) for held, (a, b) in joints if s >> a & s >> b & 1) >= need
        for s, need in zip(sets.tolist(), needs.tolist(), strict=True)
    )
