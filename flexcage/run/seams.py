"""Runs that another flexcage, or an edited one, goes on with: refused, or noted as a seam."""

from __future__ import annotations

import logging
from pathlib import Path

from flexcage._version import __version__
from flexcage.core.errors import InputError
from flexcage.core.sources import physics
from flexcage.core.warning import RunWarning
from flexcage.results.store import MemoryRunStore

log = logging.getLogger(__name__)


def check_physics(folder: Path, store: MemoryRunStore, allowed: bool) -> None:
    """Refuse, or note, that a run is gone on with by sources other than those it has so far."""
    seams = store.seams
    before = seams[-1] if seams else store.layout.attrs
    if before["physics"] == physics():
        return
    by = f"flexcage {before['version']}"
    if before["version"] == __version__:
        by = f"another state of flexcage {__version__}"
    if not allowed:
        raise InputError(
            f"The run in '{folder}' was begun by {by}, whose sources of physics differ from those "
            f"of this flexcage {__version__}: from {store.n_time:,} samples on it would follow "
            "another model. Go on with the one that began it, run the case again, or take "
            "--other-version (in Python, other_version=True), which summary and report then say.",
            where="resume",
            value=before["physics"],
        )
    store.go_on_by(__version__, physics())
    log.warning("%s", seam_warnings(store)[-1].text)


def seam_warnings(store: MemoryRunStore) -> list[RunWarning]:
    """Where a run was gone on with by another flexcage, or an edited one."""
    found, attrs, t = [], store.layout.attrs, store.layout.coords["time"][1]
    before = attrs["version"]
    for seam in store.seams:
        at = min(seam["sample"], len(t)) - 1
        when = f"{1e3 * t[at]:.6g} ms" if at >= 0 else "its beginning"
        found.append(
            RunWarning(
                "other_version",
                f"From {when} on (sample {seam['sample']:,}) the run was gone on with by other "
                f"sources of physics: flexcage {seam['version']}, before that {before}; two models "
                "may meet there, so statistics over both say little.",
            )
        )
        before = seam["version"]
    return found
