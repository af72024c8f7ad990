"""The benchmarks run and print what README.md promises; nothing is timed."""

import json
import math
import re
import sys
from importlib import import_module
from pathlib import Path

import pytest

PAGES = [
    Path(__file__).with_name(name)
    for name in ("README.md", "peers.md", "methods.md", "large_studies.md")
]
FAST = ("solver", "fe", "scale", "ball", "methods", "start", "own", "machine", "rollers")
SLOW = {
    "peer": "sksundae",
    "exudyn": "exudyn",
    "study": "distributed",
    "dataset": "pyarrow",
    "shards": "pyarrow",
    "whole": "",
}  # and what they need
POSITIVE = re.compile(
    r"cpu_s_per|force_error|first_step_s|import_s|total_s|_us$|tetrahedra|plain_s|window_ms"
)


def promised(what):
    """Keys in the tables of a benchmark's section."""
    section, level = "", 0
    text = "".join(page.read_text("utf-8") for page in PAGES)
    for line in text.splitlines(keepends=True):
        heading = re.match(r"(#+) (.*)", line)
        if heading and (not level or len(heading[1]) <= level):
            level = len(heading[1]) if heading[2].lower() == what else 0
        section += line if level else ""
    tables = re.findall(r"\| key \| meaning \|\n\|---\|---\|\n((?:\|.*\n)+)", section)
    cells = [row.split("|")[1] for table in tables for row in table.splitlines()]
    return {key for cell in cells for key in re.findall(r"`(\w+)`", cell)}


def numbers(found):
    """All numbers in an object."""
    if isinstance(found, dict):
        found = list(found.values())
    if isinstance(found, list):
        return [number for item in found for number in numbers(item)]
    return [found] if isinstance(found, (int, float)) else []


@pytest.fixture
def run(monkeypatch):
    """The script, whose choice of threads and of folders ends with the test."""
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        monkeypatch.setenv(name, "1")
    monkeypatch.setattr(sys, "path", [*sys.path])
    return import_module("run")


def test_every_benchmark_is_run_here(run):
    assert {*FAST, *SLOW} == set(run.WHAT)


@pytest.mark.parametrize(
    "what", [*FAST, *(pytest.param(name, marks=pytest.mark.slow) for name in SLOW)]
)
def test_a_benchmark_prints_what_is_promised(run, what, capsys):
    if SLOW.get(what):
        pytest.importorskip(SLOW[what])
    assert run.main([what, "--json", "--quick"]) == 0
    figures = json.loads(capsys.readouterr().out)
    keys = promised(what)
    for part in figures.values() if what == "whole" else [figures]:
        assert keys and keys <= set(part)
    assert all(math.isfinite(number) for number in numbers(figures))
    positive = [key for key in figures if POSITIVE.search(key)]
    assert all(min(numbers(figures[key])) > 0.0 for key in positive)
