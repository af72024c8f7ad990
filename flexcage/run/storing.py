"""What a run writes as it begins, and its cage, as a stored run has it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from flexcage._version import __version__
from flexcage.bearings import recording_of
from flexcage.bodies.cage import BODY_VERSION, flexible_from_reduction
from flexcage.cages.build import reduction_of
from flexcage.case import Case
from flexcage.core.cache import cached_arrays
from flexcage.core.hashing import content_hash
from flexcage.core.sources import physics
from flexcage.core.timing import Stages
from flexcage.core.warning import RunWarning
from flexcage.integrate.recorded import new_store
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.modes.reduction import CageReduction
from flexcage.results.cage_file import (
    FORMAT,
    CageFile,
    cage_file,
    cage_record,
    check_same,
    find_cage,
)
from flexcage.results.store import MemoryRunStore
from flexcage.results.warnings import to_text
from flexcage.run.cage_sizes import check_sizes
from flexcage.run.folder import PART_OF, check_links, keep_cage, kept_cage, write_case
from flexcage.stages import Cage, made_cage
from flexcage.system.problem import BearingSystem


def run_store(
    case: Case,
    bearing: BearingSystem,
    cage: Cage,
    folder: Path | None,
    *,
    study: Path | None = None,
    warned: Sequence[RunWarning] = (),
    machine: str = "",
) -> MemoryRunStore:
    """A new store to write to, in ``folder`` or in memory; the folder receives case and cage, or
    its ``study`` the cage. ``machine`` names that of a bearing which a shaft moves."""
    attrs = {
        "case": case.to_toml(), "hash": case.hash, "version": __version__, "physics": physics(),
        "warnings": to_text(warned), **({PART_OF: machine} if machine else {}),
    }  # fmt: skip
    if folder is not None:
        check_links(folder)
        write_case(folder, case)
        mesh, reduction = cage
        if mesh is not None:
            file = _cage_file(case, mesh, reduction)
            keep_cage(folder, file, study=study)
            attrs["cage"] = file.digest
    return new_store(
        folder and folder / "results.zarr",
        bearing,
        recording_of(case.bearing),
        duration=case.solver.duration,
        output=case.output,
        attrs=attrs,
    )


def stored_cage(case: Case, store: MemoryRunStore, folder: Path, stages: Stages) -> Cage:
    """The cage that a stored run's results refer to.

    A run that did not keep it (``output.keep_cage``) gets it made anew; InputError if that is
    another one.
    """
    if case.cage is None:
        return None, None
    record = stages.named("cage", kept_cage, folder, store)
    modes = store.layout.coords.get("mode", ((), ()))[1]
    check_sizes(record, case, len(modes), find_cage(folder, record.digest))
    if record.mesh is None:
        mesh, made = made_cage(case, stages)
        assert made is not None, "a rigid cage keeps its mesh"
        check_same(record, made.record())
        return mesh, replace(made, stored=record.reduced)
    if case.cage_model == "rigid":
        return record.mesh, None
    cage = reduction_of(
        record.mesh,
        cage=case.cage,
        defects=case.all_defects,
        spec=case.modes,
        order=case.mesh.order,
        stored=record.reduced,
    )
    return record.mesh, cage


def _cage_file(case: Case, mesh: CageMesh, reduction: CageReduction | None) -> CageFile:
    """What a run's folder keeps of its cage. That of a flexible cage is packed once."""
    if reduction is None:
        return cage_file(cage_record(mesh, {}))
    large = case.output.keep_cage
    modes = case.modes.damped_as(case.its_cage.warm_material)  # as in the run

    def make() -> dict[str, np.ndarray]:
        body = flexible_from_reduction(reduction, modes).data._asdict()
        reduced = {**reduction.record(), "body": {k: np.asarray(v) for k, v in body.items()}}
        return vars(cage_file(cage_record(mesh, reduced, large=large)))

    key = content_hash(FORMAT, reduction.content, BODY_VERSION, modes, large)
    kept = reduction.once(f"file {key}", lambda: cached_arrays("cage", key, make))
    return CageFile(str(kept["digest"]), kept["content"])
