"""A user's module: one of each kind that flexcage takes from outside, each with one call.

``flexcage run CASE --use my_extensions.py`` loads it, or plain ``import my_extensions``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from scipy.linalg import eigh

from flexcage import register
from flexcage.core.spec import option, quantity
from flexcage.modes.basis import ModeBasis
from flexcage.modes.pockets import pocket_loads
from flexcage.results.registry import Variable
from flexcage.solve.contract import DONE, LOG_FULL, RESIDUALS, STEPS, T
from flexcage.solve.runge_kutta import EXPLICIT_METHOD
from flexcage.spec import Constraint, FrictionLaw, Material, ModesSpec, NormalLaw

# ------------------------------------------------------------------- a normal law with own values


@dataclass(frozen=True, kw_only=True)
class Spring(NormalLaw):
    """A linear spring and dashpot at every slice, whatever geometry and materials say."""

    law: str = "spring"
    stiffness: float = quantity("N/um", doc="stiffness of one slice", above=0.0)
    loss: float = quantity("us", 1e-7, doc="time constant of the dashpot", minimum=0.0)


def spring(n, d, v, onset, p, F, Fe, Fd, Fv):
    """F = k (d + loss v), clipped at zero; the dashpot fades in over the first 0.1 um."""
    for i in range(n):
        F[i] = Fe[i] = Fd[i] = Fv[i] = 0.0
        if d[i] > 0.0:
            Fe[i] = p[0] * d[i]
            share = min(d[i] / p[3], 1.0)
            force = p[0] * (d[i] + p[2] * share * v[i])
            if force > 0.0:
                F[i] = force
                Fd[i] = p[0] * (1.0 + (p[2] * v[i] / p[3] if d[i] < p[3] else 0.0))
                Fv[i] = p[0] * p[2] * share


register.normal_law(
    "spring", spring, spec=Spring, parameters=lambda s, k, n: (s.stiffness, 1.0, s.loss, 1e-7)
)

# ------------------------------------------------------------------------------- a constraint


@dataclass(frozen=True, kw_only=True)
class Rail(Constraint):
    """The cage's centre stays on a line through the axis, at ``azimuth`` from y towards z."""

    type: str = "rail"
    azimuth: float = quantity("deg", 0.0, doc="azimuth of the line")


def rail(t, y, at, p, G, g, h):
    """g: distance from the line; G: slopes of its rate h in the velocities of the cage's centre."""
    q, u, b = at.cage_q + 1, at.cage_u + 1, at.cage_b + 1  # of the centre's y, then z
    G[0, b], G[0, b + 1] = -p[0], p[1]
    g[0] = p[1] * y[q + 1] - p[0] * y[q]
    h[0] = p[1] * y[u + 1] - p[0] * y[u]


register.constraint(
    "rail", rail, level="position", spec=Rail,
    parameters=lambda s: (np.sin(s.azimuth), np.cos(s.azimuth)),
)  # fmt: skip

# ----------------------------------------------------------------------------- a friction law


@dataclass(frozen=True, kw_only=True)
class LimitedShear(FrictionLaw):
    """Friction of a film: proportional to the sliding speed, up to a limiting shear."""

    law: str = "limited_shear"
    limit: float = option(0.06, doc="friction coefficient at large sliding speed", minimum=0.0)
    scale: float = quantity("m/s", 0.2, doc="sliding speed of 76 % of it", above=0.0)


def limited_shear(n, u, p, g, dg):
    """mu = limit tanh(u/scale), as mu/u and its derivative; a series near u = 0."""
    for i in range(n):
        x = u[i] / p[1]
        if x < 1e-3:
            g[i] = p[0] / p[1] * (1.0 - x * x / 3.0)
            dg[i] = -2.0 * p[0] * x / (3.0 * p[1] ** 2)
        else:
            t = np.tanh(x)
            g[i] = p[0] * t / u[i]
            dg[i] = (p[0] / p[1] * (1.0 - t * t) - g[i]) / u[i]


register.friction_law(
    "limited_shear", limited_shear, spec=LimitedShear, parameters=lambda s: (s.limit, s.scale)
)

# ------------------------------------------------------------------------------- a mode basis


@dataclass(frozen=True, kw_only=True)
class PocketShapes(ModesSpec):
    """Rayleigh-Ritz modes in the span of the answers to one load on every pocket."""

    kind: str = "pocket_shapes"
    face: int = option(0, doc="pocket face that is loaded (0 front ... 3 side-x)", minimum=0)


def pocket_shapes(solver, *, pocket_count, spec):
    """The lowest ``spec.count`` of them; inertia relief leaves no rigid motion in the answers."""
    model = solver.model
    loads = [pocket_loads(model, k, pocket_count)[:, 2 * spec.face] for k in range(pocket_count)]
    answers = solver.solve(np.stack(loads, axis=1))
    mass = answers.T @ model.mass_times(answers)
    squares, mixed = eigh(answers.T @ (model.K @ answers), mass)
    squares, shapes = squares[: spec.count], answers @ mixed[:, : spec.count]
    return ModeBasis(
        name="pocket_shapes",
        shapes=shapes.reshape(-1, 3, len(squares)),
        stiffness=np.diag(squares),
        mass=np.eye(len(squares)),
        frequencies=np.sqrt(squares) / (2.0 * np.pi),
        kind=("ritz",) * len(squares),
    )


register.mode_basis("pocket_shapes", pocket_shapes, spec=PocketShapes)

# ------------------------------------------------------------------------------- an integrator


def heun(fns, data, st, opt, t_end, times, ys, yds, first, log, quads):
    """Heun's method at steps of ``solver.max_step``; samples lie on lines between the points."""
    rates, note, sample = fns
    y, K, end, power, real, count = st.y, st.K, st.Y[0], st.power, st.real, st.count
    done, row = first, 0
    rates(real[T], y, K[0], data, power[0])
    if count[STEPS] == 0:
        note(real[T], y, data)
    while real[T] < t_end:
        if row == len(log):
            return LOG_FULL, done, row
        h = (t_end - real[T]) / np.ceil((t_end - real[T]) / opt.h_max - 1e-9)
        for k in range(len(y)):
            end[k] = y[k] + h * K[0, k]
        rates(real[T] + h, end, K[1], data, power[1])
        for k in range(len(y)):
            end[k] = y[k] + 0.5 * h * (K[0, k] + K[1, k])
        rates(real[T] + h, end, K[1], data, power[1])
        real[T] += h
        note(real[T], end, data)
        while done < len(times) and times[done] <= real[T] + 1e-12 * h:
            x = 1.0 - (real[T] - times[done]) / h
            for k in range(len(y)):
                ys[done, k] = y[k] + x * (end[k] - y[k])
                yds[done, k] = K[0, k] + x * (K[1, k] - K[0, k])
            for k in range(len(st.quad)):
                quads[done, k] = st.quad[k] + x * h * power[0, k]
            sample(done, times[done], ys[done], yds[done], data)
            done += 1
        for k in range(len(st.quad)):
            st.quad[k] += 0.5 * h * (power[0, k] + power[1, k])
            power[0, k] = power[1, k]
        for k in range(len(y)):
            y[k], K[0, k] = end[k], K[1, k]
        log[row, 0], log[row, 1], log[row, 2] = real[T], h, 2
        count[STEPS] += 1
        count[RESIDUALS] += 2
        row += 1
    return DONE, done, row


register.integrator(
    replace(
        EXPLICIT_METHOD, name="heun", advance=heun, functions=("rates", "note", "sample"),
        helpers=(), bounded=False,
    )
)  # fmt: skip

# ------------------------------------------------------------------------------- an output


def ring_force(arrays, bearing):
    """Normal force and traction of all rollers on the inner ring, y and z (n, 2) [N]."""
    c, s = np.cos(arrays["element_position"][:, :, 2]), np.sin(arrays["element_position"][:, :, 2])
    normal, traction = arrays["race_force"][:, :, 0], arrays["race_traction"][:, :, 0]
    return -np.stack(
        [(normal * c - traction * s).sum(axis=1), (normal * s + traction * c).sum(axis=1)], axis=1
    )


register.variable(
    Variable("ring_force", ("time", "axis2"), "N", "force of all rollers on the inner ring"),
    ring_force,
)

# ------------------------------------------------------------------------------- a picture


def ring_force_picture(scene, path: Path) -> Path:
    """The new output over time."""
    from matplotlib.figure import Figure

    force = scene.dataset["ring_force"]
    figure = Figure(figsize=(8, 4))
    axes = figure.add_subplot()
    axes.plot(force["time"] * 1e3, force, label=["y", "z"])
    axes.set(xlabel="time, ms", ylabel="force on the inner ring, N", title=scene.name)
    axes.legend()
    figure.savefig(path)
    return path


register.picture("ring_force", ring_force_picture)

# --------------------------------------------------------------------- a material and a preset

register.material(
    Material(
        name="my_bronze", youngs_modulus=110e9, poisson_ratio=0.34, density=8800.0,
        source="invented for the test",
    )
)  # fmt: skip
register.preset(Path(__file__).with_name("my_bearing.toml"))
