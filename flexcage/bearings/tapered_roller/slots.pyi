from flexcage.bearings.tapered_roller.figures import FIGURES as figures
from flexcage.bearings.tapered_roller.inference import INFERENCE as inside
from flexcage.bearings.tapered_roller.losses import tapered_losses as losses
from flexcage.bearings.tapered_roller.motion import MOTION as motion
from flexcage.bearings.tapered_roller.recording import RECORDING as recording
from flexcage.bearings.tapered_roller.rubbing import rubbing as rubbing
from flexcage.bearings.tapered_roller.shapes import tapered_shapes as shapes
from flexcage.bearings.tapered_roller.slip import SPEED as speed
from flexcage.bearings.tapered_roller.statics import rollers_of as statics
from flexcage.bearings.tapered_roller.variables import VARIABLES as variables

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
