from flexcage.bearings.ball.rubbing import rubbing as rubbing
from flexcage.bearings.four_point.figures import FIGURES as figures
from flexcage.bearings.four_point.inference import INFERENCE as inside
from flexcage.bearings.four_point.losses import four_point_losses as losses
from flexcage.bearings.four_point.motion import MOTION as motion
from flexcage.bearings.four_point.recording import RECORDING as recording
from flexcage.bearings.four_point.recording import VARIABLES as variables
from flexcage.bearings.four_point.shapes import four_point_shapes as shapes
from flexcage.bearings.four_point.slip import SPEED as speed
from flexcage.bearings.four_point.statics import four_point_balls_of as statics

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
