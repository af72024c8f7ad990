"""Splits without leakage: whatever shares a bearing, a load or a seed stays on one side."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence

TRAIN, VALIDATION, TEST = "train", "validation", "test"
#: By the name of a split: the column of the truth table whose values must not be parted.
GROUPED = {"by_bearing": "bearing_id", "by_load": "load_group", "by_seed": "seed"}
_SHARE = 0.15  # of the groups for validation, and for test


def split(groups: Sequence[str]) -> dict[str, str]:
    """Train, validation or test for every group: 70, 15 and 15 % of them, in an order that their
    names alone decide; of two groups one is for test, one alone is for train."""
    ordered = sorted(set(groups), key=lambda g: hashlib.sha256(g.encode()).hexdigest())
    count = len(ordered)
    test = max(round(_SHARE * count), 1) if count > 1 else 0
    validation = max(round(_SHARE * count), 1) if count > 2 else 0
    sides = [TEST] * test + [VALIDATION] * validation
    sides += [TRAIN] * (count - len(sides))
    return dict(zip(ordered, sides))


def splits_of(truth: Sequence[Mapping[str, object]]) -> list[dict[str, str]]:
    """A row for every recording: its side in each split."""
    rows = [{"recording_id": str(row["recording_id"])} for row in truth]
    for name, column in GROUPED.items():
        sides = split([str(row[column]) for row in truth])
        for row, source in zip(rows, truth):
            row[name] = sides[str(source[column])]
    return rows


def leaks(
    rows: Sequence[Mapping[str, str]], truth: Sequence[Mapping[str, object]]
) -> list[tuple[str, str]]:
    """Splits that part a group, and the group."""
    by_id = {str(row["recording_id"]): row for row in truth}
    found = []
    for name, column in GROUPED.items():
        sides: dict[str, set[str]] = {}
        for row in rows:
            sides.setdefault(str(by_id[row["recording_id"]][column]), set()).add(row[name])
        found += [(name, group) for group, own in sides.items() if len(own) > 1]
    return found
