"""Bodies as DMIG entries of a Nastran bulk file (.pch), through pyYeti.

Rows and columns carry grid numbers and components; the GRID entries of the same file, if it has
any, say where they are.
"""

from __future__ import annotations

import re
from collections import Counter
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.core.arrays import Damaged
from flexcage.core.memory import in_bytes, total_memory
from flexcage.modes.exchange.body import ReducedBody
from flexcage.modes.exchange.contents import (
    MASS,
    STIFFNESS,
    Contents,
    from_matrices,
    labels_of,
    numbers_of,
    picked,
    refuse_twice,
    unreadable,
    warn_of_damping,
)
from flexcage.modes.exchange.nastran import nastran
from flexcage.modes.exchange.nodes import bulk_text, read_grids

# the first entry of a matrix, which has 0 where the others have a grid
_HEADS = re.compile(r"^DMIG\*?[ ,]+(\w+)[ ,]+0[ ,]", re.MULTILINE | re.IGNORECASE)
_COPIES = 6.0  # of a matrix while it is read


def read(path: Path, *, where: str) -> Contents:
    """Stiffness and mass of the DMIG entries, and the file's own GRID entries."""
    module = _module()
    try:
        text = bulk_text(path)
        refuse_twice(_HEADS.findall(text), path, where=where)
        _check_memory(text)
        found = module.rddmig(StringIO(text), square=True, expanded=False)
        grids = read_grids(path, where=where, needed=False)
    except Exception as error:  # of all kinds on broken files
        if hasattr(error, "where"):
            raise
        raise unreadable(path, error, where=where) from error
    warn_of_damping(found, path)
    stiffness, mass = picked(found, STIFFNESS), picked(found, MASS)
    if stiffness is None:
        return from_matrices(found, path, where=where)  # says what is missing
    index = stiffness.index
    if mass is not None:
        index = index.union(mass.index)
    labels = np.array(index.to_list(), np.int64).reshape(-1, 2)
    whole = [m if m is None else _on(m, index) for m in (stiffness, mass)]
    return Contents(stiffness=whole[0], mass=whole[1], labels=labels, points=grids)


def _check_memory(text: str) -> None:
    """Refuse matrices that are too large to be full ones, which pyYeti makes of all."""
    columns = Counter(re.findall(r"^DMIG\*?[\s,]+(\w+)", text, re.MULTILINE | re.IGNORECASE))
    name, count = max(columns.items(), key=lambda found: found[1], default=("", 0))
    need, memory = _COPIES * 8.0 * count**2, total_memory()
    if need > memory:
        raise Damaged(
            f"its matrix {name} has {count:,} columns, which as a full one take {in_bytes(need)}, "
            f"and this machine has {in_bytes(memory)}; write OUTPUT4, which is read as it stands"
        )


def _on(frame: Any, index: Any) -> np.ndarray:
    values: np.ndarray = frame.reindex(index=index, columns=index, fill_value=0.0).to_numpy()
    return values if np.iscomplexobj(values) else values.astype(float)  # complex: refused later


def write(body: ReducedBody, path: Path) -> None:
    """Write stiffness and mass as DMIG entries KAAX and MAAX, and nodes as GRID entries.

    Shapes have no place there: what is read again has the nodes' own coordinates alone.
    """
    import pandas

    module = _module()
    stiffness, mass = body.dense()
    labels = pandas.MultiIndex.from_arrays(list(labels_of(body).T), names=["id", "dof"])
    frame = {
        name: pandas.DataFrame(matrix, index=labels, columns=labels)
        for name, matrix in (("KAAX", stiffness), ("MAAX", mass))
    }
    with path.open("w", encoding="ascii") as file:
        for number, place in zip(numbers_of(body), body.nodes):
            first, second, third = (f"{c:16.9E}" for c in place)
            file.write(f"GRID*   {number:16d}{0:16d}{first}{second}\n*       {third}\n")
        module.wtdmig(file, frame)


def _module() -> Any:
    return nastran("bulk")
