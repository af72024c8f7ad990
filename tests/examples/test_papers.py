"""The papers' studies: their texts load and plan, and their claims judge figures of known order."""

import sys
from dataclasses import replace
from math import isnan
from pathlib import Path
from types import SimpleNamespace

import pytest
from PIL import Image

from flexcage.core.errors import InputError
from flexcage.study.outputs import Figure
from flexcage.study.plan import make_plan
from flexcage.study.verdicts import FAILS, HOLDS, UNDECIDED, Verdict, read_verdicts

PAPERS = Path(__file__).parents[2] / "examples" / "papers"


@pytest.fixture(scope="module")
def papers():
    """The modules of examples/papers, which import each other as scripts do."""
    sys.path.insert(0, str(PAPERS))
    import n1013_claims
    import n1013_figures
    import n1013_page
    import n1013_pinch
    import n1013_pocket_deformation as script
    import n1013_view

    yield SimpleNamespace(
        view=n1013_view, claims=n1013_claims, page=n1013_page, pinch=n1013_pinch, script=script,
        figures=n1013_figures,
    )  # fmt: skip
    sys.path.remove(str(PAPERS))


def rows_with(cages, variation="base", starts=3):
    """Finished cases as the study gives them: figures by cage, the same from every start."""
    return {
        (cage, variation): tuple(
            SimpleNamespace(figures={k: Figure(v, "", "", abs(v) * 0.002) for k, v in f.items()})
            for _ in range(starts)
        )
        for cage, f in cages.items()
    }


def claim(papers, key):
    return next(c for c in papers.claims.CLAIMS if c.key == key)


def test_the_whole_study_is_a_plan(papers):
    study = papers.script.load()
    plan = make_plan(study)
    assert len(plan.cases) == 5 * 9 * 3
    labels = {(p.point.labels["cage"], p.point.labels["variation"]) for p in plan.cases}
    assert {cage for cage, _ in labels} == set(papers.view.CAGES)
    case = plan.case(next(p for p in plan.cases if p.point.labels["cage"] == "dp -0.3"))
    assert case.defects[0].displacement == pytest.approx(-0.3e-3)
    assert case.cage.pocket_length - case.bearing.roller_length == pytest.approx(0.25e-3)
    assert case.cage.pocket_width - case.bearing.roller_diameter == pytest.approx(0.20e-3)
    # ten turns of the cage remain after settling, at the epicyclic 45.15 Hz and 1 % of slip
    for one in (case, study.case):
        assert one.solver.duration * (1 - one.output.settle) > 10 / (0.99 * 45.1515)


def test_stages_are_parts_of_the_study(papers):
    """Every case of a stage is one of the whole study, and nothing is computed twice."""
    study = papers.script.load()
    whole = {p.hash for p in make_plan(study).cases}
    counts = {}
    for name, stage in papers.script.STAGES.items():
        hashes = {p.hash for p in make_plan(papers.script.part(study, stage)).cases}
        assert hashes <= whole, name
        counts[name] = len(hashes)
    assert counts["base"] == 15 and counts["rigid"] == 10 and counts["crossbeam"] == 6
    assert counts["rest"] == len(whole)
    quick = make_plan(papers.script.load(quick=True))
    assert len(quick.cases) == 5


def test_stress_that_rises_holds_and_one_that_does_not_fails(papers):
    c = papers.view
    rising = {cage: {c.STRESS: s, c.CORNER: s} for cage, s in zip(c.CROSSBEAM, (10e6, 12e6, 30e6))}
    one = claim(papers, "000-1")
    found = one.verdict(rows_with(rising), ("base", "Z 21"))
    assert (found.outcome, found.range) == (
        HOLDS,
        "Cq - Dw: holds at 0.2 mm. Cp - Lw: holds at 0.25 mm. Z: holds at 22. "
        "undecided, not computed: Z 21. (mean of the peak) holds: base. "
        "(pocket corners) holds: base",
    )
    assert found.figures[0].value == pytest.approx(10.0) and found.figures[0].unit == "MPa"
    flat = {cage: {c.STRESS: 10e6, c.CORNER: 10e6} for cage in c.CROSSBEAM}
    assert one.verdict(rows_with(flat), ("base",)).outcome == UNDECIDED
    falling = dict(zip(c.CROSSBEAM, reversed(rising.values())))
    assert one.verdict(rows_with(falling), ("base",)).outcome == FAILS
    assert one.verdict({}, ("base",)).outcome == UNDECIDED
    assert one.verdict({}, ("base",)).reason == "not computed"


def test_a_roller_that_stops_drops_and_one_that_slows_by_a_percent_does_not(papers):
    c = papers.view
    twelve = claim(papers, "000-12")

    def outcome(longer, shorter):
        speeds = {c.SOUND: -2900.0, c.LONGER: longer, c.SHORTER: shorter}
        figures = {cage: {c.spin(5): v, c.spin_ripple(5): 0.01} for cage, v in speeds.items()}
        return twelve.verdict(rows_with(figures), ("base",)).outcome

    assert outcome(-2900.0, -280.0) == HOLDS
    assert outcome(-2900.0, -2870.0) == FAILS
    assert outcome(-2500.0, -280.0) == FAILS


def test_a_case_whose_energy_does_not_close_is_left_out(papers):
    def case(state, missing):
        labels = {"cage": "sound", "variation": "base"}
        figures = {"energy_of_drive": Figure(missing, "1")} if state == "done" else {}
        point = SimpleNamespace(labels=labels)
        return SimpleNamespace(state=state, figures=figures, planned=SimpleNamespace(point=point))

    cases = [case("done", 2e-4), case("done", 2e-3), case("failed", 0.0)]
    rows = papers.view.rows_of(SimpleNamespace(rows=cases))
    assert rows == {("sound", "base"): (cases[0],)}


def test_every_claim_of_the_paper_is_there(papers):
    keys = [c.key for c in papers.claims.CLAIMS]
    assert keys == [f"000-{k}" for k in range(1, 14)]
    outputs = set(papers.script.load().outputs)
    for c in papers.claims.CLAIMS:
        assert set(c.figures) <= outputs, c.key
        for output in c.figures:  # each has a name and a unit
            papers.view.shown(output, "sound", papers.view.Estimate(1.0))


def test_the_static_pair_is_linear_and_loses_its_force_with_the_interference(papers):
    p = papers.pinch
    found = p.PinchMap(2e-8, 0.1e6, 0.2e6, (), 160e6)
    assert found.static(0.25e-3).force == pytest.approx(2500.0)
    assert found.static(0.25e-3).corner == pytest.approx(250e6)
    assert found.static(0.31e-3).force == 0.0
    assert found.clearance_of(250e6) == pytest.approx(0.25e-3)
    two = tuple(p.Squeezed(c, 0.0, s, s) for c, s in ((0.2e-3, 700e6), (0.28e-3, 100e6)))
    bearings = replace(found, assembled=two)
    assert bearings.assembled_clearance_of(400e6) == pytest.approx(0.24e-3)
    assert isnan(bearings.assembled_clearance_of(50e6))


def test_mistakes_are_refused_before_anything_is_computed(papers, tmp_path):
    with pytest.raises(InputError, match="There is no stage 'bsae'; choose from base"):
        papers.script.main(["--stages", "bsae", "-o", str(tmp_path / "out")])
    with pytest.raises(InputError, match="leave out --quick or --page"):
        papers.script.main(["--quick", "--page", "-o", str(tmp_path / "out")])
    assert not (tmp_path / "out").exists()


def test_the_page_is_a_table(papers):
    verdict = Verdict(key="1", claim="a < b", outcome=HOLDS)
    table = papers.page._table([verdict]).splitlines()
    assert table[-1] == "| 1 | a < b | **holds** |  |"


def test_the_page_shows_all_that_the_paper_plots_and_keeps_its_colours(papers, tmp_path):
    drawn = {"acceleration", "cage_speed", "radial_displacement", "roller_speeds", "stress"}
    assert set(papers.figures.HISTORIES) == drawn
    names = {f"{name}.png" for name in drawn} | {"orbits.png", "pinch.png", "stress_sound.png"}
    pictures = tmp_path / "figures"
    pictures.mkdir()
    blend = (51, 177, 143)  # a band of the second roller over white
    for name in {*names, "other.png"}:
        image = Image.new("RGB", (2500, 200), "white")
        image.paste(blend, (0, 0, 1250, 200))
        image.save(pictures / name)
    found = papers.page._copy_images(pictures, tmp_path / "images")
    assert {path.name for path in found} == names == {p.name for p in found[0].parent.iterdir()}
    for path in found:
        with Image.open(path) as image:
            assert image.size == (1250, 100) and path.stat().st_size < 200_000
            if path.stem in drawn:
                assert image.convert("RGB").getpixel((100, 50)) == pytest.approx(blend, abs=2)
    text = papers.page._pictures(found)
    for path in found:
        caption = text.partition(f"](images/{path.name})\n\n*")[2].partition("*\n")[0]
        assert caption.strip("*").endswith(".") and len(caption) > 20, path.name
    assert "*Speed of the cage over time.*" in text


def test_the_page_counts_the_cases_that_had_not_settled(papers):
    def results(**drifts):
        rows, stored = [], {}
        for name, drift in drifts.items():
            labels = {"cage": "sound", "variation": "base" if name < "c" else "Z 21"}
            planned = SimpleNamespace(hash=name, point=SimpleNamespace(labels=labels))
            rows.append(SimpleNamespace(planned=planned))
            if drift != "open":
                figures = {} if drift == "lacking" else {"drift": Figure(drift, "")}
                stored[name] = SimpleNamespace(figures=figures)
        return SimpleNamespace(rows=rows, stored=stored)

    told = papers.page._unsettled(
        results(a="whirl radius", b="nothing", c="cage speed, whirl radius", d=None, e="open")
    )
    assert "2 of 3 cases had not settled" in told
    assert "in whirl radius (2), cage speed (1)." in told
    assert told.endswith("At the base clearances, sound: whirl radius in 1 of 2 starts.")
    assert "Every one of 2 cases" in papers.page._unsettled(results(a="nothing", c="nothing"))
    assert papers.page._unsettled(results(a="lacking", b="open")) == ""


def test_a_reason_has_the_figures_and_only_for_the_outcome_it_explains(papers):
    c = papers.view
    speeds = {c.SOUND: -2900.0, c.LONGER: -2900.0, c.SHORTER: 280.0}
    rows = rows_with({cage: {c.spin(5): w, c.spin_ripple(5): 0.01} for cage, w in speeds.items()})
    found = claim(papers, "000-12").verdict(rows, ("base",))
    text = papers.page.with_reason(found, c.View(rows)).reason
    assert found.outcome == HOLDS and "-2,674" in text and "27,693" in text  # rpm
    failed = replace(found, outcome=FAILS)
    assert papers.page.with_reason(failed, c.View(rows)).reason == ""
    missing = claim(papers, "000-12").verdict({}, ("base",))
    assert papers.page.with_reason(missing, c.View({})).reason == "not computed"


@pytest.mark.slow
def test_quick_mode_from_end_to_end(papers, tmp_path):
    found = papers.script.main(["--quick", "-o", str(tmp_path / "quick")])
    stored = [(v.key, v.outcome, v.range) for v in read_verdicts(tmp_path / "quick")]
    assert len(found) == 14 and stored == [(v.key, v.outcome, v.range) for v in found]
    by_key = {v.key: v for v in found}
    assert by_key["000-8"].figures and by_key["000-8b"].outcome in (HOLDS, FAILS)
    # the roller that its pocket pinches stands still in it: it turns with the cage
    speed = next(f for f in by_key["000-12"].figures if f.label == "speed of roller j, dp -0.3")
    assert speed.value < 0.2 * 27937.5
    images = {p.name for p in (tmp_path / "quick" / "figures").glob("*.png")}
    assert {"stress.png", "orbits.png", "pinch.png", "stress_sound.png"} <= images
