"""What pages are made of: thinned curves, split surfaces, escaped texts."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from report_parts import (
    NUMBERS,
    PEAK,
    SPIKE,
    SPIKE_AT,
    account,
    cage_stress,
    dataset,
    scene,
    study_account,
)

from flexcage.core.errors import InputError
from flexcage.render.scene import surface_of
from flexcage.report import page as page_module
from flexcage.report.blocks import Cell, Page, PageSection, PageTable, Text
from flexcage.report.cage_view import cage_figure, common_limit, split_at_edges
from flexcage.report.comparison import (
    MOST_NAMED,
    Abscissa,
    Output,
    comparison_charts,
    mark,
)
from flexcage.report.extras import extra_figures
from flexcage.report.histories import history_charts
from flexcage.report.page import html, write_page
from flexcage.report.plots import new_figure
from flexcage.report.run_page import run_page
from flexcage.report.study_page import study_page
from flexcage.report.tables import filled
from flexcage.report.thinning import thinned
from flexcage.results.row import SummaryRow
from flexcage.results.summary import Section as Part
from flexcage.results.summary import Summary


class _Texts(HTMLParser):
    """Elements of a page, and its text as a reader sees it."""

    def __init__(self) -> None:
        super().__init__()
        self.tags, self.text = [], []

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data):
        self.text.append(data)


def read(text: str) -> _Texts:
    parser = _Texts()
    parser.feed(text)
    return parser


def test_thinning_keeps_every_peak_and_draws_the_same_envelope():
    rng = np.random.default_rng(3)
    values = rng.normal(size=50_001)
    values[31_415], values[271] = 99.0, -77.0
    kept = thinned(values, 100)
    assert len(kept) <= 202 and {0, 50_000, 31_415, 271} <= set(kept)
    assert (np.diff(kept) > 0).all()
    for part in np.array_split(np.arange(50_000), 50):  # halves of buckets cannot hide a peak
        inside = kept[(kept >= part[0]) & (kept <= part[-1])]
        assert values[inside].max() == values[part].max()


def test_thinning_leaves_short_records_and_gaps():
    assert (thinned(np.arange(10.0)) == np.arange(10)).all()
    gap = np.ones(10_000)
    gap[3000:7000] = np.nan
    kept = thinned(gap, 50)
    assert np.isnan(gap[kept]).any() and np.isfinite(gap[kept]).any()


def test_histories_show_the_one_sample_that_bears_most():
    charts = history_charts(scene(dataset()), NUMBERS)
    force = next(c for c in charts if c.title.startswith("Pocket force"))
    rear = next(t for t in force.figures[0][1].data if t.name == "rear faces")
    assert max(rear.y) == pytest.approx(SPIKE)
    assert rear.x[int(np.argmax(rear.y))] == pytest.approx(SPIKE_AT / 50.0, rel=1e-6)
    assert len(rear.x) < 1500


def test_a_cube_is_split_into_its_faces():
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    tets = np.array([(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7),
                     (0, 5, 1, 7)])  # fmt: skip
    corner, sharp = split_at_edges(corners, surface_of(tets).triangles)
    assert corner.shape == (12, 3) and corner.max() + 1 == 24  # four of its own for each face
    lengths = np.linalg.norm(corners[sharp[:, 0]] - corners[sharp[:, 1]], axis=1)
    assert len(sharp) == 12 and lengths == pytest.approx(1.0)  # the diagonals are flat


def test_the_view_shows_the_deformed_cage_in_megapascals():
    cage = cage_stress()
    limit, over = common_limit([cage])
    assert over and 22e6 <= limit < PEAK  # one hot spot does not set the range
    figure = cage_figure(cage, 500.0, limit, over)
    body = figure.data[0]
    at = np.stack([body.z, body.x, body.y], axis=1) * 1e-3  # the view's z is the bearing's x
    moved = cage.points + 500.0 * cage.displacement
    hottest = int(np.argmax(body.intensity))
    assert body.intensity[hottest] == pytest.approx(PEAK / 1e6)
    assert at[hottest] == pytest.approx(moved[cage.peak_vertex], abs=1e-8)
    faces = np.stack([body.i, body.j, body.k], axis=1)
    a, b, c = (at[faces[:, k]] for k in range(3))
    volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0
    corners = moved[cage.tets]
    edges = corners[:, 1:] - corners[:, :1]
    assert volume == pytest.approx(np.linalg.det(edges).sum() / 6.0, rel=1e-4)


def test_one_range_suits_all_cages():
    cages = [cage_stress("a", 0.5), cage_stress("b", 1.0)]
    assert common_limit(cages)[0] == common_limit(cages[1:])[0] > common_limit(cages[:1])[0]


NASTY = "</script><script>alert(1)</script><b>&amp;"


def test_texts_are_escaped_everywhere():
    text = html(run_page(account(name=NASTY, case_text=NASTY, statement=[NASTY])))
    seen = read(text)
    assert "".join(seen.text).count("<script>alert(1)</script>") >= 4  # as words
    assert "<script>alert" not in text
    assert sum(tag == "script" and "type" not in given for tag, given in seen.tags) == 2


def test_names_of_cases_are_words_for_plotly_too():
    axis = Abscissa("label", ["<b>one</b>", "two"], [NASTY, "b"])
    (chart,) = comparison_charts(
        [Output("slip", "%", np.array([1.0, 2.0]), np.full(2, np.nan))], [axis], [NASTY, "second"]
    )
    figure = chart.figures[0][1]
    texts = [*figure.layout.xaxis.ticktext, figure.data[0].name, figure.data[0].text[0]]
    assert all("<b>" not in text and "<script" not in text for text in texts)


def test_points_of_a_group_are_joined_in_order_and_carry_intervals():
    values = [3.0, 1.0, 2.0, 1.0, 2.0, 3.0]
    group = ["a"] * 3 + ["b"] * 3
    mean = np.array([30.0, 10.0, 20.0, 1.0, np.nan, 3.0])
    half = np.array([3.0, 1.0, 2.0, np.nan, np.nan, 0.3])
    names = [f"case {k}" for k in range(6)]
    (chart,) = comparison_charts(
        [Output("force", "N", mean, half)], [Abscissa("load [N]", values, group)], names
    )
    first, second = chart.figures[0][1].data
    assert list(first.x) == [1.0, 2.0, 3.0] and list(first.y) == [10.0, 20.0, 30.0]
    assert list(first.error_y.array) == [1.0, 2.0, 3.0] and first.mode == "lines+markers"
    assert list(second.x) == [1.0, 3.0], "what failed is left out"
    assert "case 1" in first.text[0] and "10.0 ± 1.0 N" in first.text[0]
    assert "±" not in second.text[0]


@pytest.mark.parametrize("values", [[1.0, 2.0], ["one", "two"]])
def test_every_case_is_named_where_there_are_more_groups_than_colours(values):
    many = 45
    group = [f"cage {k}" for k in range(many) for _ in values]
    axis, n = Abscissa("load", values * many, group), len(group)
    output = Output("force", "N", np.arange(float(n)), np.full(n, np.nan))
    (chart,) = comparison_charts([output], [axis], group)
    data = chart.figures[0][1].data
    assert [s.name for s in data] == [f"cage {k}" for k in range(many)]
    assert all(s.showlegend and s.mode == "markers" for s in data)
    assert len({(s.marker.color, s.marker.symbol) for s in data}) == many
    if "one" in values:
        assert all(abs(x - i) < 0.5 for s in data for i, x in enumerate(s.x))
    assert len({tuple(mark(k).items()) for k in range(MOST_NAMED)}) == MOST_NAMED


def test_intervals_of_sizes_end_at_zero():
    """Two scattered runs: half of the interval is more than the mean. A force ends at zero, a slip
    ratio does not; both reach as far up."""
    mean, half = np.array([2.0, 5.0]), np.array([7.0, 1.0])
    axis = Abscissa("load [N]", [1.0, 2.0], ["", ""])
    for positive, least in ((True, 0.0), (False, -5.0)):
        (chart,) = comparison_charts([Output("x", "N", mean, half, positive)], [axis], ["a", "b"])
        (series,) = chart.figures[0][1].data
        below = np.array(series.y) - np.array(series.error_y.arrayminus)
        assert below.tolist() == [least, 4.0] and list(series.error_y.array) == [7.0, 1.0]
        assert "2.0 ± 7.0 N" in series.text[0], "the text keeps the whole margin"


def test_every_output_has_one_chart_with_a_choice_of_its_axis(tmp_path):
    n, loads = 3, [1.0, 2.0, 3.0]
    axes = [Abscissa(f"axis {k} [N]", loads, [""] * n) for k in range(5)]
    outputs = [Output(f"output {k}", "N", np.ones(n), np.full(n, np.nan)) for k in range(15)]
    page = study_page(study_account(tmp_path, outputs=outputs, abscissas=axes))
    blocks = next(s for s in page.sections if s.title == "Comparison").blocks
    _, shown, folded = blocks
    charts = [*shown.charts, *folded.charts]
    assert [c.title for c in charts] == [f"output {k}" for k in range(15)]
    assert all([name for name, _ in c.figures] == [f"axis {k}" for k in range(5)] for c in charts)
    assert len(shown.charts) == 12 and folded.title == "3 more outputs"
    text = html(page)
    (closed,) = re.findall(r"<details><summary>3 more outputs.*?</details>", text, flags=re.S)
    assert closed.count('class="chart"') == 3


def test_a_page_of_one_run_shows_no_chart_twice():
    """What the page draws as charts that can be zoomed or turned, it does not show as pictures."""
    names = ["mesh", "histories", "orbit", "spectra", "stress_peak", "stress_envelope", "my_own"]
    page = run_page(account(images=[Path(f"{name}.png") for name in names]))
    shown = [
        image.path.stem
        for section in page.sections
        for block in section.blocks
        if block.kind == "gallery"
        for image in block.images
    ]
    assert sorted(shown) == ["mesh", "my_own", "spectra", "stress_envelope"]


@pytest.mark.parametrize(
    ("names", "first"),
    [
        (["bearing", "mesh", "spectra", "stress_peak"], "stress_peak"),
        (["bearing", "mesh", "spectra"], "bearing"),
        ([], None),
    ],
)
def test_the_first_screen_has_a_picture_and_spectra_the_whole_width(names, first):
    page = run_page(account(images=[Path(f"{name}.png") for name in names]))
    begin = page.sections[0].blocks[0]
    assert (begin.image.path.stem if begin.kind == "beside" else None) == first
    images = [i for s in page.sections for b in s.blocks if b.kind == "gallery" for i in b.images]
    assert [i.path.stem for i in images if i.wide] == ["spectra"] * bool(names)
    assert first not in [i.path.stem for i in images], "not twice"


def test_what_histories_and_orbit_show_as_pictures_the_page_shows_as_charts():
    ds = dataset()
    ds["inner_speed"] = ds["inner_speed"] * np.linspace(0.5, 1.0, ds.sizes["time"])
    run = scene(ds)
    charts = {chart.title: chart.figures[0][1] for chart in history_charts(run, NUMBERS)}
    assert list(charts)[:2] == ["Speed of the inner ring", "Load on the inner ring"]
    assert [t.name for t in charts["Load on the inner ring"].data] == ["radial load"]
    spin = next(f for title, f in charts.items() if title.startswith("Roller spin"))
    assert f"roller {run.followed}" in [t.name for t in spin.data], "that of the damaged pocket"
    orbit = charts["Orbit of the cage's centre, settled part"]
    circle = next(t for t in orbit.data if t.name == "land clearance 250 µm")
    assert np.mean([min(circle.y), max(circle.y)]) == pytest.approx(15.0, abs=1e-3), (
        "about the place of the inner ring, which guides the cage"
    )
    assert {"start", "end", "mean"} <= {t.name for t in orbit.data}


def test_key_figures_carry_their_margins_or_say_why_not():
    rows = (
        SummaryRow("cage_speed", "Cage speed", 281.6, "rpm", margin=1.26),
        SummaryRow("cage_slip_ratio", "Slip", 0.0074286, "%"),
        SummaryRow("whirl_radius", "Whirl radius", 245.07e-6, "um"),
        SummaryRow("pocket_force_peak", "Peak", 89.001, "N", "pocket 19"),
        SummaryRow("energy_audit", "Audit", "passed", "", "at most 0.1 %"),
    )
    page = run_page(account(summary=Summary((Part("All", rows),))))
    tiles = next(s for s in page.sections if s.title == "Key figures").blocks[0].tiles
    assert [(t.value, t.note) for t in tiles] == [
        ("2,689 rpm", "± 12"),
        ("0.743 %", "± not known: the run is too short"),
        ("245 µm", "± not known: the run is too short"),
        ("89.0 N", "one instant"),
        ("passed", "at most 0.1 %"),
    ]


def test_a_key_figure_says_of_what_it_is_beside_its_margin():
    row = SummaryRow(
        "pocket_force_mean", "Pocket force, mean", 2.198, "N", "while in contact; more", 0.054
    )
    page = run_page(account(summary=Summary((Part("All", (row,)),))))
    tiles = next(s for s in page.sections if s.title == "Key figures").blocks[0].tiles
    assert [(t.value, t.note) for t in tiles] == [("2.198 N", "± 0.054, while in contact")]


def test_long_tables_are_folded_away():
    page = run_page(account())
    folds = [b.fold for s in page.sections for b in s.blocks if b.kind == "table" and b.fold]
    assert folds == ["All figures", "Settings", "Values that no source gives"]
    text = html(page)
    assert re.search(r"<details><summary>All figures \(\d+\)</summary>", text)
    assert text.count("<details") == text.count("</details>")


def test_legends_stand_above_the_plot_and_buttons_beside_it():
    """No legend or button lies over a curve: the script of a page adds the height of the legend."""
    figure = new_figure("x", "y")
    legend = figure.layout.legend
    assert legend.y > 1.0 and legend.yanchor == "bottom" and legend.maxheight > 100
    assert figure.layout.margin.r >= 40


def test_a_page_asks_for_nothing_outside():
    text = html(run_page(account()))
    for _, given in read(text).tags:
        for name in ("src", "href", "action", "data", "poster"):
            assert re.match("data:|#|$", given.get(name, ""))
    assert "default-src 'none'" in text and len(text.encode()) < 15e6


def test_a_page_without_charts_carries_no_plotly():
    page = Page("Small", "", [PageSection("Only", [Text("file", "x = 1")])])
    assert len(html(page)) < 20_000


def test_a_page_too_large_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(page_module, "LIMIT", 1000)
    with pytest.raises(InputError, match="more than 0 MB; show fewer pictures"):
        write_page(
            Page("Large", "", [PageSection("A", [Text("b", "c" * 2000)])]), tmp_path / "a.html"
        )
    assert not list(tmp_path.iterdir())


def test_a_page_that_cannot_be_written(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot be written"):
        write_page(Page("A", "", []), tmp_path / "file" / "a.html")


def test_figures_of_a_folder(tmp_path):
    assert extra_figures(tmp_path) is None
    place = tmp_path / "figures"
    place.mkdir()
    for name in ("b_two.png", "a.png"):
        (place / name).write_bytes(b"")
    (place / "captions.json").write_text('{"a.png": "The first <one>"}')
    (place / "margins.csv").write_text("case,margin\nsound,0.25\n")
    gallery, table = extra_figures(tmp_path).blocks
    assert [i.caption for i in gallery.images] == ["The first <one>", "B two"]
    assert table.cells[0][1] == Cell("0.25", 0.25)
    (place / "captions.json").write_text('["a"]')
    with pytest.raises(InputError, match="should map file names to captions"):
        extra_figures(tmp_path)


def test_columns_without_content_are_left_out():
    table = filled(PageTable(("a", "b", "c"), [["1", "", "x"], ["2", "", ""]]))
    assert list(table.head) == ["a", "c"]
    assert filled(PageTable(("a", "b"), [])).head == ("a", "b")
