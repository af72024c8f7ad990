"""What a map says, as text and as files: indices of its outputs, and the noise of starts."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from flexcage.core.errors import EnvironmentLacks, InputError
from flexcage.core.listing import wrapped
from flexcage.results.export import frame_to_csv
from flexcage.study.maps import MapResults
from flexcage.study.sensitivity import KINDS, Index

_MOST = 3  # unknowns that a line names


def index_rows(results: MapResults) -> list[dict[str, Any]]:
    """One row an output, condition and unknown: the index, its margin, and whether it matters.

    Empty, with no error, where SALib is not installed or too few runs are done.
    """
    rows = []
    for output in results.study.about.outputs:
        for condition in results.conditions:
            for index in _indices(results, output, condition):
                rows.append({
                    "output": output, "condition": condition, "unknown": index.name,
                    "index": index.value, "+-": index.margin, "matters": index.matters,
                })  # fmt: skip
    return rows


def _indices(results: MapResults, output: str, condition: str) -> list[Index]:
    try:
        return results.indices(output, condition)
    except (EnvironmentLacks, InputError):
        return []


def map_text(results: MapResults) -> str:
    """The map in words: what was computed, and for every output what moves it beyond the dummy."""
    about = results.about
    kind = KINDS[about["design"]]
    points = f"{len(results.shares)} points of {len(results.names) - 1} unknowns"
    lines = [
        *results.study.cautions(),
        f"{points} ({about['design']}, seed {about['seed']}), "
        f"{len(results.conditions)} conditions, "
        f"{about['starts']} start{'s' * (about['starts'] > 1)} each: {results.study.status()}; "
        f"{results.seconds:,.0f} s of processor time",
    ]
    for output in results.study.about.outputs:
        for condition in results.conditions:
            found = _indices(results, output, condition)
            if not found:
                lines.append(f"{output}, {condition}: no {kind}; too few runs, or SALib is missing")
                continue
            strong = sorted((i for i in found if i.matters), key=lambda i: -i.value)[:_MOST]
            names = ", ".join(f"{i.name} ({i.value:.3g})" for i in strong)
            noise = results.noise(output, condition)
            starts = "" if math.isnan(noise) else f"; starts make {noise:.0%} of the variance"
            lines.append(
                f"{output}, {condition}: {names or 'nothing exceeds the dummy'} "
                f"({kind}; dummy {found[-1].value:.3g}){starts}"
            )
    return "\n".join(wrapped(line, rest="  ") for line in lines)


def write_map(results: MapResults) -> list[Path]:
    """Write ``map.csv``, a row a run, and ``indices.csv`` into the map's folder; their paths."""
    import pandas as pd

    folder = results.study.folder.path
    paths = [frame_to_csv(results.table, folder / "map.csv")]
    rows = index_rows(results)
    if rows:
        paths.append(frame_to_csv(pd.DataFrame(rows), folder / "indices.csv"))
    return paths
