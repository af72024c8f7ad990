"""4400 rollers, each a two-hundredth as stiff as one of 22, come to H. Sjoevall's integrals of the
load zone, J_r for Q in proportion to d^(10/9)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from known_rows import check

from flexcage.bearings import statics_of
from flexcage.contacts.spec import Contacts, NormalLaw, PairSpec
from flexcage.system.spec import Load
from flexcage.system.statics.solve import solve_bearing
from flexcage.verification import Row, Tolerance
from flexcage.verification.cases.roller_statics import bearing, displacement

# radial clearance [um]: displacement [um], load zone eps and largest force [N] under 1000 N, in
# which rollers are spread evenly
SPREAD = {
    0: (1.7829, 0.50000, 185.681), 10: (7.5920, 0.17071, 281.409), 20: (13.0327, 0.11635, 335.053),
    40: (23.6200, 0.07663, 407.870), 55: (31.4459, 0.06274, 448.878),
}  # fmt: skip
COUNT, MANY = 22, 4400
INTEGRAL = Tolerance(1.5e-5, "printed to five digits or six; 4400 rollers stand for the integral")
ZONE = Tolerance(
    4e-4, "the zone's ends are known to one roller of 4400, eps is (1 - cos psi)/2", absolute=True
)


@pytest.mark.parametrize("clearance", SPREAD)
def test_rollers_spread_evenly(clearance):
    """No case may have rollers that overlap; the static solution alone takes them."""
    share = COUNT / MANY
    of = replace(bearing(clearance), roller_count=MANY)
    contacts = Contacts(race=PairSpec(normal=NormalLaw(stiffness_factor=share), slices=16))
    found = solve_bearing(
        of, statics_of(of), load=Load(radial=1000.0), speed=0.0, contacts=contacts
    )
    moved, zone, largest = SPREAD[clearance]
    force = found.elements.force[:, 0]
    most = float(force.max() / share)
    loaded = np.pi * np.count_nonzero(force > 0.0) / MANY
    check([
        Row("displacement", "um", moved, displacement(found), INTEGRAL),
        Row("largest force", "N", largest, most, INTEGRAL),
        Row("load zone", "", zone, 0.5 * (1.0 - np.cos(loaded)), ZONE),
    ])  # fmt: skip
    if clearance == 0:
        in_reverse = most * COUNT / 1000.0
        check([
            Row("integral J_r", "", 0.244799, 1.0 / in_reverse, INTEGRAL),
            Row("1/J_r", "", 4.08499, in_reverse, INTEGRAL),
        ])  # fmt: skip
