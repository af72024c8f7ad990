"""Laws and constraints from outside that read what they were not given, or give slopes that are
none: told before a run, with the numbers."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from flexcage.contacts import laws
from flexcage.contacts.spec import FrictionLaw, NormalLaw
from flexcage.core import registry
from flexcage.core.errors import InputError
from flexcage.core.probing import place_beyond
from flexcage.system.layout import Layout, bodies_of_bearing
from flexcage.system.own_rows import check_rows

TABLES = (
    laws.NORMAL_LAWS, laws.NORMAL_PARAMETERS, laws.FRICTION_LAWS, laws.FRICTION_PARAMETERS,
    laws.specs.NORMAL_LAWS, laws.specs.FRICTION_LAWS, registry._sources,
)  # fmt: skip


@pytest.fixture(autouse=True)
def tables():
    saved = [dict(table) for table in TABLES]
    yield
    for table, before in zip(TABLES, saved):
        table.clear()
        table.update(before)


def spring(n, d, v, onset, p, F, Fe, Fd, Fv):
    """k (d + loss v) on both sides of a bend at p[3], damped."""
    for i in range(n):
        F[i] = Fe[i] = Fd[i] = Fv[i] = 0.0
        if d[i] > 0.0:
            Fd[i] = p[0] if d[i] < p[3] else 2.0 * p[0]
            Fe[i] = p[0] * d[i] + p[0] * max(d[i] - p[3], 0.0)
            share = min(d[i] / p[3], 1.0)
            F[i] = Fe[i] + p[0] * p[2] * share * v[i]
            Fd[i] += p[0] * p[2] * v[i] / p[3] if share < 1.0 else 0.0
            Fv[i] = p[0] * p[2] * share
            if F[i] <= 0.0:
                F[i] = Fd[i] = Fv[i] = 0.0


def last_of_all(n, d, v, onset, p, F, Fe, Fd, Fv):
    for i in range(n):
        Fd[i] = (1.0 + p[-1]) * p[0] if d[i] > 0.0 else 0.0
        F[i] = Fe[i] = Fd[i] * d[i]
        Fv[i] = 0.0


def half_slope(n, d, v, onset, p, F, Fe, Fd, Fv):
    for i in range(n):
        Fd[i] = 0.5 * p[0] if d[i] > 0.0 else 0.0
        F[i] = Fe[i] = 2.0 * Fd[i] * d[i]
        Fv[i] = 0.0


def no_damping_slope(n, d, v, onset, p, F, Fe, Fd, Fv):
    for i in range(n):
        k = p[0] if d[i] > 0.0 else 0.0
        Fe[i], F[i] = k * d[i], k * d[i] * (1.0 + p[2] * v[i])
        Fd[i], Fv[i] = k * (1.0 + p[2] * v[i]), 0.0


def unwritten(n, d, v, onset, p, F, Fe, Fd, Fv):
    for i in range(n):
        Fd[i] = p[0] if d[i] > 0.0 else 0.0
        F[i] = Fe[i] = Fd[i] * d[i]


def two_sided(n, d, v, onset, p, F, Fe, Fd, Fv):
    for i in range(n):
        F[i] = Fe[i] = p[0] * d[i]
        Fd[i], Fv[i] = p[0], 0.0


def pulling(n, d, v, onset, p, F, Fe, Fd, Fv):
    for i in range(n):
        Fd[i] = -p[0] if d[i] > 0.0 else 0.0
        F[i] = Fe[i] = Fd[i] * d[i]
        Fv[i] = 0.0


def giving(n, d, v, onset, p, F, Fe, Fd, Fv):
    for i in range(n):
        k = p[0] if d[i] > 0.0 else 0.0
        Fe[i], Fd[i], Fv[i] = k * d[i], k * (1.0 - v[i]), -k * d[i]
        F[i] = Fd[i] * d[i]


def half_elastic(n, d, v, onset, p, F, Fe, Fd, Fv):
    for i in range(n):
        Fd[i] = p[0] if d[i] > 0.0 else 0.0
        F[i] = Fd[i] * d[i]
        Fe[i], Fv[i] = 0.5 * F[i], 0.0


def sets_its_stiffness(n, d, v, onset, p, F, Fe, Fd, Fv):
    p[0] = 2e7
    for i in range(n):
        Fd[i] = p[0] if d[i] > 0.0 else 0.0
        F[i] = Fe[i] = Fd[i] * d[i]
        Fv[i] = 0.0


def clips_its_depth(n, d, v, onset, p, F, Fe, Fd, Fv):
    for i in range(n):
        d[i] = max(d[i], 0.0)
        Fd[i] = p[0] if d[i] > 0.0 else 0.0
        F[i] = Fe[i] = Fd[i] * d[i]
        Fv[i] = 0.0


def whole_arrays(n, d, v, onset, p, F, Fe, Fd, Fv):
    for i in range(len(d)):
        Fd[i] = p[0] if d[i] > 0.0 else 0.0
        F[i] = Fe[i] = Fd[i] * d[i]
        Fv[i] = 0.0


NORMAL = {
    "pulling": (pulling, (1e7, 1.0), "pulls: F is -300 N at a penetration of 30 um"),
    "giving": (giving, (1e7, 1.0), "gives energy: F less that at rest is .* N at"),
    "half_elastic": (half_elastic, (1e7, 1.0), "gives Fe = 150 N at .* which is not F at rest"),
    "stiff": (sets_its_stiffness, (1e7, 1.0), "writes into p, which is not its own"),
    "clips": (clips_its_depth, (1e7, 1.0), "writes into d, which is not its own"),
    "whole": (whole_arrays, (1e7, 1.0), "writes beyond the first n entries"),
    "bent": (
        spring,
        (1e7, 1.0, 1e-5),
        r"reads p\[3\], but its parameters are 3 numbers, p\[0\] to",
    ),
    "last": (last_of_all, (1e7, 1.0), r"reads p\[-1\], but its parameters are 2 numbers"),
    "half": (half_slope, (1e7, 1.0), r"dF/dd \(Fd\) = 5e\+06 N/m at .* values give 1e\+07 N/m"),
    "damped": (no_damping_slope, (1e7, 1.0, 2.0), r"dF/dv \(Fv\) = 0 N s/m at .* off at"),
    "unwritten": (unwritten, (1e7, 1.0), "no finite number at a penetration of 1e-09 m"),
    "sticky": (two_sided, (1e7, 1.0), "gives a force or a slope without contact"),
}


@pytest.mark.parametrize("name", NORMAL)
def test_a_normal_law_that_is_none_is_refused_before_it_is_used(name):
    law, own, words = NORMAL[name]
    laws.register_normal(name, law, parameters=lambda spec, K, n: own)
    with pytest.raises(InputError, match=f"Normal law '{name}' .*{words}"):
        laws.normal_parameters(NormalLaw(law=name), 1e7, 1.0)


def test_a_law_with_a_bend_and_all_its_parameters_is_taken():
    own = (1e7, 1.0, 1e-5, 2e-6)
    laws.register_normal("bent", spring, parameters=lambda spec, K, n: own)
    assert tuple(laws.normal_parameters(NormalLaw(law="bent"), 1e7, 1.0)[:4]) == own


def shear(n, u, p, g, dg):
    """mu = p[0] tanh(u/p[1])."""
    for i in range(n):
        x = u[i] / p[1]
        if x < 1e-3:
            g[i], dg[i] = p[0] / p[1] * (1.0 - x * x / 3.0), -2.0 * p[0] * x / (3.0 * p[1] ** 2)
        else:
            t = np.tanh(x)
            g[i] = p[0] * t / u[i]
            dg[i] = (p[0] / p[1] * (1.0 - t * t) - g[i]) / u[i]


def slope_of_mu(n, u, p, g, dg):
    shear(n, u, p, g, dg)
    for i in range(n):
        dg[i] = g[i] + u[i] * dg[i]


def plain_coulomb(n, u, p, g, dg):
    for i in range(n):
        g[i] = p[0] / u[i]
        dg[i] = -g[i] / u[i]


def fades(n, u, p, g, dg):
    shear(n, u, p, g, dg)
    for i in range(n):
        g[i] *= 1.0 - p[2]
        dg[i] *= 1.0 - p[2]


def pushes(n, u, p, g, dg):
    shear(n, u, p, g, dg)
    for i in range(n):
        g[i], dg[i] = -g[i], -dg[i]


FRICTION = {
    "pushes": (pushes, "pushes along the motion: g = mu/u is -0.5 s/m at a sliding speed of 0"),
    "slope_of_mu": (slope_of_mu, r"dg/du \(dg\) = .* at a sliding speed of"),
    "coulomb": (plain_coulomb, "no finite number at a sliding speed of 0 m/s"),
    "fades": (fades, r"reads p\[2\], but its parameters are 2 numbers"),
}


@pytest.mark.parametrize("name", FRICTION)
def test_a_friction_law_that_is_none_is_refused_before_it_is_used(name, monkeypatch):
    from flexcage.core.jit import kernel

    compiled = kernel(laws.FRICTION_SIGNATURE)(shear)
    monkeypatch.setitem(globals(), "shear", compiled)
    law, words = FRICTION[name]
    laws.register_friction(name, law, parameters=lambda spec: (0.1, 0.2))
    laws.register_friction("shear", compiled, parameters=lambda spec: (0.1, 0.2))
    assert laws.friction_parameters(FrictionLaw(law="shear"))[1] == 0.2
    with pytest.raises(InputError, match=f"Friction law '{name}' .*{words}"):
        laws.friction_parameters(FrictionLaw(law=name))


def test_a_value_that_hides_behind_a_comparison_is_found():
    """No number beyond those given may change what comes out, NaN alone does not show it."""
    given = np.array([1.0, 2.0])
    assert place_beyond(lambda p: (p[:2],), given) is None
    assert place_beyond(lambda p: (np.array([1.0 if p[5] > 10.0 else 0.0]),), given) == 5


# --- constraints ---------------------------------------------------------------------------------


def spacer(t, y, at, p, G, g, h):
    h[0] = y[at.inner_u + 1] - y[at.outer_u + 1]
    G[0, at.inner_b + 1], G[0, at.outer_b + 1] = 1.0, -1.0


def one_sided(t, y, at, p, G, g, h):
    spacer(t, y, at, p, G, g, h)
    G[0, at.outer_b + 1] = 0.0


def offset(t, y, at, p, G, g, h):
    spacer(t, y, at, p, G, g, h)
    h[0] -= p[1]


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        (one_sided, r"gives G\[0, at.outer_b \+ 1\] = 0, but differences of h\[0\] .* give -1"),
        (offset, r"reads p\[1\], but its parameters are one number, "),
    ],
)
def test_rows_of_a_constraint_that_leave_a_body_out_or_read_too_far(rows, words):
    layout = Layout(4, bodies_of_bearing(3), ("spacer",))
    kind = SimpleNamespace(labels=("",), rows=spacer)
    y = np.linspace(-1.0, 2.0, layout.size)
    check_rows(kind, "spacer", np.array([3.0]), layout.places, y)
    with pytest.raises(InputError, match=words):
        check_rows(
            SimpleNamespace(labels=("",), rows=rows), "own", np.array([3.0]), layout.places, y
        )
