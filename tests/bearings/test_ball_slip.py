"""Slip and lines of ball bearings refer to the contact angles that the balls have."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from flexcage.bearings.ball import slip as ball_slip
from flexcage.case.presets import load_preset
from flexcage.results.figures.part import SettledRun
from flexcage.results.figures.sections import summarise
from flexcage.results.registry import VARIABLES
from flexcage.results.slip import (
    BearingNumbers,
    SlipRange,
    at_own_angles,
    cage_speed,
    element_slip_ratio,
    rolling_by_curvature,
)
from flexcage.results.spectra import SIGNALS, run_frequencies
from flexcage.results.store import RunStore

BEARING = load_preset("7010C-PI").bearing
Z, PITCH, D = BEARING.ball_count, BEARING.pitch_diameter, BEARING.ball_diameter
NUMBERS = BearingNumbers(
    pitch_diameter=PITCH, element_diameter=D, element_count=Z,
    contact_angle=BEARING.nominal_contact_angle, rolling_heights=BEARING.rolling_heights,
)  # fmt: skip
INNER, OUTER = 0.42, 0.22  # rad, contact angles of the loaded balls
SPEED, SLIP = 4000 * np.pi / 30, 0.002
_CAGE_SPEED = SIGNALS["cage_speed"]


def by_hand() -> tuple[float, float]:
    """Orbit and spin in the cage of balls that roll at both angles [rad/s]."""
    r_i, r_o = 0.5 * (PITCH - D * np.cos(INNER)), 0.5 * (PITCH + D * np.cos(OUTER))
    orbit = SPEED * r_i / (r_i + r_o)
    return orbit, (SPEED - orbit) * r_i / (0.5 * D * np.cos(0.5 * (INNER - OUTER)))


@pytest.fixture(scope="module")
def run():
    """Two turns of the cage, 0.2 % too slow. Half of the balls bear 20 N, those on one side at
    negative angles, as under a tilted ring; the others touch the outer race alone."""
    orbit, spin = by_hand()
    n = 3001
    t = np.linspace(0.0, 2.0 * 2.0 * np.pi / orbit, n)
    names = """inner_speed inner_angle inner_position inner_quaternion element_position
        element_velocity element_omega race_force contact_angle race_slip cage_position
        cage_quaternion cage_omega cage_velocity pocket_force land_force multiplier""".split()
    coords = {
        "time": t, "element": np.arange(Z), "pocket": np.arange(Z), "face": ["pocket"],
        "constraint": ["axial_force", "moment_y", "moment_z", "drive_torque"],
    }  # fmt: skip
    store = RunStore.create(
        None, coords=coords,
        variables=names, n_time=n, block=n, attrs={"family": "ball", "element": "ball"},
    )  # fmt: skip
    a = {v: np.zeros(store.layout.shape(VARIABLES[v])) for v in names}
    cage = (1.0 - SLIP) * orbit
    a["inner_speed"][:] = SPEED
    a["cage_quaternion"][:, 0] = np.cos(0.5 * cage * t)
    a["cage_quaternion"][:, 1] = np.sin(0.5 * cage * t)
    a["cage_omega"][:, 0] = cage
    a["element_omega"][:, :, 0] = cage - spin
    a["race_force"][:, ::2], a["race_force"][:, 1::2, 1] = 20.0, 3.0
    a["contact_angle"][:, :, 0], a["contact_angle"][:, :, 1] = INNER, OUTER
    a["contact_angle"][:, : Z // 2] *= -1.0
    a["contact_angle"][:, 1::2] = 9.0  # of balls that bear nothing
    store.write_block(0, a)
    return store.dataset()


def test_slip_counts_from_rolling_at_the_angles_of_loaded_balls(run):
    own = at_own_angles(run, NUMBERS)
    assert own.angles == pytest.approx((INNER, OUTER), rel=1e-12)
    speed = cage_speed(run, NUMBERS)
    orbit, _ = by_hand()
    assert speed.epicyclic == pytest.approx(orbit, rel=1e-12)
    assert speed.slip_ratio == pytest.approx(SLIP, rel=1e-6)
    nominal = 0.5 * SPEED * (1.0 - NUMBERS.element_diameter * np.cos(NUMBERS.contact_angle) / PITCH)
    assert speed.nominal == pytest.approx(nominal, rel=1e-12)
    assert speed.nominal_slip == pytest.approx(1.0 - speed.mean / nominal, rel=1e-9)
    assert np.abs(element_slip_ratio(run, NUMBERS)).max() < 1e-12
    assert np.abs(ball_slip.slip_ratio(run, NUMBERS, nominal=True)).min() > 1e-3


def test_the_summary_names_both_references(run):
    s = summarise(SettledRun(run, NUMBERS, settle=0.0))
    note = s.row("epicyclic_speed").note
    assert note == "pure rolling at the mean contact angles, 24.1 deg inner, 12.6 deg outer"
    assert s["cage_slip_ratio"] == pytest.approx(SLIP, rel=1e-5)
    assert s["slip_loaded"] == pytest.approx(0.0, abs=1e-12)
    for key in ("epicyclic_speed_nominal", "cage_slip_ratio_nominal", "slip_loaded_nominal"):
        assert s.row(key).note == "by the nominal contact angle, 15 deg"
    assert s["epicyclic_speed_nominal"] != pytest.approx(s["epicyclic_speed"], rel=1e-3)


def test_balls_without_load_and_without_angles_have_the_nominal_one(run):
    free = run.copy(deep=True)
    free["race_force"][:] = 0.0
    assert at_own_angles(free, NUMBERS) == NUMBERS
    assert rolling_by_curvature(free, NUMBERS) is None
    s = summarise(SettledRun(free, NUMBERS, settle=0.0))
    assert s["epicyclic_speed"] == s["epicyclic_speed_nominal"]
    assert s.row("epicyclic_speed").note == ""


def test_lines_stand_where_balls_of_these_angles_pass(run):
    orbit, spin = by_hand()
    lines = run_frequencies(run, NUMBERS)
    assert lines["FTF"] == pytest.approx(orbit / (2 * np.pi))
    assert lines["BSF"] == pytest.approx(spin / (2 * np.pi))
    assert lines["BPFO"] == pytest.approx(Z * orbit / (2 * np.pi))
    assert lines["BPFI"] == pytest.approx(Z * (SPEED - orbit) / (2 * np.pi))
    nominal = run_frequencies(run, NUMBERS, own=False)
    assert nominal["BPFO"] == pytest.approx(515.0728, abs=1e-3)


def test_curvature_of_contacts_makes_slip_of_balls_that_roll(run):
    """A strip at the ellipse's end lies a^2/(2 R) above the middle; a fifth of it, on average."""
    found = rolling_by_curvature(run, NUMBERS)
    share = []
    for contact, radius in zip(BEARING.contacts, (5.000625e-3, 5.000625e-3)):
        a = contact.semi_axes(20.0)[0]
        fit = 2.0 / (2.0 / D + 1.0 / radius)
        share.append(0.2 * a**2 / (2.0 * fit) / (0.5 * D))
    inner, outer = share
    assert found.ball_slip == pytest.approx(-0.5 * (inner + outer), rel=0.2)
    _, spin = by_hand()
    assert found.sliding == pytest.approx(
        (spin * 0.5 * D * inner, spin * 0.5 * D * outer), rel=5e-3
    )


def test_a_slip_that_curvature_makes_is_not_laid_to_the_traction_curve(run):
    limits = SlipRange(rise=0.3)
    assert "traction curve's slope" in limits.note(0.01, (0.2, 0.1), (0.02, 0.01))
    assert "balls roll" in limits.note(-0.003, (0.03, 0.02), (0.02, 0.01))
    assert "traction curve's slope" in limits.note(-0.003, (0.03, 0.02))
    assert "creep speed" in SlipRange(creep=0.1).note(-0.003, (0.03, 0.02), (0.02, 0.01))
    slow = (
        summarise(SettledRun(run, NUMBERS, settle=0.0, slip_range=limits)).row("slip_loaded").note
    )
    assert slow.startswith("balls roll: the grooves' curvature alone")
    flat = replace(NUMBERS, rolling_heights=(0.0, 0.0))
    told = summarise(SettledRun(run, flat, settle=0.0, slip_range=limits)).row("slip_loaded").note
    assert "traction curve's slope" in told


def test_the_spectra_say_at_which_angles_lines_stand(run, tmp_path, monkeypatch):
    from matplotlib.text import Text

    from flexcage.render import sheet, spectra_picture

    texts: list[str] = []

    def save(figure, path):
        texts.extend(text.get_text() for text in figure.findobj(Text))
        return path

    monkeypatch.setattr(sheet, "save", save)
    monkeypatch.setattr("flexcage.render.spectra.SIGNALS", {"cage_speed": _CAGE_SPEED})
    spectra_picture(run, tmp_path / "spectra.png", bearing=NUMBERS)
    orbit, _ = by_hand()
    assert f"BPFO\n{Z * orbit / (2 * np.pi):,.1f} Hz" in texts
    facts = next(text for text in texts if "mean contact angles" in text)
    assert "at mean contact angles of 24.1° and 12.6°; at the nominal 15°" in facts
    assert "BPFO 515.1 Hz" in facts
