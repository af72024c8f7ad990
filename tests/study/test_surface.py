"""Response surfaces on known functions with noise: coverage of regions, power, and reading."""

import numpy as np
import pytest
from study_cases import row_of, short_study

from flexcage.cli import main
from flexcage.core.errors import InputError
from flexcage.study.axes import Grid, Points, Zip
from flexcage.study.folder import Folder
from flexcage.study.outputs import StudyFigure
from flexcage.study.plan import make_plan
from flexcage.study.quadratic import fit_quadratic, terms
from flexcage.study.results import StudyResults
from flexcage.study.samples import Samples, samples_of
from flexcage.study.surface import FLAT, response_surface, surface_through

LINE = np.linspace(-1.0, 1.0, 7)
PLANE = np.stack([a.ravel() for a in np.meshgrid(LINE, LINE)], axis=1)
TRIALS = 200
SPREAD = 3.5 * np.sqrt(0.95 * 0.05 / TRIALS)  # of a share of 95 % over the trials


def bowl(z, middle, depth):
    return 20.0 + depth * ((z - np.asarray(middle)) ** 2).sum(axis=1)


def covered(middle, place, depth, noise, seed):
    """Share of trials in which the region of confidence holds the true place of the minimum."""
    rng = np.random.default_rng(seed)
    hits = flat = 0
    for _ in range(TRIALS):
        fit = fit_quadratic(PLANE, bowl(PLANE, middle, depth) + rng.normal(0.0, noise, len(PLANE)))
        whole = fit.level > FLAT
        flat += whole
        hits += whole or bool(fit.least_in(np.array([place]), PLANE)[0])
    return hits / TRIALS, flat / TRIALS


def test_region_of_an_inner_minimum_has_its_confidence():
    hits, flat = covered((0.2, -0.1), (0.2, -0.1), depth=4.0, noise=1.0, seed=1)
    assert abs(hits - 0.95) < SPREAD and flat == 0.0  # exact where the minimum is well inside


@pytest.mark.parametrize(
    "middle, place, noise",
    [
        ((1.6, -0.1), (1.0, -0.1), 2.0),  # at an edge of the box
        ((1.6, -1.6), (1.0, -1.0), 2.0),  # in a corner
        ((0.2, -0.1), (0.2, -0.1), 30.0),  # hardly seen
    ],
)
def test_regions_elsewhere_hold_at_least_as_often(middle, place, noise):
    hits, _ = covered(middle, place, depth=4.0, noise=noise, seed=2)
    assert hits > 0.95 - SPREAD


def test_flat_values_are_called_flat():
    _, flat = covered((0.0, 0.0), (0.0, 0.0), depth=0.0, noise=1.0, seed=3)
    assert abs(flat - 0.95) < SPREAD


def test_region_is_that_of_box_and_hunter_inside():
    """Where the fit is convex and its minimum is inside, a place is in the region if the gradient
    there is zero within its joint F interval."""
    rng = np.random.default_rng(4)
    fit = fit_quadratic(PLANE, bowl(PLANE, (0.2, -0.1), 4.0) + rng.normal(0.0, 1.0, len(PLANE)))
    places = 0.2 * rng.uniform(-1.0, 1.0, (400, 2)) + (0.2, -0.1)
    step = 1e-5
    slopes = [
        (terms(places + step * e) - terms(places - step * e)) / (2.0 * step) for e in np.eye(2)
    ]
    rows = np.stack(slopes, axis=1)  # (n, 2, p)
    gradient = rows @ fit.beta
    spread = fit.noise * rows @ fit.spread @ rows.transpose(0, 2, 1)
    distance = np.einsum("ni,nij,nj->n", gradient, np.linalg.inv(spread), gradient)
    from scipy.stats import f

    wanted = distance <= 2.0 * f.ppf(0.95, 2, fit.dof)
    assert 20 < wanted.sum() < 380
    assert (fit.least_in(places, PLANE) == wanted).mean() > 0.995


def samples(noise, repeats=1, depth=4.0, seed=5):
    x = np.repeat(PLANE, repeats, axis=0)
    rng = np.random.default_rng(seed)
    y = bowl(x, (0.2, -0.1), depth) + rng.normal(0.0, noise, len(x))
    names = ("a", "b")
    return Samples("force", "N", names, tuple(f"{n} [mm]" for n in names), x, y)


def test_both_models_find_a_minimum_and_a_maximum():
    pytest.importorskip("sklearn")
    found = surface_through(samples(0.3))
    for optimum in found.optima.values():
        assert np.abs(optimum.place - (0.2, -0.1)).max() < 0.15
        assert not optimum.whole and optimum.inside.mean() < 0.1
        assert (optimum.box[0] < (0.2, -0.1)).all() and (optimum.box[1] > (0.2, -0.1)).all()
        assert abs(optimum.value - 20.0) < 2.0 * optimum.half
    assert abs(found.models["kriging"].noise ** 0.5 - 0.3) < 0.1
    highest = surface_through(samples(0.3), highest=True)
    for optimum in highest.optima.values():
        assert np.allclose(optimum.place, (-1.0, 1.0), atol=1e-6)
        assert abs(optimum.value - bowl(np.array([[-1.0, 1.0]]), (0.2, -0.1), 4.0)[0]) < 1.0


@pytest.mark.slow
def test_kriging_region_holds_the_minimum_of_what_is_no_quadratic():
    """A skew valley, of which a quadratic misses the least: 40 trials, nearly all of which hold."""
    pytest.importorskip("sklearn")
    rng = np.random.default_rng(6)
    x = np.repeat(np.linspace(-1.0, 1.0, 15), 4)[:, None]
    valley = np.exp(1.5 * x[:, 0]) - 2.2 * x[:, 0]
    true = np.log(2.2 / 1.5) / 1.5
    hits = 0
    for _ in range(40):
        y = valley + rng.normal(0.0, 0.15, len(x))
        box = surface_through(
            Samples("f", "N", ("a",), ("a",), x, y), models=("kriging",)
        ).optima["kriging"].box  # fmt: skip
        hits += box[0, 0] <= true <= box[1, 0]
    assert hits >= 34


def test_a_surface_that_is_missed_says_so():
    rng = np.random.default_rng(8)
    x = np.repeat(LINE, 8)[:, None]
    y = np.sin(3.0 * x[:, 0]) + rng.normal(0.0, 0.05, len(x))
    found = surface_through(Samples("f", "N", ("a",), ("a",), x, y), models=("quadratic",))
    assert found.models["quadratic"].misfit < 1e-6
    assert "misses the points" in found.report()


SPEEDS = ["5000 rpm", "6000 rpm", "7000 rpm"]
LOADS = ["500 N", "1 kN", "1.5 kN", "2 kN"]


def finished(folder, *axes):
    """A study's folder whose cases have figures that lie about a bowl."""
    study = short_study(*axes, outputs=("cage_speed", "pocket_force_mean"))
    plan, out = make_plan(study), Folder(folder)
    out.prepare(plan)
    rng = np.random.default_rng(9)
    for planned in plan.cases:
        case = plan.case(planned)
        speed, load = case.drive.speed / 628.3, case.load.radial / 1e3
        value = 5.0 + 20.0 * (speed - 1.0) ** 2 + (load - 1.2) ** 2 + rng.normal(0.0, 0.01)
        figures = {
            "cage_speed": StudyFigure(value, "rad/s", "rpm"),
            "pocket_force_mean": StudyFigure(value, "N", "N", 0.02),
        }
        out.case(planned.hash).mkdir()
        out.write_row(out.case(planned.hash), row_of(planned, figures))
    return StudyResults(folder)


def test_a_finished_study_is_read(tmp_path, capsys):
    axes = Grid("drive.speed", SPEEDS), Grid("load.radial", LOADS)
    results = finished(tmp_path, *axes)
    found = response_surface(results, "pocket_force_mean", models=("quadratic",))
    speed, load = found.optima["quadratic"].place
    assert abs(speed - 6000.0) < 60.0 and abs(load - 1200.0) < 30.0
    assert found.samples.titles == ("drive.speed [rpm]", "load.radial [N]")
    command = ["study", "surface", str(tmp_path), "pocket_force_mean", "--model", "quadratic"]
    assert main(command) == 0
    assert "95 % region: load.radial [N]" in capsys.readouterr().out
    assert (tmp_path / "surface_pocket_force_mean.png").stat().st_size > 10_000
    lines = (tmp_path / "surface_pocket_force_mean.csv").read_text().splitlines()
    assert len(lines) == 1 + len(found.places)
    assert main([*command[:3], "pocket_force"]) == 2
    assert "no output 'pocket_force'" in capsys.readouterr().err
    assert main([*command, "--where", "drive.speed"]) == 2
    assert "should be PATH=VALUE" in capsys.readouterr().err


def test_what_else_varies_must_be_chosen(tmp_path):
    labels = Points([{"label": "one"}, {"label": "two", "contacts.pocket.slices": 20}])
    results = finished(tmp_path, Grid("load.radial", LOADS), labels)
    with pytest.raises(InputError, match="varies beside the surface's axes"):
        samples_of(results, "cage_speed", axes=["load.radial"])
    one = samples_of(results, "cage_speed", where={"label": "one"})
    assert one.axes == ("load.radial",) and len(one.y) == len(LOADS)
    with pytest.raises(InputError, match="No finished case has label = six"):
        samples_of(results, "cage_speed", where={"label": "six"})
    with pytest.raises(InputError, match="does not vary 'load.axial'"):
        samples_of(results, "cage_speed", axes=["load.axial"])


def test_axes_that_change_together_are_refused(tmp_path):
    results = finished(tmp_path, Zip({"drive.speed": SPEEDS, "load.radial": LOADS[:3]}))
    with pytest.raises(InputError, match="axes must not change together"):
        response_surface(results, "cage_speed", models=("quadratic",))


def test_a_surface_of_a_study_s_folder(tmp_path):
    with pytest.raises(InputError, match="There is no folder '.*none'"):
        response_surface(tmp_path / "none", "cage_speed")
