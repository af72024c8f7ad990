"""Names of the integers in kernels: what an evaluation is asked for, and which law stands where.

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
