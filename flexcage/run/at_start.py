"""What must be known of a run before it begins."""

from __future__ import annotations

import logging

import numpy as np

from flexcage.cages import cage_type_of
from flexcage.case import Case
from flexcage.core.errors import InputError
from flexcage.core.threads import one_blas_thread
from flexcage.core.warning import RunWarning
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.modes.reduction import CageReduction
from flexcage.results.warnings import warnings_of
from flexcage.results.warnings_at_start import AT_START, Setup, of_statics
from flexcage.stress.mirrored import in_mirror
from flexcage.stress.operators import von_mises
from flexcage.stress.recovery import CageLoads, StressRecovery
from flexcage.stress.run_stress import recovery_of
from flexcage.system.begun import Start

log = logging.getLogger(__name__)


def warnings_at_start(
    case: Case, mesh: CageMesh | None, cage: CageReduction | None, start: Start
) -> tuple[RunWarning, ...]:
    """What must be known of a run before it begins, beside what its case alone tells
    (``foreseen``), logged too; InputError for a cage that its assembly alone stresses more than the
    case allows."""
    found = (
        *(_of_cage(case, mesh, cage, start) if mesh is not None else ()),
        *of_statics(start.warnings),
    )
    for warning in found:
        log.warning(warning.text)
    return found


def _of_cage(
    case: Case, mesh: CageMesh, cage: CageReduction | None, start: Start
) -> tuple[RunWarning, ...]:
    setup = Setup(
        bearing=case.mounted.bearing,
        cage=case.its_cage,
        land=case.land,
        mesh=mesh,
        flexible=cage is not None,
        basis=case.modes.kind,
        attached=cage is None or bool(np.any(getattr(cage.interface, "compliance", True))),
        pinched=start.pinched,
        pinch_force=start.pinch_force,
        fit=None if cage is None else cage.fit,
        highest=0.0 if cage is None else float(cage.table.frequency.max()),
    )
    return (*warnings_of(AT_START, setup), *_assembly_stress(case, cage, start))


@one_blas_thread
def _assembly_stress(case: Case, cage: CageReduction | None, start: Start) -> list[RunWarning]:
    if cage is None or not start.pinched:
        return []
    recovery = recovery_of(cage, cage_type_of(case.its_cage).places())
    pushed = np.split(start.station, case.cages)
    pushed = [in_mirror(p, cage.interface.across) if k else p for k, p in enumerate(pushed)]
    peak = max(_largest_under(recovery, stations) for stations in pushed)
    material = case.its_cage.material
    text = f"Assembling the bearing stresses the cage to {peak / 1e6:.0f} MPa"
    limit = case.limits.stress
    if limit is not None and peak > limit:
        raise InputError(
            f"{text}, more than limits.stress ({limit / 1e6:.0f} MPa); make the defect "
            "smaller, the pocket larger, or raise the limit",
            where="defects",
            value=peak,
        )
    if peak <= material.proof_stress:
        return []
    proof = f"the proof stress of {material.name} ({material.proof_stress / 1e6:.0f} MPa)"
    return [RunWarning("assembly_stress", f"{text}, more than {proof}: it would yield.")]


def _largest_under(recovery: StressRecovery, stations: np.ndarray) -> float:
    """Largest equivalent stress [Pa] of a cage under forces (Z, F, n_st, 3) on its stations."""
    loads = CageLoads(station_forces=stations)
    stress = von_mises(recovery.stress(recovery.displacement(loads), loads))
    stress[recovery.contact_zone] = 0.0
    return float(stress.max())
