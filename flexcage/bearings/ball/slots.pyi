from flexcage.bearings.ball.bending import BENDING as bending
from flexcage.bearings.ball.figures import FIGURES as figures
from flexcage.bearings.ball.inference import INFERENCE as inside
from flexcage.bearings.ball.losses import ball_losses as losses
from flexcage.bearings.ball.motion import MOTION as motion
from flexcage.bearings.ball.recording import RECORDING as recording
from flexcage.bearings.ball.rings import ball_rings as rings
from flexcage.bearings.ball.rubbing import rubbing as rubbing
from flexcage.bearings.ball.shapes import ball_shapes as shapes
from flexcage.bearings.ball.slip import SPEED as speed
from flexcage.bearings.ball.statics import balls_of as statics
from flexcage.bearings.ball.variables import VARIABLES as variables

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
