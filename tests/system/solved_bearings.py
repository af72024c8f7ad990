"""Static solutions of bearings of any family."""

from flexcage.bearings import statics_of
from flexcage.system.statics import solve


def solve_bearing(bearing, **how):
    """``flexcage.system.statics.solve.solve_bearing`` with the elements of the bearing's family."""
    return solve.solve_bearing(bearing, statics_of(bearing), **how)
