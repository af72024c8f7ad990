"""Energy audit of runs with losses: what is stored against what came in and went out."""

import numpy as np
import pytest
from verification_bearing import log, n1013

from flexcage.results.audit import imbalance
from flexcage.simulate import simulate

SHORT = {"solver.duration": "5 ms", "output.rate": "100 kHz", "output.vibration_rate": "200 kHz"}
TIGHT = {"solver.tolerance": "0.0001 um", "solver.max_step": "5 us"}
CAGE_SIDE = ("pocket_damping", "pocket_friction", "modal_damping", "land")


def audited(*tables) -> tuple[float, float]:
    """Worst imbalance of a default run over the drive's work, and over the cage's losses."""
    ds = simulate(n1013(SHORT, *tables)).dataset
    gap = float(np.abs(imbalance(ds)).max())
    drive = float(np.abs(ds["work"].sel(channel="drive")).max())
    lost = -float(ds["work"].sel(channel=list(CAGE_SIDE))[-1].sum())
    assert drive > 0.1 and lost > 1e-4 and float(ds["pocket_force"].max()) > 5.0
    log.info("%s: imbalance %.2e J, drive %.3f J, cage side loses %.2e J", tables, gap, drive, lost)
    return gap / drive, gap / lost


def test_audit_of_a_default_run():
    over_drive, over_cage = audited()
    assert over_drive < 2e-3  # 5e-4 measured
    assert over_cage < 0.05


@pytest.mark.slow
def test_audit_tightens_with_the_tolerance():
    over_drive, over_cage = audited(TIGHT)
    assert over_drive < 4e-5
    assert over_cage < 1e-3
