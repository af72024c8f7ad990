"""Rings with modes, on supports and on soft seats, and housings that yield, in a run."""

from itertools import product

import numpy as np
import pytest
from bearing_runs import unbalanced
from ring_cases import LOADS, at_rest, case_of, housing_file, soft

import flexcage
from flexcage.bearings import sections_of, statics_of
from flexcage.case import Case
from flexcage.core.errors import InputError
from flexcage.geometry.materials import MATERIALS
from flexcage.geometry.ring import OuterRing, Raceway, RingSection
from flexcage.modes.ring import RingSeat, reduce_ring
from flexcage.stages import assembled_start, bearing_in_motion, cage_mesh
from flexcage.static import solve_static
from flexcage.stress.rings import ring_field
from flexcage.system.rings.low_modes import CARRIED, low_modes, residual_compliance
from flexcage.system.rings.modes import deflect
from flexcage.system.rings.modes_data import modes_of
from flexcage.system.rings.moving import moving_rings
from flexcage.system.rings.supports import press_supports
from flexcage.system.spec import Load
from flexcage.system.statics.options import AT_START
from flexcage.system.statics.rings import Rings
from flexcage.system.statics.solve import solve_bearing

SEATS = {
    "N1013": ("arcs", (40.0, -40.0)),
    "7010C-PI": ("points", (50.0, 180.0, 300.0)),
}
STEEL = MATERIALS["steel"]


def held(preset):
    """Keys of an outer ring on its supports."""
    seat, azimuths = SEATS[preset]
    supports = tuple(np.radians(azimuths))
    return {
        "outer_ring.ring": "flexible", "outer_ring.seat": seat, "outer_ring.supports": supports,
    }  # fmt: skip


def differ_little(found, wanted, share):
    assert np.abs(found - wanted).max() < share * np.abs(wanted).max()


# --- supports ------------------------------------------------------------------------------------


def brute_force(between, free):
    """Forces of supports that only press, by trying all sets of them."""
    for bears in product((False, True), repeat=len(free)):
        keep = np.array(bears)
        press = np.zeros(len(free))
        press[keep] = np.linalg.solve(between[np.ix_(keep, keep)], free[keep])
        entered = free - between @ press
        if (press >= 0.0).all() and (entered[~keep] <= 0.0).all():
            return press
    raise AssertionError


@pytest.mark.parametrize("holds", (False, True))
def test_supports_press_and_are_not_entered(holds):
    rng = np.random.default_rng(3)
    none, nothing = np.zeros(0, np.int64), np.zeros(0)
    sets = set()
    for _ in range(60):
        root = rng.standard_normal((6, 6))
        between = root @ root.T + 0.05 * np.eye(6)
        free = rng.standard_normal(6)
        modes = modes_of(
            1, none, none, np.zeros((0, 2)), np.zeros((0, 3)), nothing, nothing, np.zeros((0, 0)),
            np.zeros((6, 0)), np.zeros((6, 0)), azimuth=np.zeros(6), between=between, holds=holds,
        )  # fmt: skip
        modes.free_penetration[:] = free
        press_supports(modes)
        wanted = np.linalg.solve(between, free) if holds else brute_force(between, free)
        assert modes.press == pytest.approx(wanted, rel=1e-9, abs=1e-12)
        sets.add(tuple(modes.press > 0.0))
    assert len(sets) > 15  # of different supports


# --- modes ---------------------------------------------------------------------------------------


def thin_ring():
    """A free ring with a square section, 4 mm on a radius of 50 mm."""
    radius, side = 0.05, 0.004
    low, half = radius - 0.5 * side, 0.5 * side
    outline = ((-half, low + side), (-half, low), (half, low), (half, low + side))
    race = Raceway(place=(0.0, low), normal=(0.0, 1.0), extent=half, line=True)
    section = RingSection(outline, ("", "race", "", "seat"), race, side)
    return reduce_ring(section, STEEL, RingSeat(rigidly=False))


def test_modes_of_a_thin_ring_are_those_in_closed_form():
    """Radial shapes of unit modal mass of a ring that does not stretch, u_r = n u_psi, to 2 %:
    m/2 (1 + 1/n^2) a'^2 (S. S. Rao, Vibration of Continuous Systems, 9); what modes leave of the
    compliance is little, and positive."""
    ring = thin_ring()
    modes = low_modes(ring)
    mass = STEEL.density * 0.004**2 * 2.0 * np.pi * 0.05
    rigid = modes.frequency == 0.0
    assert modes.shape[rigid, 0] ** 2 == pytest.approx([1.0 / mass], rel=1e-4)
    for n in range(2, 5):
        found = (modes.shape[modes.harmonic == n][:, [0, 2]] ** 2).max(axis=0)
        assert found == pytest.approx([2.0 * n**2 / (mass * (n**2 + 1))] * 2, rel=0.02)
    assert modes.frequency.max() < CARRIED
    assert np.array_equal(low_modes(ring).shape, modes.shape)  # signs too: a run may be resumed
    rest = residual_compliance(ring, modes)
    assert (np.linalg.eigvalsh(rest[:, :2, :2]) > 0.0).all()
    assert rest[2, 0, 0] < 1e-2 * ring.compliance[2, 0, 0]


@pytest.mark.parametrize("speed", (0.0, 500.0, 3000.0))
def test_waves_on_a_turning_ring_travel_as_bryans(speed):
    """Seen from a frame that does not spin, a wave of a ring that does not stretch has the
    frequencies sqrt(w^2 + (W P)^2) +- W P with P = n (n^2 - 1)/(n^2 + 1), to 1 % of P: G. H. Bryan,
    Proc. Cambridge Philos. Soc. 7 (1890) 101, whose frame turns with the ring."""
    modes = low_modes(thin_ring())
    for n in (2, 3):
        in_plane = np.flatnonzero((modes.harmonic == n) & (np.abs(modes.shape[:, 0]) > 1e-2))[0]
        w, coupled = modes.frequency[in_plane], modes.turning[in_plane, in_plane]
        closed = n * (n**2 - 1) / (n**2 + 1)
        assert coupled == pytest.approx(closed, rel=0.01)
        # a'' + 2 W P a' + w^2 a = 0 of the pair
        turn = 2.0 * speed * coupled * np.array([[0.0, 1.0], [-1.0, 0.0]])
        system = np.block([[np.zeros((2, 2)), np.eye(2)], [-(w**2) * np.eye(2), -turn]])
        found = np.unique(np.abs(np.linalg.eigvals(system).imag).round(3))
        apart, mean = speed * closed, np.hypot(w, speed * closed)
        wanted = np.unique(np.round([mean - apart, mean + apart], 3))
        assert found == pytest.approx(wanted, abs=0.02 * apart + 1e-3)


def rates_of(bearing, y):
    """y' by the explicit method's function."""
    yd = np.zeros_like(y)
    bearing.function("rates")(0.0, y.copy(), yd, bearing.args, np.zeros(0))
    return yd


def in_the_air(case):
    """A bearing whose elements lie on the outer race, away from the inner one, and its state."""
    bearing = bearing_in_motion(case, cage_mesh(case), None)
    layout = bearing.layout
    y = np.zeros(layout.size)
    q = layout.q(y)
    model = bearing.data.model
    q["elements"][:, 1] = model.bodies.pitch + 30e-6
    q["elements"][:, 2] = 2.0 * np.pi * np.arange(layout.elements) / layout.elements
    q["quaternion"][0] = 1.0
    layout.u(y)["inner"][3] = case.drive.speed
    return bearing, y


@pytest.mark.slow
@pytest.mark.parametrize("mass", (0.3, 2.0))
@pytest.mark.parametrize("speed", (0.0, 2000.0))
def test_a_turning_ring_vibrates_on_its_shaft(mass, speed):
    """Frequencies of the linear motion of the explicit method, elements off the race. One wave:
    ring and shaft move against each other, w sqrt(1 + m/M) at rest to 1 %. Two and more: as from
    the turning modes alone, to 1e-6. Nothing is damped."""
    case = case_of("N1013", speed=speed, **soft("inner"), **{
        "load.shaft_mass": mass, "load.gravity": 0.0, "inner_ring.relaxation": 1e-12,
    })  # fmt: skip
    bearing, y = in_the_air(case)
    layout, count = bearing.layout, bearing.layout.places.inner_modes
    base = rates_of(bearing, y)
    places = np.arange(layout.size)
    q, u = layout.q(places), layout.u(places)
    at = np.concatenate([q["inner"][1:3], q["inner_modes"], u["inner"][1:3], u["inner_modes"]])
    system = np.zeros((len(at), len(at)))
    for k, place in enumerate(at):
        h = 1e-9 if k < len(at) // 2 else 1e-5
        moved = y.copy()
        moved[place] += h
        system[:, k] = (rates_of(bearing, moved) - base)[at] / h
    values = np.linalg.eigvals(system)
    assert np.abs(values.real).max() < 1e-4 * np.abs(values).max()
    found = np.sort(values.imag[values.imag > 1.0])
    modes = bearing.data.model.inner_modes
    oval = modes.harmonic > 1
    n = int(oval.sum())
    turn = 2.0 * speed * modes.turning[np.ix_(oval, oval)]
    alone = np.linalg.eigvals(
        np.block([[np.zeros((n, n)), np.eye(n)], [-np.diag(modes.stiffness[oval]), -turn]])
    )
    for w in np.sort(alone.imag[alone.imag > 1.0]):
        assert np.abs(found / w - 1.0).min() < 1e-6
    if speed == 0.0:
        once = (modes.harmonic == 1) & (np.abs(modes.section[:, 1]) > 1e-2)
        w, whole = np.sqrt(modes.stiffness[once].min()), bearing.data.model.inner_ring.inertia[0]
        own = whole - mass
        assert np.abs(found / (w * np.sqrt(1.0 + own / mass)) - 1.0).min() < 0.01
    assert count == len(modes.stiffness)


@pytest.mark.parametrize(
    "preset", ("N1013", pytest.param("7010C-PI", marks=pytest.mark.slow))
)  # fmt: skip
def test_what_kernels_read_is_the_static_solution(preset):
    """Wherever the line between modes and the rest lies, deflections and supports' forces at rest
    are the static ones."""
    bearing = Case.from_preset(preset).bearing
    outer = OuterRing(**{k.split(".")[1]: v for k, v in held(preset).items()})
    rings = Rings(outer=outer, sections=sections_of(bearing))
    load = Load(**LOADS[preset])
    solution = solve_bearing(bearing, statics_of(bearing), load=load, rings=rings)
    (ring,), count = solution.rings, bearing.element_count
    moving = moving_rings(rings, solution)
    q, s = np.zeros((count, 6)), np.zeros((2, count, 2))
    q[:, 2], s[1] = ring.azimuth, ring.force
    data, modes, at_start = moving.data, moving.modes[1], moving.at_start[1]
    q[:, 1] = 0.5 * bearing.pitch_diameter
    deflect(1, q.ravel(), s.ravel(), np.zeros(6), at_start, data, modes)
    a, b, c = data.half_space[1]
    found = data.deflection[1] - ring.force @ np.array([[a, b], [b, c]])
    wanted = ring.deflection @ ring.seated.to_v
    for port in range(2):
        differ_little(found[:, port], wanted[:, port], 5e-4)
    differ_little(modes.press, ring.support_force, 1e-4)
    # modes rest: supports and elements balance their springs
    pushed = modes.stiffness * at_start - modes.push
    waves = np.where(modes.quarter == 0, *(f(np.outer(ring.azimuth, modes.harmonic))
                                           for f in (np.cos, np.sin)))  # fmt: skip
    borne = ((waves.T @ ring.force) * modes.shape).sum(axis=1)
    differ_little(pushed, borne, 1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("preset", LOADS)
def test_a_run_at_rest_is_the_static_solution(preset):
    """Forces, displacements and supports' forces within 0.1 %."""
    case = at_rest(preset, **held(preset))
    run, static = flexcage.simulate(case, stress=False), solve_static(case, options=AT_START)
    ds = run.dataset
    differ_little(ds["race_force"].values[-1], static.elements.force, 1e-3)
    differ_little(ds["inner_position"].values[-1], static.displacement[:3], 1e-3)
    differ_little(ds["support_force"].values[-1], static.rings[0].support_force, 1e-3)
    outer = ds["ring_deflection"].values[-1][:, 1, :2]
    differ_little(outer, static.rings[0].deflection[:, :2], 1e-3)
    (at_last,) = run.rings(time=ds["time"].values[-1])
    now, then = (ring_field(ring, stations=60) for ring in (at_last, static.rings[0]))
    differ_little(now.displacement, then.displacement, 3e-3)
    differ_little(now.von_mises, then.von_mises, 3e-3)


# --- motion --------------------------------------------------------------------------------------


@pytest.mark.slow
def test_two_arcs_make_two_peaks_in_motion():
    """Elements beside the supports bear most, as in the static solution (Harris and Broschard:
    ``test_flexible_rings``), while they travel past them."""
    ds = flexcage.simulate(case_of("N1013", duration=6e-3, **held("N1013")), stress=False).dataset
    force = ds["race_force"].values[:, :, 1]
    azimuth = np.degrees(ds["element_position"].values[..., 2])
    azimuth = (azimuth + 180.0) % 360.0 - 180.0
    mean = [force[np.abs(azimuth - at) < 8.0].mean() for at in (-40.0, 0.0, 40.0)]
    assert mean[1] < 0.4 * min(mean[0], mean[2])
    assert np.ptp(ds["element_position"].values[:, 0, 2]) > np.radians(60.0)


@pytest.mark.slow
@pytest.mark.parametrize("preset", LOADS)
def test_energy_is_accounted_for(preset):
    """Under a load that swings, so that supports press and let go; of what rings lose 1 % may come
    back for an instant, as supports follow the forces that the ring bears and not the contacts'."""
    wave = {
        "load.wave": "sine", "load.wave_of": "radial", "load.wave_period": 5e-4,
        "load.wave_amplitude": 0.95 * LOADS[preset]["radial"],
    }  # fmt: skip
    run = flexcage.simulate(case_of(preset, **held(preset), **wave), stress=False)
    ds = run.dataset
    missed = ds["energy"].sum("energy_kind") - ds["work"].sum("channel")
    assert np.ptp(missed.values) < 1e-4 * np.abs(ds["work"].values[-1]).sum()
    damped = ds["work"].sel(channel="modal_damping").values
    assert damped[-1] < 0.0
    assert (np.diff(damped) < 1e-2 * abs(damped[-1])).all()
    pressed = ds["support_force"].values > 0.0
    assert (pressed != pressed[0]).any()


@pytest.mark.slow
@pytest.mark.parametrize("preset", LOADS)
def test_forces_on_all_bodies_add_up_to_none(preset):
    """Between races that swing, slopes included, in a state that is no equilibrium."""
    case = case_of(preset, **held(preset))
    bearing = bearing_in_motion(case, cage_mesh(case), None)
    layout, start = bearing.layout, assembled_start(case, bearing)
    y, rng = start.y.copy(), np.random.default_rng(1)
    elements = layout.q(y)["elements"]
    elements[:, 1] += 1e-6 * rng.standard_normal(len(elements))
    elements[:, 2] += 1e-3 * rng.standard_normal(len(elements))
    modes = layout.q(y)["outer_modes"]
    modes *= 1.0 + 0.01 * rng.standard_normal(len(modes))
    bearing.residual(0.0, y, start.yd)
    rings = bearing.data.model.rings
    assert np.abs(rings.moment[1]).max() > 1e-6  # slopes push
    assert np.abs(unbalanced(bearing, elements)).max() < 1e-12


ON_SEATS = {  # soft rings on seats that stand, are held, move, turn
    "outer": soft("outer"),
    "inner": soft("inner", **{"load.shaft_mass": 1.0}),
    "inner of a light shaft": soft("inner"),
    "both, in a bushing": soft("inner", "outer", **{
        "load.shaft_mass": 1.0, "mount.kind": "bushing", "mount.stiffness": 3e8, "mount.mass": 1.0,
    }),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("preset", LOADS)
@pytest.mark.parametrize("seats", ON_SEATS)
def test_soft_rings_rest_as_in_the_static_solution(preset, seats):
    """Forces and displacements within 0.2 %, deflections, which still swing a little, 0.3 %."""
    case = at_rest(preset, duration=3e-3, **ON_SEATS[seats])
    run, static = flexcage.simulate(case, stress=False), solve_static(case, options=AT_START)
    ds, layout = run.dataset, bearing_in_motion(case, cage_mesh(case), None).layout
    assert any(body.modes for body in layout.bodies)
    differ_little(ds["race_force"].values[-1], static.elements.force, 2.5e-3)
    differ_little(ds["inner_position"].values[-1], static.displacement[:3], 2e-3)
    for ring in static.rings:
        side, ports = ("inner", "outer").index(ring.side), ring.deflection @ ring.seated.to_v
        found = ds["ring_deflection"].values[-1][:, side] @ ring.seated.to_v
        differ_little(found[:, 0], ports[:, 0], 3e-3)


@pytest.mark.slow
@pytest.mark.parametrize("preset", LOADS)
@pytest.mark.parametrize("seats", ON_SEATS)
def test_energy_is_accounted_for_on_soft_seats(preset, seats):
    """Under a load that swings while the inner ring turns, which moves them by 50 um: balls 1e-4,
    rollers 4e-4 (set after 3e-4 was seen)."""
    wave = {
        "load.wave": "sine", "load.wave_of": "radial", "load.wave_period": 5e-4,
        "load.wave_amplitude": 0.9 * LOADS[preset]["radial"],
    }  # fmt: skip
    ds = flexcage.simulate(case_of(preset, **ON_SEATS[seats], **wave), stress=False).dataset
    missed = ds["energy"].sum("energy_kind") - ds["work"].sum("channel")
    allowed = {"N1013": 4e-4, "7010C-PI": 1e-4}[preset]
    assert np.ptp(missed.values) < allowed * np.abs(ds["work"].values[-1]).sum()


def test_a_ring_on_a_light_seat_is_warned_of():
    """Its mass moves with the seat; with a shaft as heavy as the ring there is nothing to say."""
    told = {}
    for mass in (0.0, 1.0):
        case = at_rest("N1013", **soft("inner"), **{"load.shaft_mass": mass})
        told[mass] = bearing_in_motion(case, cage_mesh(case), None).rings.warnings
    (said,) = told[0.0]
    assert "the inner ring vibrates on its seat as a whole at 3.5 kHz" in said
    assert "load.shaft_mass" in said and told[1.0] == ()


# --- housings ------------------------------------------------------------------------------------


@pytest.fixture
def housing(tmp_path):
    return housing_file(tmp_path, along=3e8, coupled=2e6)


@pytest.mark.slow
@pytest.mark.parametrize("bends", ("rigid", "flexible"))
@pytest.mark.parametrize("preset", LOADS)
def test_a_run_at_rest_in_a_housing_is_the_static_solution(preset, bends, housing):
    """Forces and displacements within 0.1 %, of the outer ring too; it has its mass."""
    given = {"mount.body": housing, "mount.mass": 0.5, "outer_ring.ring": bends}
    case = at_rest(preset, **given, **{"load.misalignment": 2e-4} if preset == "N1013" else {})
    ds, static = flexcage.simulate(case, stress=False).dataset, solve_static(case, options=AT_START)
    assert np.abs(static.outer[:3]).max() > 1e-6
    differ_little(ds["race_force"].values[-1], static.elements.force, 1e-3)
    differ_little(ds["inner_position"].values[-1], static.displacement[:3], 1e-3)
    differ_little(ds["outer_position"].values[-1], static.outer[:3], 2e-3)


@pytest.mark.slow
def test_a_ring_swings_in_its_housing_with_its_mass(housing):
    """After a jump of load the outer ring with its housing swings on the seat: y'' = (F - K y)/m
    to 1 %, F the sum of what rollers bear."""
    case = case_of("N1013", speed=0.0, duration=3e-3, **{
        "mount.body": housing, "mount.mass": 5.0, "load.gravity": 0.0, "load.ramp_to": 8000.0,
        "load.ramp_time": 1e-4, "output.rate": 200e3, "solver.max_step": 2e-6,
    })  # fmt: skip
    ds = flexcage.simulate(case, stress=False).dataset
    y, v = ds["outer_position"].values[:, 1], ds["outer_velocity"].values[:, 1]
    psi = ds["element_position"].values[..., 2]
    force = (ds["race_force"].values[..., 1] * np.cos(psi)).sum(axis=1)
    mass, t = case.bearing.outer_ring_mass + 5.0, ds["time"].values
    assert np.gradient(y, t)[5:-5] == pytest.approx(v[5:-5], abs=0.01 * np.abs(v).max())
    pull = 2e8 * (y + 0.5 * case.outer_ring.relaxation * v)
    assert mass * np.gradient(v, t)[5:-5] == pytest.approx(
        (force - pull)[5:-5], abs=0.01 * np.abs(force).max()
    )
    assert y.max() > 1.2 * 8000.0 / 2e8  # it overshoots


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({**held("N1013"), "mount.kind": "bushing"}, "in a run supports stand still"),
        ({**held("N1013"), "mount.body": "h.npz"}, "but mount.body is given, and in a run"),
        ({"mount.body": "h.npz", "mount.kind": "bushing"}, "a housing takes its place"),
    ],
)
def test_what_does_not_go_together_is_said_in_a_sentence(changes, said):
    with pytest.raises(InputError, match=said):
        case_of("N1013", **changes)
