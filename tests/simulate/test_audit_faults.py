"""A force that is no slope of an energy: the audit says so, whatever the steps."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from simulate_cases import n1013

import flexcage
from flexcage.contacts import laws
from flexcage.contacts.spec import NORMAL_LAWS as SPECS
from flexcage.core.errors import InputError
from flexcage.results.audit import EXCEEDED, OF_DRIVE, PASSED, energy_audit

# without rolling resistance, which takes 97 % of what the drive does and would hide it
RIGID = {
    "cage.model": "rigid", "solver.duration": "2 ms", "lubricant.rolling_resistance": "none",
}  # fmt: skip
FAULTY = "stronger_on_the_way_in"


def stronger_on_the_way_in(n, d, v, onset, p, F, Fe, Fd, Fv):
    """Called elastic, and up to a fifth stronger while the surfaces near than while they part: each
    contact takes energy that nothing accounts for."""
    for k in range(n):
        depth = max(d[k], 0.0)
        K = p[0] * (1.0 + 0.2 * v[k] / (abs(v[k]) + 0.01))
        F[k] = Fe[k] = K * depth ** p[1]
        Fd[k] = K * p[1] * depth ** (p[1] - 1.0)
        Fv[k] = p[0] * 0.2 * 0.01 / (abs(v[k]) + 0.01) ** 2 * depth ** p[1]


@pytest.fixture(scope="module")
def faulty() -> Iterator[str]:
    laws.register_normal(FAULTY, stronger_on_the_way_in)
    yield FAULTY
    for table in (laws.NORMAL_LAWS, laws.NORMAL_PARAMETERS, SPECS):
        table.pop(FAULTY, None)


def audited(law: str, place: str, **changes):
    run = flexcage.simulate(n1013(RIGID, {f"contacts.{place}.normal.law": law}, changes),
                            stress=False)  # fmt: skip
    return energy_audit(run.dataset)


def test_such_a_law_is_refused_before_a_run(faulty):
    with pytest.raises(InputError, match="gives Fe = .* which is not F at rest there"):
        audited(faulty, "race")


def test_a_race_that_takes_energy_unseen(faulty, monkeypatch):
    """If nobody tries its law beforehand."""
    monkeypatch.setattr(laws, "check_normal", lambda *law: None)
    sound, wrong = (audited(law, "race") for law in ("elastic", faulty))
    assert sound.verdict == PASSED
    assert wrong.verdict == EXCEEDED and wrong.of_drive > OF_DRIVE > 5.0 * sound.of_drive
