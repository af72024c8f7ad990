from flexcage.bearings.cylindrical_roller.bending import BENDING as bending
from flexcage.bearings.cylindrical_roller.figures import FIGURES as figures
from flexcage.bearings.cylindrical_roller.full_complement import INFERENCE as inside
from flexcage.bearings.cylindrical_roller.losses import roller_losses as losses
from flexcage.bearings.cylindrical_roller.motion import MOTION as motion
from flexcage.bearings.cylindrical_roller.recording import RECORDING as recording
from flexcage.bearings.cylindrical_roller.rings import roller_rings as rings
from flexcage.bearings.cylindrical_roller.rubbing import rubbing as rubbing
from flexcage.bearings.cylindrical_roller.shapes import roller_shapes as shapes
from flexcage.bearings.cylindrical_roller.slip import SPEED as speed
from flexcage.bearings.cylindrical_roller.statics import rollers_of as statics
from flexcage.bearings.cylindrical_roller.variables import VARIABLES as variables

__all__ = [
    "bending",
    "figures",
    "inside",
    "losses",
    "motion",
    "recording",
    "rings",
    "rubbing",
    "shapes",
    "speed",
    "statics",
    "variables",
]
