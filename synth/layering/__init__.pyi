from synth.layering.cores import CoreCondition as CoreCondition, LayerCore as LayerCore
from synth.layering.face_orders import read_face_orders as read_face_orders, wishes_of as wishes_of
from synth.layering.local import FlatVertex as FlatVertex
from synth.layering.orders import (
    FlatFolding as FlatFolding,
    LayerComponent as LayerComponent,
    LayerOrder as LayerOrder,
    layers as layers,
)
