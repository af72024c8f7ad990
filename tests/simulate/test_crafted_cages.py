"""A cage.zip of other sizes than the run's is refused and named before a kernel reads it."""

import shutil
from pathlib import Path

import numpy as np
import pytest
from simulate_cases import Interrupted, bent, n1013

from flexcage.case import load_case
from flexcage.case.catalogue import find
from flexcage.case.new import new_case
from flexcage.cli import main
from flexcage.core.errors import InputError
from flexcage.core.timing import Stages
from flexcage.results.cage_file import CageRecord, cage_file, read_cage, write_cage
from flexcage.run.cage_sizes import check_sizes
from flexcage.run.storing import _cage_file
from flexcage.simulate import load_run, simulate
from flexcage.stages import made_cage

BLOCK = 10 / 50e3  # [s]
CASE = n1013({"solver.duration": "0.8 ms", "output.block": 10}, defects=bent("0.1 mm"))
POCKETS = 22


@pytest.fixture(scope="module")
def stopped(tmp_path_factory):
    out = tmp_path_factory.mktemp("stopped") / "run"
    with pytest.raises(KeyboardInterrupt):
        simulate(CASE, out=out, progress=Interrupted(2, BLOCK))
    return out


@pytest.fixture
def run(stopped, tmp_path):
    return Path(shutil.copytree(stopped, tmp_path / "run"))


def resized(array: np.ndarray, old: int, new: int) -> np.ndarray:
    for axis, size in enumerate(array.shape):
        if size == old:
            array = np.take(array, np.arange(new) % old, axis=axis)
    return array


def crafted(run: Path, group: str, what: str, new: int) -> int:
    """Rewrite the cage with sizes of a group changed, and seals, checksums and names that fit;
    the size that it had."""
    record = read_cage(run / "cage.zip")
    old = {
        "modes": len(record.groups["basis"]["step"]), "pockets": POCKETS,
        "points": len(record.groups["mesh"]["points"]),
    }[what]  # fmt: skip
    changed = {name: resized(array, old, new) for name, array in record.groups[group].items()}
    groups = {**record.groups, group: changed}
    write_cage(run / "cage.zip", cage_file(CageRecord(groups, record.digest)))
    return old


CHANGES = {
    "a smaller body": ("body", "modes", 20, "body.C has the shape (3, 20), not (3, {})"),
    "a larger body": ("body", "modes", 90, "body.C has the shape (3, 90), not (3, {})"),
    "a smaller basis": ("basis", "modes", 40, "3, 40), not (11726, 3, {})"),
    "fewer pockets": (
        "interface",
        "pockets",
        10,
        "interface.offset has the shape (10, 4, 65), not",
    ),
    "fewer modes at stations": ("interface", "modes", 9, "3, 9), not (22, 4, 7, 3, {})"),
    "a longer table": ("table", "modes", 60, "table.frequency has the shape (60,), not ({},)"),
    "fewer points": ("mesh", "points", 1900, "corners that are not there"),
}


@pytest.mark.parametrize("name", CHANGES)
def test_a_cage_of_other_sizes_is_named(run, capsys, name):
    *change, words = CHANGES[name]
    words = words.format(crafted(run, *change))
    assert main(["run", str(run / "case.toml"), "-o", str(run), "--resume", "--no-images"]) == 2
    said = [line for line in capsys.readouterr().err.splitlines() if "warning:" not in line]
    assert len(said) == 1 and words in said[0] and str(run / "cage.zip") in said[0]
    with pytest.raises(InputError, match=r"cage\.zip"):
        load_run(run)


def test_missing_and_added_arrays_are_named(run):
    record = read_cage(run / "cage.zip")
    body = {k: v for k, v in record.groups["body"].items() if k != "SS"}
    more = {**record.groups["interface"], "of_mine": np.zeros(3)}
    for group, arrays, words in (("body", body, "no body.SS"), ("interface", more, "of_mine")):
        groups = {**record.groups, group: arrays}
        write_cage(run / "cage.zip", cage_file(CageRecord(groups, record.digest)))
        with pytest.raises(InputError, match=words):
            simulate(CASE, out=run, resume=True)


def test_its_own_cage_goes_on(run):
    assert simulate(CASE, out=run, resume=True).store.complete


COARSE = {"mesh.fineness": "coarse"}
VARIANTS = {
    "linear": {"mesh.order": 1},
    "rigid": {"cage.model": "rigid"},
    "not kept": {"output.keep_cage": False},
    "free": {"modes.kind": "free_free"},
    "Craig-Bampton": {"modes.kind": "craig_bampton"},
}


def cases():
    for name, changes in VARIANTS.items():
        yield name, CASE.replace({**COARSE, **changes})
    for designation, cage in (("6205", "ribbon"), ("6205", "crown"), ("7205B", "machined")):
        text = new_case(find(designation).outline, "catalogue", cage=cage).text
        yield cage, load_case(text, overrides=COARSE)
    bent_claw = {"type": "bent_claw", "pocket": 1, "claw": "front", "deflection": "0.05 mm"}
    text = new_case(find("6205").outline, "catalogue", cage="crown").text
    yield "bent claw", load_case(text, overrides=COARSE).replace("defects", [bent_claw])


@pytest.mark.slow
def test_cages_of_all_kinds_have_the_sizes_that_are_asked_for(tmp_path):
    for name, case in cases():
        made = made_cage(case, Stages())
        path = write_cage(tmp_path / f"{name}.zip", _cage_file(case, *made))
        check_sizes(read_cage(path), case, made[1].basis.size if made[1] else 0, path)
