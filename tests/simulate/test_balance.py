"""Blocks that leak energy are done again: bearings whose runs used to exceed the audit."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from audit_trial import plausible_case
from simulate_cases import Interrupted

import flexcage
from flexcage.integrate import balance, integration
from flexcage.integrate.balance import AGAIN, SPARE, TAKEN, TIGHTER, Balance
from flexcage.results.audit import EXCEEDED, OF_DRIVE, PASSED, energy_audit
from flexcage.results.registry import ENERGIES
from flexcage.solve.contract import TOO_SMALL
from flexcage.system.data import POWERS

#: Numbers in the trial of seed 1, and what is special in them.
LEAKY = {
    13: "7000C with spalls of both races, loose in its housing",
    61: "7011C with spalls of both races, loose in its housing",
    70: "NJ303 with a spall narrower than its rollers, on a bushing",
    118: "6306 with clearance in its housing",
}


def leaky(number: int, **output: Any) -> flexcage.Case:
    case = plausible_case(1, number, duration="3 ms")
    return replace(case, output=replace(case.output, **output))


def run_of(case: flexcage.Case, **how):
    return flexcage.simulate(case, stress=False, **how)


@pytest.mark.parametrize("number", LEAKY, ids=lambda n: LEAKY[n])
def test_what_leaks_is_done_again(monkeypatch, number):
    mended = run_of(leaky(number))
    assert energy_audit(mended.dataset).verdict == PASSED
    assert 1 <= mended.summary["repeated_blocks"] <= AGAIN * mended.store.layout.n_blocks
    monkeypatch.setattr(balance, "TAKEN", np.inf)
    unmended = run_of(leaky(number))
    assert energy_audit(unmended.dataset).verdict == EXCEEDED
    assert unmended.summary["repeated_blocks"] == 0


def test_a_run_that_repeats_blocks_is_resumed_to_the_same_bits(tmp_path):
    case = leaky(118, block=10)
    length = 10 / case.output.rate
    unbroken = run_of(case, out=tmp_path / "unbroken")
    assert unbroken.summary["repeated_blocks"]
    for blocks in (1, 3, 9):
        with pytest.raises(KeyboardInterrupt):
            run_of(case, out=tmp_path / "broken", progress=Interrupted(blocks, length))
        resumed = run_of(case, out=tmp_path / "broken", resume=True)
        for name, values in unbroken.dataset.data_vars.items():
            np.testing.assert_array_equal(resumed.dataset[name], values, err_msg=name)
        for key in ("repeated_blocks", "steps", "failed_error_tests"):
            assert resumed.summary[key] == unbroken.summary[key]
        shutil.rmtree(tmp_path / "broken")


class Bare:
    """Of a store, what books need; nothing is in it."""

    class layout:
        n_time, block = 100, 10

    blocks = 0


def books(leaks: list[float]) -> Iterator[balance.Weighed]:
    """A body that a drive of 1 W speeds up, in blocks of 10 s that leak so many J each."""
    book, start, lost = Balance(Bare()), 0.0, 0.0
    for leak in leaks:
        time = start + np.arange(1.0, 11.0)
        stored, work = np.zeros((10, len(ENERGIES))), np.zeros((10, len(POWERS)))
        work[:, POWERS.index("drive")] = time
        stored[:, ENERGIES.index("kinetic")] = time - lost - leak * (time - start) / 10.0
        yield book.weigh(stored, work)
        book.keep(10)
        start, lost = start + 10.0, lost + leak


def test_the_books_ask_for_what_the_audit_would_not_bear():
    may = 10.0 * OF_DRIVE  # of a block [J]
    sound, worse, late = 0.4 * TAKEN * may, 2.0 * TAKEN * may, 1.2 * TAKEN * may
    assert [w.over for w in books([sound, sound, worse])] == [False, False, False]
    assert [w.over for w in books([worse, sound, late])] == [True, False, True]
    assert [w.over for w in books([worse, sound, sound])] == [True, False, False]
    assert [w.spare for w in books([0.5 * SPARE * may, 2.0 * SPARE * may])] == [True, False]


def test_a_block_that_cannot_be_done_again_stays_as_it_was(monkeypatch):
    case = leaky(118)
    plain, tried = run_of(case), []
    honest = integration.Integration._attempt

    def fails_when_tight(self, index):
        found = honest(self, index)
        tried.append(self.tightened)
        return found._replace(outcome=TOO_SMALL) if self.tightened < 1.0 else found

    monkeypatch.setattr(integration.Integration, "_attempt", fails_when_tight)
    kept = run_of(case)
    assert tried == [1.0, TIGHTER, 1.0]
    assert energy_audit(kept.dataset).verdict == EXCEEDED
    assert energy_audit(plain.dataset).verdict == PASSED
