from enumerate.conical.query import (
    ConicalCountJob as ConicalCountJob,
    ConicalQuery as ConicalQuery,
    Portion as Portion,
    conical_orders as conical_orders,
    count_conical_orders as count_conical_orders,
    joint_symmetries as joint_symmetries,
)
from enumerate.conical.rounds import fewest_layers as fewest_layers
