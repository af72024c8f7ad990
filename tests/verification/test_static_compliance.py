"""Deflection under static contact forces: the reduced cage against the full mesh, every pocket."""

from itertools import product

import numpy as np
import pytest
from full_mesh import reduced_compliance, station_rows
from verification_bearing import bent, cage_of, log, n1013, pushed

PATTERNS = {
    "uniform": np.full(7, 1.0 / 7.0),
    "linear": np.linspace(-1.0, 1.0, 7),
    "roller with profile": np.array([0.0, 0.1, 0.25, 0.3, 0.25, 0.1, 0.0]),
    "middle": np.eye(7)[3],
    "end": np.eye(7)[0],
}


@pytest.fixture(scope="module")
def damaged_cage():
    """A cage without any symmetry: one bent crossbeam, one pushed side beam."""
    return cage_of(n1013(defects=bent("0.2 mm") + pushed("-0.2 mm", pocket=11)))[1]


@pytest.fixture(scope="module")
def deflections(damaged_cage):
    """(Z, 4, 5, 2): each pattern's own deflection per newton, reduced and full."""
    table = np.zeros((22, 4, len(PATTERNS), 2))
    patterns = np.stack(list(PATTERNS.values()))
    for pocket in range(22):
        rows = np.concatenate([patterns @ station_rows(damaged_cage, pocket, f) for f in range(4)])
        full = rows @ damaged_cage.solver.solve(np.ascontiguousarray(rows.T))
        for face in range(4):
            reduced = patterns @ reduced_compliance(damaged_cage, pocket, [face]) @ patterns.T
            part = slice(face * len(patterns), (face + 1) * len(patterns))
            table[pocket, face] = np.stack([np.diag(reduced), np.diag(full[part, part])], axis=1)
    return table


def test_every_pocket_yields_as_the_full_mesh(deflections):
    """Within 0.3 % for any pattern; uniform and linear loads are in the span, and nearly a
    profile's. The worst is a force in the middle alone, narrower than any load of the basis."""
    error = deflections[..., 0] / deflections[..., 1] - 1.0
    for k, name in enumerate(PATTERNS):
        log.info("%s: largest error %.4f", name, np.abs(error[:, :, k]).max())
    assert np.abs(error[:, :, :2]).max() < 5e-4
    assert np.abs(error[:, :, 2]).max() < 5e-4
    assert np.abs(error).max() < 4e-3
    assert error.max() < 1e-4  # never softer than the mesh


def test_drive_point_compliance_has_the_expected_size(deflections):
    """A crossbeam's is near 1.6e-4 mm/N (30 %), most of it the ring's ovalisation."""
    crossbeams = 1e3 * deflections[:, :2, 0, 1]
    assert np.all((1.1e-4 < crossbeams) & (crossbeams < 2.1e-4))
    assert np.ptp(crossbeams) < 0.05 * crossbeams.mean()


def test_a_pocket_s_opening_under_a_pinch(damaged_cage):
    """Opposite forces on both faces of a pocket, the load of a squeezed roller: within 0.2 %, and
    within 5 % if both act in the middle alone.

    Ovalisation cancels, so that what uniform, linear and quadratic loads miss weighs more.
    """
    places = ((0, (0, 1)), (4, (0, 1)), (5, (2, 3)), (11, (2, 3)))
    for (pocket, faces), (name, bound) in product(
        places, {"roller with profile": 2e-3, "middle": 0.05}.items()
    ):
        pair = np.tile(PATTERNS[name], 2)
        rows = np.concatenate([station_rows(damaged_cage, pocket, f) for f in faces])
        full = pair @ rows @ damaged_cage.solver.solve((pair @ rows)[:, None])[:, 0]
        reduced = pair @ reduced_compliance(damaged_cage, pocket, faces) @ pair
        log.info("pocket %d %s: %.4e against %.4e mm/N", pocket, faces, 1e3 * reduced, 1e3 * full)
        assert reduced == pytest.approx(full, rel=bound)


def test_what_cutting_the_coupling_costs(damaged_cage):
    """A crossbeam squeezed between two rollers (front of pocket 7, rear of pocket 8): the beam
    bends for neither, and only what two pockets share of it is cut."""
    uniform = PATTERNS["uniform"]
    rows = np.stack([uniform @ station_rows(damaged_cage, p, f) for p, f in ((7, 0), (8, 1))])
    full = rows @ damaged_cage.solver.solve(np.ascontiguousarray(rows.T))
    own = [
        uniform @ reduced_compliance(damaged_cage, p, [f]) @ uniform for p, f in ((7, 0), (8, 1))
    ]
    np.testing.assert_allclose(own, np.diag(full), rtol=1e-3)
    interface = damaged_cage.interface
    modes = [s * uniform @ interface.modes[p, f, :, 2] for p, f, s in ((7, 0, 1.0), (8, 1, -1.0))]
    across = modes[0] @ np.linalg.solve(damaged_cage.basis.stiffness, modes[1])
    missing = (across - full[0, 1]) / full[0, 0]
    log.info("the next pocket's deflection misses %.1f %% of the own one", 100.0 * missing)
    assert abs(missing) < 0.06
