"""What a drive's torque counts and what not, against formulas written here; why a cage is slower
than its loaded rollers: what ``flexcage/results/README.md`` says of both."""

from __future__ import annotations

from math import pi

import friction_models
import numpy as np
import pytest
from friction_models import Size

from flexcage import load_case, simulate
from flexcage.cli import main

VISCOSITY, DENSITY = 0.01, 860.0  # the default lubricant [Pa s, kg/m^3]
PRESSURE = 20e-9  # its pressure coefficient [1/Pa]
MODULUS = 206e9 / (1.0 - 0.3**2)  # E' = 2/sum((1 - nu^2)/E) of steel on steel [Pa]
RPM = pi / 30.0
SPEED = 3000.0  # rpm


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Runs of designations at 3000 rpm with a rigid cage, by designation, load and duration."""
    folder = tmp_path_factory.mktemp("torque")

    def run(designation, load, duration, **changes):
        path = folder / f"{designation}.toml"
        assert main(["new", designation, "-o", str(path), "--force"]) == 0
        case = load_case(path).replace(**{
            "drive.speed": f"{SPEED} rpm", "load.radial": load, "solver.duration": duration,
            "cage.model": "rigid", **changes,
        })  # fmt: skip
        return simulate(case, stress=False)

    return run


def torques(run, begin=0.3):
    """Torque [N mm] on the inner ring that every channel takes, after a share of the run."""
    ds = run.dataset
    first = int(begin * ds.sizes["time"])
    turned = float(ds["inner_angle"][-1] - ds["inner_angle"][first])
    work = ds["work"].isel(time=-1) - ds["work"].isel(time=first)
    return {c: -1e3 * float(work.sel(channel=c)) / turned for c in ds["channel"].values}


def skf(size, rolling, sliding, *, kz, smooth):
    """Rolling and sliding moment [N mm] of SKF's model at SPEED, in the default oil."""
    nu = 1e6 * VISCOSITY / DENSITY
    return friction_models.skf(size, rolling, sliding, n=SPEED, nu=nu, kz=kz, smooth=smooth)


def elements(run):
    """Race forces (time, element, race) [N] of the settled part, and the mean speeds [rad/s] at
    which inner and outer race pass the contacts."""
    ds = run.dataset.isel(time=slice(int(0.3 * run.dataset.sizes["time"]), None))
    cage = float(ds["cage_omega"][:, 0].mean())
    return ds["race_force"].values, (SPEED * RPM - cage, cage)


def test_torque_of_an_n208(made):
    """Rolling resistance is nearly all of it, as in SKF's model."""
    run = made("N208", "3 kN", "40 ms")
    counted, (Q, passing) = torques(run), elements(run)
    radius, length = 5.5e-3, run.case.bearing.effective_length
    expected = 0.0
    for race, ring, sign in ((0, 24.75e-3, 1.0), (1, 35.75e-3, -1.0)):
        R, u = radius * ring / (ring + sign * radius), passing[race] * ring
        q = np.maximum(Q[..., race], 1e-9)
        thick = 4.318 / PRESSURE * (PRESSURE * VISCOSITY * u / R) ** 0.658
        thick *= (q / (MODULUS * R * length)) ** 0.0126 * R * length  # Goksem and Hargreaves
        thin = 2.0796 * np.sqrt(VISCOSITY * u * q * length)  # Martin
        force = (thick**-4 + thin**-4) ** -0.25 * (Q[..., race] > 0.0)
        expected += 2e3 * u * force.sum(axis=1).mean() / (SPEED * RPM)
    assert counted["rolling_resistance"] == pytest.approx(expected, rel=0.02)
    rolling, sliding = skf(
        Size(40.0, 80.0), 1.09e-6 * 60.0**2.41 * 3000.0**0.31, 0.0015 * 60.0 * 3000.0, kz=5.1,
        smooth=0.02,
    )  # fmt: skip
    assert (rolling, sliding) == (pytest.approx(124.0, rel=0.01), pytest.approx(6.2, rel=0.02))
    assert counted["rolling_resistance"] == pytest.approx(0.94 * rolling, rel=0.04)
    assert -counted["drive"] == pytest.approx(0.95 * (rolling + sliding), rel=0.04)


@pytest.fixture(scope="module")
def deep_groove(made):
    return made("6206", "1500 N", "12 ms")


def ellipse(side):
    """(effective radius along the rolling direction [m], ratio of axes) of a 6206's contact by
    Hamrock and Brewe's approximations; side 1 inner, -1 outer."""
    ball, gamma = 0.5 * 9.525e-3, 9.525 / 46.0
    along = ball * (1.0 - side * gamma)
    across = (0.515 if side > 0 else 0.525) * 2.0 * ball
    across = 1.0 / (1.0 / ball - 1.0 / across)
    return along, across / along


def test_torque_of_a_6206(deep_groove):
    """Rolling resistance is Houpert's force, half of SKF's rolling moment; sliding on the curved
    contact is counted, at the small coefficient that the traction curve has at its slow sliding."""
    counted, (Q, passing) = torques(deep_groove), elements(deep_groove)
    expected = hysteresis = 0.0
    for race, side in ((0, 1.0), (1, -1.0)):
        R, ratio = ellipse(side)
        kappa = ratio ** (2.0 / pi)
        q, u = Q[..., race], passing[race] * 0.5 * (46.0 - side * 9.525) * 1e-3
        force = 2.86 * MODULUS * R**2 * kappa**0.348 * (PRESSURE * MODULUS) ** 0.022
        force *= (VISCOSITY * u / (MODULUS * R)) ** 0.66 * (q / (MODULUS * R**2)) ** 0.47
        expected += 2e3 * u * force.sum(axis=1).mean() / (SPEED * RPM)
        both = 1.0 + (pi / 2.0 - 1.0) / ratio  # the elliptic integral of the second kind
        mean = R * ratio / (1.0 + ratio)
        width = (6.0 * both * q * mean / (pi * kappa * MODULUS)) ** (1.0 / 3.0)
        lost = 0.01 * 3.0 / 16.0 * width * q  # N m, of 1 % loss (Johnson, Contact Mechanics 9.4)
        hysteresis += 1e3 * (lost.sum(axis=1) * u / (0.5 * 9.525e-3)).mean() / (SPEED * RPM)
    assert counted["rolling_resistance"] == pytest.approx(expected, rel=0.03)
    rolling, sliding = skf(
        Size(30.0, 62.0), 3.9e-7 * 46.0**1.96 * 1500.0**0.54,
        3.23e-3 * 46.0**-0.26 * 1500.0 ** (5.0 / 3.0), kz=3.1, smooth=0.05,
    )  # fmt: skip
    assert (rolling, sliding) == (pytest.approx(18.5, rel=0.01), pytest.approx(12.8, rel=0.01))
    assert counted["rolling_resistance"] == pytest.approx(0.49 * rolling, rel=0.05)
    assert counted["race_friction"] == pytest.approx(0.27 * sliding, rel=0.1)
    assert -counted["drive"] == pytest.approx(0.41 * (rolling + sliding), rel=0.05)
    assert hysteresis == pytest.approx(2.1, rel=0.05)  # which no channel has
    assert "hysteresis" in deep_groove.summary_at_end.row("drive_torque").note


def test_sliding_of_a_6206_with_the_coefficient_of_skfs_model(made):
    """So its path is there, Heathcote's sliding: what is small is the traction curve's rise."""
    friction = {"law": "step_coulomb", "static": 0.05, "dynamic": 0.05}
    friction |= {"v_static": "1 mm/s", "v_dynamic": "2 mm/s"}
    changes = {f"contacts.race.friction.{key}": value for key, value in friction.items()}
    counted = torques(made("6206", "1500 N", "12 ms", **changes))
    assert counted["race_friction"] == pytest.approx(0.82 * 12.8, rel=0.1)


def test_a_cage_slower_than_its_loaded_rollers(made):
    """By what it lies off the axis over the pitch radius: the clearance at its land decides.

    The cage pushes unloaded rollers against their rolling resistance, by its rear walls, and is
    pushed by rollers that leave the loaded zone, by their front walls; both press it aside.
    """
    slips = {}
    for bore, clearance in (("54.8 mm", 0.25e-3), ("54.4 mm", 0.05e-3)):
        run = made("N208", "3 kN", "80 ms", **{"cage.bore": bore})
        summary, slips[bore] = run.summary_at_end, run.summary_at_end["cage_slip_ratio"]
        ds = run.dataset.isel(time=slice(int(0.3 * run.dataset.sizes["time"]), None))
        aside = float(np.hypot(*ds["cage_position"].values[:, 1:].mean(axis=0)))
        assert 0.8 * clearance < aside < 1.15 * clearance
        assert summary["slip_loaded"] == pytest.approx(1e-3, abs=3e-4)
        assert 0.5 < (slips[bore] - 1e-3) / (aside / 30.25e-3) < 2.2
        azimuth = np.angle(np.exp(1j * ds["element_position"].values[..., 2]))  # load at 0
        push = ds["station_force"].values[..., 2].sum(axis=3)  # on the cage, by pocket and face
        front, rear = push[..., 0].sum(axis=1).mean(), push[..., 1].sum(axis=1).mean()
        assert front > 1.5 and rear == pytest.approx(-front, rel=0.1)
        leaving = (azimuth > 0.0) & (azimuth < 0.5 * pi)
        assert (push[..., 0] * leaving).sum(axis=1).mean() > 0.9 * front
        unloaded = np.abs(azimuth) > 0.4 * pi
        assert (push[..., 1] * unloaded).sum(axis=1).mean() < 0.5 * rear
    assert slips["54.8 mm"] > 0.006 and slips["54.4 mm"] < 0.7 * slips["54.8 mm"]
