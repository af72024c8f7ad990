"""Pages in a real browser: they load offline, draw, turn, sort, and are legible at any width."""

from __future__ import annotations

import io
import time

import browser as looking
import numpy as np
import pytest
from report_parts import account, study_account

from flexcage.report.comparison import Abscissa, Output
from flexcage.report.page import write_page
from flexcage.report.run_page import run_page as run_page_of
from flexcage.report.study_page import study_page

pytestmark = pytest.mark.skipif(bool(looking.why_not()), reason=looking.why_not())

VIEW = """
return [...document.querySelectorAll('.plot')].find(p => p._fullLayout && p._fullLayout.scene)
"""
CAMERA = "const c = arguments[0]._fullLayout.scene._scene.getCamera(); return [c.eye, c.up]"
COLUMN = """
const [table, column] = [document.querySelectorAll('table')[arguments[0]], arguments[1]];
return [...table.tBodies[0].rows].map(row => row.children[column].textContent)
"""
# contrast of every text against what lies under it (WCAG 2), and its size
LEGIBLE = """
const parse = (c) => c.match(/[\\d.]+/g).map(Number);
const light = (c) => { const [r, g, b] = c.slice(0, 3).map(v => v / 255).map(
  v => v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
const under = (e) => {
  for (; e; e = e.parentElement) {
    const c = parse(getComputedStyle(e).backgroundColor);
    if (c.length < 4 || c[3] > 0.99) return c;
  }
  return [255, 255, 255];
};
const found = [], walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
while (walker.nextNode()) {
  const e = walker.currentNode.parentElement;
  if (!walker.currentNode.data.trim() || e.closest('script, style, svg, noscript')) continue;
  const style = getComputedStyle(e), ink = light(parse(style.color)), paper = light(under(e));
  const contrast = (Math.max(ink, paper) + 0.05) / (Math.min(ink, paper) + 0.05);
  found.push([parseFloat(style.fontSize), contrast, paper, e.textContent.slice(0, 40)]);
}
return found;
"""


@pytest.fixture(scope="module")
def browser():
    driver = looking.open_browser()
    yield driver
    driver.quit()


@pytest.fixture(scope="module")
def run_page(browser, run_file):
    looking.load(browser, run_file)
    return browser


def pixels(element) -> np.ndarray:
    import PIL.Image

    return np.asarray(PIL.Image.open(io.BytesIO(element.screenshot_as_png)).convert("RGB"), int)


def view(browser):
    """The 3D view, in sight and still."""
    element = browser.execute_script(VIEW)
    browser.execute_script(
        "arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", element
    )
    time.sleep(0.5)
    return element


def drag(browser, element, dx: int, dy: int) -> None:
    from selenium.webdriver import ActionChains

    chain = ActionChains(browser).move_to_element(element).click_and_hold()
    for _ in range(4):
        chain.move_by_offset(dx // 4, dy // 4)
    chain.pause(1.0).release().perform()  # the view swings after the mouse: let it come to rest
    time.sleep(1.0)


@pytest.mark.parametrize("width", [1280, 400])
@pytest.mark.parametrize("page", ["run_file", "study_file"])
def test_it_loads_offline_without_errors_and_is_legible(browser, request, page, width):
    browser.execute_cdp_cmd("Network.enable", {})
    offline = {"offline": True, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0}
    browser.execute_cdp_cmd("Network.emulateNetworkConditions", offline)
    looking.load(browser, request.getfixturevalue(page), width=width)
    assert looking.requests(browser) == []
    assert looking.complaints(browser) == []
    charts, drawn = browser.execute_script(
        "return [document.querySelectorAll('.plot').length,"
        " document.querySelectorAll('.plot.drawn > .js-plotly-plot, .plot.drawn.js-plotly-plot')"
        ".length]"
    )
    assert drawn == charts > 0
    inner, scrolled = browser.execute_script(
        "return [innerWidth, document.documentElement.scrollWidth]"
    )
    assert inner == width and scrolled <= width, "the page itself never scrolls sideways"
    wide = browser.execute_script(
        "return [...document.querySelectorAll('.scroll, pre, select, img, .plot')]"
        ".filter(e => e.getBoundingClientRect().right > innerWidth).map(e => e.outerHTML)"
    )
    assert wide == []
    texts = browser.execute_script(LEGIBLE)
    assert len(texts) > 50
    assert min(t[0] for t in texts) >= 12.0
    assert [t for t in texts if t[1] < 4.5 or t[2] < 0.7] == []


def test_charts_that_are_folded_away_are_drawn_when_unfolded(browser, tmp_path):
    axes = [Abscissa(f"axis {k}", [1.0, 2.0, 3.0], [""] * 3) for k in range(2)]
    outputs = [Output(f"output {k}", "N", np.ones(3), np.full(3, np.nan)) for k in range(15)]
    page = study_page(study_account(tmp_path, outputs=outputs, abscissas=axes, stress=()))
    looking.load(browser, write_page(page, tmp_path / "page.html"), width=1280)
    drawn = "return document.querySelectorAll('.plot.drawn').length"
    assert browser.execute_script(drawn) == 12
    fold = "return document.querySelectorAll('details:has(.chart)')[0]"
    summary = browser.execute_script(f"{fold}.querySelector('summary')")
    for _ in range(3):  # opened, closed, opened again: drawn once
        summary.click()
        time.sleep(1.0)
    assert browser.execute_script(drawn) == 15
    widths = browser.execute_script(
        f"const fold = (() => {{ {fold} }})();"
        "return [...fold.querySelectorAll('.plot')].map(e => [e.clientWidth,"
        " e.querySelector('.main-svg').clientWidth])"
    )
    assert len(widths) == 3 and all(plot == svg > 200 for plot, svg in widths)
    assert looking.complaints(browser) == []


@pytest.mark.parametrize("width", [1280, 400])
def test_a_long_legend_leaves_the_plot_its_height(browser, tmp_path, width):
    """Twelve groups with long names, and a choice of what is drawn against."""
    groups = [f"contacts.pocket.friction.dynamic = 0.{k:02d}, cage = flexible" for k in range(12)]
    n = 2 * len(groups)
    long = Abscissa("load [N]", [1.0, 2.0] * len(groups), [g for g in groups for _ in range(2)])
    short = Abscissa("speed [rpm]", list(range(n)), [""] * n)
    output = Output("force", "N", np.arange(float(n)), np.full(n, 3.0), positive=True)
    page = study_page(
        study_account(
            tmp_path,
            outputs=[output],
            abscissas=[short, long],
            points=[str(k) for k in range(n)],
            stress=(),
            images=(),
        )  # fmt: skip
    )
    looking.load(browser, write_page(page, tmp_path / "page.html"), width=width)
    heights = """const plot = document.querySelector('.plot');
        const rect = (what) => plot.querySelector(what)?.getBoundingClientRect();
        const legend = rect('.legend'), area = rect('.nsewdrag');
        return [plot.clientHeight, area.height, legend ? area.top - legend.bottom : null]"""
    alone = browser.execute_script(heights)
    assert alone[2] is None and alone[1] > 180.0
    choice = browser.find_element("css selector", "figure select")
    for value, several in (("1", True), ("0", False), ("1", True)):
        browser.execute_script(
            "arguments[0].value = arguments[1]; arguments[0].dispatchEvent(new Event('change'))",
            choice, value,
        )  # fmt: skip
        time.sleep(1.0)
        high, area, apart = browser.execute_script(heights)
        if several:
            assert high > alone[0] + 100 and area > 0.9 * alone[1] and apart >= 0.0
        else:
            assert [high, area] == pytest.approx(alone[:2], abs=2.0) and apart is None
    assert looking.complaints(browser) == []


def test_the_watch_would_see_a_page_that_misbehaves(browser, tmp_path):
    page = tmp_path / "bad.html"
    page.write_text(
        "<body data-drawn=yes>bad<script src='http://127.0.0.1:9/a.js'></script>"
        "<script>throw new Error('broken')</script></body>"
    )
    looking.load(browser, page)
    assert looking.requests(browser) == ["http://127.0.0.1:9/a.js"]
    assert any("broken" in text for text in looking.complaints(browser))


def test_the_cage_is_drawn_and_turns(run_page):
    element = view(run_page)
    before, camera = pixels(element), run_page.execute_script(CAMERA, element)
    body = (before.max(axis=2) - before.min(axis=2)) > 40  # coloured, unlike lines and words
    rows, columns = np.flatnonzero(body.any(axis=1)), np.flatnonzero(body[:-90].any(axis=0))
    assert body[:-90].mean() > 0.03, "the cage covers part of the view"
    assert rows[0] > 5 and columns[0] > 5 and columns[-1] < body.shape[1] - 5, "and is all in it"
    hot = (np.abs(before[:-90] - [0xD5, 0x5E, 0x00]).max(axis=2) < 45).sum()
    assert hot > 20, "the hot spot has its own colour"
    drag(run_page, element, 160, 0)
    after, turned = pixels(element), run_page.execute_script(CAMERA, element)
    assert np.abs(np.subtract([*turned[0].values()], [*camera[0].values()])).max() > 0.1
    assert turned[0]["z"] == pytest.approx(camera[0]["z"], abs=1e-6), "about the bearing's axis"
    assert turned[1] == camera[1]
    assert (np.abs(after - before).max(axis=2) > 40).mean() > 0.01
    assert looking.complaints(run_page) == []


def test_pointing_at_the_cage_tells_the_stress(run_page):
    from selenium.webdriver import ActionChains

    element = view(run_page)
    colours = pixels(element)
    body = (colours.max(axis=2) - colours.min(axis=2)) > 40
    rows, columns = np.nonzero(body[:-100])
    told = []
    for k in np.linspace(0.2, 0.8, 7):  # some of these lie well inside the body
        y, x = rows[int(k * len(rows))], columns[int(k * len(rows))]
        dx, dy = int(x - body.shape[1] // 2), int(y - body.shape[0] // 2)
        ActionChains(run_page).move_to_element_with_offset(element, dx, dy).pause(0.4).perform()
        told += run_page.execute_script(
            "return [...arguments[0].querySelectorAll('.hovertext')].map(e => e.textContent)",
            element,
        )
    assert told and all("MPa" in text and "at pocket" in text for text in told)
    assert all(0.0 < float(text.split()[0]) <= 40.0 for text in told)


def test_tables_sort_by_number_and_by_word(browser, study_file):
    looking.load(browser, study_file)
    tables = browser.execute_script(
        "return [...document.querySelectorAll('table')].map(t => t.tHead.textContent)"
    )
    means = next(k for k, head in enumerate(tables) if "slip [%]" in head)
    heading = browser.find_elements("css selector", "table")[means].find_elements(
        "css selector", "th button"
    )
    heading[1].click()
    assert browser.execute_script(COLUMN, means, 1) == ["9", "10", "100"]
    heading[1].click()
    assert browser.execute_script(COLUMN, means, 1) == ["100", "10", "9"]
    heading[1].click()
    assert browser.execute_script(COLUMN, means, 1) == ["10", "9", "100"], "as it was"
    heading[2].click()
    assert browser.execute_script(COLUMN, means, 2) == ["0.5", "0.7", "–"], "nothing stands last"


def _between(one, other) -> float:
    """Distance of two cameras' eyes."""
    return float(np.linalg.norm(np.subtract([*one[0].values()], [*other[0].values()])))


def test_a_picture_opens_large_and_closes(browser, tmp_path):
    import PIL.Image

    images = [tmp_path / "mesh.png", tmp_path / "modes.png"]
    for path in images:
        PIL.Image.effect_noise((1802, 1012), 60.0).save(path)
    told = account(images=images)
    page = write_page(run_page_of(told), tmp_path / "a.html")
    looking.load(browser, page)
    image = browser.find_element("css selector", ".gallery img")
    browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", image)
    small = image.size["width"]
    image.click()
    large = browser.find_element("css selector", "dialog[open] img")
    assert small < 600 < 1100 < large.size["width"] <= 1280 and large.size["height"] <= 900
    large.click()
    assert browser.find_elements("css selector", "dialog[open]") == []
    assert looking.complaints(browser) == []


def test_the_view_changes_with_the_case_and_keeps_its_camera(browser, study_file):
    from selenium.webdriver.support.ui import Select

    looking.load(browser, study_file)
    element = view(browser)
    first = browser.execute_script(CAMERA, element)
    drag(browser, element, 80, 0)
    camera, before = browser.execute_script(CAMERA, element), pixels(element)
    Select(browser.find_element("css selector", ".chart select")).select_by_index(1)
    time.sleep(1.5)
    peak = browser.execute_script(
        "return arguments[0]._fullLayout.scene.annotations[0].text", element
    )
    assert peak == "peak 20 MPa"
    kept = browser.execute_script(CAMERA, element)
    # plotly keeps the camera of the moment the button was let go; the view swings on a little
    assert _between(kept, camera) < 0.3 * _between(first, camera)
    assert (np.abs(pixels(element) - before).max(axis=2) > 30).mean() > 0.01
    assert looking.complaints(browser) == []
