"""Fits: tolerances by the formulas behind ISO 286, press fits by Lame's, makers' and the finite
elements of rings, and the parts of a clearance."""

from dataclasses import replace
from itertools import pairwise
from math import inf, pi, sqrt

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from flexcage import load_preset
from flexcage.bearings import sections_of
from flexcage.core.errors import InputError
from flexcage.fem.revolved import Revolved
from flexcage.geometry.fits.cylinders import Cylinder, Press
from flexcage.geometry.fits.mounting import mount
from flexcage.geometry.fits.spec import Fit
from flexcage.geometry.fits.tolerances import (
    DEVIATIONS,
    GRADES,
    bearing_limits,
    hole_limits,
    shaft_limits,
)
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.section import mesh_section
from flexcage.verification.bearings import deep_groove

STEEL = MATERIALS["steel"]
UPTO = (1, 3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)
MEANS = np.array([sqrt(a * b) for a, b in pairwise(UPTO)])  # mm, geometric, as the standard takes
UNIT = 0.45 * np.cbrt(MEANS) + 0.001 * MEANS  # um, i


def um(limits):
    return tuple(round(1e6 * value, 4) for value in limits)


@pytest.mark.parametrize(("grade", "units"), [(5, 7), (6, 10), (7, 16), (8, 25), (9, 40)])
def test_grades_are_the_standards_multiples_of_i(grade, units):
    formula = units * UNIT
    off = np.abs(np.array(GRADES[grade]) - formula)
    # rounded to whole um, larger ones to 5 or 10; up to 3 mm the standard follows no formula
    assert (off <= np.maximum(0.7, 0.03 * formula))[1:].all()


@pytest.mark.parametrize(
    ("letter", "formula"),
    [
        ("f", -5.5 * MEANS**0.41),
        ("g", -2.5 * MEANS**0.34),
        ("k", np.where(MEANS > 3, 0.6 * np.cbrt(MEANS), 0.0)),
        ("n", 5.0 * MEANS**0.34),
    ],
)
def test_deviations_are_the_standards_powers(letter, formula):
    assert np.abs(np.array(DEVIATIONS[letter]) - formula)[1:].max() < 1.1


def test_m_and_p_follow_from_the_grades():
    seven, six = np.array(GRADES[7]), np.array(GRADES[6])
    assert (np.array(DEVIATIONS["m"]) == seven - six)[1:].all()
    above = np.array(DEVIATIONS["p"]) - seven
    assert ((above >= 0) & (above <= 5))[1:].all()


@pytest.mark.parametrize(  # as the tables of ISO 286-2 print them, um
    ("code", "size", "due"),
    [
        ("k5", 30, (2, 11)), ("j6", 40, (-5, 11)), ("js6", 60, (-9.5, 9.5)), ("m6", 40, (9, 25)),
        ("n6", 100, (23, 45)), ("p6", 100, (37, 59)), ("r6", 100, (51, 73)), ("g6", 25, (-20, -7)),
        ("h6", 30, (-13, 0)), ("f7", 50, (-50, -25)), ("k6", 3, (0, 6)), ("j5", 25, (-4, 5)),
        ("r7", 130, (63, 103)),
    ],
)  # fmt: skip
def test_limits_of_shafts(code, size, due):
    assert um(shaft_limits(code, 1e-3 * size, "fit.shaft")) == due


@pytest.mark.parametrize(
    ("code", "size", "due"),
    [
        ("H7", 72, (0, 30)), ("G7", 72, (10, 40)), ("J7", 62, (-12, 18)), ("JS7", 62, (-15, 15)),
        ("K6", 40, (-13, 3)), ("K7", 110, (-25, 10)), ("M7", 80, (-30, 0)), ("N7", 80, (-39, -9)),
        ("P7", 80, (-51, -21)), ("R7", 50, (-50, -25)), ("K7", 3, (-10, 0)), ("M6", 300, (-41, -9)),
        ("F7", 40, (25, 50)), ("H8", 120, (0, 54)),
    ],
)  # fmt: skip
def test_limits_of_holes(code, size, due):
    assert um(hole_limits(code, 1e-3 * size, "fit.housing")) == due


def test_bearings_are_below_their_size():
    assert um(bearing_limits(30e-3, outside=False, where="fit.shaft")) == (-10, 0)
    assert um(bearing_limits(72e-3, outside=True, where="fit.housing")) == (-13, 0)


@pytest.mark.parametrize(
    ("code", "said"),
    [
        ("K5", "shafts have small letters: is k5 meant?"),
        ("k9", "k has the grades 4 to 7, as in k5"),
        ("q5", "flexcage knows f, g, h, js, m, n, p, r, j, k with a grade"),
        ("tight", "or give fit.shaft_interference"),
    ],
)
def test_codes_that_are_none(code, said):
    with pytest.raises(InputError, match="fit.shaft is") as caught:
        shaft_limits(code, 30e-3, "fit.shaft")
    assert said in str(caught.value)


def test_sizes_beyond_the_tables():
    with pytest.raises(InputError, match="end at 500 mm, but the seat has 600 mm"):
        hole_limits("H7", 0.6, "fit.housing")


@pytest.mark.parametrize("hollow", [0.0, 0.3, 0.7])
def test_growth_of_the_race_is_the_makers(hollow):
    """NSK, Rolling Bearings (and T. A. Harris, chapter 3): of one steel, an interference widens the
    inner race by k (1 - k0^2)/(1 - k^2 k0^2) of it, with k = d/F and k0 = d0/d; by k with a solid
    shaft."""
    d, race, interference = 40e-3, 52e-3, 10e-6
    ring, shaft = Cylinder(d, race, STEEL), Cylinder(hollow * d, d, STEEL)
    pressure = Press(shaft, ring, d).pressure(interference)
    k, k0 = d / race, hollow
    due = interference * k * (1.0 - k0**2) / (1.0 - k**2 * k0**2)
    assert ring.pressed(race, inside=pressure) == pytest.approx(due, rel=1e-12)


@pytest.mark.parametrize("wall", [inf, 110e-3, 84e-3])
def test_outer_race_shrinks_as_makers_say(wall):
    """Likewise h (1 - h0^2)/(1 - h^2 h0^2), h = E/D and h0 = D/D0."""
    race, outside, interference = 62e-3, 80e-3, 10e-6
    ring, housing = Cylinder(race, outside, STEEL), Cylinder(outside, wall, STEEL)
    pressure = Press(ring, housing, outside).pressure(interference)
    h, h0 = race / outside, outside / wall
    due = interference * h * (1.0 - h0**2) / (1.0 - h**2 * h0**2)
    assert ring.pressed(race, outside=pressure) == pytest.approx(-due, rel=1e-12)


def test_press_fit_of_two_materials_is_one_of_DIN_7190():
    """p = I/(d [(1/E_A) ((1 + Q_A^2)/(1 - Q_A^2) + nu_A) + (1/E_I) ((1 + Q_I^2)/(1 - Q_I^2) -
    nu_I)]); both surfaces then have the same diameter."""
    brass, d, outer, bore, interference = MATERIALS["brass"], 50e-3, 80e-3, 20e-3, 40e-6
    hub, shaft = Cylinder(d, outer, brass), Cylinder(bore, d, STEEL)
    p = Press(shaft, hub, d).pressure(interference)
    qa, qi = (d / outer) ** 2, (bore / d) ** 2
    soft = ((1 + qa) / (1 - qa) + brass.poisson_ratio) / brass.youngs_modulus
    stiff = ((1 + qi) / (1 - qi) - STEEL.poisson_ratio) / STEEL.youngs_modulus
    assert p == pytest.approx(interference / (d * (soft + stiff)), rel=1e-12)
    gap = hub.pressed(d, inside=p) - shaft.pressed(d, outside=p)
    assert gap == pytest.approx(interference, rel=1e-12)


def test_a_gap_presses_nothing():
    assert Press(Cylinder(0.0, 1.0, STEEL), Cylinder(1.0, 2.0, STEEL), 1.0).pressure(-1e-6) == 0.0


def ring_model(section, material=STEEL, size=0.2):
    mesh = mesh_section(section.outline, section.names, lambda x, r: size * section.wall)
    return Revolved(mesh, material)


def solved(model, load):
    """Displacements (N, 3) of harmonic 0 under nodal loads of the whole ring."""
    rigid = sp.csc_matrix(model.rigid_motions(0)) * model.stiffness(0).diagonal().mean()
    whole = sp.bmat([[model.stiffness(0), rigid], [rigid.T, None]], format="csc")
    return splu(whole).solve(np.r_[load, np.zeros(2)])[: model.n_dof].reshape(-1, 3)


def under_pressure(section, side):
    """Growth per Pa of the diameters of seat and middle of the race, and the race's diameter."""
    model = ring_model(section)
    seat, race = model.edge_nodes("seat"), model.edge_nodes("race")
    radius = model.nodes[seat[0], 1]
    load = 2.0 * pi * radius * model.line_load("seat", (0.0, side), lambda x, r: 1.0 + 0.0 * x)
    moved = solved(model, load)[:, 1]
    middle = race[np.argmin(np.abs(model.nodes[race, 0]))]
    return 2.0 * moved[seat].mean(), 2.0 * moved[middle], 2.0 * model.nodes[middle, 1]


def sections(bearing):
    return sections_of(bearing)(
        bearing, angle=(0.0, 0.0), across=(0.5e-3, 0.5e-3),
        seat=(bearing.bore, bearing.outside_diameter),
    )  # fmt: skip


def mean_cylinder(section, side):
    x, r = np.array(section.outline).T
    area = 0.5 * abs(x @ np.roll(r, -1) - r @ np.roll(x, -1))
    width, radius = np.ptp(x), r[section.names.index("seat")]
    wall = 2.0 * (radius + side * area / width)
    pair = (2.0 * radius, wall) if side > 0.0 else (wall, 2.0 * radius)
    return Cylinder(*pair, STEEL)


def test_ring_without_groove_is_lames_cylinder():
    """A plain roller ring by finite elements in its section: plane stress, as its ends are free."""
    bearing = load_preset("N1013").bearing
    outer = sections(bearing)[1]  # the ring without ribs
    seat, race, at = under_pressure(outer, -1.0)
    cylinder = mean_cylinder(outer, -1.0)
    assert at == pytest.approx(bearing.outer_race_diameter)
    assert seat == pytest.approx(cylinder.pressed(bearing.outside_diameter, outside=1.0), rel=1e-4)
    assert race == pytest.approx(cylinder.pressed(at, outside=1.0), rel=1e-4)


@pytest.mark.parametrize(("k", "side"), [(0, 1.0), (1, -1.0)])
def test_grooved_ring_is_near_the_cylinder_of_its_section(k, side):
    """By finite elements in the real section, groove and shoulders: the seat yields within 2 %, the
    groove's bottom within 7 % as the cylinder of the same area does."""
    bearing = replace(deep_groove(10e-6), inner_shoulder=2e-3, outer_shoulder=2e-3)
    section = sections(bearing)[k]
    seat, race, at = under_pressure(section, side)
    cylinder = mean_cylinder(section, side)
    pressed = {"inside": 1.0} if side > 0.0 else {"outside": 1.0}
    own = (bearing.bore, bearing.outside_diameter)[k]
    assert cylinder.pressed(own, **pressed) == pytest.approx(seat, rel=0.02)
    assert cylinder.pressed(at, **pressed) == pytest.approx(race, rel=0.07)


def test_spinning_ring_grows_as_by_finite_elements():
    bearing = load_preset("N1013").bearing
    section = sections(bearing)[1]
    model, speed = ring_model(section), 1000.0
    radial = np.zeros((len(model.nodes), 3))
    radial[:, 1] = model.nodes[:, 1]
    moved = solved(model, speed**2 * (model.mass(0) @ radial.ravel()))[:, 1]
    cylinder = mean_cylinder(section, -1.0)
    # a ring is not quite in plane stress: along its width it bulges, by 0.2 % of its growth
    for edge, at in (("race", bearing.outer_race_diameter), ("seat", bearing.outside_diameter)):
        due = 2.0 * moved[model.edge_nodes(edge)].mean()
        assert cylinder.spun(at, speed) == pytest.approx(due, rel=3e-3)


def test_spinning_ends_are_textbook_ones():
    """A thin ring, rho w^2 r^3/E, and a solid disk, (1 - nu) rho w^2 r^3/(4 E) at its rim."""
    thin, solid = Cylinder(0.1, 0.1000001, STEEL), Cylinder(0.0, 0.1, STEEL)
    due = STEEL.density * 100.0**2 * 0.05**3 / STEEL.youngs_modulus
    assert thin.spun(0.1, 100.0) == pytest.approx(2.0 * due, rel=1e-5)
    assert solid.spun(0.1, 100.0) == pytest.approx(0.5 * (1.0 - 0.3) * due)


BEARING = deep_groove(20e-6)
WALLS = (33e-3, 54e-3)


def mounted(fit=None, bearing=BEARING, speed=0.0, walls=WALLS, **values):
    fit = fit or Fit(**values)
    bearing = replace(bearing, material=STEEL)
    return mount(bearing, fit, (15e-6, 20e-6, 25e-6), walls, speed)


def parts(mounting):
    return {part.key: part.values for part in mounting.parts}


def test_parts_add_up():
    found = parts(
        mounted(
            shaft="m6", housing="N7", inner_temperature=350.0, shaft_temperature=360.0,
            outer_temperature=330.0, housing_temperature=320.0, smoothing="roughness",
        )
    )  # fmt: skip
    last = found.pop("operating")
    for k in range(3):
        assert sum(values[k] for values in found.values()) == pytest.approx(last[k], abs=1e-15)
    assert found["inner_fit"][0] < found["inner_fit"][1] < found["inner_fit"][2] < 0.0
    assert found["smoothing"][1] > 0.0


def test_even_warmth_changes_nothing():
    """All of one steel and equally warm, the bearing is a larger one of the same shape."""
    same = dict.fromkeys(("inner_temperature", "outer_temperature"), 373.15)
    found = mounted(shaft_interference=20e-6, **same)
    assert found.part("temperature").values[1] == pytest.approx(0.0, abs=1e-12)
    assert found.inner.operating[1] == pytest.approx(found.inner.interference[1] * 25.0 / 27.0)


def test_a_warm_inner_ring_alone_takes_what_makers_say():
    """NSK and NTN: alpha (T_i - T_o) D_o of a warm inner ring with its balls."""
    warm = {"inner_temperature": 303.15, "shaft_temperature": 303.15, "element_temperature": 303.15}
    found = mounted(**warm)
    inner, _ = BEARING.race_diameters
    due = -12e-6 * 10.0 * (inner + 2.0 * BEARING.ball_diameter)  # the outer race's diameter
    assert found.part("temperature").values[1] == pytest.approx(due)


def test_aluminium_housing_lets_go():
    """A housing that expands twice as much as steel by 60 K: the interference of 40 um falls by
    (24 - 12) 1e-6 60 K 62 mm = 44.6 um."""
    alloy = replace(STEEL, name="alloy", youngs_modulus=70e9, expansion=24e-6)
    found = mounted(
        housing_interference=40e-6, smoothing="none", housing_material=alloy,
        inner_temperature=353.15, outer_temperature=353.15,
    )  # fmt: skip
    assert found.outer.operating[1] == pytest.approx(40e-6 - 44.64e-6, rel=1e-6)
    assert found.outer.pressure == (0.0, 0.0, 0.0)
    given_back = -found.part("outer_fit").values[1]
    assert found.part("temperature").values[1] == pytest.approx(given_back, rel=1e-9)


def test_an_interference_is_lost_to_speed():
    slow, fast = (mounted(shaft_interference=10e-6, speed=w) for w in (0.0, 4000.0))
    ring, shaft = Cylinder(25e-3, WALLS[0], STEEL), Cylinder(0.0, 25e-3, STEEL)
    lost = ring.spun(25e-3, 4000.0) - shaft.spun(25e-3, 4000.0)
    assert slow.inner.operating[1] - fast.inner.operating[1] == pytest.approx(lost)
    assert fast.operating < slow.operating


@pytest.mark.parametrize(
    ("smoothing", "kept"),
    [("ground", 10.0 * 25 / 27), ("turned", 10.0 * 25 / 28), ("none", 10.0),
     ("roughness", 10.0 - 0.8 * (4.0 + 2.0))],
)  # fmt: skip
def test_smoothing(smoothing, kept):
    found = mounted(shaft_interference=10e-6, smoothing=smoothing)
    assert found.inner.operating[1] == pytest.approx(1e-6 * kept)
    k = 25e-3 / WALLS[0]  # of one steel, a cylinder's outer diameter grows by k
    assert -found.part("inner_fit").values[1] > 0.9 * k * 10e-6


def test_rules_of_thumb_hold_over_sizes():
    """NTN, Ball and Roller Bearings: rings take 70 to 90 % of an effective interference off the
    clearance; here at bearings of three diameter series."""
    for d, race in ((25, 31), (30, 39.1), (50, 64), (100, 117)):
        ring = Cylinder(1e-3 * d, 1.03e-3 * race, STEEL)
        pressure = Press(Cylinder(0.0, 1e-3 * d, STEEL), ring, 1e-3 * d).pressure(1e-5)
        assert 0.7 < ring.pressed(1e-3 * race, inside=pressure) / 1e-5 < 0.9


def test_materials_without_expansion():
    strange = replace(STEEL, name="strange", expansion=None)
    with pytest.raises(InputError, match="no thermal expansion of strange is known; give fit."):
        mounted(shaft_material=strange, inner_temperature=350.0)
    assert mounted(shaft_material=strange, shaft="k5").operating < 20e-6
