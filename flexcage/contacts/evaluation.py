"""Names of the integers in kernels: what an evaluation is asked for, which law stands where, and
what a contact reports.

To numba they are constants: a name costs nothing.
"""

from __future__ import annotations

# what an evaluation is asked for (``mode``); whatever is REPORT or above also reports
RESIDUAL = 0  # forces alone
TANGENT = 1  # also their slopes, as blocks of Newton's matrix
REPORT = 2  # also the whole report, as samples want it
ACCEPT = 3  # also what a point that may be accepted needs: powers, contacts and their approach
OUTER_RING = 4  # of everything the races' force on the outer ring alone

# places in ``law``: the normal laws, and the friction laws, of the five kinds of contact
(
    RACE_LAW, POCKET_LAW, SIDE_LAW, RIB_LAW, LAND_LAW,
    RACE_RUBS, POCKET_RUBS, SIDE_RUBS, RIB_RUBS, LAND_RUBS,
) = range(10)  # fmt: skip

# places in ``sums``, what a contact reports
NORMAL = 0  # force [N]; of two ribs or lands the second one's follows
TRACTION, MOMENT_R, MOMENT_PSI = 1, 2, 3  # of a roller's race: along it [N]; about e_r, e_psi [N m]
ANGLE, ALONG, ACROSS = 1, 2, 3  # of a ball: direction of the contact [rad]; traction [N]
SLIDING = 4  # speed in the middle of a race's contact [m/s]
STORED = 5  # elastic energy [J]
DAMPED, RUBBED = 6, 7  # power of damping and of friction [W]
ROLLED = 8  # power of a race's rolling resistance [W]
SHEARED = 8  # power of a land's film [W]
APPROACH = 9  # speed at which the surfaces near [m/s]; of two lands the second one's follows
N_RACE = ROLLED + 1  # so many of them a race reports
N_SUMS = 11
