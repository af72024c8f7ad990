"""Marks of kernels on disk: what is left to be compiled, and what a run says of it."""

import numba
import pytest

from flexcage import compiling
from flexcage.case import load_case
from flexcage.core import kernel_cache, kernel_marks, users_files
from flexcage.core.kernel_files import KernelFolder

pytestmark = pytest.mark.skipif(numba.config.DISABLE_JIT, reason="needs compiled kernels")
CASE = '[bearing]\npreset = "N1013"\n[drive]\nspeed = "6000 rpm"\n[load]\nradial = "1000 N"\n'
FIRST, FEW = "for the first time: up to half a minute", "that are new: a few seconds"


@pytest.fixture
def folder(monkeypatch, tmp_path):
    """An empty cache, and no files of a user's."""
    monkeypatch.setattr(kernel_marks, "kernel_folder", KernelFolder(tmp_path / "kernels"))
    monkeypatch.setattr(users_files, "_contents", {})
    return tmp_path


def test_an_edited_law_leaves_flexcages_own_kernels(folder, monkeypatch):
    case = load_case(CASE)
    law = folder / "law.py"
    law.write_text("stiffness = 1.0\n")
    users_files.remember([law])
    used = {"flexcage.contacts.laws:short_bearing", "law:force"}
    monkeypatch.setattr(kernel_cache, "used", used)
    what = compiling.kernels_of(case)
    assert FIRST in compiling._what_is_compiled(case)
    kernel_marks.mark_compiled(what)
    assert kernel_marks.kernels_cached(what) and kernel_marks.own_kernels_cached(what)
    law.write_text("stiffness = 2.0\n")
    users_files.remember([law])
    assert not kernel_marks.kernels_cached(what)
    assert FEW in compiling._what_is_compiled(case)
    assert not kernel_marks.own_kernels_cached(f"{what}-uncaged")
