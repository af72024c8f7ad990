"""Keys that are given and not read are named; every key that is claimed unread changes nothing, and
every other one changes what a run is made of."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

import flexcage
from flexcage import stages
from flexcage.bearings.cylindrical_roller.start import geometric_guess, rolling_velocities
from flexcage.case.read import names_machine
from flexcage.case.unread import not_used, reasons
from flexcage.cli import main
from flexcage.core.binding import flat
from flexcage.core.errors import InputError
from flexcage.core.units import split
from flexcage.core.unread import why_unread
from flexcage.system.spec import Mount

FILES = [p for p in sorted(Path("examples").glob("*.toml")) if "study" not in p.name]
MACHINES = [p.stem for p in FILES if names_machine(p)]
EXAMPLES = [p.name for p in FILES if p.stem not in MACHINES]
# what is read elsewhere than in the model of the moving bearing: by cage's mesh and modes, by the
# start, the integrator, the store, or by people
ELSEWHERE = (
    "name", "description", "preset", "given", "static", "seed", "mesh", "modes", "start", "solver",
    "output", "limits", "defects", "cage.model", "bearing.designation", "lubricant.name",
    "bearing.preset", "constraints", "cage.material.density", "cage.thickness",
    "cage.rivet_diameter", "cage.claw_thickness", "cage.bar_height",
)  # fmt: skip


def fingerprint(value):
    """Everything in nested records of arrays, as bytes."""
    if isinstance(value, np.ndarray):
        return value.tobytes()
    if isinstance(value, (tuple, list)):
        return b"|".join(fingerprint(v) for v in value)
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return b"|".join(fingerprint(getattr(value, f.name)) for f in dataclasses.fields(value))
    return repr(value).encode()


def made_of(case):
    """What a run of a case is made of, apart from its cage's mesh and the choice of laws."""
    laws = [getattr(case.contacts, p) for p in ("race", "pocket", "side", "rib", "land")]
    names = [(p.normal.law, p.friction.law) for p in laws]
    return fingerprint(stages.bearing_to_compile(case).data.model), names


def others(value):
    """Values near a text of a case, and other ones."""
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, (int, float)):
        return [value * 1.0007, value + 1, value - 1]
    parts = split(value) if isinstance(value, str) else None
    if parts is None:
        return []
    number, unit = parts
    near = [float(number) * f for f in (1.0007, 0.9993, 0.9)] if number else [0.01, 1e-3, 1.0]
    return [f"{n!r} {unit}" for n in near]


def varied(case, path, value):
    for other in others(value):
        try:
            yield case.replace({path: other}, si=False)
        except InputError:
            continue


def rows(case):
    table = dict(flat(case.to_table()))
    return {k: v for k, v in table.items() if not k.startswith(ELSEWHERE)}


GIVEN_IN_VAIN = [
    ("c7010", {"contacts.side.friction.static": 0.2}, "contacts.side.friction.static (an angular "
     "contact ball bearing has no such contact)"),
    ("c7010", {"contacts.rib.slices": 8}, "contacts.rib.slices (an angular contact ball bearing "
     "has no such contact)"),
    ("6205_crown", {"contacts.land.width": 1e-3}, "contacts.land.width (the cage meets no land: "
     "cage.guidance is 'ball')"),
    ("n1013", {"mount.stiffness": 1e8}, "mount.stiffness (mount.kind is 'fixed')"),
    ("n1013", {"bearing.outer_spall.depth": 2e-5}, "bearing.outer_spall.depth "
     "(bearing.outer_spall.length is not given)"),
    ("n1013", {"outer_ring.foundation": 1e13}, "outer_ring.foundation (outer_ring.ring is "
     "'rigid')"),
    ("n1013", {"contacts.race.friction.static": 0.2}, "contacts.race.friction.static "
     "(contacts.race.friction.law is 'traction')"),
    ("n1013", {"bearing.material.proof_stress": 1e9}, "bearing.material.proof_stress (no strength "
     "of rings and rolling elements is computed)"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "changes", "said"), GIVEN_IN_VAIN)
def test_a_key_given_in_vain_is_named_with_the_reason(name, changes, said):
    case = flexcage.load_case(f"examples/{name}.toml").replace(changes)
    assert list(not_used(case)) == [f"Given, but not used: {said}."]


AT_REST = [
    ("c7010_static", {"contacts.rib.friction.law": "step_coulomb"},
     "contacts.rib.friction.law (an angular contact ball bearing has no such contact)"),
    ("c7010_static", {"load.direction": "20 deg"}, "load.direction (there is no radial load)"),
    ("nu210", {"bearing.material.loss_factor": 0.1}, "bearing.material.loss_factor (rings and "
     "rolling elements have no modal damping)"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "changes", "said"), AT_REST)
def test_a_static_solution_says_it_too(name, changes, said):
    """Once, only what moves said so; the sentence stands in the table and in the JSON."""
    case = flexcage.load_static(f"examples/{name}.toml", overrides=changes)
    solution = flexcage.solve_static(case)
    assert list(not_used(case)) == [text := f"Given, but not used: {said}."]
    assert text in solution.warnings
    again = flexcage.load_static(case.to_toml())  # as it lies in the folder
    assert list(not_used(again)) == [text] and again == case


@pytest.mark.parametrize("name", MACHINES)
def test_examples_give_a_machine_no_key_in_vain(name):
    """Nor a value that is questioned, and no critical speed is near."""
    solution = flexcage.solve_machine(flexcage.load_machine(f"examples/{name}.toml"))
    assert not solution.warnings


@pytest.mark.parametrize("name", [name.removesuffix(".toml") for name in EXAMPLES])
def test_examples_give_a_static_solution_no_key_in_vain(name):
    assert list(not_used(flexcage.load_static(f"examples/{name}.toml"))) == []


def test_what_only_a_run_reads_is_no_mistake_of_a_static_solution():
    changed = flexcage.load_case("examples/n1013.toml").replace(
        {"mount.kind": "bushing", "mount.stiffness": 1e8, "contacts.pocket.slices": 12}
    )
    still = flexcage.load_static(changed.to_toml())
    assert list(not_used(still)) == []


@pytest.mark.parametrize("command", ["mesh", "modes", "export"])
def test_commands_that_simulate_nothing_say_it_once(command, tmp_path, monkeypatch, capsys):
    """With an output that is refused, so that nothing is computed."""
    example = str(Path("examples/n1013.toml").resolve())
    monkeypatch.chdir(tmp_path)
    argv = [command, example, "--set", "mount.stiffness=1 N/m", "-o", "wrong.xyz"]
    assert main(argv) == 2
    said = capsys.readouterr().err
    assert said.count("mount.stiffness (mount.kind is 'fixed')") == 1, said


def test_a_case_that_is_compared_with_a_rigid_cage_keeps_its_modes_in_silence():
    case = flexcage.load_case("examples/n1013.toml").replace("modes.count", 12)
    assert not list(not_used(case.replace("cage.model", "rigid")))


def test_a_section_given_as_a_spec_gives_only_what_differs_from_defaults():
    case = flexcage.load_case("examples/n1013.toml")
    assert not list(not_used(case.replace("mount", Mount(kind="bushing"))))
    case = case.replace("mount", Mount(kind="bushing", clearance=2e-5))
    assert "mount.clearance (mount.kind is 'bushing')" in next(not_used(case))


@pytest.mark.parametrize("name", EXAMPLES)
def test_examples_give_no_key_in_vain(name):
    try:
        case = flexcage.load_case(f"examples/{name}")
    except InputError:  # a static case
        return
    assert list(not_used(case)) == []


def squeezed(case):
    """Forces of a bearing whose bodies are all a little out of place: contacts of every kind."""
    bearing = stages.bearing_to_compile(case)
    model, layout = bearing.data.model, bearing.layout
    if case.bearing.element == "ball":
        start = stages.assembled_start(case, bearing)
        y, yd = start.y, start.yd
    else:
        y = geometric_guess(model, layout)
        yd = rolling_velocities(model, layout, y)
    rng = np.random.default_rng(1)
    return [
        bearing.residual(1e-3, y + size * rng.standard_normal(len(y)), yd).copy()
        for size in (5e-6, 1e-4)
    ]


@pytest.mark.parametrize("name", ["n1013", "nu210", "c7010", "6205_crown", "ribbon"])
def test_a_key_without_effect_is_called_unused(name):
    case = flexcage.load_case(f"examples/{name}.toml").replace("cage.model", "rigid")
    why, whole = reasons(case), made_of(case)
    missing = set()
    for path, value in rows(case).items():
        made = [made_of(other) for other in varied(case, path, value)]
        if made and all(m == whole for m in made) and not why_unread(path, why):
            missing.add(path)
    assert missing == set()


@pytest.mark.slow
@pytest.mark.parametrize("name", ["n1013", "c7010"])
def test_a_key_that_is_called_unused_has_no_effect(name):
    case = flexcage.load_case(f"examples/{name}.toml").replace("cage.model", "rigid")
    why, forces, tried = reasons(case), squeezed(case), 0
    for path, value in rows(case).items():
        if why_unread(path, why):
            for other in varied(case, path, value):
                tried += 1
                assert all(map(np.array_equal, squeezed(other), forces)), path
                break
    assert tried > 20
