"""Runs whose rings and cage are held or moved by further constraints, from text to results."""

from __future__ import annotations

import numpy as np
import pytest
from simulate_cases import Interrupted, n1013

from flexcage import cli
from flexcage.case import load_case
from flexcage.core.errors import InputError, RunFailed
from flexcage.results import metrics
from flexcage.results.audit import energy_audit
from flexcage.simulate import simulate
from flexcage.study.outputs import check_outputs
from flexcage.system import constraints
from flexcage.system.layout import CONSTRAINTS
from flexcage.system.spec import CageSpeed, InnerPath

RPM = np.pi / 30
RIGID = {"cage.model": "rigid"}
GEARED = [
    {"type": "cage_speed", "speed": "100 rpm", "ratio": 0.44},
    {"type": "inner_path", "radius": "2 um", "speed": "9000 rpm", "phase": "90 deg"},
]
NAMES = ("cage_speed", "inner_path_y", "inner_path_z")


@pytest.fixture(scope="module")
def geared(tmp_path_factory):
    case = n1013(constraints=GEARED)
    return simulate(case, out=tmp_path_factory.mktemp("geared") / "run")


def test_a_flexible_cage_in_gear_with_a_ring_on_its_path(geared):
    ds = geared.dataset
    assert tuple(ds["constraint"].values) == (*CONSTRAINTS, *NAMES)
    speed = (100.0 + 0.44 * 6000.0) * RPM
    np.testing.assert_allclose(ds["cage_omega"].sel(axis="x"), speed, rtol=1e-9)
    at = 9000.0 * RPM * ds["time"].values + 0.5 * np.pi
    path = 2e-6 * np.stack([np.cos(at), np.sin(at)], axis=1)
    np.testing.assert_allclose(ds["inner_position"].values[:, 1:], path, atol=1e-12)
    assert energy_audit(ds).passed
    work = {k: float(ds["work"].sel(channel=k)[-1]) for k in ("drive", "constraints")}
    assert work["drive"] > 0.0 and work["constraints"] != 0.0
    # what holds the ring bears the load, but for what little a ring inside its clearance presses
    held = ds["multiplier"].sel(constraint=["inner_path_y", "inner_path_z"]).values
    units = ["N", "N m", "N m", "N m", "N m", "N", "N"]
    assert list(ds["multiplier"]["multiplier_unit"].values) == units
    assert geared.summary["constraint_inner_path_y"] == pytest.approx(-1000.0, abs=60.0)
    assert next(r for r in geared.summary if r.key == "constraint_cage_speed").shown == "N mm"
    assert np.abs(held.mean(axis=0) - [-1000.0, 0.0]).max() < 60.0


def test_a_case_of_objects_is_that_of_text(geared):
    case = n1013().replace(
        "constraints",
        (CageSpeed(speed=100.0 * RPM, ratio=0.44),
         InnerPath(radius=2e-6, speed=9000.0 * RPM, phase=0.5 * np.pi)),
    )  # fmt: skip
    assert case.hash == geared.case.hash != n1013().hash
    assert load_case(case.to_toml()) == case
    other = case.replace("constraints.0.ratio", 0.45)
    assert other.constraints[0].ratio == 0.45 and other.hash != case.hash


@pytest.mark.parametrize("method", ["bdf", "explicit"])
def test_a_resumed_run_is_the_unbroken_one(tmp_path, method):
    case = n1013(RIGID, {"solver.method": method, "output.block": 25}, constraints=GEARED)
    whole = simulate(case, out=tmp_path / "whole").dataset
    with pytest.raises(KeyboardInterrupt):
        simulate(case, out=tmp_path / "run", progress=Interrupted(2, 0.5e-3))
    again = simulate(case, out=tmp_path / "run", resume=True).dataset
    for name in ("cage_position", "inner_position", "multiplier", "work"):
        np.testing.assert_array_equal(again[name].values, whole[name].values)


@pytest.mark.parametrize("method", ["bdf", "explicit"])
def test_a_held_cage_that_is_pushed_stays(method):
    more = {"start.push": "5 mm/s", "solver.method": method, "solver.duration": "0.5 ms"}
    ds = simulate(n1013(RIGID, more, constraints=[{"type": "cage_centre", "y": "10 um"}])).dataset
    assert np.abs(ds["cage_position"].values[:, 1:] - [10e-6, 0.0]).max() < 1e-11
    assert np.abs(ds["cage_velocity"].values[:, 1:]).max() < 1e-8


UNBALANCED = {"unbalance": "0.3 g*mm", "unbalance_offset": "8 mm"}


@pytest.mark.parametrize("constraint", ["cage_centre", "cage_tilt"])
def test_a_ball_bearing_whose_cage_is_held(constraint):
    """Its centre or its axis stays, while an unbalance off its middle moves the other."""
    case = load_case(
        {"bearing": {"preset": "7010C-PI"}, "cage": UNBALANCED, "mesh": {"fineness": "coarse"},
         "drive": {"speed": "4000 rpm"}, "load": {"axial": "100 N"},
         "solver": {"duration": "2 ms"}, "constraints": [{"type": constraint}]},
        overrides=RIGID,
    )  # fmt: skip
    ds = simulate(case).dataset
    place, tilt = ds["cage_position"].values[:, 1:], metrics.tilt(ds).sel(component="total").values
    stays, other = (place, tilt) if constraint == "cage_centre" else (tilt, place)
    assert np.abs(stays).max() < 1e-12 < 1e-9 < np.abs(other).max()
    assert np.abs(ds["multiplier"].values[:, 4:]).max() > 0.0 and energy_audit(ds).passed


@pytest.mark.parametrize(
    "asked, more, words",
    [
        ([{"type": "cage_sped"}], {}, "constraints.0.type 'cage_sped' is not known; the nearest"),
        ([{"ratio": 0.4}], {}, r"\[constraints.0\] lacks 'type' .*; choose from cage_centre, cage"),
        ([{"type": "cage_speed", "radius": "1 um"}], {}, "Unknown key 'radius'"),
        ([{"type": "inner_path", "radius": "-1 um"}], {}, "constraints.0.radius is -1 um"),
        (GEARED + GEARED[:1], {}, r"constraints.2 \(cage_speed\) is on what another constraint"),
        (GEARED[1:], {"load.centre": "held", "solver.method": "explicit"},
         r"constraints.0 \(inner_path\) is on what drive, load or mount hold"),
    ],
)  # fmt: skip
def test_impossible_constraints(asked, more, words):
    with pytest.raises(InputError, match=words):
        simulate(n1013(RIGID, more, constraints=asked))


@pytest.fixture
def kinds():
    """Tables of kinds, left as they were."""
    tables = constraints.KINDS, constraints.specs.CONSTRAINTS
    saved = [dict(table) for table in tables]
    yield
    for table, before in zip(tables, saved):
        table.clear()
        table.update(before)


def circle(t, y, at, p, G, g, h):
    """(y - p1)^2 + z^2 = p0, of the cage's centre: no slope in the middle."""
    q, u, b = at.cage_q + 1, at.cage_u + 1, at.cage_b + 1
    right, up = y[q] - p[1], y[q + 1]
    g[0] = right * right + up * up - p[0]
    G[0, b], G[0, b + 1] = 2.0 * right, 2.0 * up
    h[0] = G[0, b] * y[u] + G[0, b + 1] * y[u + 1]


def test_a_constraint_that_cannot_be_met(kinds):
    constraints.register_constraint(
        "nowhere", circle, level="position", parameters=lambda s: (-1.0, 1.0)
    )
    with pytest.raises(RunFailed, match="moved onto the constraint 'nowhere'; can it be met"):
        simulate(n1013(RIGID, constraints=[{"type": "nowhere"}]))


def test_a_start_leaves_a_place_without_slopes(kinds):
    constraints.register_constraint(
        "orbit", circle, level="position", parameters=lambda s: (4e-10, 0.0)
    )
    more = {"solver.duration": "0.5 ms"}
    ds = simulate(n1013(RIGID, more, constraints=[{"type": "orbit"}])).dataset
    radius = np.linalg.norm(ds["cage_position"].values[:, 1:], axis=1)
    np.testing.assert_allclose(radius, 20e-6, rtol=1e-8)


def test_a_place_at_which_contacts_are_pressed_beyond_measure():
    for constraint, words in (
        ({"type": "cage_centre", "y": "500 um"}, "and its pocket press each other with"),
        ({"type": "inner_path", "y": "400 um"}, "and a race press each other with"),
    ):
        with pytest.raises(InputError, match=words) as caught:
            simulate(n1013(RIGID, constraints=[constraint]))
        assert "limits.assembly_force (20,000 N)" in str(caught.value)


def test_what_a_constraint_drives_is_a_drive():
    """The inner ring stands; the cage is turned, and takes the rollers along."""
    held = [{"type": "cage_speed", "speed": "500 rpm"}]
    ds = simulate(n1013(RIGID, {"drive.speed": "0 rpm"}, constraints=held)).dataset
    audit = energy_audit(ds)
    assert audit.channels["constraints"] > 1e-3 > abs(audit.channels["drive"])
    assert audit.passed and audit.of_drive < 1e-3


def test_outputs_of_studies_name_constraints_that_every_case_has():
    name = "multiplier[constraint=cage_speed].mean"
    study = {"sizes": {}, "flexible": False, "family": "cylindrical_roller"}
    check_outputs((name,), **study, reactions=(*CONSTRAINTS, "cage_speed"))
    with pytest.raises(InputError, match="there is no constraint 'cage_speed'; choose from"):
        check_outputs((name,), **study)


def test_the_command_line_takes_them_apart(tmp_path, capsys):
    text = n1013(RIGID, constraints=GEARED).to_toml()
    (tmp_path / "case.toml").write_text(text, encoding="utf-8")
    wrong = ["--set", "constraints.0.speed=100"]
    assert cli.main(["run", str(tmp_path / "case.toml"), "-o", str(tmp_path / "r"), *wrong]) == 2
    assert "constraints.0.speed is 100 without a unit" in capsys.readouterr().err
