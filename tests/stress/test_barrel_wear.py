"""Wear of the pockets of barrels: what friction took in a run, in both rows alike."""

from __future__ import annotations

from pathlib import Path

import pytest

import flexcage
from flexcage.case import load_case
from flexcage.stress.wear_laws import WearLaw

CASE = Path(__file__).parents[2] / "examples" / "22208_run.toml"
LAW = WearLaw(material="brass", coefficient=2e-15)


@pytest.mark.slow
def test_sliding_of_barrels_explains_the_work_of_friction():
    """Recorded forces times speeds of rigid bodies are the work that friction took; of bars alone,
    as an end counts with the mean speed of its points."""
    fine = {
        "solver.duration": "12 ms", "solver.tolerance": "0.001 um", "output.rate": "200 kHz",
        "load.misalignment": "0 mrad", "contacts.side.friction.law": "none",
    }  # fmt: skip
    found = flexcage.simulate(load_case(CASE, overrides=fine), stress=False).wear(LAW)
    assert found.friction_check == pytest.approx(1.0, abs=0.02)
    rate = found.dataset["volume_rate"].sum("face").values
    first, second = rate[:16].sum(), rate[16:].sum()
    assert first > 0.0 and second == pytest.approx(first, rel=0.5)
