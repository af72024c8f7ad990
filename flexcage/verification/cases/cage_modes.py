"""Free frequencies of cages of solid elements."""

from __future__ import annotations

from collections.abc import Iterator

import flexcage
from flexcage.stages import cage_modes
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance

# preset: the first frequencies [Hz] of its free cage on the coarse mesh, each twice
TABLE = {
    "N1013": (869.0968, 1605.429, 2445.759),
    "7010C-PI": (744.1358, 1157.008, 2077.818),
}
MESH = Tolerance(5e-3, "other versions of gmsh mesh otherwise; on the same elements it is 2e-5")


def rows() -> Iterator[Row]:
    for name, expected in TABLE.items():
        coarse = {"bearing": {"preset": name}, "mesh": {"fineness": "coarse"}}
        found = cage_modes(flexcage.load_case(coarse)).frequency
        for k, reference in enumerate(expected):
            for other, value in enumerate(found[2 * k : 2 * k + 2]):
                which = f"{name}, cage: frequency {2 * k + other + 1}"
                yield Row(which, "Hz", reference, float(value), MESH)


CASE: KnownAnswer = KnownAnswer(
    name="cage_modes",
    title="Free frequencies of cages",
    source="CalculiX 2.20 on the same quadratic tetrahedra (tests/verification/calculix.py)",
    checks="The first six elastic frequencies of the free cages of an N1013 (brass, window cage) "
    "and of a 7010C (polyimide, round pockets) on their coarse meshes. A cage that is alike all "
    "round has each twice.",
    rows=rows,
)
