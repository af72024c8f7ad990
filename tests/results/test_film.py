"""The lubricant's film: of a static solution and of runs, against rolling by hand."""

from __future__ import annotations

import json

import numpy as np
import pytest

import flexcage
from flexcage.case import load_static
from flexcage.simulate import simulate
from flexcage.verification.runs import NO_OIL, c7010, n1013

STATIC = """
[bearing]
preset = "7010C-PI"
[lubricant]
viscosity = "0.02 Pa*s"
[drive]
speed = "4000 rpm"
[load]
axial = "100 N"
"""


def by_hand(contact, load, speed, *, viscosity, alpha):
    """Hamrock and Dowson's central film [m], with every number written out."""
    U = viscosity * speed / (contact.modulus * contact.rolling)
    W = load / (contact.modulus * contact.rolling**2)
    H = 2.69 * U**0.67 * (alpha * contact.modulus) ** 0.53 * W**-0.067
    return contact.rolling * H * (1.0 - 0.61 * np.exp(-0.73 * contact.ratio))


def test_film_of_a_static_solution():
    case = load_static(STATIC)
    s = flexcage.solve_static(case)
    orbit = s.elements.orbital_speed[0]
    for k, side in enumerate((-1.0, 1.0)):
        angle = s.elements.angle[0, k]
        surface = 0.5 * (65e-3 + side * 9.525e-3 * np.cos(angle))
        speed = abs((case.speed if k == 0 else 0.0) - orbit) * surface
        expected = by_hand(case.bearing.contacts[k], s.elements.force[0, k], speed,
                           viscosity=0.02, alpha=2e-8)  # fmt: skip
        assert s.film.central[0, k] == pytest.approx(expected, rel=1e-9)
    assert (s.film.least < s.film.central).all() and s.film.least.min() > 0.1e-6
    assert f"{1e6 * s.film.least[0, 0]:.4g}" in s.table() and "h inner, um" in s.table()
    assert json.loads(s.to_json())["film"]["least"][0][0] == pytest.approx(s.film.least[0, 0])


def test_no_film_at_rest_nor_where_nothing_touches():
    standing = flexcage.solve_static(load_static(STATIC, overrides={"drive.speed": "0 rpm"}))
    assert (standing.film.least == 0.0).all() and "h inner" not in standing.table()
    roller = '[bearing]\npreset = "N1013"\n[load]\nradial = "1 kN"\n[drive]\nspeed = "6000 rpm"\n'
    s = flexcage.solve_static(load_static(roller))
    apart = s.elements.force[:, 0] == 0.0
    assert apart.any() and np.isnan(s.film.least[apart, 0]).all()
    assert np.isfinite(s.film.least[~apart]).all()


def test_film_of_a_run_of_balls_is_that_of_rolling_balls():
    """A spin of some per cent of the roll does not entrain; slip is a ten thousandth."""
    friction = {"contacts.race.friction.law": "traction", "drive.speed": "4000 rpm"}
    run = simulate(c7010(NO_OIL, friction, {"solver.duration": "3 ms"}))
    ds, film = run.dataset.isel(time=-1), run.film_thickness.isel(time=-1)
    assert film.dims == ("element", "race", "film") and film.attrs["units"] == "m"
    orbit = float(
        (ds["element_velocity"].sel(cyl="psi") / ds["element_position"].sel(cyl="r")).mean()
    )
    radius, case = float(ds["element_position"].sel(cyl="r").mean()), run.case
    for k, (race, side) in enumerate((("inner", -1.0), ("outer", 1.0))):
        angle, force = (float(ds[n].sel(race=race).mean()) for n in
                        ("contact_angle", "race_force"))  # fmt: skip
        surface = radius + side * 0.5 * 9.525e-3 * np.cos(angle)
        speed = abs((case.drive.speed if k == 0 else 0.0) - orbit) * surface
        expected = by_hand(case.bearing.contacts[k], force, speed,
                           viscosity=case.lubricant.viscosity, alpha=2e-8)  # fmt: skip
        found = float(film.sel(race=race, film="central").mean())
        assert found == pytest.approx(expected, rel=1e-3)
    assert 0.1e-6 < run.summary["film_least_inner"] < run.summary["film_inner"] < 2e-6
    assert run.summary["film_inner"] == pytest.approx(found, rel=0.2)


def test_film_of_a_run_of_rollers():
    """Under load they roll; elsewhere there is no film at the inner race."""
    run = simulate(n1013({"solver.duration": "1 ms", "cage.model": "rigid"}))
    film, force = run.film_thickness.isel(time=-1), run.dataset["race_force"].isel(time=-1)
    touching = (force > 0.0).values
    assert np.isfinite(film.values[touching]).all() and np.isnan(film.values[~touching]).all()
    static = flexcage.solve_static(run.case).film.least
    loaded = (force.sel(race="inner") > 50.0).values
    found = film.sel(race="inner", film="least").values[loaded]
    assert found.min() == pytest.approx(np.nanmin(static[:, 0]), rel=0.05)
