from graphs.loops.classes import CentreClass as CentreClass, centre_classes as centre_classes
from graphs.loops.loop import Centre as Centre, Loop as Loop, cyclic_order as cyclic_order
