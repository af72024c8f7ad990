"""A run and a study whose every array is made here: reports without a simulation."""

from __future__ import annotations

import numpy as np
from ring_with_pockets import Z, ring_mesh

from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.cages.window.defects import CrossbeamDefect
from flexcage.cages.window.places import WINDOW_PLACES
from flexcage.case.presets import load_preset
from flexcage.contacts.spec import LandSpec
from flexcage.render.album import Scene, StressPictures
from flexcage.report.blocks import PageTable
from flexcage.report.cage_view import CageStress
from flexcage.report.comparison import Abscissa, Output
from flexcage.report.run_page import RunAccount
from flexcage.report.study_page import StudyAccount
from flexcage.report.tables import number
from flexcage.results.figures.part import SettledRun
from flexcage.results.figures.sections import summarise
from flexcage.results.registry import VARIABLES
from flexcage.results.row import SummaryRow
from flexcage.results.slip import BearingNumbers
from flexcage.results.store import RunStore
from flexcage.results.warnings import warnings_of
from flexcage.results.warnings_at_end import AT_END, RunOutcome

NUMBERS = BearingNumbers(pitch_diameter=82.5e-3, element_diameter=8e-3, element_count=Z)
PEAK = 40e6  # Pa, at one vertex of the cage
SPIKE, SPIKE_AT = 123.0, 1234  # N, at one sample
BEARING = RollerBearing(
    bore=65e-3, outside_diameter=100e-3, width=18e-3, inner_race_diameter=74.5e-3,
    outer_race_diameter=90.5e-3, roller_diameter=8e-3, roller_length=8e-3, effective_length=7.3e-3,
    roller_count=Z, rib_diameter=78.4e-3, rib_gap=8.03e-3,
)  # fmt: skip


def dataset(n: int = 5000):
    """A run at 6000 rpm, 1 % of cage slip, one pocket force of SPIKE newtons, energy in balance."""
    t = np.arange(n) / 50e3
    names = ["inner_speed", "element_omega", "cage_position", "cage_quaternion", "cage_omega"]
    names += ["cage_velocity", "race_force", "race_slip", "pocket_force", "energy", "work"]
    names += ["inner_position", "inner_quaternion", "multiplier"]
    coords = {
        "time": t, "element": np.arange(Z), "pocket": np.arange(Z),
        "constraint": ["axial_force", "moment_y", "moment_z", "drive_torque"],
        "energy_kind": ["kinetic", "strain"], "channel": ["drive", "pocket_friction"],
    }  # fmt: skip
    store = RunStore.create(
        None,
        coords=coords,
        variables=names,
        n_time=n,
        block=n,
        attrs={"family": "cylindrical_roller", "element": "roller"},
    )
    a = {v: np.zeros(store.layout.shape(VARIABLES[v])) for v in names}
    inner = 6000 * np.pi / 30
    cage = 0.99 * NUMBERS.kinematics(inner).cage_speed
    a["inner_speed"][:] = inner
    a["inner_position"][:, 1], a["inner_quaternion"][:, 0] = 15e-6, 1.0
    a["cage_quaternion"][:, 0], a["cage_quaternion"][:, 1] = (
        np.cos(cage * t / 2),
        np.sin(cage * t / 2),
    )
    a["cage_omega"][:, 0] = cage * (1.0 + 1e-3 * np.sin(900 * t))
    a["cage_position"][:, 1:] = 5e-5 * np.stack([np.cos(cage * t), np.sin(cage * t)], axis=1)
    a["element_omega"][:, :, 0] = NUMBERS.kinematics(inner).element_spin
    a["race_force"][:, :4, 0], a["race_force"][:, :, 1] = 300.0, 10.0
    a["pocket_force"][:, 2, 0] = 5.0 * np.clip(np.sin(900 * t), 0.0, None)
    a["pocket_force"][SPIKE_AT, 7, 1] = SPIKE
    a["energy"][:, 0] = 1.0
    a["work"][:, 0], a["work"][:, 1] = 7.0 * t, -7.0 * t
    store.write_block(0, a)
    return store.dataset()


def cage_stress(name: str = "", factor: float = 1.0) -> CageStress:
    """An ovalised ring whose stress has its peak at one outer vertex."""
    mesh = ring_mesh()
    psi = np.arctan2(mesh.points[:, 2], mesh.points[:, 1])
    radial = np.column_stack([0 * psi, np.cos(psi), np.sin(psi)])
    stress = factor * 1e7 * (1.2 + np.cos(2 * psi))
    peak = int(np.argmax(mesh.points @ [1.0, 1.0, 0.3]))
    stress[peak] = factor * PEAK
    shift = 5e-6 * np.cos(2 * psi)[:, None] * radial
    return CageStress(name, mesh.points, mesh.tets, shift, stress, 0.02, peak, Z)


def scene(ds, name: str = "small") -> Scene:
    cage, n = cage_stress(), ds.sizes["time"]
    roots = np.abs(np.sin(np.arange(n)[:, None] * 1e-2)) * [8e6, 3e6]
    stress = StressPictures(
        nodes=cage.points, cells=cage.tets, basis=None, time=cage.time,
        displacement=cage.displacement, von_mises=cage.von_mises, envelope=cage.von_mises,
        peak_vertex=cage.peak_vertex, peak_place="", settled=int(0.3 * n), roots=roots,
        root_names=["pocket1_root_front+x", "pocket2_root_rear-x"], root_kind=WINDOW_PLACES.kind,
    )  # fmt: skip
    return Scene(
        name=name, dataset=ds, bearing=BEARING, mesh=ring_mesh(),
        defects=[CrossbeamDefect(crossbeam=2, displacement=1e-4)],
        loads=np.tile([0.0, 1e3, 0.0], (n, 1)),
        clearance=2.5e-4, guide="inner", settle=0.3, stress=stress,
    )  # fmt: skip


def account(name: str = "small", **changes) -> RunAccount:
    """What a report tells of this run."""
    ds = dataset()
    summary = summarise(SettledRun(ds, NUMBERS, settle=0.3))
    summary = summary.with_section("Solver", [SummaryRow("steps", "Steps", 1234)])
    summary = summary.with_section(
        "Equivalent stress", [SummaryRow("stress_peak", "Peak", PEAK, "MPa")]
    )
    duration = float(ds["time"][-1])
    outcome = RunOutcome(
        summary=summary, dataset=ds, bearing=BEARING, cage=load_preset("N1013").cage,
        land=LandSpec(), duration=duration, settle=0.3,
    )  # fmt: skip
    warned = [warning.text for warning in warnings_of(AT_END, outcome)]
    values = {
        "scene": scene(ds, name), "summary": summary, "numbers": NUMBERS,
        "statement": ["A bearing made for tests."], "warnings": warned,
        "steps": {"time": np.linspace(0.0, duration, 900), "step": np.full(900, 2e-6)},
        "settings": {"tolerance": "0.005 µm"}, "assumptions": {"cage.bore": ("78 mm", "chosen")},
        "sources": {"paper": "a paper"}, "case_text": "name = 'small'", "commands": "flexcage run",
        "hash": "0123", **changes,
    }  # fmt: skip
    return RunAccount(**values)


def study_account(folder, **changes) -> StudyAccount:
    """What a report tells of a study of three loads, one of which failed."""
    loads, slip = [10.0, 9.0, 100.0], np.array([0.5, 0.7, np.nan])
    rows = [[number(k), number(load), number(s)] for k, (load, s) in enumerate(zip(loads, slip))]
    points = [f"load = {load:g} N" for load in loads]
    values = {
        "name": "loads", "folder": folder, "status": "3 cases: 2 done, 1 failed, 0 open",
        "varied": ["load: 9 N, 10 N, 100 N."], "base": ["A bearing made for tests."],
        "statistics": PageTable(("point", "load [N]", "slip [%]"), rows, "Means"),
        "cases": PageTable(("point", "load [N]", "slip [%]"), rows, "All cases"),
        "audits": PageTable(("point", "audit"), [["0", "passed"]], "Audit"),
        "outputs": [Output("slip", "%", slip, np.array([0.05, np.nan, np.nan]))],
        "abscissas": [Abscissa("load [N]", loads, ["", "", ""])], "points": points,
        "failures": ["Point 2 failed: it fell apart."],
        "stress": [cage_stress("Point 0", 1.0), cage_stress("Point 1", 0.5)], "scale": 500.0,
        "assumptions": {}, "study_text": "name = 'loads'", "commands": "flexcage study run",
        **changes,
    }  # fmt: skip
    return StudyAccount(**values)
