"""Assumptions are what nobody gave, what something reads, in words that fit the bearing."""

from __future__ import annotations

import pytest

from flexcage.case import Case, description, load_case
from flexcage.geometry.materials import MATERIALS

N1013 = '[bearing]\npreset = "N1013"\n'


def test_a_value_that_the_user_gives_is_none_even_if_it_is_the_default():
    assert "cage.fillet_radius" in load_case(N1013).assumptions
    given = load_case(N1013 + '[cage]\nfillet_radius = "0.5 mm"\n[modes]\ndamping = 0.01\n')
    assert given == load_case(N1013).replace("modes.damping", 0.01)
    assert "cage.fillet_radius" not in given.assumptions
    assert "modes.damping" not in given.assumptions
    assert "cage.pocket_width" in given.assumptions
    changed = load_case(N1013).replace({"lubricant.density": "860 kg/m^3"})
    assert changed == load_case(N1013) and "lubricant.density" not in changed.assumptions
    pocket = load_case(N1013).replace("contacts.pocket.friction", {"static": 0.1})
    assert "contacts.pocket.friction.static" not in pocket.assumptions
    assert "contacts.pocket.friction.dynamic" in pocket.assumptions


def test_a_complete_case_file_still_knows_what_was_given():
    case = load_case(N1013 + '[cage]\nfillet_radius = "0.5 mm"\n')
    again = load_case(case.to_toml())
    assert again == case and again.hash == case.hash
    assert again.assumptions == case.assumptions != {}


def test_a_case_of_objects_assumes_what_is_as_by_default():
    case = load_case(N1013)
    assert "modes.damping" in Case(bearing=case.bearing, cage=case.cage).assumptions


@pytest.mark.parametrize("preset", ["7010C-PI", "7010C-PA66", "7603025", "15x37x10"])
def test_ball_bearings_assume_nothing_of_ribs_side_beams_and_lands(preset):
    told = load_case(f'[bearing]\npreset = "{preset}"\n').assumptions
    assert "contacts.race.normal.restitution" in told
    for place in ("rib", "side", "land"):
        assert not any(path.startswith(f"contacts.{place}.") for path in told)
    for word in ("N1013", " rib", "side beam", "the paper'", "the papers"):
        own = {p: w for p, w in told.items() if p.startswith(("contacts", "lubricant", "modes"))}
        assert not any(word in why for why in own.values()), word


def test_a_rigid_cage_assumes_nothing_of_modes():
    rigid = load_case(N1013 + '[cage]\nmodel = "rigid"\n').assumptions
    assert "modes.damping" not in rigid and "contacts.land.width" in rigid


def test_values_that_follow_are_shown_as_numbers():
    shown = description.assumed(load_case(N1013))
    assert shown["contacts.land.width"][0] == "3.5 mm"
    assert shown["modes.damping"][0] == "0.01"


def test_damping_follows_the_cages_material():
    def ratio(material: str) -> float:
        case = load_case(N1013).replace("cage.material", material)
        return case.modes.damped_as(case.cage.material).damping

    assert ratio("brass") == ratio("steel") == 0.01
    for name in ("PA66", "PEEK", "polyimide"):
        material = MATERIALS[name]
        assert material.loss_factor == pytest.approx(0.04e9 / material.youngs_modulus, rel=0.03)
        assert ratio(name) == pytest.approx(0.01 + 0.5 * material.loss_factor)
    own = load_case(N1013).replace({"cage.material": "PA66", "modes.damping": 0.03})
    assert own.modes.damped_as(own.cage.material).damping == 0.03
    brass = load_case(N1013)
    assert brass.hash == brass.replace("modes.damping", 0.01).hash
