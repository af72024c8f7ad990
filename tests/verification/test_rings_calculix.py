"""Rings that bend against CalculiX's stored answers; the scripts that made them stand beside."""

import json

import numpy as np
import pytest
import ring_contact_calculix as contact
import ring_on_arcs_calculix as arcs

from flexcage.bearings.ball.rings import grooved_section
from flexcage.geometry.hertz import PointContact
from flexcage.geometry.materials import Material
from flexcage.modes.ring import Held, reduce_ring


@pytest.fixture(scope="module")
def solution():
    return arcs.ours()


@pytest.fixture(scope="module")
def stored():
    return json.loads(arcs.STORED.read_text("utf-8"))


def test_load_distribution_on_two_arcs(solution, stored):
    """Forces of the rollers within 2 % of the largest; the ring's displacement within 1 %."""
    (ring,) = solution.rings
    own = solution.elements.force[arcs.solved(ring), 1]
    assert solution.displacement[1] == pytest.approx(stored["displacement_m"], rel=0.01)
    assert np.abs(own - stored["roller_force_n"]).max() < 0.02 * own.max()


def test_how_far_rollers_patches_yield(solution, stored):
    """The ring between its arcs, free of any law of contact: 1 % of the largest compliance."""
    (ring,) = solution.rings
    count = len(ring.azimuth)
    whole = ring.seated.compliance(ring.bears).reshape(count, 2, count, 2)[:, 0, :, 0]
    here = arcs.solved(ring)
    own = whole[np.ix_(here, here)] + whole[np.ix_(here, -here % count)]  # and mirror images
    half_space = ring.seated.reduction.half_space[0, 0] * np.eye(len(here))
    theirs = 1e-3 * np.array(stored["yields_mm_per_n"])
    assert np.abs(own + half_space - theirs).max() < 0.01 * np.abs(theirs).max()


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
        ring = force * reduce_ring(section, steel, Held()).local[1, 1]
        alone = (force / hertz.stiffness) ** (2.0 / 3.0)
        assert alone + ring == pytest.approx(whole, rel=0.02)
        shares.append((ring, whole - alone))
    own, theirs = np.array(shares).T
    assert np.abs(own - theirs).max() < 0.05 * np.abs(theirs).max()
