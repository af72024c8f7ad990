"""Each warning is provoked once; a sound run has none."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from flexcage.case.presets import load_preset
from flexcage.contacts.spec import LandSpec
from flexcage.core.warning import RunWarning
from flexcage.geometry.plausibility import implausible_geometry
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.modes.basis import BodyFit
from flexcage.results.edges import Edge
from flexcage.results.elastic import ElasticShape
from flexcage.results.row import SummaryRow
from flexcage.results.summary import Section, Summary
from flexcage.results.warnings import from_attrs, to_text, warnings_of
from flexcage.results.warnings_at_end import AT_END, RunOutcome
from flexcage.results.warnings_at_start import AT_START, Setup, of_statics

N1013, BALL, RIBBON = (load_preset(name) for name in ("N1013", "7010C-PA66", "15x37x10"))
FILLETED = {f"pocket{k}_{part}": np.zeros((1, 3), int) for k in range(22) for part in (
    "front", "rear", "side+x", "side-x", "fillet",
)} | {name: np.zeros((1, 3), int) for name in ("land_inner", "land_outer")}  # fmt: skip
FIGURES = {"roller_passes": 60, "drift": "none", "energy_audit": "passed", "stress_peak": 1e6}


def like(preset, *, bearing=None, **cage):
    """The preset with some values of its bearing and its cage changed."""
    return SimpleNamespace(
        bearing=replace(preset.bearing, **bearing or {}), cage=replace(preset.cage, **cage)
    )


def motion(radius, *, turns=4.0, tilt=0.0, duration=0.1):
    """A run whose cage's centre circles once a turn at ``radius`` (n,) [m] about the axis."""
    n = len(radius)
    angle = np.linspace(0.0, 2.0 * np.pi * turns, n)
    zero = np.zeros(n)
    spin = np.stack([np.cos(angle / 2), np.sin(angle / 2), zero, zero], axis=1)
    if tilt:
        spin = np.tile([np.cos(tilt / 2), 0.0, np.sin(tilt / 2), 0.0], (n, 1))
    place = np.stack([zero, radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    return xr.Dataset(
        {
            "cage_position": (("time", "axis"), place),
            "inner_position": (("time", "axis"), np.zeros((n, 3))),
            "cage_quaternion": (("time", "quaternion"), spin),
            "inner_speed": ("time", np.full(n, 600.0)),
        },
        coords={"time": np.linspace(0.0, duration, n), "axis": ["x", "y", "z"]},
    )


def end(preset=N1013, radius=None, notes="", land=None, run=None, **figures):
    rows = tuple(SummaryRow(k, k, v, "", notes) for k, v in (FIGURES | figures).items())
    steady = np.full(500, 50e-6) if radius is None else radius
    outcome = RunOutcome(
        summary=Summary((Section("All", rows),)),
        dataset=run or motion(steady),
        bearing=preset.bearing,
        cage=preset.cage,
        land=land or LandSpec(),
        duration=0.1,
        settle=0.3,
    )
    return outcome


def keys(outcome):
    return [w.key for w in warnings_of(AT_END, outcome)]


@pytest.mark.parametrize("preset", [N1013, BALL, RIBBON])
def test_a_sound_run_has_none(preset):
    assert warnings_of(AT_END, end(preset)) == ()
    setup = Setup(
        bearing=preset.bearing, cage=preset.cage, land=LandSpec(),
        mesh=CageMesh(np.zeros((0, 3)), np.zeros((0, 4), int), FILLETED, 22),
    )  # fmt: skip
    assert warnings_of(AT_START, setup) == ()


@pytest.mark.parametrize(
    ("figures", "key", "words"),
    [
        ({"stress_start": 200e6}, "stress_above_proof",
         "reaches 200 MPa, more than the proof stress of brass (160 MPa)"),
        ({"stress_peak": 750e6}, "stress_above_proof", "reaches 750 MPa"),
        ({"roller_passes": 7}, "short_run", "7 roller passes and 2.8 turns of the cage, but "
         "intervals need 20 passes"),
        ({"drift": "cage speed"}, "not_settled", "halves of the settled part differ beyond the "
         "intervals in: cage speed"),
        ({"energy_audit": "EXCEEDED", "energy_of_drive": 2e-3, "energy_of_cage": 0.07},
         "energy_audit", "0.2 % of the drive's work (at most 0.1 %) and 7 %"),
    ],
)  # fmt: skip
def test_figures_that_warn(figures, key, words):
    (found,) = warnings_of(AT_END, end(**figures))
    assert found.key == key and words in found.text and found.text.endswith(".")


def test_slip_that_the_law_does_not_resolve():
    outcome = end(slip_loaded=0.01, notes="unresolved: sliding is under the creep speed")
    (found,) = warnings_of(AT_END, outcome)
    assert found.key == "slip_unresolved"
    assert found.text == "Roller slip in the loaded zone is unresolved: sliding is under the " \
        "creep speed."  # fmt: skip


def test_a_run_that_stopped_early():
    (found,) = warnings_of(AT_END, replace(end(), duration=0.2))
    assert found.key == "unfinished" and "stopped at 100 ms of 200 ms" in found.text


def test_a_run_of_less_than_a_turn():
    outcome = end(run=motion(np.full(500, 1e-6), turns=0.5))
    (found,) = warnings_of(AT_END, outcome)
    assert found.key == "short_run" and "one turn of the cage" in found.text
    stands = outcome.dataset.assign(inner_speed=("time", np.zeros(500)))
    assert keys(replace(outcome, dataset=stands)) == [], "a bearing that stands has no turns"


def test_a_cage_that_is_being_thrown_off():
    """Before it fails: its centre goes outwards all along, beyond what pockets leave it."""
    preset = like(BALL, guidance="ball")
    spiral = 20e-6 * np.exp(np.linspace(0.0, 3.4, 500))  # to 0.6 mm; pockets leave 0.15 mm or so
    free = LandSpec(kind="none")
    outcome = end(preset, spiral, land=free)
    (found,) = [w for w in warnings_of(AT_END, outcome) if w.key == "thrown_off"]
    assert "grows steadily" in found.text and "to 599 um at 100 ms" in found.text
    back = end(preset, spiral[::-1], land=free)
    assert "thrown_off" not in keys(back), "one that comes back"
    small = end(preset, 0.1 * spiral, land=free)
    assert keys(small) == [], "one that stays within its pockets"
    assert "thrown_off" not in keys(end(preset, spiral)), "one that shoulders will hold"
    held = like(BALL, guidance="outer")
    assert "thrown_off" not in keys(end(held, spiral)), "one that its land will hold"


def test_a_cage_that_passes_a_ring():
    """The ribbon cage of the preset has 0.535 mm to both shoulders, here without their contact."""
    free = LandSpec(kind="none")
    assert keys(end(RIBBON, np.full(500, 530e-6), land=free)) == []
    inner, outer = warnings_of(AT_END, end(RIBBON, np.full(500, 605e-6), land=free))
    assert (inner.key, outer.key) == ("passes_ring", "passes_ring")
    assert "passes through the inner ring's shoulder: it swings by 605 um" in inner.text
    assert "the outer ring's shoulder" in outer.text and "the gap there is 535 um" in outer.text
    tilted = end(RIBBON, run=motion(np.full(500, 500e-6), tilt=0.02), land=free)
    assert "passes_ring" in keys(tilted), "a tilt moves its ends outwards"
    roller = end(N1013, np.full(500, 2.5e-3))  # its land holds it at the inner ring's ribs alone
    (found,) = [w for w in warnings_of(AT_END, roller) if w.key == "passes_ring"]
    assert "the outer race" in found.text


def test_a_cage_that_meets_shoulders():
    assert keys(end(RIBBON, np.full(500, 534e-6))) == []
    inner, outer = warnings_of(AT_END, end(RIBBON, np.full(500, 536e-6)))
    assert (inner.key, outer.key) == ("meets_ring", "meets_ring")
    assert (
        "meets the outer ring's shoulder: its centre and its tilt together reach 536 um"
        in outer.text
    )
    window = end(N1013, np.full(500, 2.5e-3))
    assert "meets_ring" not in keys(window), "rollers' cages pass the ring that does not guide them"


def test_shoulders_that_nobody_gave():
    preset = like(RIBBON, bearing={"inner_shoulder": None})
    (found, _) = warnings_of(AT_END, end(preset, np.full(500, 800e-6)))
    assert "shoulder (a fifth of the ball's diameter is assumed)" in found.text
    open_side = like(BALL, bearing={"inner_shoulder": None, "outer_shoulder": None})
    assert open_side.bearing.cage_space(open_side.cage) == (None, None)


def test_a_cage_narrower_than_the_groove_meets_the_groove():
    bearing = RIBBON.bearing
    narrow = replace(RIBBON.cage, width=2e-3)
    inner, outer = bearing.cage_space(narrow)
    high = bearing.inner_groove_radius - np.sqrt(bearing.inner_groove_radius**2 - 1e-6)
    assert inner.name == "the inner ring's groove"
    assert inner.diameter == pytest.approx(
        bearing.pitch_diameter - bearing.ball_diameter + 2.0 * high
    )
    assert outer.diameter > bearing.cage_space(RIBBON.cage)[1].diameter


def test_a_contact_over_the_edge_of_its_groove():
    edge = Edge(
        race="inner", beyond=np.radians(2.0), kind="ball", element=3, time=0.05, force=400.0,
        angle=np.radians(31.0),
    )  # fmt: skip
    (found,) = warnings_of(AT_END, replace(end(BALL), edges=(edge, replace(edge, beyond=-0.1))))
    assert found.key == "over_edge"
    assert found.text.startswith("The contact ellipse of ball 3 runs over the inner groove's edge")


def setup(preset=N1013, groups=FILLETED, **changes):
    mesh = CageMesh(np.zeros((0, 3)), np.zeros((0, 4), int), groups, 22)
    values = {"bearing": preset.bearing, "cage": preset.cage, "land": LandSpec(), "mesh": mesh}
    return Setup(**values | changes)


WITHOUT = {k: v for k, v in FILLETED.items() if not k.endswith("fillet")}
WITHOUT_LAND = {k: v for k, v in FILLETED.items() if k != "land_inner"}


@pytest.mark.parametrize(
    ("changes", "key", "words"),
    [
        ({"groups": WITHOUT}, "sharp_corners", "no fillets in the corners of all pockets"),
        ({"groups": {k: v for k, v in FILLETED.items() if k != "pocket3_fillet"}},
         "sharp_corners", "corners of pockets 3 (groups such as pocket3_fillet), so "
         "cage.fillet_radius = 0.5 mm is not in it"),
        ({"basis": "mine", "attached": False}, "no_residual_flexibility", "basis 'mine' has no"),
        ({"basis": "free_free", "attached": False}, "no_residual_flexibility", "too stiff"),
        ({"attached": False, "fit": BodyFit(1.0, 0.88, 1e-9), "highest": 1e6},
         "no_residual_flexibility", "holds 88 % of the static deflection"),
        ({"fit": BodyFit(1.1, 1.0, 1e-9), "highest": 1e6}, "body_stiffness", "is 1.1 times as"),
        ({"fit": BodyFit(1.0, 1.0, 1e-9, 0.93), "highest": 1e6}, "lumped_mass",
         "A mode of modes.body has 0.93 times the mass"),
        # sqrt(1/(c m))/2 pi of a steel roller of 8 mm by 8 mm, 3.157 g, on 1e-7 m/N
        ({"fit": BodyFit(1.0, 1.0, 1e-7), "highest": 1.5e3}, "few_modes",
         "reach 1.5 kHz, but a roller bounces on the wall of its pocket at 8.96 kHz"),
        ({"groups": WITHOUT_LAND}, "rigid_land", "no group 'land_inner'"),
        ({"pinched": (4, 5), "pinch_force": 12.0}, "pinched",
         "the roller of pockets 4, 5 is pinched with up to 12 N"),
    ],
)  # fmt: skip
def test_what_warns_at_the_start(changes, key, words):
    (found,) = warnings_of(AT_START, setup(**changes))
    assert found.key == key and words in found.text


def test_what_the_static_solution_warns_of():
    (found,) = of_statics(["the largest pressure, 5000 MPa, is above ..."])
    assert found.key == "static"
    assert found.text.startswith("At the start the largest pressure, 5000 MPa")


def test_what_does_not_warn_at_the_start():
    rigid = setup(groups={}, flexible=False)
    complete = setup(basis="craig_bampton", attached=False)  # its constraint modes are all dynamic
    fits = setup(fit=BodyFit(1.02, 0.99, 1e-7), highest=1e5, attached=False)
    for good in (rigid, complete, fits, setup(groups=WITHOUT_LAND, land=LandSpec(kind="none"))):
        assert warnings_of(AT_START, good) == ()


@pytest.mark.parametrize(
    ("preset", "changes", "words"),
    [
        (N1013, {"pocket_width": 11.12e-3}, "cage's crossbeams is only 0.109 mm"),
        (N1013, {"pocket_length": 15.9e-3}, "cage's side beams is only 0.05 mm"),
        (N1013, {"outside_diameter": 79.1e-3}, "cage's wall is only 0.1 mm"),
        (BALL, {"pocket_diameter": 14.9e-3, "pocket_shape": "spherical"},
         "rims beside the pockets is only"),
        (RIBBON, {"thickness": 0.15e-3}, "cage's sheet is only 0.15 mm"),
    ],
)  # fmt: skip
def test_geometry_that_is_legal_and_odd(preset, changes, words):
    cage = replace(preset.cage, **changes)
    texts = [w.text for w in implausible_geometry(preset.bearing, cage)]
    assert any(words in text for text in texts), texts
    assert list(implausible_geometry(preset.bearing, preset.cage)) == []


def test_pockets_that_guide_nothing():
    cage = replace(RIBBON.cage, pocket_diameter=9e-3)
    assert any(
        "they hardly guide them" in w.text for w in implausible_geometry(RIBBON.bearing, cage)
    )


def test_warnings_are_kept_with_the_figures(tmp_path):
    told = (RunWarning("not_settled", "It has not settled."),)
    row = SummaryRow("cage_speed", "Cage speed", 280.0, "rpm")
    summary = Summary((Section("Speeds", (row,)),), told)
    text, data = summary.write(tmp_path)
    lines = text.read_text("utf-8").splitlines()
    assert lines[:3] == ["Warnings", "  - It has not settled.", ""], "before the figures"
    again = Summary.read(data)
    assert again == summary and again.warnings == told
    assert summary.with_section("More", ()).warnings == told
    assert summary.brief().splitlines()[:2] == lines[:2]
    assert replace(summary, warnings=()).text().startswith("Warnings: none")
    assert replace(summary, warnings=None).text().startswith("Speeds"), "nobody looked for any"


def test_warnings_of_the_start_are_kept_in_the_store():
    told = (RunWarning("a", "One."), RunWarning("b", "Two."))
    assert from_attrs({"warnings": to_text(told)}) == told


def test_a_cage_that_deforms_too_far_for_linear_displacements():
    """As far as nonlinear solutions say: off by 10 % at 5.7 degrees, stiffened at 9.2."""
    turned = replace(end(RIBBON), shape=ElasticShape(rotation=0.12))
    (found,) = warnings_of(AT_END, turned)
    assert found.key == "large_rotation" and "turn elastically by up to 6.9 deg" in found.text
    assert "off by about 12 % there; modes.geometric_stiffening = true leaves about 7 %." in (
        found.text
    )
    assert keys(replace(end(RIBBON), shape=ElasticShape(rotation=0.12, stiffened=True))) == []
    assert keys(replace(end(RIBBON), shape=ElasticShape(rotation=0.09))) == []
    stiff = replace(end(RIBBON), shape=ElasticShape(rotation=0.2, stiffened=True))
    (found,) = warnings_of(AT_END, stiff)
    assert found.text.endswith("off by about 12 % there.")


def test_a_cage_that_grows_into_a_ring():
    """The gap to both shoulders is 0.535 mm; a ring that guides the cage takes it up."""
    assert keys(replace(end(RIBBON), shape=ElasticShape(inward=0.5e-3, outward=0.53e-3))) == []
    grown = replace(end(RIBBON), shape=ElasticShape(outward=0.6e-3))
    (found,) = warnings_of(AT_END, grown)
    assert found.key == "grown_into_ring"
    assert "deforms by 0.6 mm towards the outer ring's shoulder, but the gap there is 0.535" in (
        found.text
    )
    bent_in = replace(end(RIBBON), shape=ElasticShape(inward=0.6e-3))
    assert "the inner ring's shoulder" in warnings_of(AT_END, bent_in)[0].text
