"""A body as its file has it, in words: what is compared with the mode table after the import."""

from __future__ import annotations

import numpy as np

from flexcage.modes.exchange.body import RESIDUAL, ReducedBody
from flexcage.modes.exchange.checks import elastic_modes

_SHOWN = 40  # frequencies


def body_table(body: ReducedBody, *, where: str = "body") -> str:
    """Nodes, coordinates, mass, centre and inertia of a body, and its elastic frequencies.

    Mass and inertia are those of its rigid motions, if it holds them all. Frequencies are those of
    its eigenmodes, or of its dynamic coordinates where it names kinds.
    """
    lines = [f"{body.source or 'body'}: {_size(body)}", *_rigid(body)]
    if body.mass is None or body.is_full:
        return "\n".join(lines)
    frequencies, kinds = _frequencies(body, where)
    lines.append(f"{'no':>4s}  {'kind':<12s} {'frequency':>12s}")
    shown = zip(kinds[:_SHOWN], frequencies[:_SHOWN])
    lines += [f"{i + 1:4d}  {kind:<12s} {f:9.1f} Hz" for i, (kind, f) in enumerate(shown)]
    if len(frequencies) > _SHOWN:
        more = len(frequencies) - _SHOWN
        lines.append(f"      and {more} more, up to {frequencies.max():.1f} Hz")
    return "\n".join(lines)


def _frequencies(body: ReducedBody, where: str) -> tuple[np.ndarray, list[str]]:
    """Frequencies (m,) [Hz] and kinds of the dynamic coordinates, or of all eigenmodes."""
    if body.kind:
        dynamic = np.array(body.kind) != RESIDUAL
        stiffness, mass = (np.diag(m)[dynamic] for m in body.dense())
        return np.sqrt(stiffness / mass) / (2.0 * np.pi), [k for k in body.kind if k != RESIDUAL]
    values, _ = elastic_modes(body, where=where)
    return np.sqrt(values) / (2.0 * np.pi), ["elastic"] * len(values)


def _size(body: ReducedBody) -> str:
    nodes = f"{len(body.nodes):,} nodes"
    if body.is_full:
        return f"full matrices of {nodes}"
    shaped = "no shapes" if body.shapes is None else "shapes"
    residual = body.kind.count(RESIDUAL)
    quasi = f" ({residual} of them quasi-static)" if residual else ""
    return f"{body.size} coordinates{quasi}, {shaped} of {nodes}, {len(body.boundary)} of boundary"


def _rigid(body: ReducedBody) -> list[str]:
    if body.rigid is None or body.mass is None:
        return []
    whole = np.asarray(body.rigid.T @ (body.mass @ body.rigid))
    mass = whole[0, 0]
    # mass times the cross product of the centre: the translations' coupling to the rotations
    centre = np.array([whole[1, 5], whole[2, 3], whole[0, 4]]) / mass
    inertia = np.diag(whole)[3:]
    return [
        f"mass {mass:.5g} kg, centre ({', '.join(f'{1e3 * c:.4g}' for c in centre)}) mm, inertia "
        f"about x, y, z {', '.join(f'{i:.4g}' for i in inertia)} kg m^2"
    ]
