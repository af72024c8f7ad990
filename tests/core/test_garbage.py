"""Python's search for unused objects pauses while a program loads, and leaves that out."""

import gc
import subprocess
import sys

import pytest

from flexcage.core.garbage import few_collections

_CODE = """
import gc
from flexcage.core.garbage import while_loading
with while_loading():
    assert not gc.isenabled()
assert gc.isenabled() and gc.get_freeze_count() > 0
with while_loading():
    assert gc.isenabled()  # once in a process
"""
_RUN = """
import gc, sys
from flexcage.cli import main
assert main(["run", *sys.argv[1:]]) == 2
assert gc.isenabled() and gc.get_freeze_count() > 0
"""


def test_the_search_pauses_once_while_a_program_loads():
    subprocess.run([sys.executable, "-c", _CODE], check=True)


def test_a_run_loads_without_it(tmp_path):
    """A run that ends early, on a mesh file that is not there."""
    case = tmp_path / "case.toml"
    case.write_text(
        '[bearing]\npreset = "N1013"\n[mesh]\nfile = "none.msh"\n[solver]\nduration = "1 s"\n'
    )
    arguments = [str(case), "-o", str(tmp_path / "run")]
    subprocess.run([sys.executable, "-c", _RUN, *arguments], check=True)


def test_what_is_old_is_not_collected_while_pictures_are_drawn():
    before, usual = gc.get_freeze_count(), gc.get_threshold()
    with pytest.raises(KeyError), few_collections():
        assert gc.get_freeze_count() > before
        raise KeyError
    assert gc.get_freeze_count() <= before
    assert gc.get_threshold() == usual
