"""The example of heat: the numbers of its page, and the case that it leaves."""

import re
import tomllib
from pathlib import Path

import pytest

from flexcage import load_case, warm

EXAMPLES = Path(__file__).parents[2] / "examples"
PAGE = (EXAMPLES / "heat.md").read_text("utf-8")


@pytest.fixture(scope="module")
def warmth():
    return warm(load_case(EXAMPLES / "6206_warm.toml"))


def number(pattern):
    return float(re.search(pattern, PAGE)[1])


def test_its_page_has_its_numbers(warmth):
    t, end = warmth.temperatures, warmth.last
    assert len(warmth.iterations) == number(r"settles after (\d+) iterations")
    assert t["inner"] - 273.15 == pytest.approx(number(r"inner ring has ([\d.]+) °C"), abs=0.06)
    assert t["outer"] - 273.15 == pytest.approx(number(r"outer one ([\d.]+) °C"), abs=0.06)
    assert end.loss == pytest.approx(number(r"oil and seals lose ([\d.]+) W"), abs=0.06)
    assert 1e6 * end.clearance == pytest.approx(number(r"mounting, ([\d.]+) um are left"), abs=0.06)
    assert 1e6 * warmth.iterations[0].clearance == pytest.approx(
        number(r"it would be ([\d.]+) um"), abs=0.06
    )
    assert end.out["shaft to ambient"] == pytest.approx(
        number(r"([\d.]+) W leave by the shaft"), abs=0.06
    )
    assert end.out["housing to ambient"] == pytest.approx(number(r"shaft, ([\d.]+) W by"), abs=0.06)
    assert t["inner"] == pytest.approx(number(r"# ([\d.]+) K"), abs=0.06)
    assert end.losses["inner race"] == pytest.approx(number(r"# ([\d.]+) W"), abs=0.06)


def test_its_page_shows_what_the_file_says(warmth):
    shown = tomllib.loads(re.search(r"```toml\n(.*?)```", PAGE, re.DOTALL)[1])
    case = tomllib.loads((EXAMPLES / "6206_warm.toml").read_text("utf-8"))
    for section, values in shown.items():
        assert values.items() <= case[section].items()


def test_the_settled_case_is_as_warm(warmth):
    case, t = warmth.case, warmth.temperatures
    assert case.cage.temperature == pytest.approx(t["cage"], abs=0.006)
    assert case.fit.element_temperature == pytest.approx(t["elements"], abs=0.006)
    assert case.mounting.operating == pytest.approx(warmth.last.clearance, abs=2e-8)
    again = load_case(case.to_toml())
    assert again.hash == case.hash and again.mounted.bearing == case.mounted.bearing
