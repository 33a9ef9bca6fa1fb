"""All conical candidates: the cyclic orders of the joints of a chain round a cone, up to symmetry."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from enumerate.conical.layers import fewest_layers as fewest_layers
    from enumerate.conical.query import ConicalCountJob as ConicalCountJob
    from enumerate.conical.query import ConicalQuery as ConicalQuery
    from enumerate.conical.query import Portion as Portion
    from enumerate.conical.query import conical_orders as conical_orders
    from enumerate.conical.query import count_conical_orders as count_conical_orders
    from enumerate.conical.symmetries import joint_symmetries as joint_symmetries
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "layers": "fewest_layers",
            "query": "ConicalCountJob ConicalQuery Portion conical_orders count_conical_orders",
            "symmetries": "joint_symmetries",
        },
    )
