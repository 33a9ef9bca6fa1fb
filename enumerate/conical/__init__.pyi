from enumerate.conical.layers import fewest_layers as fewest_layers
from enumerate.conical.query import (
    ConicalCountJob as ConicalCountJob,
    ConicalQuery as ConicalQuery,
    Portion as Portion,
    conical_orders as conical_orders,
    count_conical_orders as count_conical_orders,
)
from enumerate.conical.symmetries import joint_symmetries as joint_symmetries
