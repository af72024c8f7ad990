"""All pairs of a designation and a type of cage: ``flexcage new`` writes what can be meshed.

Slow: all cages are meshed in truth, as their cases ask, and counted (``pytest -m slow -rP``).
"""

from __future__ import annotations

import random
import sys
from collections import Counter
from functools import cache

import numpy as np
import pytest

from flexcage.bearings import in_motion
from flexcage.case.case import load_case
from flexcage.case.catalogue import designations, find
from flexcage.case.new import new_case
from flexcage.core.errors import InputError
from flexcage.geometry.bearing import BEARING_TYPES
from flexcage.geometry.cage import cages_of
from flexcage.geometry.full_complement import CAGED
from flexcage.mesh import sector
from flexcage.mesh.rows import rows_in
from flexcage.stages import cage_mesh

TETRAHEDRON = 4  # of gmsh's types of elements
MOST = 200_000  # nodes of a mesh, for each row of pockets in it, that a small machine reduces


def pairs() -> list[tuple[str, str]]:
    """Of bearings that run: cases of others have no cage."""
    found = [(d, BEARING_TYPES[find(d).outline.type]) for d in designations()
             if find(d).outline.complement == CAGED]  # fmt: skip
    found = [(d, spec.element) for d, spec in found if in_motion(spec)]
    return [(d, cage) for d, element in found for cage in cages_of(element)]


@cache
def written(designation: str, cage: str):
    """The case, or the sentence why there is none."""
    try:
        return load_case(new_case(find(designation).outline, "catalogue", cage=cage).text)
    except InputError as error:
        return str(error)


def estimated(case) -> float:
    """Nodes of the quadratic mesh, about: 7 for a cube of the thinnest part's size."""
    cage, count = case.cage, case.bearing.element_count
    thin = cage.thinnest(case.bearing.pitch_diameter, count)
    ring = 0.25 * np.pi * (cage.outside_diameter**2 - cage.bore**2) * cage.width
    return 7.0 * 0.5 * ring / thin**3


SAMPLE = random.Random(7).sample(pairs(), 25)


@pytest.mark.parametrize(("designation", "cage"), SAMPLE)
def test_what_is_proposed_is_of_a_size_that_can_be_meshed(designation, cage):
    case = written(designation, cage)
    if isinstance(case, str):
        assert case.startswith(f"No {cage} cage of usual proportions fits into {designation}: ")
        assert case.endswith(", the usual one of such bearings.")
    else:
        assert estimated(case) < 10 * MOST


EXTREME = {
    (
        "7212B",
        "crown",
    ): "claws could be 0.18 mm thick at most, and a crown cage has claws of at least 1 mm",
    ("7201A", "crown"): "claws could be 0.1",
    ("7204A", "ribbon"): "leave no flats between them",
}


@pytest.mark.parametrize("pair", EXTREME)
def test_pairs_that_do_not_go_together_are_told_the_usual_cage(pair):
    """Balls of angular contact bearings stand too close for claws and for rivets."""
    found = written(*pair)
    assert isinstance(found, str), "it was written"
    assert EXTREME[pair] in found and found.endswith("take --cage machined, the usual one of such "
                                                     "bearings.")  # fmt: skip


class Foreseen:
    """Tetrahedra of parts of sectors, foreseen and counted, beside ``sector.generate``."""

    def __init__(self, monkeypatch):
        self.parts: list[tuple[float, int]] = []
        self._expected = sector.expected_tets
        monkeypatch.setattr(sector, "expected_tets", self)

    def __call__(self, gmsh, plan):
        value = self._expected(gmsh, plan)
        gmsh.model.mesh.generate(3)
        self.parts.append((value, len(gmsh.model.mesh.getElementsByType(TETRAHEDRON)[0])))
        gmsh.model.mesh.clear()
        return value

    def ratios(self) -> list[float]:
        return [value / count for value, count in self.parts]


PLAIN = [("6205", "crown"), ("6205", "ribbon"), ("7205B", "machined"), ("NU205", "window")]


@pytest.mark.parametrize("fineness", ["coarse", "medium", "fine"])
@pytest.mark.parametrize("pair", PLAIN)
def test_elements_are_foreseen_within_a_factor_of_two(monkeypatch, pair, fineness):
    """They decide whether a mesh is begun."""
    found = Foreseen(monkeypatch)
    cage_mesh(written(*pair).replace("mesh.fineness", fineness))
    assert found.parts and 0.5 < min(found.ratios()) <= max(found.ratios()) < 2.0, found.parts


@pytest.mark.slow
def test_all_that_is_written_is_meshed(monkeypatch):
    """Counts by type of cage, and the largest mesh of each (``-rP`` shows them)."""
    counts: Counter[tuple[str, str]] = Counter()
    largest: dict[str, tuple[int, str]] = {}
    wrong, found = [], Foreseen(monkeypatch)
    for designation, cage in pairs():
        case = written(designation, cage)
        counts[cage, "refused" if isinstance(case, str) else "meshed"] += 1
        if isinstance(case, str):
            continue
        try:
            mesh = cage_mesh(case)
        except Exception as error:  # all are tried
            wrong.append((designation, cage, f"{type(error).__name__}: {error}"))
            continue
        rows = max(len(rows_in(mesh.info)), 1)
        nodes = (2 * len(mesh.points) + len(mesh.tets)) // rows  # of quadratic elements, nearly
        largest[cage] = max(largest.get(cage, (0, "")), (nodes, designation))
        if nodes >= MOST:
            wrong.append((designation, cage, f"{nodes} nodes a row"))
    ratios = found.ratios()
    sys.stdout.write(f"{dict(counts)}\n{largest}\n")
    sys.stdout.write(f"elements foreseen over found: {min(ratios):.2f} to {max(ratios):.2f}\n")
    assert not wrong
    assert 0.5 < min(ratios) <= max(ratios) < 2.0
    assert all(counts[cage, "meshed"] for cage in largest)
