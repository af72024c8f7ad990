"""The chapter's data files: read whole, or refused with one sentence that names the remedy."""

from importlib import resources

import numpy as np
import pytest

from flexcage import cli
from flexcage.core.errors import EnvironmentLacks
from flexcage.verification import data_files
from flexcage.verification.data_files import stored_arrays

FOLDER = resources.files("flexcage.verification") / "data"
NAMES = [entry.name for entry in FOLDER.iterdir() if entry.name.endswith(".npz")]


@pytest.fixture()
def elsewhere(tmp_path, monkeypatch):
    """An empty folder in the place of the installed one."""
    monkeypatch.setattr(data_files.resources, "files", lambda _: tmp_path)
    folder = tmp_path / "data"
    folder.mkdir()
    return folder


@pytest.mark.parametrize("name", NAMES)
def test_every_file_is_read_whole(name):
    arrays = stored_arrays(name)
    assert arrays and all(np.isfinite(a).all() for a in arrays.values())


def test_a_missing_file_is_one_sentence_in_the_table(elsewhere, capsys):
    assert cli.main(["verify", "flexible_body"]) == 1
    (line,) = (x for x in capsys.readouterr().out.splitlines() if "Reinstall" in x)
    assert f"'{elsewhere / 'free_body.npz'}' is missing. Reinstall flexcage" in line
    assert "Error" not in line and line.endswith("FAIL")


@pytest.mark.parametrize("keep", [0.0, 0.001, 0.5, 0.999])
def test_a_file_cut_short_says_so(elsewhere, keep):
    whole = (FOLDER / "free_body.npz").read_bytes()
    (elsewhere / "free_body.npz").write_bytes(whole[: int(keep * len(whole))])
    with pytest.raises(EnvironmentLacks, match="cannot be read.*Reinstall flexcage"):
        stored_arrays("free_body.npz")


def test_a_file_with_other_bytes_in_the_middle_says_so(elsewhere):
    whole = bytearray((FOLDER / "free_body.npz").read_bytes())
    middle = len(whole) // 2
    whole[middle : middle + 64] = bytes(64)
    (elsewhere / "free_body.npz").write_bytes(whole)
    with pytest.raises(EnvironmentLacks, match="cannot be read.*Reinstall flexcage"):
        stored_arrays("free_body.npz")
