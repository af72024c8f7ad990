"""Runs of shafts from files of reduced bodies, beside that of the beams that they were made of."""

from __future__ import annotations

import numpy as np
import pytest
from reduced_shafts import beam_body, beams, reduced, rotor, shaft_of

from flexcage import load_machine
from flexcage.core.errors import InputError
from flexcage.machine_run import load_machine_run, simulate_machine

ELEMENTS = 30


def ran(shaft, **more):
    return simulate_machine(load_machine(rotor(shaft)), stress=False, **more)


@pytest.fixture(scope="module")
def beam():
    return ran(beams(ELEMENTS))


@pytest.mark.parametrize(
    ("modes", "given", "within"),
    [
        (None, True, 2e-6),
        pytest.param(None, False, 1e-4, marks=pytest.mark.slow),
        pytest.param(40, True, 1e-3, marks=pytest.mark.slow),
    ],
)
def test_a_body_s_run_is_that_of_its_beams(beam, tmp_path, modes, given, within):
    """Displacements at the same places, and forces, over 1 ms: of the whole matrices, with lumped
    polar inertia, and of a reduction; beside the largest changes of each."""
    body = beam_body(ELEMENTS, gyroscopic=given)
    found = ran(shaft_of(body if modes is None else reduced(body, modes), tmp_path))
    assert found.shaft.sizes["mode_number"] == beam.shaft.sizes["mode_number"] > 0
    for name in ("displacement", "force"):
        ours, theirs = (run.shaft[name].transpose("time", ...).values for run in (found, beam))
        changed = np.ptp(theirs, axis=0)[..., :3].max()
        apart = np.abs(ours - theirs)[..., :3].max()
        assert apart < within * changed, (name, apart / changed)
    assert found.summary.missed < 1e-3


@pytest.mark.slow
def test_a_body_s_run_is_read_without_its_file_and_goes_on_with_no_other(tmp_path):
    file, out = tmp_path / "shaft.npz", tmp_path / "run"
    shaft = shaft_of(reduced(beam_body(ELEMENTS), 10), tmp_path)
    run = ran(shaft, out=out)
    file.unlink()
    again = load_machine_run(out)
    np.testing.assert_array_equal(again.shaft["force"].values, run.shaft["force"].values)
    assert again.summary.bearings["front"].radial == run.summary.bearings["front"].radial
    shaft_of(reduced(beam_body(ELEMENTS), 12), tmp_path)
    with pytest.raises(InputError, match=r"the file of shaft.body, '.*shaft.npz', has changed"):
        ran(shaft, out=out, resume=True)
