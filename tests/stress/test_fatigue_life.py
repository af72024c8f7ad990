"""Counted stress, damage and life against closed forms and full finite-element solutions."""

import importlib.util

import numpy as np
import pytest
from test_recovery import quasi_static, station_forces

from flexcage.core.errors import EnvironmentLacks, InputError
from flexcage.geometry.materials import MATERIALS
from flexcage.results.statistics import Windows
from flexcage.stress.counting import corrected_amplitude, count, damage
from flexcage.stress.fatigue import CountedStress, counted_stress, place_fatigue
from flexcage.stress.fields import TensorFields
from flexcage.stress.history import histories_at
from flexcage.stress.recovery import CageLoads
from flexcage.stress.sn_curves import SN_CURVES, SNCurve, register_sn_curve, sn_curve

CURVE = SNCurve(
    material="known", amplitude=100e6, cycles=1e6, slope=5.0, tensile_strength=500e6, source="here"
)
STEP, TURN = 1e-4, 0.02


def life_of(stress, curve=CURVE):
    windows = Windows(len(stress), np.arange(0, len(stress), 100))
    counted = {"here": (7, CountedStress(0, np.array([1.0, 0.0, 0.0]), stress))}
    samples = np.arange(len(stress))
    return place_fatigue(counted, curve, windows, samples=samples, step=STEP, turn=TURN)["here"]


def table_of(stress, *, passes, turn=TURN):
    windows = Windows(len(stress), np.linspace(0, len(stress), passes, endpoint=False, dtype=int))
    counted = {"here": (7, CountedStress(0, np.array([1.0, 0.0, 0.0]), stress))}
    samples = np.arange(len(stress))
    return place_fatigue(counted, CURVE, windows, samples=samples, step=STEP, turn=turn).table()


def test_a_table_explains_its_dashes():
    said = {"No interval (-)": {"passes": 2}, "No stress once a turn (-)": {"turn": np.nan}}
    for sentence, change in said.items():
        table = table_of(sine(80e6), **{"passes": 50, **change})
        assert "-" in table.splitlines()[1].split() and sentence in table and "nan" not in table
    table = table_of(sine(80e6), passes=50)
    assert "(-)" not in table and "-" not in table.splitlines()[1].split()


def sine(amplitude, mean=0.0, cycles=50, samples=100):
    """Whole cycles, each with samples at its two ends."""
    return mean + amplitude * np.sin(2.0 * np.pi * np.arange(cycles * samples) / samples)


def test_life_of_a_sine_is_that_of_its_sn_curve():
    stress = sine(80e6)
    place = life_of(stress)
    frequency = 1.0 / (100 * STEP)
    endured = 1e6 * (100.0 / 80.0) ** 5
    assert place.cycles == pytest.approx(frequency)
    assert place.life_hours == pytest.approx(endured / frequency / 3600.0)
    assert place.largest == pytest.approx((-80e6, 80e6))
    assert place.dominance == pytest.approx(1.0 / 50.0)
    # two of these cycles in a turn of the cage do what one of 80 MPa 2^(1/5) would
    assert place.amplitude == pytest.approx(80e6 * (TURN * frequency) ** 0.2)
    assert place.vertex == 7


@pytest.mark.parametrize(
    ("mean", "factor"),
    [(0.0, 1.0), (80e6, 1.0 + 0.2), (-40e6, 1.0 - 0.2 * 0.5), (-200e6, 1.0 - 0.2)],
    ids=["R=-1", "R=0", "R=-3", "R>1"],
)
def test_mean_stress_counts_as_in_the_fkm_diagram(mean, factor):
    """Goodman's M = 100/500; beyond R = infinity compression helps no further."""
    place = life_of(sine(80e6, mean))
    assert place.life_hours == pytest.approx(life_of(sine(80e6 * factor)).life_hours)


def test_damages_of_blocks_add_up():
    blocks = [(90e6, 10), (60e6, 40), (75e6, 20)]
    stress = np.concatenate([sine(size, cycles=n) for size, n in blocks])
    total = sum(n / (1e6 * (100e6 / size) ** 5) for size, n in blocks)
    # where blocks meet, rising flanks join into half cycles: less than one cycle each
    assert life_of(stress).damage_rate * len(stress) * STEP == pytest.approx(total, rel=0.02)


def test_life_falls_with_the_slope_of_stress():
    rng = np.random.default_rng(5)
    stress = 40e6 * rng.standard_normal(4000)
    one, twice = life_of(stress), life_of(2.0 * stress)
    assert one.life_hours / twice.life_hours == pytest.approx(2.0**5)
    assert twice.cycles == one.cycles and twice.margin > 0.0


def test_a_repeated_history_closes_all_its_cycles():
    """ASTM E1049-85, figure 6, as a history that repeats: its cycles by hand."""
    loops = count(np.array([-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0]))
    found = sorted(zip(loops.low, loops.high))
    assert found == [(-4.0, 5.0), (-3.0, 4.0), (-2.0, 1.0), (-1.0, 3.0)]


def test_a_constant_stress_does_no_damage():
    place = life_of(np.full(500, 30e6))
    assert place.damage_rate == 0.0 and place.life_hours == np.inf and place.cycles == 0.0
    assert place.largest_range == 0.0 and place.amplitude == 0.0
    assert len(corrected_amplitude(np.zeros(0), np.zeros(0), 0.3)) == len(
        damage(np.zeros(0), CURVE)
    )


def uniaxial(direction, size):
    """Tensors (6, nt) of a tension ``size`` (nt,) along directions (nt, 3)."""
    x, y, z = np.broadcast_to(direction, (len(size), 3)).T
    return size * np.stack([x * x, y * y, z * z, x * y, y * z, x * z])


def test_reversed_tension_is_counted_once_with_its_sign():
    along = np.array([2.0, -1.0, 2.0]) / 3.0
    size = 50e6 * np.sin(2.0 * np.pi * np.arange(400) / 100)
    quiet = 0.5 * uniaxial(along, size)
    counted = counted_stress(np.stack([quiet, uniaxial(along, size)], axis=1), 0.3)
    assert counted.point == 1
    assert abs(counted.normal @ along) == pytest.approx(1.0, abs=2e-4)
    assert np.ptp(counted.stress) == pytest.approx(100e6, rel=1e-3)
    assert len(count(counted.stress)) == 4  # von Mises' stress would have eight


def test_a_tension_that_turns_pulsates_on_every_plane_it_meets():
    """sigma cos^2 of the angle: from 0 to sigma, twice a turn."""
    angle = 2.0 * np.pi * np.arange(720) / 360
    around = np.stack([np.cos(angle), np.sin(angle), np.zeros(720)], axis=1)
    tensors = uniaxial(around, np.full(720, 60e6))[:, None]
    counted = counted_stress(tensors, 0.3)
    loops = count(counted.stress)
    assert abs(counted.normal[2]) < 0.03 and len(loops) == 4
    np.testing.assert_allclose(loops.high - loops.low, 60e6, rtol=2e-3)


def test_of_equal_ranges_the_one_under_tension_is_counted():
    size = 50e6 * np.sin(2.0 * np.pi * np.arange(200) / 100)
    pull = uniaxial(np.array([0.0, 1.0, 0.0]), size + 20e6)
    push = uniaxial(np.array([1.0, 0.0, 0.0]), size - 20e6)
    assert counted_stress(np.stack([push, pull], axis=1), 0.3).point == 1


@pytest.mark.parametrize("which", ["recovery", "damaged"])
def test_tensors_of_a_history_are_those_of_the_full_mesh(which, request):
    recovery = request.getfixturevalue(which)
    forces = station_forces(seed=3, samples=3)
    forces[..., :2, :, 0:2] = 0.0
    forces[..., 2:, :, 1:] = 0.0
    q = np.stack([quasi_static(recovery, one) for one in forces])
    fields = TensorFields(recovery)
    names = tuple(fields.places)[:5]
    samples, histories = histories_at(fields, q, forces, places=names)
    assert list(samples) == list(range(len(q)))
    for name, tensors in histories:
        of_place = np.isin(recovery.vertex_stress.owner, fields.vertices[fields.places[name]])
        for k, one in enumerate(forces):
            moved = recovery.displacement(CageLoads(station_forces=one))
            full = recovery.vertex_stress(moved[..., None], one[..., None])[of_place, 0]
            scale = np.abs(full).max() + 1.0
            np.testing.assert_allclose(tensors[:, :, k], full.T, atol=2e-4 * scale)


def test_curves_have_sources_and_unknown_materials_are_refused():
    assert all(curve.source for curve in SN_CURVES.values()) and set(SN_CURVES) <= set(MATERIALS)
    with pytest.raises(InputError, match="No published S-N curve of polyimide.*your own"):
        sn_curve("polyimide")
    nameless = SNCurve(material="x", amplitude=1e6, cycles=1e6, slope=5.0, tensile_strength=1e8)
    with pytest.raises(InputError, match="no source"):
        register_sn_curve(nameless)
    with pytest.raises(InputError, match="'brass' exists already"):
        register_sn_curve(SN_CURVES["brass"])


def test_the_nylon_curve_goes_through_its_points():
    curve = sn_curve("PA66")
    for cycles, psi in ((1e4, 6500.0), (1e5, 5900.0), (1e6, 5300.0), (1e7, 5200.0)):
        line = curve.amplitude * (curve.cycles / cycles) ** (1.0 / curve.slope)
        assert line == pytest.approx(psi * 6894.757, rel=0.04)


def test_without_pylife_one_sentence_says_what_to_install(monkeypatch):
    find = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name, *a: None if name == "pylife" else find(name, *a)
    )
    with pytest.raises(EnvironmentLacks, match=r"pip install '\.\[fatigue\]'"):
        count(np.zeros(3))
