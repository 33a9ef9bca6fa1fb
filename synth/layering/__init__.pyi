from synth.layering.answer import layers as layers
from synth.layering.assignments import (
    OrdersByAssignment as OrdersByAssignment,
    orders_by_assignment as orders_by_assignment,
)
from synth.layering.cores import CoreCondition as CoreCondition, LayerCore as LayerCore
from synth.layering.counting.job import LayerCountJob as LayerCountJob, numbers_of as numbers_of
from synth.layering.counting.settling import counted as counted
from synth.layering.face_orders import (
    posed_fold_text as posed_fold_text,
    read_face_orders as read_face_orders,
    wishes_of as wishes_of,
)
from synth.layering.fixing import ChangedAssignment as ChangedAssignment, locally_fixed as locally_fixed
from synth.layering.local import FlatVertex as FlatVertex
from synth.layering.orders import (
    FlatFolding as FlatFolding,
    LayerComponent as LayerComponent,
    LayerOrder as LayerOrder,
    flat_folding as flat_folding,
    is_folded as is_folded,
)
from synth.layering.space.orders import LayersInSpace as LayersInSpace
from synth.layering.staying import StayingFlat as StayingFlat, staying_flat as staying_flat
from synth.layering.summary import FlatFoldability as FlatFoldability, flat_foldability as flat_foldability
