"""Was a finished case computed with the values that the plan gives it?

New plans hold the values beside the hashes. One of an earlier flexcage holds hashes alone, and its
study.toml may have been edited since: there the text of the case, which every case's folder keeps,
decides.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from flexcage.case import Case
from flexcage.case.files import file_paths
from flexcage.core.errors import InputError, shown
from flexcage.core.units import parse
from flexcage.study.about import About
from flexcage.study.folder import CaseRow, Folder
from flexcage.study.plan import Planned
from flexcage.study.spec import read_file, value_at

_CLOSE = 1e-9  # relative: texts are rounded to 12 digits


def check_values(folder: Folder, about: About, planned: Planned, row: CaseRow) -> None:
    """InputError, which names the first value, if a case was computed with another one."""
    if row.values is not None:
        had = dict(row.values)
    elif about.sure or not (folder.case(row.hash) / "case.toml").is_file():
        return
    else:
        table = read_file(folder.case(row.hash) / "case.toml")
        had = {path: value_at(table, path) for path in planned.point.values}
    for path, value in planned.point.values.items():
        if path in file_paths(Case) or had.get(path) is None:
            continue
        if not _same(had[path], value, about.units.get(path, "")):
            raise InputError(
                f"'{folder.path}' says that point {planned.number} has {path} = {shown(value)}, "
                f"but its results in cases/{row.hash} are of {shown(had[path])}: its study.toml or "
                "plan.json was edited. Undo the edit, or go on with 'flexcage study resume "
                f"{folder.path}', which computes the edited study.",
                where=path,
                value=value,
            )


def _same(one: Any, other: Any, unit: str) -> bool:
    """Do two values of a case's text mean the same? What cannot be told, as a material's name from
    its table, does."""
    if one == other:
        return True
    try:
        if unit:
            one, other = (parse(value, unit, where="") for value in (one, other))
    except InputError:
        return False
    numbers = all(isinstance(v, (int, float)) and not isinstance(v, bool) for v in (one, other))
    if numbers:
        return math.isclose(one, other, rel_tol=_CLOSE)
    tables = any(isinstance(v, (Mapping, list, tuple)) for v in (one, other))
    return tables
