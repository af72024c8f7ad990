"""Table 4 of "Machines 2024, 12(7), 466": the cage's measured slip beside the computed, in parts.

    python examples/papers/riveted_cage_slip.py RUN [RUN ...]     # folders of runs at 9000 rpm

Equation 10 compares the cage with omega_m = omega_i (1 - D/dm)/2, which knows no contact angle. Its
slip is the sum of four parts, all over omega_m: balls larger than the printed 6.47 mm, by which
omega_m is computed (reference); balls that roll at a contact angle (angle), and on lines beside
the middle of curved contacts (curvature), which both let the cage lead; and what is left, balls and
cage that slide behind (traction).
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence

import flexcage
from flexcage.results.metrics import rolling_by_curvature, settled

PRINTED_BALL, PRINTED_PITCH = 6.47e-3, 26e-3
#: Shown rows of table 4, 9000 rpm: measured and the paper's own computed slip.
TABLE_4 = {"modified": (0.0113, 0.0104), "original": (0.0184, 0.0167)}


def parts(run: flexcage.Run) -> dict[str, float]:
    """The slip of equation 10 and its four parts, which sum to it."""
    s, bearing = run.summary, run.case.bearing
    inner = float(run.case.drive.speed)
    reference = 0.5 * inner * (1.0 - PRINTED_BALL / PRINTED_PITCH)
    flat = 0.5 * inner * (1.0 - bearing.ball_diameter / bearing.pitch_diameter)
    cage = abs(float(s["cage_speed"]))
    rolling = cage / (1.0 - float(s["cage_slip_ratio"]))  # at the run's contact angles
    curved = rolling_by_curvature(settled(run.dataset, run.case.output.settle), run.numbers)
    share = 0.0 if curved is None else curved.cage_slip
    return {
        "equation 10": 1.0 - cage / reference,
        "reference": (reference - flat) / reference,
        "angle": (flat - rolling) / reference,
        "curvature": share * rolling / reference,
        "traction": (rolling * (1.0 - share) - cage) / reference,
    }


def table(runs: Mapping[str, flexcage.Run]) -> str:
    """Markdown: measured rows, then every run."""
    names = ("equation 10", "reference", "angle", "curvature", "traction")
    lines = ["| case | " + " | ".join(f"{n} [%]" for n in names) + " |", "| --- " * 6 + "|"]
    for cage, (measured, own) in TABLE_4.items():
        rest = " |  |  |  |  |"
        lines.append(f"| {cage}, measured | {100.0 * measured:.2f}{rest}")
        lines.append(f"| {cage}, the paper's model | {100.0 * own:.2f}{rest}")
    for name, run in runs.items():
        found = parts(run)
        lines.append(f"| {name} | " + " | ".join(f"{100.0 * found[n]:.2f}" for n in names) + " |")
    return "\n".join(lines)


def main(arguments: Sequence[str] | None = None) -> str:
    """Print the table of some runs."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("runs", nargs="+", help="folders of runs")
    options = parser.parse_args(arguments)
    text = table({folder: flexcage.load_run(folder) for folder in options.runs})
    print(text)
    return text


if __name__ == "__main__":
    main()
