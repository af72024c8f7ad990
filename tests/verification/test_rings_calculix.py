"""Rings that bend against CalculiX's stored answers; the scripts that made them stand beside."""

import json

import numpy as np
import pytest
import ring_contact_calculix as contact
import ring_on_arcs_calculix as arcs

from flexcage.bearings.ball.rings import grooved_section
from flexcage.geometry.hertz import PointContact
from flexcage.geometry.materials import Material
from flexcage.modes.ring import RingSeat, reduce_ring
from flexcage.system.statics.rings import SeatedRing

STORED = json.loads(arcs.STORED.read_text("utf-8"))


@pytest.mark.parametrize("row", STORED["arcs"], ids=lambda row: f"{row['arc_deg']:g} deg")
def test_load_distribution_on_two_arcs(row):
    """Arcs that press wherever the ring lies on them: forces of the rollers within 3 % of the
    largest, the ring's displacement within 1 %."""
    solution = arcs.ours(row["arc_deg"])
    (ring,) = solution.rings
    own = solution.elements.force[arcs.solved(ring), 1]
    assert solution.displacement[1] == pytest.approx(row["displacement_m"], rel=0.01)
    assert np.abs(own - row["roller_force_n"]).max() < 0.03 * own.max()


def test_how_far_patches_of_rollers_and_strips_of_the_seat_yield():
    """The free ring, without any law of contact, under loads that are in balance: within 0.2 % of
    the largest compliance, and each roller's patch under its own force within 1 %."""
    (ring,) = arcs.ours(arcs.ARCS[0]).rings
    reduction, rollers = ring.seated.reduction, arcs.rollers(ring)
    middle, width = arcs.strips()
    k, s = len(rollers), len(middle)
    free = SeatedRing(
        "outer", reduction, np.append(rollers, -rollers), support=np.append(middle, -middle),
        width=np.tile(width, 2), presses_only=True,
    )  # fmt: skip
    seat, beside = free.bordered
    race = free.race.reshape(2 * k, 2, 2 * k, 2)[:, 0, :, 0]
    beside = beside.reshape(2 * k, 2, -1)[:, 0]
    own = np.block([  # under forces and their mirror images
        [race[:k, :k] + race[:k, k:], beside[:k, :s] + beside[:k, s : 2 * s]],
        [(beside[:k, :s] + beside[:k, s : 2 * s]).T, seat[:s, :s] + seat[:s, s : 2 * s]],
    ])  # fmt: skip
    own[range(k), range(k)] += reduction.half_space[0, 0]
    cos = np.cos(np.append(rollers, middle))
    balanced = np.eye(k + s) - np.outer(cos, cos) / (cos @ cos)
    theirs = balanced @ (1e-3 * np.array(STORED["yields_mm_per_n"])) @ balanced
    own = balanced @ own @ balanced
    assert np.abs(own - theirs).max() < 0.002 * np.abs(theirs).max()
    assert np.diag(own)[:k] == pytest.approx(np.diag(theirs)[:k], rel=0.01)


def test_approach_from_ball_to_seat():
    """A stiff ball in the groove of a ring that is held outside: the whole approach within 2 %, and
    the ring's share beside Hertz within 5 % of its largest."""
    steel = Material(
        name="steel", youngs_modulus=1e6 * contact.MODULUS, poisson_ratio=contact.POISSON,
        density=7850.0,
    )  # fmt: skip
    ball, groove, bottom = (1e-3 * r for r in (contact.BALL, contact.GROOVE, contact.BOTTOM))
    hertz = PointContact(
        rolling=1.0 / (1.0 / ball - 1.0 / bottom),
        transverse=1.0 / (1.0 / ball - 1.0 / groove),
        modulus=2.0 * steel.plane_strain_modulus / (1.0 + 1.0 / contact.STIFF),
    )
    rows = json.loads(contact.STORED.read_text("utf-8"))["rows"]
    assert len(rows) == len(contact.WALLS)
    shares = []
    for row in rows:
        force, whole, wall = row["force_n"], 1e-3 * row["approach_mm"], 1e-3 * row["wall_mm"]
        section = grooved_section(
            (0.0, bottom - groove), groove, 1.0, shoulder=bottom - 1e-3 * contact.SHOULDER,
            half=1e-3 * contact.HALF_WIDTH, seat=bottom + wall, angle=0.0,
            across=float(hertz.semi_axes(force)[0]),
        )  # fmt: skip
        ring = force * reduce_ring(section, steel, RingSeat()).local[1, 1]
        alone = (force / hertz.stiffness) ** (2.0 / 3.0)
        assert alone + ring == pytest.approx(whole, rel=0.02)
        shares.append((ring, whole - alone))
    own, theirs = np.array(shares).T
    assert np.abs(own - theirs).max() < 0.05 * np.abs(theirs).max()
