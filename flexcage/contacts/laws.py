"""Normal and friction laws: how hard. One signature each, so that a new law is one function.

``register_normal`` and ``register_friction`` add a law from any module: its name is then a choice
in cases, and the compiled bearing takes it as it is.

A law works on all slices of a contact, or of many contacts, at once: called through numba's
first-class function type a scalar law costs 30 ns a slice, a vector one 30 ns a call (measured
here), and a chain of operations takes as long for one slice as for the sixteen of a contact.

Normal law:   (n, d, v, onset, p, F, Fe, Fd, Fv)  penetration d, its rate v (> 0 approaching), speed
              at which the contact closed (0 before), parameters p -> force F >= 0, its elastic part
              Fe (F at v = 0), and dF/dd, dF/dv; entries with d <= 0 give zeros.
Friction law: (n, u, p, g, dg)  sliding speed u >= 0 -> g = mu(u)/u and dg/du, finite at u = 0.
Parameter vectors are those of ``normal_parameters`` and ``friction_parameters``.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from math import copysign, exp, sqrt
from typing import Any, NamedTuple

import numba
import numpy as np
from numba import types
from scipy.optimize import brentq

from flexcage.contacts import spec as specs
from flexcage.contacts.own_laws import check_friction, check_normal
from flexcage.contacts.spec import DecayFriction, EhlTraction, FrictionLaw, Lubricant, NormalLaw
from flexcage.core.elementary import exponentials, powers, product_of_powers
from flexcage.core.errors import InputError
from flexcage.core.jit import kernel, kernel_of, why_not_compiled
from flexcage.core.kernel_values import KernelType
from flexcage.core.registry import add, check_free, source_of
from flexcage.geometry.hertz import PointContact
from flexcage.geometry.materials import MATERIALS

_F8, _A, _I8 = types.float64, types.Array(types.float64, 1, "C"), types.int64
NORMAL_SIGNATURE = types.void(_I8, *[_A] * 8)
FRICTION_SIGNATURE = types.void(_I8, _A, _A, _A, _A)
_ARGUMENTS = {
    NORMAL_SIGNATURE: "n, d, v, onset, p, F, Fe, Fd, Fv",
    FRICTION_SIGNATURE: "n, u, p, g, dg",
}
NORMAL_TYPE = KernelType(NORMAL_SIGNATURE)
FRICTION_TYPE = KernelType(FRICTION_SIGNATURE)

N_NORMAL = 10  # stiffness and exponent of the elastic force, and what else a law needs
N_FRICTION = 10
# places in p, of a normal law
STIFFNESS, EXPONENT = 0, 1  # of all laws: elastic force
DISSIPATION, FLOOR = 2, 3  # of ``restitution``: lambda, and the least speed of onset
DAMPING, FULL_DEPTH = 2, 3  # of ``impact_step``
# of a friction law
T_A, T_B, T_C, T_D, T_SLOPE = range(5)  # of ``traction``: Gupta's letters, and mu/u at u = 0
STATIC, DYNAMIC, V_STATIC, V_DYNAMIC = range(4)  # of Coulomb's: coefficients, then their speeds
DECAY = 3  # of ``decay_coulomb``, in place of a second speed


@kernel(NORMAL_SIGNATURE)
def elastic(n, d, v, onset, p, F, Fe, Fd, Fv):
    """F = K d^n, nothing dissipated."""
    powers(n, d, p[EXPONENT] - 1.0, Fd)
    for k in range(n):
        slope = p[STIFFNESS] * Fd[k]
        F[k] = Fe[k] = slope * d[k]
        Fd[k], Fv[k] = p[EXPONENT] * slope, 0.0


@kernel(NORMAL_SIGNATURE)
def restitution(n, d, v, onset, p, F, Fe, Fd, Fv):
    """F = K d^n (1 + (lambda/v0) v), Hunt-Crossley family, clipped at zero."""
    powers(n, d, p[EXPONENT] - 1.0, Fd)
    for k in range(n):
        chi = p[DISSIPATION] / max(onset[k], p[FLOOR])
        factor = 1.0 + chi * v[k]
        slope = p[STIFFNESS] * Fd[k]
        Fe[k] = slope * d[k]
        slope = slope if factor > 0.0 else 0.0
        F[k], Fd[k], Fv[k] = slope * d[k] * factor, p[EXPONENT] * slope * factor, slope * d[k] * chi


@kernel(NORMAL_SIGNATURE)
def impact_step(n, d, v, onset, p, F, Fe, Fd, Fv):
    """F = K d^n + c_max STEP(d, 0, 0, d_max, 1) v, clipped at zero (ADAMS IMPACT)."""
    powers(n, d, p[EXPONENT] - 1.0, Fd)
    for k in range(n):
        slope = p[STIFFNESS] * Fd[k]
        x = min(max(d[k] / p[FULL_DEPTH], 0.0), 1.0)
        c = p[DAMPING] * x * x * (3.0 - 2.0 * x)
        Fe[k] = slope * d[k]
        force = Fe[k] + c * v[k]
        if force > 0.0:
            F[k], Fv[k] = force, c
            Fd[k] = p[EXPONENT] * slope + p[DAMPING] * 6.0 * x * (1.0 - x) / p[FULL_DEPTH] * v[k]
        else:
            F[k] = Fd[k] = Fv[k] = 0.0


@kernel(FRICTION_SIGNATURE)
def no_friction(n, u, p, g, dg):
    """mu = 0."""
    for k in range(n):
        g[k] = dg[k] = 0.0


@kernel(FRICTION_SIGNATURE)
def traction(n, u, p, g, dg):
    """Gupta: mu = (A + B u) exp(-C u) + D with A = -D, so mu(0) = 0."""
    exponentials(n, u, -p[T_C], dg)
    for k in range(n):
        x, e = u[k], dg[k]
        if x < 1e-7:
            g[k], dg[k] = p[T_SLOPE], 0.0
        else:
            mu = (p[T_A] + p[T_B] * x) * e + p[T_D]
            dmu = (p[T_B] - p[T_C] * (p[T_A] + p[T_B] * x)) * e
            g[k] = mu / x
            dg[k] = (dmu - g[k]) / x


@kernel(FRICTION_SIGNATURE)
def step_coulomb(n, u, p, g, dg):
    """ADAMS static/dynamic friction."""
    for k in range(n):
        x = u[k]
        if x < p[V_STATIC]:
            s = x / p[V_STATIC]
            g[k] = p[STATIC] * (3.0 - s * s) / (2.0 * p[V_STATIC])
            dg[k] = -p[STATIC] * s / (p[V_STATIC] * p[V_STATIC])
        else:
            if x < p[V_DYNAMIC]:
                s = (x - p[V_STATIC]) / (p[V_DYNAMIC] - p[V_STATIC])
                mu = p[STATIC] + (p[DYNAMIC] - p[STATIC]) * s * s * (3.0 - 2.0 * s)
                dmu = (p[DYNAMIC] - p[STATIC]) * 6.0 * s * (1.0 - s) / (p[V_DYNAMIC] - p[V_STATIC])
            else:
                mu, dmu = p[DYNAMIC], 0.0
            g[k] = mu / x
            dg[k] = (dmu - g[k]) / x


@kernel(FRICTION_SIGNATURE)
def ramp_coulomb(n, u, p, g, dg):
    """Ambrosio's ramp: none below v_static, full above."""
    for k in range(n):
        x = u[k]
        if x <= p[V_STATIC]:
            g[k] = dg[k] = 0.0
        else:
            if x < p[V_DYNAMIC]:
                mu = p[DYNAMIC] * (x - p[V_STATIC]) / (p[V_DYNAMIC] - p[V_STATIC])
                dmu = p[DYNAMIC] / (p[V_DYNAMIC] - p[V_STATIC])
            else:
                mu, dmu = p[DYNAMIC], 0.0
            g[k] = mu / x
            dg[k] = (dmu - g[k]) / x


@kernel(FRICTION_SIGNATURE)
def decay_coulomb(n, u, p, g, dg):
    """LS-DYNA's mu = f_d + (f_s - f_d) exp(-DC u), with a cubic step from rest to v_static."""
    exponentials(n, u, -p[DECAY], dg)
    for k in range(n):
        x, excess = u[k], (p[STATIC] - p[DYNAMIC]) * dg[k]
        mu, dmu = p[DYNAMIC] + excess, -p[DECAY] * excess
        if x < p[V_STATIC]:
            s = x / p[V_STATIC]
            rise = (3.0 - s * s) / (2.0 * p[V_STATIC])
            g[k] = mu * rise
            dg[k] = dmu * rise - mu * s / (p[V_STATIC] * p[V_STATIC])
        else:
            g[k] = mu / x
            dg[k] = (dmu - g[k]) / x


def exact_dissipation(e: float) -> float:
    """lambda of F = K d^n (1 + (lambda/v0) d') that gives restitution e exactly, for any n, K, m.

    Solves ln[(1+lambda)/(1-lambda e)] = lambda (1+e) for its positive root.
    """
    if e > 1.0 - 1e-6:
        return 1.5 * max(1.0 - e, 0.0)  # series; the difference of logarithms is all rounding

    def equation(lam: float) -> float:
        return np.log1p(lam) - np.log1p(-lam * e) - lam * (1.0 + e)

    upper = (1.0 - 1e-13) / e
    if equation(upper) < 0.0:
        return upper  # below e = 0.031 the root is 1/e to rounding
    # f ~ (e^2 - 1) lambda^2/2 < 0 near the trivial root, +inf at 1/e
    return float(brentq(equation, 1e-3 * (1.0 - e), upper, xtol=1e-15, rtol=1e-14))


def gupta_coefficients(peak: float, peak_speed: float, high: float) -> tuple[float, ...]:
    """A, B, C, D of the traction curve through mu(0) = 0, mu(peak_speed) = peak (a maximum)."""
    d, a = high, -high
    if high == 0.0:  # B u exp(-C u) alone
        return 0.0, peak * exp(1.0) / peak_speed, 1.0 / peak_speed, 0.0

    def miss(c: float) -> float:
        b = a * c / (1.0 - c * peak_speed)
        return (a + b * peak_speed) * exp(-c * peak_speed) + d - peak

    c = brentq(miss, (1.0 + 1e-6) / peak_speed, 500.0 / peak_speed)
    return a, a * c / (1.0 - c * peak_speed), c, d


def _elastic_parameters(law: NormalLaw, stiffness: float, exponent: float) -> Sequence[float]:
    return stiffness, exponent


def _restitution_parameters(law: NormalLaw, stiffness: float, exponent: float) -> Sequence[float]:
    return stiffness, exponent, exact_dissipation(law.restitution), law.speed_floor


def _impact_parameters(law: NormalLaw, stiffness: float, exponent: float) -> Sequence[float]:
    return stiffness, exponent, law.damping, law.full_damping_depth


def _lankarani_parameters(law: NormalLaw, stiffness: float, exponent: float) -> Sequence[float]:
    return stiffness, exponent, 0.75 * (1.0 - law.restitution**2), law.speed_floor


def _traction_parameters(law: FrictionLaw) -> Sequence[float]:
    a, b, c, d = gupta_coefficients(law.peak, law.peak_speed, law.high_speed)
    return a, b, c, d, b - c * a


def _ehl_parameters(law: EhlTraction) -> Sequence[float]:
    """Gupta's curve without its maximum."""
    slope = law.limit / law.creep_speed
    return -law.limit, 0.0, 1.0 / law.creep_speed, law.limit, slope


def _coulomb_parameters(law: FrictionLaw) -> Sequence[float]:
    return law.static, law.dynamic, law.v_static, law.v_dynamic


def _decay_parameters(law: DecayFriction) -> Sequence[float]:
    return law.static, law.dynamic, law.v_static, law.decay


NORMAL_LAWS: dict[str, Any] = {
    "elastic": elastic,
    "restitution": restitution,
    "impact_step": impact_step,
    "impact": impact_step,
    "lankarani_nikravesh": restitution,
}
FRICTION_LAWS: dict[str, Any] = {
    "none": no_friction,
    "traction": traction,
    "step_coulomb": step_coulomb,
    "ramp_coulomb": ramp_coulomb,
    "ehl": traction,
    "decay_coulomb": decay_coulomb,
}
# those not named here take the parameters of "elastic" and of "step_coulomb"
NORMAL_PARAMETERS: dict[str, Callable[[Any, float, float], Sequence[float]]] = {
    "restitution": _restitution_parameters,
    "impact_step": _impact_parameters,
    "impact": _impact_parameters,
    "lankarani_nikravesh": _lankarani_parameters,
}
FRICTION_PARAMETERS: dict[str, Callable[[Any], Sequence[float]]] = {
    "traction": _traction_parameters,
    "ehl": _ehl_parameters,
    "decay_coulomb": _decay_parameters,
}


def register_normal(
    name: str,
    law: Callable[..., None],
    *,
    spec: type[NormalLaw] | None = None,
    parameters: Callable[[Any, float, float], Sequence[float]] | None = None,
) -> None:
    """Add a normal law: ``normal.law = "name"`` in a case then asks for it, at any contact place.

    ``law`` is a function (n, d, v, onset, p, F, Fe, Fd, Fv) of the signature above; it is compiled
    here unless it is compiled already. ``spec``, if the law has values of its own, is a frozen
    dataclass derived from ``NormalLaw`` whose fields carry their units (``core.spec``) and whose
    ``law`` defaults to ``name``. ``parameters(spec, K, n)`` gives the law's vector p, at most
    ``N_NORMAL`` numbers, from the spec and the stiffness K [N/m^n] and exponent n of one slice or
    point as geometry and materials make them. p[0] and p[1] must be the stiffness and exponent of
    an elastic force like the law's: the start's equilibrium uses them, and the stored energy is F
    d/(p[1] + 1). Without ``parameters`` p is (K, n).

    Raises InputError for a name that is taken, a law that cannot be compiled, or a wrong spec.
    """
    check_free(NORMAL_LAWS, name, what="normal law")
    _check_own_spec(name, spec, NormalLaw)
    compiled = _compiled(law, NORMAL_SIGNATURE, f"normal law '{name}'")
    add(NORMAL_LAWS, name, compiled, what="normal law", source=law)
    NORMAL_PARAMETERS[name] = parameters or _elastic_parameters
    specs.NORMAL_LAWS[name] = spec


def register_friction(
    name: str,
    law: Callable[..., None],
    *,
    spec: type[FrictionLaw] | None = None,
    parameters: Callable[[Any], Sequence[float]] | None = None,
) -> None:
    """Add a friction law: ``friction.law = "name"`` in a case then asks for it.

    As ``register_normal``, with a function (n, u, p, g, dg), a spec derived from ``FrictionLaw``
    and ``parameters(spec)``, at most ``N_FRICTION`` numbers, all of them the law's. Without
    ``parameters`` p is (static, dynamic, v_static, v_dynamic).
    """
    check_free(FRICTION_LAWS, name, what="friction law")
    _check_own_spec(name, spec, FrictionLaw)
    compiled = _compiled(law, FRICTION_SIGNATURE, f"friction law '{name}'")
    add(FRICTION_LAWS, name, compiled, what="friction law", source=law)
    FRICTION_PARAMETERS[name] = parameters or _coulomb_parameters
    specs.FRICTION_LAWS[name] = spec


def _check_own_spec(name: str, spec: Any, base: type) -> None:
    if spec is None:
        return
    if not (isinstance(spec, type) and issubclass(spec, base) and spec is not base):
        raise InputError(
            f"The spec of law '{name}' must be a dataclass derived from {base.__name__}.",
            where=name,
        )
    default = spec.__dataclass_fields__["law"].default  # type: ignore[attr-defined]
    if default != name:
        raise InputError(
            f"{spec.__name__}.law defaults to '{default}', but must to '{name}', the name under "
            "which it is registered.",
            where=name,
        )


def _compiled(law: Any, signature: Any, what: str) -> Any:
    """The law as numba passes it by value: compiled for exactly this signature."""
    takes = list(inspect.signature(getattr(law, "py_func", law)).parameters)
    if len(takes) != len(signature.args):
        raise InputError(
            f"The {what} takes ({', '.join(takes)}), but must take ({_ARGUMENTS[signature]}).",
            where=what,
            value=takes,
        )
    if numba.config.DISABLE_JIT:  # type: ignore[attr-defined]
        return getattr(law, "py_func", law)
    if hasattr(law, "nopython_signatures"):
        if any(s.args == signature.args for s in law.nopython_signatures):
            return law
        law = law.py_func
    try:
        return kernel_of(law, signature)
    except numba.errors.NumbaError as exc:
        reason = why_not_compiled(exc)
        raise InputError(
            f"The {what} ({_ARGUMENTS[signature]}) cannot be compiled: {reason}.", where=what
        ) from exc


def friction_parameters(law: FrictionLaw) -> np.ndarray:
    """Parameter vector (N_FRICTION,) of a friction law."""
    own = FRICTION_PARAMETERS.get(law.law, _coulomb_parameters)(law)
    p = _vector(own, N_FRICTION, f"friction law '{law.law}'")
    if source_of(law.law):
        check_friction(FRICTION_LAWS[law.law], law.law, tuple(p[: len(own)]))
    return p


def normal_parameters(
    law: NormalLaw, stiffness: float, exponent: float, *, parts: int = 1
) -> np.ndarray:
    """Parameter vector (N_NORMAL,) of the normal law of one of the equal ``parts`` (slices, points)
    of a contact, whose ``stiffness`` is that of them all [N/m^exponent]."""
    build = NORMAL_PARAMETERS.get(law.law, _elastic_parameters)
    stiffness, exponent = law.elastic(stiffness, exponent)
    own = build(law.shared_by(parts), stiffness * law.stiffness_factor / parts, exponent)
    p = _vector(own, N_NORMAL, f"normal law '{law.law}'")
    if p[STIFFNESS] < 0.0 or p[EXPONENT] < 1.0:
        raise InputError(
            f"The parameters of normal law '{law.law}' begin with {p[:2]}, but must be a stiffness "
            "of 0 or more and an exponent of 1 or more.",
            where=law.law,
        )
    if source_of(law.law):
        check_normal(NORMAL_LAWS[law.law], law.law, tuple(p[: len(own)]))
    return p


def _vector(own: Sequence[float], length: int, what: str) -> np.ndarray:
    values = np.asarray(own, float)
    if values.ndim != 1 or len(values) > length or not np.isfinite(values).all():
        raise InputError(
            f"The parameters of {what} are {values}, but must be at most {length} finite numbers.",
            where=what,
        )
    return np.concatenate([values, np.zeros(length - len(values))])


def iso_line_stiffness(effective_length: float, modulus: float) -> float:
    """ISO/TS 16281 stiffness of ONE roller-race contact [N/m^(10/9)].

    c_L = 35948 Lwe^(8/9) N/mm^(10/9) is for steel, and both races in series; one contact is
    2^(10/9) c_L. ``modulus`` is E' = 2/((1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2) [Pa] of roller and
    race. What elastic bodies of one shape yield depends on Q/E' alone, so that a force in
    proportion to d^(10/9) is in proportion to E'; A. Palmgren's d = 1.36 [Q sum((1 - nu^2)/E)]^0.9
    / L^0.8, of which the standard's form is, says the same. The standard states no modulus of its
    steel: it is taken to be that of ``GCr15`` here.
    """
    c_mm = 35948.0 * (effective_length * 1e3) ** (8.0 / 9.0) * 2.0 ** (10.0 / 9.0)
    return c_mm * 1e3 ** (10.0 / 9.0) * (modulus / MATERIALS["GCr15"].plane_strain_modulus)


# c of 2 q (1-nu^2)/(pi E) [ln(4 w/b) - c]: how much more the middle of a Hertzian pressure on the
# end of a strip moves than that end does, in the mean, under the same load spread all over it;
# body forces balance both. On a half-plane c is 1 against the mean of the spread load's
# displacement, ln 2 + 1/2 = 1.19 against its middle. The strip ends in free corners: it moves
# evenly under the even load (plain compression) and more than a half-plane under the other. Finite
# elements of the section: 1.26 where it is deep, 1.28 to 1.33 for crossbeams 0.75 to 4 times as
# wide as high, 1.335 for the N1013's (a wedge, 0.93, touched a little off its middle). The value
# below keeps the wall's share within 1.2 % for all of them.
PATCH_CONSTANT = 1.31


def pocket_line_law(
    *,
    radius: float,
    length: float,
    roller: tuple[float, float],
    wall: tuple[float, float],
    depth: float,
    patch_half_width: float = 0.0,
    loads: tuple[float, float] = (0.5, 500.0),
) -> tuple[float, float]:
    """Stiffness and exponent of a roller against a flat wall, F = K d^n, fitted over ``loads`` [N].

    Johnson, Contact Mechanics 5.6: the roller yields q (1-nu^2)/(pi E) [2 ln(4 R/b) - 1] to its
    axis, the wall q (1-nu^2)/(pi E) [2 ln(2 h/b) - nu/(1-nu)] to a point ``depth`` h inside it.
    With ``patch_half_width`` w > 0 the wall's mesh already yields by the mean displacement of its
    face under the same load spread over the face's whole height 2 w, so the wall contributes only
    the difference, 2 q (1-nu^2)/(pi E) [ln(4 w/b) - PATCH_CONSTANT], which no longer depends on
    depth.
    ``roller`` and ``wall`` are (E, nu).
    """
    soft = [(1.0 - nu**2) / e for e, nu in (roller, wall)]
    q = np.geomspace(loads[0], loads[1], 40) / length
    b = np.sqrt(4.0 * q * radius * (soft[0] + soft[1]) / np.pi)
    approach = q * soft[0] / np.pi * (2.0 * np.log(4.0 * radius / b) - 1.0)
    if patch_half_width > 0.0:
        approach += (
            2.0 * q * soft[1] / np.pi * (np.log(4.0 * patch_half_width / b) - PATCH_CONSTANT)
        )
    else:
        lateral = wall[1] / (1.0 - wall[1])
        approach += q * soft[1] / np.pi * (2.0 * np.log(2.0 * depth / b) - lateral)
    if approach.min() <= 0.0:
        one, other = (f"{e / 1e9:.4g} GPa" for e, _ in (roller, wall))
        raise InputError(
            f"The contact of a roller ({one}) on the cage's pocket ({other}) becomes as wide as "
            f"its bodies under {loads[1]:g} N, where no law of line contact holds; are "
            "cage.material.youngs_modulus and bearing.material.youngs_modulus, or that of "
            "bearing.element_material, in the unit meant?",
            where="cage.material.youngs_modulus",
            value=wall[0],
        )
    exponent, intercept = np.polyfit(np.log(approach), np.log(q * length), 1)
    return float(np.exp(intercept)), float(exponent)


def land_line_law(
    *,
    radius: float,
    clearance: float,
    length: float,
    cage: tuple[float, float],
    ring: tuple[float, float],
    depth: float,
    loads: tuple[float, float] = (0.5, 50.0),
) -> tuple[float, float]:
    """Stiffness and exponent of a cage's land on a ring's, F = K d^n, fitted over ``loads`` [N].

    Two cylinders that differ by ``clearance`` in radius touch like one of radius
    R (R + c)/c on a flat, over a half-width b; each yields
    q (1-nu^2)/(pi E) [2 ln(2 h/b) - nu/(1-nu)] to a point ``depth`` h inside it (Johnson, Contact
    Mechanics 5.6). That holds for b well below h; a closer fit is taken to be as stiff as one of
    b = h/2 at the largest load, which its touch over a wider arc exceeds.
    ``cage`` and ``ring`` are (E, nu).
    """
    soft = [(1.0 - nu**2) / e for e, nu in (cage, ring)]
    q = np.geomspace(loads[0], loads[1], 40) / length
    b = np.sqrt(4.0 * q * radius * (radius + clearance) / clearance * sum(soft) / np.pi)
    b *= min(1.0, 0.5 * depth / b[-1])
    approach = sum(
        q * s / np.pi * (2.0 * np.log(2.0 * depth / b) - nu / (1.0 - nu))
        for s, (_, nu) in zip(soft, (cage, ring), strict=True)
    )
    exponent, intercept = np.polyfit(np.log(approach), np.log(q * length), 1)
    return float(np.exp(intercept)), float(exponent)


def flat_end_stiffness(radius: float, one: tuple[float, float], two: tuple[float, float]) -> float:
    """Linear stiffness [N/m] of a flat circular end on a half-space, 2 E* a (Johnson 3.4)."""
    compliance = sum((1.0 - nu**2) / e for e, nu in (one, two))
    return 2.0 * radius / compliance


IVR_CONSTANT = 2.0796226511  # F = c sqrt(eta u Q L): Martin's film, a test derives it


def rolling_resistance(lubricant, radius: float, length: float, modulus: float) -> np.ndarray:
    """Coefficients (c_ehl, c_ivr) of the rolling resistance of one contact, zeros for "none".

    Elastohydrodynamic (Goksem and Hargreaves 1978): F = (4.318/alpha)(G U)^0.658 W^0.0126 R L
    = c_ehl u^0.658 Q^0.0126; rigid-isoviscous (Martin's film): F = c_ivr sqrt(u Q), smaller
    where the contact is light. u: entrainment speed [m/s], Q: load [N], U = eta u/(E' R),
    W = Q/(E' R L), G = alpha E', E' = 2/sum((1-nu^2)/E). ``blended`` takes the smaller, smoothly.

    The force is that on one surface of a fully flooded, isothermal contact: the limit theta = 0 of
    F/L = (R/alpha) W D^(0.658228 + 0.0106383 theta^0.3174603) exp(-0.162625)
    / (1 + 0.411483 theta^0.707071), D = 11.8122 G U/W^1.5, the fit that open bearing programs quote
    after Goksem. Its constant is then 4.3173 and its exponent of W 0.01266, of which 4.318 and
    0.0126 are the usual rounding. The heat of shear in the inlet, theta = eta beta u^2/k (beta:
    loss of viscosity per kelvin, k: conductivity), lowers the force and is not modelled.
    """
    kind = lubricant.rolling_resistance
    if kind == "none":
        return np.zeros(2)
    alpha = lubricant.pressure_coefficient
    speed = alpha * lubricant.viscosity / radius  # G U = alpha eta u / R
    load = 1.0 / (modulus * radius * length)
    ehl = 4.318 / alpha * speed**0.658 * load**0.0126 * radius * length
    ivr = IVR_CONSTANT * sqrt(lubricant.viscosity * length) if kind == "blended" else np.inf
    return np.array([ehl, ivr])


def point_rolling_resistance(lubricant: Lubricant, contact: PointContact) -> np.ndarray:
    """(factor, powers of roll rate [rad/s] and load [N]) of a ball's resisting moment [N m].

    Houpert's force at one surface of a point contact, F = 2.86 E' R^2 kappa^0.348 G^0.022 U^0.66
    W^0.47, with U = eta u/(E' R), W = Q/(E' R^2), G = alpha E' (L. Houpert, Piezoviscous-rigid
    rolling and sliding traction forces, J. Tribol. 109 (1987) 363): isothermal and fully flooded.
    Two surfaces lose 2 F u while ball and race turn at u/R against each other, so M = 2 F R: a
    couple, which leaves both in balance. The line contact's two formulas have no counterpart: any
    choice but "none" is this one.
    """
    if lubricant.rolling_resistance == "none":
        return np.zeros(3)
    R, modulus = contact.rolling, contact.modulus
    speed = lubricant.viscosity / modulus  # U = eta (w R)/(E' R)
    load = 1.0 / (modulus * R * R)
    force = 2.86 * modulus * R * R * contact.ratio**0.348
    force *= (lubricant.pressure_coefficient * modulus) ** 0.022 * speed**0.66 * load**0.47
    return np.array([2.0 * force * R, 0.66, 0.47])


@kernel
def rolling_forces(n, c, u, q, out):
    """Rolling resistance [N] of n contacts at entrainment speeds u under loads q, signed as u."""
    for k in range(n):
        speed, load = max(abs(u[k]), 1e-100), max(q[k], 1e-100)
        ehl = c[0] * product_of_powers(speed, 0.658, load, 0.0126)
        ratio = ehl / (c[1] * sqrt(speed * load))  # of films, the second may be infinite
        ratio *= ratio
        force = copysign(ehl / sqrt(sqrt(1.0 + ratio * ratio)), u[k])
        out[k] = force if c[0] > 0.0 and q[k] > 0.0 and u[k] != 0.0 else 0.0


class LandFilm(NamedTuple):
    """Oil between a cage's land and its ring's: viscosity [Pa s], then sizes [m]."""

    viscosity: float
    width: float
    radius: float
    clearance: float


@kernel
def short_bearing(film, eccentricity, rate, w_sum, w_diff):
    """Half-Sommerfeld short-bearing land film: both components of the force [N], and the size of
    the moment [N m].

    Eccentricity and its rate (y, z) are those of the cage against the ring [m, m/s], ``w_sum`` the
    sum and ``w_diff`` the difference of angular speeds. Whirl enters by replacing U = R w_sum by
    U - 2 R whirl speed; squeeze by the full-film term. Ghaisas/Gupta steady form.
    """
    eta, L, R, C = film
    (ey, ez), (vy, vz) = eccentricity, rate
    e = sqrt(ey * ey + ez * ez)
    moment = 2.0 * np.pi * eta * R * w_diff * R * R * L / C
    if e < 1e-12:
        factor = np.pi * eta * R * L**3 / C**3
        fy = -factor * vy - 0.25 * factor * (w_sum * ez)
        fz = -factor * vz + 0.25 * factor * (w_sum * ey)
        return fy, fz, moment
    eps = min(e / C, 0.98)
    s = 1.0 - eps * eps
    cy, cz = ey / e, ez / e
    radial = (vy * cy + vz * cz) / C
    whirl = (cy * vz - cz * vy) / e
    U = R * w_sum - 2.0 * R * whirl
    fr = -eta * U * L**3 * eps * eps / (C * C * s * s) * np.sign(U)
    fr -= np.pi * eta * R * L**3 * radial * (1.0 + 2.0 * eps * eps) / (C * C * s**2.5)
    ft = np.pi * eta * U * L**3 * eps / (4.0 * C * C * s**1.5)
    return fr * cy - ft * cz, fr * cz + ft * cy, moment / sqrt(s)
