from flexcage.bearings.spherical_roller.inference import INFERENCE as inside
from flexcage.bearings.spherical_roller.shapes import barrel_shapes as shapes
from flexcage.bearings.spherical_roller.statics import rollers_of as statics

__all__ = ["inside", "shapes", "statics"]
