"""A defect from outside: one class, and a cage has it in mesh, contact, pictures and words."""

from __future__ import annotations

import dataclasses
import importlib
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

from flexcage import register
from flexcage.cages.build import build_cage_mesh, rigid_interface_of
from flexcage.cages.window import CAGE_TYPE as WINDOW
from flexcage.cages.window.cage import ROLLER_CAGES, WindowCage
from flexcage.cages.window.defects import SideBeamDefect
from flexcage.cages.window.faces import pocket_size
from flexcage.case import Case
from flexcage.case.description import in_words
from flexcage.core import registry
from flexcage.core.errors import InputError
from flexcage.core.wings import CAGE_TYPES
from flexcage.geometry import defect as defects
from flexcage.register import option
from flexcage.render.mesh_pictures import mesh_picture

HERE = Path(__file__).parent
DENT = {"type": "dent", "pocket": 3, "depth": "0.2 mm"}
CASE = """
[bearing]
preset = "N1013"
[mesh]
fineness = "coarse"
[[defects]]
type = "dent"
pocket = 3
depth = "0.2 mm"
"""

OF_WINDOWS = "whose defects are 'crossbeam', 'side_beam', 'broken_crossbeam', 'dent'"


@pytest.fixture
def mine(monkeypatch):
    """The user's module, imported as any other; other tests do not see what it registers."""
    monkeypatch.setattr(defects.DEFECTS, "_added", {})
    monkeypatch.setattr(defects, "_ADDED", {})
    monkeypatch.setattr(registry, "_sources", {})
    monkeypatch.syspath_prepend(HERE)
    yield importlib.import_module("my_defect")
    del sys.modules["my_defect"]


def dented(*more, preset="N1013"):
    sections = {"mesh": {"fineness": "coarse"}, "defects": [DENT, *more]}
    return Case.from_table({"bearing": {"preset": preset}, **sections})


def test_the_mesh_has_it_and_contacts_feel_it(mine):
    case = dented({"type": "side_beam", "pocket": 3, "side": "-x", "displacement": "0.1 mm"})
    mesh = build_cage_mesh(**case.cage_shape)
    (dent, beam) = mesh.info["defects"]
    assert (dent["kind"], beam["kind"]) == ("dent", "side_beam")
    assert dent["asked"] == -0.2e-3 and dent["delivered"] == pytest.approx(-0.2e-3, abs=1e-9)
    assert mesh.info["altered_sectors"] == (3,)
    size = pocket_size(mesh, 3, pitch_radius=0.5 * case.bearing.pitch_diameter)
    assert size == pytest.approx([case.cage.pocket_width, case.cage.pocket_length - 0.1e-3])
    made = rigid_interface_of(case.cage, pocket_count=22, defects=case.defects[:1])
    shape = np.clip(1.0 - (2.0 * made.offset_at[2] / case.cage.pocket_width) ** 2, 0.0, 1.0) ** 2
    assert made.offset[3, 2] == pytest.approx(-0.2e-3 * shape, abs=1e-12)
    assert np.count_nonzero(np.abs(made.offset).max(axis=2) > 1e-12) == 1  # no other face


def test_what_a_shipped_defect_says_of_faces_follows_from_what_it_moves():
    """For whoever writes ``displace`` alone: the same as the side beam's own sentence."""
    case = Case.from_preset("N1013")
    beam = SideBeamDefect(pocket=7, side="-x", displacement=0.1e-3)
    points = rigid_interface_of(case.cage, pocket_count=22).offset_at
    told = beam.offsets(points, case.cage, pocket_count=22)
    followed = super(SideBeamDefect, beam).offsets(points, case.cage, pocket_count=22)
    np.testing.assert_allclose(followed, told, atol=1e-12)


def test_pictures_words_tables_and_hashes_have_it(mine, tmp_path, monkeypatch):
    case = dented()
    assert "pocket 3 has a dent of 0.2 mm." in in_words(case)[0]
    assert case.defects == (mine.Dent(pocket=3, depth=0.2e-3),)
    assert case.to_table()["defects"] == [DENT]
    assert Case.from_table(case.to_table()) == case
    deeper = case.replace("defects.0.depth", "0.3 mm")
    bent = {"defects.0.type": "side_beam", "defects.0.displacement": "0.1 mm"}
    other = case.replace({**bent, "defects.0.pocket": 1})
    assert other.defects == (SideBeamDefect(pocket=1, displacement=0.1e-3),)
    assert len({case.hash, deeper.hash, other.hash}) == 3
    before = case.hash
    edited = Path(shutil.copy(mine.__file__, tmp_path / "edited.py"))
    edited.write_text(edited.read_text() + "\n# another depth\n")
    monkeypatch.setitem(registry._sources, "dent", "")
    monkeypatch.setattr(mine, "__file__", str(edited))
    registry.note_source("dent", mine.Dent)
    assert dented().hash != before  # what it moves may be another now
    mesh = build_cage_mesh(**case.cage_shape)
    assert mesh_picture(mesh, tmp_path / "mesh.png", defects=case.defects).stat().st_size > 1e4


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"pocket": 22}, "defects.0.pocket is 22, but the cage's pockets are numbered 0 to 21"),
        ({"depth": "3 mm"}, "defects.0.depth is 3 mm, more than half of the side beam's"),
        ({"depth": "0 mm"}, "must be greater than 0 mm"),
        ({"deptj": "1 mm"}, "Unknown key 'deptj' in .*; the nearest known one is 'depth'"),
    ],
)
def test_its_mistakes_are_said_like_all_others(mine, change, words):
    with pytest.raises(InputError, match=words):
        Case.from_table({"bearing": {"preset": "N1013"}, "defects": [{**DENT, **change}]})


def test_another_cage_has_none_and_says_which_it_has(mine):
    with pytest.raises(InputError, match="'dent', .*machined cages, .*'displaced', 'crack'"):
        dented(preset="7010C-PI")
    crack = {"type": "crack", "web": 1, "share": 0.2}
    with pytest.raises(InputError, match=OF_WINDOWS):
        dented(crack)


def test_a_cage_type_of_ones_own_lists_its_own(mine, monkeypatch):
    """Also one that it shares with others; a name that another defect has is refused."""
    monkeypatch.setattr(CAGE_TYPES, "_members", dict(CAGE_TYPES))

    @dataclass(frozen=True, kw_only=True)
    class Slim(WindowCage):
        cage_type: ClassVar[str] = "slim"
        type: str = option("slim", choices=ROLLER_CAGES)

    @dataclass(frozen=True, kw_only=True)
    class Notch(mine.Dent):
        type: str = defects.defect_type("notch")

    taken = dataclasses.make_dataclass(
        "Taken", [("type", str, defects.defect_type("dent"))], bases=(Notch,), frozen=True
    )
    slim = dataclasses.replace(WINDOW, name="slim", spec=Slim, defects=(Notch, SideBeamDefect))
    with pytest.raises(InputError, match="kind of defect 'dent' exists already"):
        register.cage_type(dataclasses.replace(slim, defects=(taken,)))
    register.cage_type(slim)
    assert registry.source_of("notch") and not registry.source_of("side_beam")
    table = {"bearing": {"preset": "N1013"}, "cage": {"type": "slim"}}
    case = Case.from_table({**table, "defects": [{**DENT, "type": "notch"}]})
    assert case.defects == (Notch(pocket=3, depth=0.2e-3),)
    with pytest.raises(InputError, match="one of the slim cages, .* 'notch', 'side_beam'"):
        Case.from_table({**table, "defects": [DENT]})
    with pytest.raises(InputError, match=OF_WINDOWS):
        dented({**DENT, "type": "notch"})


def test_what_is_no_defect_of_such_a_cage_is_not_added(mine):
    named = dataclasses.field(default="chip")
    chip = dataclasses.make_dataclass(
        "Chip", [("type", str, named)], bases=(defects.CageDefect,), frozen=True, kw_only=True
    )
    for kind, cages, words in (
        (chip, ("window",), "Chip is no WindowDefect"),
        (mine.Dent, ("windw",), "no cage type 'windw'; the nearest known one is 'window'"),
        (mine.Dent, ("window",), "kind of defect 'dent' exists already"),
        (dict, ("window",), "no class derived from CageDefect"),
    ):
        with pytest.raises(InputError, match=words):
            register.cage_defect(kind, cages=cages)


def test_the_command_line_takes_it(tmp_path):
    """In a process of its own."""
    (tmp_path / "case.toml").write_text(CASE)

    def flexcage(*argv):
        command = [sys.executable, "-m", "flexcage.cli", *argv]
        return subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)

    use = ["--use", str(HERE / "my_defect.py")]
    done = flexcage("mesh", "case.toml", *use, "--set", "defects.0.depth=0.1 mm")
    assert done.returncode == 0, done.stderr
    assert "dent" in done.stdout and "-0.1 mm" in done.stdout.replace("-0.1000", "-0.1")
    done = flexcage("keys", "defects", *use)
    assert 'type = "dent"' in done.stdout and "depth" in done.stdout
    done = flexcage("mesh", "case.toml")
    assert done.returncode == 2
    assert "defects.0.type 'dent' is not known; " in done.stderr and "--use FILE" in done.stderr
