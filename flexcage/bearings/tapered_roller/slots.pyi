from flexcage.bearings.tapered_roller.inference import INFERENCE as inside
from flexcage.bearings.tapered_roller.losses import tapered_losses as losses
from flexcage.bearings.tapered_roller.statics import rollers_of as statics

__all__ = ["inside", "losses", "statics"]
