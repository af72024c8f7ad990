"""Every constant of every body's material changes what it should, in statics and in what a run
computes with, and nothing else; those that nothing reads are named."""

from __future__ import annotations

import numpy as np
import pytest

import flexcage
from flexcage import solve_static, stages
from flexcage.case.unread import not_used

CASES = {
    name: flexcage.load_case(f"examples/{name}.toml").replace("cage.model", "rigid")
    for name in ("n1013", "nu210", "c7010")
}
#: Parts of a model that know the elastic constants of rings and elements, and of the cage.
ELASTIC = {
    "n1013": {"inner", "outer", "rib", "neighbours", "pocket", "land"},
    "nu210": {"inner", "outer", "outer_rib", "neighbours", "pocket", "land"},
    "c7010": {"inner", "outer", "neighbours", "pocket", "land"},
}
FACTOR = {"youngs_modulus": 1.5, "poisson_ratio": 0.8, "density": 1.3}


def changed(case, path):
    return case.replace({path: FACTOR[path.rpartition(".")[2]] * value_at(case, path)})


def value_at(case, path):
    for key in path.split("."):
        case = getattr(case, key)
    return case


def laws(case):
    """Parameters of the normal law of every contact place that has any."""
    model = stages.bearing_to_compile(case).data.model
    places = {name: getattr(part, "normal", None) for name, part in model._asdict().items()}
    return {k: np.array(v) for k, v in places.items() if v is not None}, model


@pytest.mark.parametrize("constant", FACTOR)
@pytest.mark.parametrize("body", ["bearing", "cage"])
@pytest.mark.parametrize("name", CASES)
def test_a_constant_changes_the_laws_and_masses_that_it_should(name, body, constant):
    case = CASES[name]
    (before, heavy), (after, light) = laws(case), laws(changed(case, f"{body}.material.{constant}"))
    moved = {k for k in before if not np.array_equal(before[k], after[k])}
    elastic = ELASTIC[name] if body == "bearing" else {"pocket", "land"}
    if constant == "density":
        assert moved == set()
        ratio = 1.3 if body == "bearing" else 1.0
        masses = [
            np.array([m.bodies.element[0], m.inner_ring.inertia[0], m.outer_ring.inertia[0]])
            for m in (heavy, light)
        ]
        assert masses[1] / masses[0] == pytest.approx(ratio)
    else:
        assert elastic <= moved <= elastic | {"rib", "outer_rib"}


@pytest.mark.parametrize("name", ["n1013", "nu210"])
def test_rollers_on_races_are_as_stiff_as_both_materials_make_them(name):
    (before, _), (after, _) = (
        laws(CASES[name]),
        laws(CASES[name].replace("bearing.material.youngs_modulus", 310e9)),
    )
    for race in ("inner", "outer"):
        assert after[race][0] / before[race][0] == pytest.approx(310.0 / 206.0, rel=1e-12)


@pytest.mark.parametrize("name", CASES)
def test_statics_follow_the_moduli_of_rings_and_elements(name):
    """What contacts yield goes with E^-0.9 (lines) or E^-2/3 (points) at a given load; what is
    left of the displacement is clearance."""
    case = CASES[name]
    soft, stiff = (
        solve_static(case.replace("bearing.material.youngs_modulus", e)) for e in (206e9, 412e9)
    )
    assert np.linalg.norm(stiff.displacement[:3]) < 0.97 * np.linalg.norm(soft.displacement[:3])
    assert stiff.largest_pressure > 1.2 * soft.largest_pressure
    thin, thick = np.nanmax(stiff.film.central), np.nanmax(soft.film.central)
    assert thin != pytest.approx(thick, rel=1e-3)
    heavy = solve_static(changed(case, "bearing.material.density"))
    assert heavy.elements.centrifugal.max() == pytest.approx(
        1.3 * solve_static(case).elements.centrifugal.max(), rel=1e-2
    )


def test_bearing_steel_is_as_it_was_to_the_bit():
    """35948 Lwe^(8/9) 2^(10/9) N/mm^(10/9), ISO/TS 16281, over the slices."""
    case = CASES["n1013"]
    whole = 35948.0 * (case.bearing.effective_length * 1e3) ** (8.0 / 9.0) * 2.0 ** (10.0 / 9.0)
    whole *= 1e3 ** (10.0 / 9.0)
    (law, _) = laws(case)
    assert law["inner"][0] == whole / case.contacts.race.slices


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("constant", ["proof_stress", "loss_factor"])
def test_constants_that_nothing_reads_are_named(name, constant):
    case = CASES[name].replace(f"bearing.material.{constant}", 0.5)
    assert f"bearing.material.{constant} (" in next(not_used(case))
