"""How mechanisms move: linkages at a pose, closure of their loops, paths of closed poses."""
