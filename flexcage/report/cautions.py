"""What a reader of a run's figures must be warned of, from the figures themselves."""

from __future__ import annotations

from math import isfinite

from flexcage.results.audit import EXCEEDED, OF_CAGE, OF_DRIVE
from flexcage.results.bootstrap import FEWEST
from flexcage.results.summary import Summary


def cautions(
    summary: Summary,
    *,
    reached: float,
    duration: float,
    proof_stress: float,
    material: str,
    element: str = "roller",
) -> list[str]:
    """Warnings, one sentence each: an unfinished run, too few passes, drift, audit, slip, yield.

    ``reached`` and ``duration`` [s]: where the run stands and where it should end;
    ``proof_stress`` [Pa] of the cage's ``material``; ``element`` is "roller" or "ball".
    """
    found = [
        _unfinished(reached, duration),
        _few_passes(summary, element),
        _drift(summary),
        _audit(summary),
        _slip(summary, element),
        _yield(summary, proof_stress, material),
        _pinched(summary, element),
        *(_over_edge(summary, race) for race in ("inner", "outer")),
    ]
    return [text for text in found if text]


def _number(summary: Summary, key: str) -> float:
    """A figure, or NaN where the summary has none."""
    value = summary[key] if key in summary else None
    return float(value) if isinstance(value, (int, float)) else float("nan")


def _unfinished(reached: float, duration: float) -> str:
    if reached >= duration * (1.0 - 1e-3):
        return ""
    return (
        f"The run stopped at {reached * 1e3:.4g} ms of {duration * 1e3:.4g} ms; 'flexcage run "
        "--resume' goes on with it."
    )


def _few_passes(summary: Summary, element: str) -> str:
    count = _number(summary, "roller_passes")
    if not count < FEWEST:
        return ""
    return (
        f"Statistics rest on {count:.0f} {element} passes, and intervals want {FEWEST}: they are "
        "missing or too narrow; a longer solver.duration gives more."
    )


def _drift(summary: Summary) -> str:
    drift = summary["drift"] if "drift" in summary else None
    if drift in (None, "nothing"):
        return ""
    return (
        f"The two halves of the run differ beyond the intervals in: {drift}; it has not settled, "
        "so raise output.settle or solver.duration."
    )


def _audit(summary: Summary) -> str:
    if "energy_audit" not in summary or summary["energy_audit"] != EXCEEDED:
        return ""
    shares = (
        (_number(summary, "energy_of_drive"), "the drive's work", OF_DRIVE),
        (_number(summary, "energy_of_cage"), "the cage's losses", OF_CAGE),
    )
    known = " and ".join(
        f"{100.0 * share:.2g} % of {what} (at most {100.0 * most:g} %)"
        for share, what, most in shares
        if isfinite(share)
    )
    return f"The energy audit is exceeded: the imbalance is {known}; tighten solver.tolerance."


def _slip(summary: Summary, element: str) -> str:
    note = summary.row("slip_loaded").note if "slip_loaded" in summary else ""
    if not note.startswith("unresolved"):
        return ""
    return f"{element.capitalize()} slip in the loaded zone is {note}."


def _yield(summary: Summary, proof_stress: float, material: str) -> str:
    peak = max(
        (v for v in (_number(summary, k) for k in ("stress_peak", "stress_start")) if isfinite(v)),
        default=0.0,
    )
    if peak <= proof_stress:
        return ""
    return (
        f"The stress reaches {peak / 1e6:.0f} MPa, more than the proof stress of {material} "
        f"({proof_stress / 1e6:.0f} MPa): a real cage would yield there, and this one is linear "
        "elastic."
    )


def _over_edge(summary: Summary, race: str) -> str:
    if not _number(summary, f"edge_{race}") > 0.0:
        return ""
    row = summary.row(f"edge_{race}")
    return (
        f"A contact ellipse runs over the {race} groove's edge by {row.text} deg ({row.note}); its "
        "edge pressure is not computed."
    )


def _pinched(summary: Summary, element: str) -> str:
    if "pinch_force" not in summary:
        return ""
    row = summary.row("pinch_force")
    return (
        f"The bearing was assembled with {element}s pinched by up to {row.text} N ({row.note}): "
        "the cage is pre-stressed."
    )
