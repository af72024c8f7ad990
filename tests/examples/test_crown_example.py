"""The example with a crown cage: its claws open as far as half a sector of its own model says."""

from pathlib import Path

import numpy as np
import pytest

from flexcage.case import load_case
from flexcage.simulate import simulate

CASE = Path(__file__).parents[2] / "examples" / "6205_crown.toml"
# m at rad/s: ``linearised`` of tests/verification/crown_coning.py, of this material
OPENED, AT = 0.10826e-3, 1662.6


def test_the_claws_of_the_example_open_outwards():
    """At the first sample, before balls push the cage: every tip, and by the same."""
    short = {"solver.duration": "0.05 ms", "mesh.fineness": "coarse"}
    run = simulate(load_case(CASE, overrides=short), stress=False)
    moved, model = run.stress(time=0.0).displacement, run.recovery.model
    tips = np.unique(model.group("end+x"))
    out = model.nodes[tips] * (0.0, 1.0, 1.0)
    grown = np.sum(moved[tips] * out, axis=1) / np.linalg.norm(out, axis=1)
    opened = OPENED * (run.dataset["cage_omega"].values[0, 0] / AT) ** 2
    assert opened > 0.11e-3 and grown.max() == pytest.approx(opened, rel=0.01)
    assert grown.min() > 0.97 * opened
    assert "large_rotation" not in {w.key for w in run.warnings}
