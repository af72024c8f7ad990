"""Shapes packed sector by sector come back as they were, from a fraction of the bytes."""

from dataclasses import replace

import numpy as np
import pytest

from flexcage.case import load_case
from flexcage.core.timing import Stages
from flexcage.results import repeating
from flexcage.results.cage_file import cage_file, cage_record, read_cage, write_cage
from flexcage.stages import made_cage

COARSE = {"mesh.fineness": "coarse", "cage.model": "flexible"}
CAGES = {
    "sound": ("N1013", []),
    "bent": ("N1013", [{"type": "crossbeam", "crossbeam": 0, "displacement": "0.2 mm"}]),
    "cracked": ("7010C-PI", [{"type": "crack", "web": 0, "side": "+x", "share": 0.5}]),
}


@pytest.fixture(params=[("sound", 1), ("bent", 1), ("bent", 2), ("cracked", 2)], ids=str)
def record(request):
    (preset, defects), order = CAGES[request.param[0]], request.param[1]
    table = {"bearing": {"preset": preset}, "defects": defects}
    case = load_case(table, overrides={**COARSE, "mesh.order": order})
    mesh, reduction = made_cage(case, Stages())
    return cage_record(mesh, reduction.record())


def test_shapes_come_back_bit_by_bit(record, tmp_path):
    found = read_cage(write_cage(tmp_path / "cage.zip", cage_file(record))).groups["basis"]
    assert set(found) == set(record.groups["basis"])
    np.testing.assert_array_equal(found["steps"], record.groups["basis"]["steps"])
    assert found["steps"].dtype == np.int32 and found["steps"].flags.c_contiguous


def test_little_is_left_beyond_one_sector(record):
    """Two to five bits a number of 24 in window cages; a crack, which lets more waves run round
    the ring than few modes hold, leaves half."""
    packed = repeating.pack(record.groups["basis"], record.mesh)
    bits = np.log2(1.0 + packed["left"])
    cracked = "doubled" in record.mesh.info
    assert 19.0 < bits[..., packed["nodes"][0]].mean()
    assert bits.mean() < (14.0 if cracked else 5.0)


def test_sums_are_exact_in_whatever_order_they_are_added(record):
    """So that every processor predicts the same steps."""
    steps = record.groups["basis"]["steps"]
    packed = repeating.pack(record.groups["basis"], record.mesh)
    first = steps[packed["nodes"][0]].reshape(-1, steps.shape[2])
    half = 2 ** repeating._bits(steps.shape[2])
    for part in np.divmod(packed["mix"], half):
        assert np.abs(part).max() <= half
        for matrix in part:
            in_floats = first.astype(float) @ matrix.astype(float)
            np.testing.assert_array_equal(in_floats, first.astype(np.int64) @ matrix)
            most = np.abs(first.astype(np.int64)) @ np.abs(matrix)
            assert most.max() < 2**53


def test_a_mesh_that_does_not_repeat_keeps_its_shapes_as_they_are(record):
    mesh = replace(record.mesh, info={})
    assert repeating.pack(record.groups["basis"], mesh) is record.groups["basis"]
