from flexcage.bearings.ball.figures import FIGURES as figures
from flexcage.bearings.ball.rubbing import rubbing as rubbing
from flexcage.bearings.ball.slip import SPEED as speed
from flexcage.bearings.ball.variables import VARIABLES as variables
from flexcage.bearings.double_row_ball.inference import INFERENCE as inside
from flexcage.bearings.double_row_ball.losses import losses as losses
from flexcage.bearings.double_row_ball.motion import MOTION as motion
from flexcage.bearings.double_row_ball.recording import RECORDING as recording
from flexcage.bearings.double_row_ball.shapes import double_row_shapes as shapes
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
