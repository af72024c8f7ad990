from flexcage.bearings.cylindrical_roller.figures import FIGURES as figures
from flexcage.bearings.cylindrical_roller.motion import MOTION as motion
from flexcage.bearings.cylindrical_roller.rubbing import rubbing as rubbing
from flexcage.bearings.cylindrical_roller.slip import SPEED as speed
from flexcage.bearings.cylindrical_roller.variables import VARIABLES as variables
from flexcage.bearings.double_row_roller.inference import INFERENCE as inside
from flexcage.bearings.double_row_roller.losses import losses as losses
from flexcage.bearings.double_row_roller.recording import RECORDING as recording
from flexcage.bearings.double_row_roller.shapes import double_row_roller_shapes as shapes
from flexcage.bearings.two_rows import rows_of as statics

__all__ = [
    "figures",
    "inside",
    "losses",
    "motion",
    "recording",
    "rubbing",
    "shapes",
    "speed",
    "statics",
    "variables",
]
