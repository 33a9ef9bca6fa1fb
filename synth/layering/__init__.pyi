from synth.layering.cores import CoreCondition as CoreCondition, LayerCore as LayerCore
from synth.layering.local import FlatVertex as FlatVertex
from synth.layering.orders import (
    FlatFolding as FlatFolding,
    LayerComponent as LayerComponent,
    LayerOrder as LayerOrder,
    layers as layers,
)
