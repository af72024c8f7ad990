from flexcage.bearings.spherical_roller.figures import FIGURES as figures
from flexcage.bearings.spherical_roller.inference import INFERENCE as inside
from flexcage.bearings.spherical_roller.losses import spherical_losses as losses
from flexcage.bearings.spherical_roller.motion import MOTION as motion
from flexcage.bearings.spherical_roller.recording import RECORDING as recording
from flexcage.bearings.spherical_roller.rubbing import rubbing as rubbing
from flexcage.bearings.spherical_roller.shapes import barrel_shapes as shapes
from flexcage.bearings.spherical_roller.statics import rollers_of as statics
from flexcage.bearings.spherical_roller.variables import VARIABLES as variables
from flexcage.bearings.tapered_roller.slip import SPEED as speed

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
