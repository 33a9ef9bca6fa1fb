from synth.analysis.layering._layers import layers as layers
from synth.analysis.layering.assignments import (
    OrdersByAssignment as OrdersByAssignment,
    orders_by_assignment as orders_by_assignment,
)
from synth.analysis.layering.cores import CoreCondition as CoreCondition, LayerCore as LayerCore
from synth.analysis.layering.counting.job import LayerCountJob as LayerCountJob, numbers_of as numbers_of
from synth.analysis.layering.counting.propagation import counted as counted
from synth.analysis.layering.face_orders import (
    fold_text_of_layers as fold_text_of_layers,
    read_face_orders as read_face_orders,
    wishes_of as wishes_of,
)
from synth.analysis.layering.fixing import ChangedAssignment as ChangedAssignment, locally_fixed as locally_fixed
from synth.analysis.layering.flat_creases import StayingFlat as StayingFlat, staying_flat as staying_flat
from synth.analysis.layering.local import FlatVertex as FlatVertex
from synth.analysis.layering.orders import (
    FlatFolding as FlatFolding,
    LayerComponent as LayerComponent,
    LayerOrder as LayerOrder,
    flat_folding as flat_folding,
    is_folded as is_folded,
)
from synth.analysis.layering.space.orders import LayersInSpace as LayersInSpace
from synth.analysis.layering.summary import FlatFoldability as FlatFoldability, flat_foldability as flat_foldability
