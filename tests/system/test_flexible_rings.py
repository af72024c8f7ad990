"""Static solutions with rings that bend."""

import dataclasses
from functools import cache

import numpy as np
import pytest
from roller_designs import NUP

from flexcage.bearings import sections_of, statics_of
from flexcage.case.presets import load_preset
from flexcage.core.errors import InputError
from flexcage.geometry.ring import InnerRing, OuterRing
from flexcage.modes import ring as ring_modes
from flexcage.system.spec import Load
from flexcage.system.statics.rings import Rings
from flexcage.system.statics.solve import solve_bearing

LOADS = {
    "N1013": Load(radial=5e3, misalignment=2e-4),
    "7603025": Load(axial=3500.0, radial=1200.0),
    "7010C-PI": Load(axial=500.0, radial=300.0, moment_z=1.0, tilt="free"),
}
SPEED = 300.0  # rad/s
BOTH = {"inner": InnerRing(ring="flexible"), "outer": OuterRing(ring="flexible")}


def on(seat, azimuths, arc=15.0):
    supports = tuple(np.radians(azimuths))
    return OuterRing(ring="flexible", seat=seat, supports=supports, support_arc=np.radians(arc))


@cache
def rigid(name, load=None):
    bearing = load_preset(name).bearing
    return solve_bearing(bearing, statics_of(bearing), load=load or LOADS[name], speed=SPEED)


def bent(name, load=None, **rings):
    bearing = load_preset(name).bearing
    rings = Rings(sections=sections_of(bearing), **rings)
    return solve_bearing(
        bearing, statics_of(bearing), load=load or LOADS[name], speed=SPEED, rings=rings
    )


def of_a_modulus(name, factor):
    material = load_preset(name).bearing.material
    hard = dataclasses.replace(material, youngs_modulus=factor * material.youngs_modulus)
    return {side: dataclasses.replace(ring, material=hard) for side, ring in BOTH.items()}


def test_rings_that_are_rigid_cost_nothing_to_the_bit():
    one, other = rigid("N1013"), bent("N1013")
    assert other.rings == ()
    assert np.array_equal(one.displacement, other.displacement)
    assert np.array_equal(one.elements.force, other.elements.force)
    assert one.to_json() == other.to_json()


@pytest.mark.parametrize("name", LOADS)
def test_rings_of_a_hard_material_are_rigid(name):
    one, other = rigid(name), bent(name, **of_a_modulus(name, 1e4))
    assert other.displacement == pytest.approx(one.displacement, rel=1e-4, abs=1e-10)
    largest = one.largest_force
    assert np.abs(one.elements.force - other.elements.force).max() < 1e-4 * largest
    assert np.abs(other.stiffness - one.stiffness).max() < 1e-3 * np.abs(one.stiffness).max()


@pytest.mark.parametrize("name", LOADS)
def test_elements_bear_the_load(name):
    solution = bent(name, **BOTH)
    e, load = solution.elements, solution.load
    angle = np.nan_to_num(e.angle[:, 0])
    radial = e.force[:, 0] * np.cos(angle)
    found = [e.force[:, 0] @ np.sin(angle), radial @ np.cos(e.azimuth), radial @ np.sin(e.azimuth)]
    assert found == pytest.approx(load[:3], abs=1e-3 * solution.largest_force)
    assert solution.unbalanced < 1e-9


@pytest.mark.parametrize("name", LOADS)
def test_stiffness_is_the_slope_of_the_load(name):
    """The exact tangent with rings that bend, against differences of two solutions: 4 %, as the
    places at which balls press the rings go with the load as well."""
    load, step = LOADS[name], 2.0
    outer = on("points", (50.0, 180.0, 300.0))
    low, high = (
        bent(name, dataclasses.replace(load, radial=load.radial + d), outer=outer)
        for d in (-step, step)
    )
    middle = bent(name, load, outer=outer)
    free = middle.reaction == 0.0
    moved = (high.displacement - low.displacement)[free]
    slope = middle.stiffness[np.ix_(free, free)] @ moved
    assert slope == pytest.approx((high.load - low.load)[free], abs=0.08 * step)


def test_axial_load_through_ribs_tilts_sections_about_their_races():
    """A rib's force has the rib's height as its lever on the race, not the radius of the bearing:
    rings that bend move by 1 % as much again at the most, and share the load as rigid ones do."""
    load = Load(axial=600.0, radial=3000.0)
    one = solve_bearing(NUP, statics_of(NUP), load=load)
    rings = Rings(sections=sections_of(NUP), **BOTH)
    other = solve_bearing(NUP, statics_of(NUP), load=load, rings=rings)
    assert other.elements.axial.sum() == pytest.approx(600.0, rel=1e-6)
    assert other.displacement[0] == pytest.approx(one.displacement[0], rel=0.01)
    assert other.elements.axial.max() == pytest.approx(one.elements.axial.max(), rel=0.05)
    for ring in other.rings:
        assert np.abs(ring.force[:, 1]).max() < other.elements.axial.max() * 5e-3  # N m


def test_supports_bear_the_load_and_push_only():
    solution = bent("N1013", outer=on("arcs", (60.0, -60.0, 180.0)))
    (outer,) = solution.rings
    place, force = outer.seated.support, outer.support_force
    assert (force >= 0.0).all() and (force > 0.0).sum() >= 2
    assert [force @ np.cos(place), force @ np.sin(place)] == pytest.approx([5e3, 0.0], abs=1.0)
    assert not force[np.cos(place) < 0.0].any()


def test_points_pull_as_well_and_do_not_clamp():
    """One force for a point, about which the ring pivots, however wide the load is spread."""
    found = []
    for arc in (2.0, 10.0):
        (outer,) = bent("N1013", outer=on("points", (60.0, -60.0, 180.0), arc)).rings
        place, force = outer.seated.support, outer.support_force
        assert len(force) == 3
        assert force[np.cos(place) < 0.0].sum() < 0.0
        assert force @ np.cos(place) == pytest.approx(5e3, abs=1.0)
        found.append(force)
    assert found[1] == pytest.approx(found[0], abs=0.02 * found[0].max())


def test_a_wider_arc_bears_at_its_edges():
    """The ring rests where the next width begins to bear, so displacements fall evenly with the
    width, without a jump (of 15 % between 8 and 10 degrees where an arc was one pad, then two);
    three times as many strips move nothing by 0.5 %."""
    width = np.arange(6.0, 15.0)
    down = [bent("N1013", outer=on("arcs", (60.0, -60.0), arc)).displacement[1] for arc in width]
    step = -np.diff(down)
    assert (step > 0.0).all()
    assert np.abs(np.diff(step)).max() < 0.15 * step.mean()


@pytest.mark.parametrize("arc", (2.0, 15.0))
def test_strips_of_an_arc_have_converged(arc, monkeypatch):
    one = bent("N1013", outer=on("arcs", (60.0, -60.0), arc))
    monkeypatch.setattr("flexcage.system.statics.rings._STRIPS", 24)
    other = bent("N1013", outer=on("arcs", (60.0, -60.0), arc))
    assert len(other.rings[0].support_force) == 3 * len(one.rings[0].support_force)
    assert one.displacement[1] == pytest.approx(other.displacement[1], rel=0.005)
    change = np.abs(one.elements.force - other.elements.force).max()
    assert change < 0.01 * one.largest_force


@pytest.mark.parametrize(
    ("azimuths", "arc"), (((77.0, 100.0, 172.0, 188.0, 195.0, 280.0), 6.0), ((88.0, -88.0), 15.0))
)
def test_arcs_that_wedge_a_ring_hold_it(azimuths, arc):
    """The load lies between supports almost a half turn apart, which press many times as hard."""
    (outer,) = bent("N1013", outer=on("arcs", azimuths, arc)).rings
    place, force = outer.seated.support, outer.support_force
    assert [force @ np.cos(place), force @ np.sin(place)] == pytest.approx([5e3, 0.0], abs=1.0)
    assert (force >= 0.0).all() and force.sum() > 2.0 * 5e3


def test_two_support_arcs_make_two_peaks():
    """A thin outer ring on two supports loads the elements beside them most, not the one between:
    "the maximum rolling-element loads in the bearing occur in close angular proximity of the points
    of load application", T. A. Harris and J. L. Broschard, J. Basic Eng. 86 (1964) 457, of planet
    gears, whose teeth load the outer ring at two places."""
    force = bent("N1013", LOADS["N1013"], outer=on("arcs", (40.0, -40.0))).elements.force[:, 1]
    count = len(force)
    around = np.roll(force, count // 2)  # the load's azimuth, 0, in the middle
    peaks = [k for k in range(1, count - 1) if around[k - 1] < around[k] > around[k + 1]]
    azimuth = (np.array(peaks) - count // 2) * 360.0 / count
    assert len(peaks) == 2 and np.abs(np.abs(azimuth) - 40.0).max() < 360.0 / count
    assert force[0] < 0.5 * force.max()
    stiff = rigid("N1013").elements.force[:, 1]
    assert stiff.argmax() == 0


@pytest.mark.parametrize("name", ("N1013", "7603025"))
def test_results_hardly_depend_on_the_patch(name, monkeypatch):
    """Hertz is counted once: with patches half as long again, nothing moves by 1 %."""
    found = []
    reduce = ring_modes.reduce_ring
    for along in (0.18, 0.27):
        monkeypatch.setattr(
            "flexcage.system.statics.rings.reduce_ring",
            lambda *a, along=along, **k: reduce(*a, **{**k, "along": along}),
        )
        found.append(bent(name, **BOTH))
    one, other = found
    assert other.displacement[:3] == pytest.approx(one.displacement[:3], rel=0.005, abs=1e-9)
    change = np.abs(one.elements.force - other.elements.force).max()
    assert change < 0.005 * one.largest_force


def test_a_turn_by_an_element_turns_the_solution():
    load = LOADS["N1013"]
    count = load_preset("N1013").bearing.element_count
    step = 2.0 * np.pi / count
    load = dataclasses.replace(load, misalignment=0.0)
    one = bent("N1013", load, outer=on("arcs", (60.0, -60.0)))
    turned = np.degrees(step) + np.array((60.0, -60.0))
    other = bent("N1013", dataclasses.replace(load, direction=step), outer=on("arcs", turned))
    assert np.roll(one.elements.force[:, 0], 1) == pytest.approx(
        other.elements.force[:, 0], abs=1e-6 * one.largest_force
    )


def test_a_ring_that_lifts_off_is_refused():
    with pytest.raises(InputError, match="free to move across the axis"):
        bent("N1013", outer=on("arcs", (150.0, -150.0)))


def test_a_seat_inside_the_race_is_refused():
    with pytest.raises(InputError, match=r"outer_ring.diameter leaves the outer ring a wall"):
        bent("N1013", outer=OuterRing(ring="flexible", diameter=0.08))


@pytest.mark.parametrize("name", LOADS)
def test_rings_that_bend_sit_on_a_seat_that_yields(name):
    """Hard rings as rigid ones do; soft ones move with the seat by what the elements bear."""
    seat = np.diag([2e-9, 1e-9, 3e-9, 1e-6, 2e-6])  # m/N and rad/(N m)
    bearing = load_preset(name).bearing
    options = {"load": LOADS[name], "speed": SPEED, "seat": seat}
    both = solve_bearing(bearing, statics_of(bearing), **options)
    sections = sections_of(bearing)
    hard, soft = (
        solve_bearing(
            bearing, statics_of(bearing), **options, rings=Rings(sections=sections, **rings)
        )
        for rings in (of_a_modulus(name, 1e4), BOTH)
    )
    assert hard.outer == pytest.approx(both.outer, rel=1e-3, abs=1e-9)
    assert hard.elements.force == pytest.approx(both.elements.force, rel=1e-3, abs=1.0)
    assert np.abs(soft.elements.force - both.elements.force).max() > 1e-3 * both.largest_force
    borne = soft.load + soft.reaction  # by the elements, and by the seat
    assert soft.outer == pytest.approx(seat @ borne, rel=1e-6, abs=1e-12)
    assert np.abs(soft.outer).max() > 1e-6


@pytest.mark.parametrize("name", ("N1013", "7603025", "15x37x10"))
def test_sections_have_the_rings_shape(name):
    """Outlines close around the area between race or shoulders and seat, ribs included."""
    b = load_preset(name).bearing
    found = sections_of(b)(b, angle=(0.0, 0.0), across=(1e-4, 1e-4),
                           seat=(b.bore, b.outside_diameter))  # fmt: skip
    for section in found:
        x, r = np.array(section.outline).T
        area = 0.5 * abs(np.sum(x * np.roll(r, -1) - np.roll(x, -1) * r))
        low, high = section.wall * b.width, (np.ptp(r)) * b.width
        assert low < area * (1.0 + 1e-9) and area < high * (1.0 + 1e-9)
        assert len(set(section.outline)) == len(section.outline) == len(section.names)
        assert np.ptp(x) == pytest.approx(b.width)
    if name == "N1013":  # two ribs on the inner ring, none on the outer
        x, r = np.array(found[0].outline).T
        area = 0.5 * abs(np.sum(x * np.roll(r, -1) - np.roll(x, -1) * r))
        rib, race = 0.5 * b.rib_diameter, 0.5 * b.inner_race_diameter
        ribs = (rib - race) * (b.width - b.rib_gap)
        assert area == pytest.approx((race - 0.5 * b.bore) * b.width + ribs, rel=1e-9)


def test_ribs_of_a_design_are_in_its_sections():
    """An NU has its ribs on the outer ring, where they stiffen it."""
    n = load_preset("N1013").bearing
    nu = dataclasses.replace(n, design="NU", rib_diameter=2.0 * n.pitch_diameter - n.rib_diameter)
    plain, ribbed = (
        sections_of(b)(b, angle=(0.0, 0.0), across=(0.0, 0.0), seat=(b.bore, b.outside_diameter))
        for b in (n, nu)
    )
    assert min(r for _, r in ribbed[1].outline) == pytest.approx(0.5 * nu.rib_diameter)
    assert max(r for _, r in ribbed[0].outline) == pytest.approx(0.5 * n.inner_race_diameter)
    free = ring_modes.RingSeat(rigidly=False)
    soft, stiff = (ring_modes.reduce_ring(s[1], n.material, free) for s in (plain, ribbed))
    assert stiff.compliance[2, 0, 0] < 0.9 * soft.compliance[2, 0, 0]
