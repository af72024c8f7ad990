"""What one run of the riveted cage is: slip by the paper's equation 10 and its parts, tilt, rivets.

Numbers that studies of this folder ask for. All are over the whole settled record.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np
from scipy.spatial.transform import Rotation

from flexcage import register
from flexcage.geometry.materials import Material
from flexcage.geometry.riveted_joint import JointShape
from flexcage.mesh.riveted_joint import JointMesh
from flexcage.results import metrics
from flexcage.results.reductions import REDUCTIONS
from flexcage.results.slip import cage_speed, rolling_by_curvature
from flexcage.results.statistics import element_passes
from flexcage.stress.riveted_joint import Fit, RivetedJoint

PRINTED_BALL, PRINTED_PITCH = 6.47e-3, 26e-3  # m, of which equation 10's reference is made
UNITS = {
    "drifts": "",  # 1 where the cage's speed in the record's halves differs
    "pocket_turn_largest": "N",  # largest ball-cage force of a turn of the cage, mean over turns
    "slip": "%",  # of the cage, by equation 10
    "slip_size": "%",  # its size
    "reference": "%",  # its parts, which sum to it: balls that are not the printed ones
    "angle": "%",  # contact angles
    "curvature": "%",  # rolling beside the middle of curved contacts
    "traction": "%",  # what is left: sliding
    "psi": "deg",  # |arctan(omega_z/omega_x)| of the cage, mean: the paper's inclination
    "cage_tilt": "deg",  # of the cage's axis, mean
    "whirl": "um",  # largest distance of the cage's centre from its mean place
    "ball_load": "N",  # force of the inner race on a ball that it touches, mean
    "rivet": "MPa",  # nominal stress of the most stressed rivet in a ball pass, mean of largest
}
#: Of the joint of the most stressed rivet (rivet.py), which takes half a minute a run.
FILLET_UNITS = {
    "root_tight": "MPa",  # largest equivalent stress at the roots of the heads, under interference
    "eave_tight": "MPa",  # under the edges of the heads
    "root_loose": "MPa",  # both with play
    "eave_loose": "MPa",
    "fillet": "MPa",  # largest range of a normal stress at those roots over a cycle, with play
}
PLAYS = {"tight": -3e-6, "loose": 3e-6}  # m, of rivets in their holes: assumptions, as are
CLAMP, FRICTION = 100.0, 0.15  # N, and of steel on greased steel
FEW = 1e-3  # of the cage's speed, below which halves do not differ
ROOT_RADIUS = 0.1e-3  # m, of cold headed rivets: an assumption
MESH = JointMesh(sectors=6, size=1.5, seat=0.5, growth=2.0)  # six elements over the root


def evaluate(run) -> Mapping[str, float]:
    """All of ``UNITS`` of one run, in SI."""
    ds = metrics.settled(run.dataset, run.case.output.settle)
    force = ds["race_force"].sel(race="inner").values
    slip = slip_parts(run, ds)
    return {
        **slip,
        "slip_size": abs(slip["slip"]),
        "drifts": float(
            element_passes(ds, run.numbers).drifts(
                np.abs(ds["cage_omega"].sel(axis="x").values), beyond=2.0, by=FEW
            )
        ),
        "pocket_turn_largest": turn_largest(run, ds),
        "psi": inclination(ds, run.case.load.direction),
        "cage_tilt": float(metrics.tilt(ds).sel(component="total").values.mean()),
        "whirl": float(metrics.whirl_radius(ds).max()),
        "ball_load": float(force[force > 0.0].mean()),
        "rivet": rivet_stress(run),
    }


def turn_largest(run, ds) -> float:
    """Largest ball-cage force [N] in each turn of the cage, mean over turns."""
    part = metrics.whole_revolutions(ds)
    peaks = metrics.pocket_peaks(part).max(("pocket", "face")).values
    turns = max(round(abs(float(np.ptp(metrics.carrier_angle(part)))) / (2.0 * np.pi)), 1)
    return REDUCTIONS["turn_max"].over_turns(peaks, 1.0, turns)


def slip_parts(run, ds) -> dict[str, float]:
    """The slip of equation 10 and its four parts. The equation compares the cage with omega_m =
    omega_i (1 - D/dm)/2, which knows no contact angle; all are shares of omega_m."""
    bearing, inner = run.case.bearing, float(run.case.drive.speed)
    reference = 0.5 * inner * (1.0 - PRINTED_BALL / PRINTED_PITCH)
    flat = 0.5 * inner * (1.0 - bearing.ball_diameter / bearing.pitch_diameter)
    speed = cage_speed(ds, run.numbers)
    cage, rolling = abs(speed.mean), abs(speed.epicyclic)
    curved = rolling_by_curvature(ds, run.numbers)
    share = 0.0 if curved is None else curved.cage_slip
    return {
        "slip": 1.0 - cage / reference,
        "reference": 1.0 - flat / reference,
        "angle": (flat - rolling) / reference,
        "curvature": share * rolling / reference,
        "traction": (rolling * (1.0 - share) - cage) / reference,
    }


def inclination(ds, direction: float) -> float:
    """The paper's psi_c = arctan(omega_cz/omega_cx), mean of its size [rad]: the direction of the
    cage's angular velocity, seen from the outer ring, in the plane of the lever, which has the
    radial load's azimuth [rad] and in which the moment tilts the inner ring."""
    turn = Rotation.from_quat(ds["cage_quaternion"].values, scalar_first=True)
    omega = turn.apply(ds["cage_omega"].values)
    along = np.cos(direction) * omega[:, 1] + np.sin(direction) * omega[:, 2]
    return float(np.abs(np.arctan(along / omega[:, 0])).mean())


def rivet_stress(run) -> float:
    """Of the most stressed rivet the largest nominal stress of a ball pass, mean over passes [Pa];
    NaN of a rigid cage."""
    if not run.case.riveted:
        return float("nan")
    share = run.case.output.settle
    worst = metrics.settled(run.rivets.dataset, share)["stress"].max("rivet").values
    return float(element_passes(metrics.settled(run.dataset, share), run.numbers).peak(worst).value)


def fillets(run) -> Mapping[str, float]:
    """``FILLET_UNITS`` of one run; NaN of a rigid cage."""
    if not run.case.riveted:
        return dict.fromkeys(FILLET_UNITS, float("nan"))
    cage, bearing = run.case.cage, run.case.bearing
    shape = cage.rivet_joint(bearing.pitch_diameter, bearing.element_count, ROOT_RADIUS)
    _, largest, least = run.rivets.cycle()
    bodies, units = joint(shape, cage.material), {}
    for name, play in PLAYS.items():
        found = bodies.cycle(largest, least, Fit(play=play, clamp=CLAMP, friction=FRICTION))
        again = found.instants["again"].equivalent
        for place in ("root", "eave"):
            units[f"{place}_{name}"] = float(again[found.places[place]].max())
    return {**units, "fillet": found.range_at("root")[0]}  # with play, the last of PLAYS


@lru_cache(maxsize=2)
def joint(shape: JointShape, material: Material) -> RivetedJoint:
    """The bodies of a joint, which starts of one cage share."""
    return RivetedJoint(shape, material, mesh=MESH)


register.outputs(evaluate, UNITS)
register.outputs(fillets, FILLET_UNITS)
