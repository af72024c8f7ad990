"""A displaced beam touches its roller where the geometry of roller and cage says."""

import numpy as np
import pytest
from verification_bearing import bearing_of, bent, cage_of, log, n1013, pushed, state_at_rest

PITCH = 2.0 * np.pi / 22
TOUCH = 0.4e-6  # fifteen slices on a curved wall and a roller with profile
CLAMPED = 16.0  # w(s) = 16 s^2 (1-s)^2, s from 0 to 1 along the beam


def beam(x, length):
    s = x / length + 0.5
    return CLAMPED * s**2 * (1.0 - s) ** 2


def touch(bearing, *, pocket, face, coordinate, low, high, **pose):
    """Value of a roller's coordinate at which its pocket's face begins to press on it."""
    y, yd = state_at_rest(bearing)
    roller = bearing.layout.q(y)["elements"][pocket]
    names = ("x", "r", "psi", "skew", "tilt", "spin")
    roller[2] = pocket * PITCH
    for name, value in pose.items():
        roller[names.index(name)] += value
    where = names.index(coordinate)
    start = roller[where]

    def presses(value):
        roller[where] = start + value
        bearing.residual(0.0, y, yd, 2)
        return bearing.data.work.report.pocket_normal[pocket, face] > 0.0

    assert not presses(low) and presses(high)
    while abs(high - low) > 1e-12:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if presses(middle) else (middle, high)
    return 0.5 * (low + high)


def first_touch(case, *, bend, skew=0.0):
    """Travel towards a crossbeam face bent by ``bend`` (outward) at which a skewed roller touches.

    The first point of the generatrix to meet the wall, by minimisation over the whole length.
    """
    b = case.bearing
    s = np.linspace(-0.4999, 0.4999, 20001) * b.effective_length
    drop = b.profile.drop(s, diameter=b.roller_diameter, length=b.effective_length)
    surface = -s * np.sin(skew) + 0.5 * b.roller_diameter / np.cos(skew) - drop
    wall = 0.5 * case.cage.pocket_width + bend * beam(s * np.cos(skew), case.cage.pocket_length)
    return (wall - surface).min()


@pytest.fixture(scope="module", params=["rigid", "flexible"])
def bent_bearing(request):
    """Crossbeam 5 bent by half of the clearance; pockets 4 and 5 keep room for their rollers."""
    middle = {"contacts.pocket.slices": 15}  # an odd number has one at the roller's middle
    case = n1013({"cage.model": request.param, **middle}, defects=bent("0.1 mm"))
    return case, bearing_of(case)


@pytest.mark.parametrize(
    ("pocket", "face", "bend"), [(4, 0, -0.1e-3), (4, 1, 0.0), (5, 1, 0.1e-3), (5, 0, 0.0)]
)
def test_a_roller_touches_after_the_travel_that_the_defect_leaves(bent_bearing, pocket, face, bend):
    """Front of pocket 4: nothing of 0.1 mm is left; rear of pocket 5: the beam's ends touch.

    There the roller's outer slice, at its middle, stands for its edge.
    """
    case, bearing = bent_bearing
    expected = first_touch(case, bend=bend)
    assert expected == pytest.approx(0.0, abs=1e-9) or bend >= 0.0
    sign = 1.0 if face == 0 else -1.0
    limits = {"low": -1e-3 * sign, "high": 1e-2 * sign}
    angle = touch(bearing, pocket=pocket, face=face, coordinate="psi", **limits)
    found = sign * case.bearing.pitch_radius * np.sin(angle)
    assert found == pytest.approx(expected, abs=1.2e-6 if bend > 0.0 else 2e-9)


@pytest.mark.parametrize("skew", [-10e-3, -3e-3, 3e-3, 10e-3])
def test_a_skewed_roller_touches_off_the_middle(bent_bearing, skew):
    case, bearing = bent_bearing
    expected = first_touch(case, bend=-0.1e-3, skew=skew)
    angle = touch(bearing, pocket=4, face=0, coordinate="psi", low=-1e-3, high=1e-2, skew=skew)
    found = case.bearing.pitch_radius * np.sin(angle)
    log.info("skew %g: touches at %.3f um, geometry %.3f um", skew, 1e6 * found, 1e6 * expected)
    assert found == pytest.approx(expected, abs=TOUCH)


def test_the_deformed_mesh_has_the_face_that_contact_sees():
    """Vertices of the bent face lie on the deflection curve; both faces of the beam move alike."""
    case = n1013(defects=bent("0.2 mm"))
    mesh, _ = cage_of(case)
    for group, pocket, side in (("pocket4_front", 4, 1.0), ("pocket5_rear", 5, -1.0)):
        angle = PITCH * pocket
        points = mesh.points[np.unique(mesh.groups[group])]
        t = points @ [0.0, -np.sin(angle), np.cos(angle)]
        moved = -0.2e-3 * beam(points[:, 0], case.cage.pocket_length)
        # beam 5 lies half a pitch after pocket 4 and before pocket 5: it moves along its own psi
        np.testing.assert_allclose(t, side * 0.5 * case.cage.pocket_width + moved, atol=1e-8)


@pytest.mark.parametrize("side", ["+x", "-x"])
def test_a_pushed_side_beam_stops_the_roller_earlier(side):
    """delta_p = -0.1 mm takes 0.1 mm, at the most, from the 0.125 mm of axial play on its side."""
    case = n1013({"cage.model": "rigid"}, defects=pushed("-0.1 mm", side=side))
    bearing, width = bearing_of(case), case.cage.pocket_width
    sign, face = (1.0, 2) if side == "+x" else (-1.0, 3)
    end = bearing.data.model.pocket.points[:, 1]
    expected = 0.125e-3 - 0.1e-3 * beam(np.abs(end).min(), width)
    found = touch(bearing, pocket=5, face=face, coordinate="x", low=-1e-3 * sign, high=1e-3 * sign)
    assert sign * found == pytest.approx(expected, abs=3e-6)
    other = touch(
        bearing, pocket=5, face=5 - face, coordinate="x", low=1e-3 * sign, high=-1e-3 * sign
    )
    assert -sign * other == pytest.approx(0.125e-3, abs=1e-9)
