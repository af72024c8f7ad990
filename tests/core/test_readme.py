"""The pages hold what they promise: links and anchors lead somewhere, cases load, commands and
names exist, and no page is long."""

import argparse
import ast
import dataclasses
import importlib
import re
import shlex
from collections import Counter
from functools import cache
from operator import attrgetter
from pathlib import Path

import pytest

import flexcage
from flexcage import cli
from flexcage.bearings import in_motion
from flexcage.case import load_case

ROOT = Path(__file__).parents[2]
FOLDERS = ("examples", "flexcage", "meshes", "tests")
PAGES = sorted([ROOT / "README.md", *(p for f in FOLDERS for p in (ROOT / f).rglob("*.md"))])
MOST_LINES = 300
#: Presets for the cases of a page, block by block, where they name none.
CASES = {
    "README.md": ("",),
    "examples/cases.md": ("N1013", "", "", "15x37x10", "", "N1013", "N1013", "N1013", "7010C-PI"),
    "examples/fits.md": ("",),
    "examples/signals.md": ("N1013", "N1013"),
    "meshes/README.md": ("N1013",),
    "flexcage/cages/README.md": ("15x37x10",),
    "flexcage/modes/README.md": ("N1013",),
}
# a static case, a study, maps, a spectrum, machines, a case whose housing is a reader's,
# cages without their bearings
NOT_CASES = {
    "examples/cases.md": 1,
    "examples/studies.md": 1,
    "examples/unknowns.md": 1,
    "examples/fits.md": 1,
    "examples/machines.md": 1,
    "examples/heat.md": 1,
    "examples/signals.md": 1,
    "examples/datasets.md": 1,
    "flexcage/cages/README.md": 2,
}


def name_of(page):
    return page.relative_to(ROOT).as_posix()


def text_of(name):
    return (ROOT / name).read_text("utf-8")


def blocks(text, *kinds):
    return re.findall(rf"^```(?:{'|'.join(kinds)})\n(.*?)^```", text, flags=re.S | re.M)


def prose(text):
    """The text without fenced blocks."""
    return re.sub(r"^```.*?^```", "", text, flags=re.S | re.M)


@cache
def anchors(page):
    """Anchors of a page's headings, as GitHub makes them."""
    found, seen = set(), Counter()
    for heading in re.findall(r"^#+ (.+)$", prose(page.read_text("utf-8")), flags=re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
        slug = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
        found.add(f"{slug}-{seen[slug]}" if seen[slug] else slug)
        seen[slug] += 1
    return found


def links(page):
    """Targets of a page's links and pictures that stay in the tree."""
    text = re.sub(r"`[^`]*`", "", prose(page.read_text("utf-8")))
    found = re.findall(r"\]\(\s*([^()\s]+)\s*\)", text)
    return [target for target in found if not re.match(r"[a-z]+:", target)]


def broken(page):
    """Links of a page that lead nowhere."""
    for target in links(page):
        path, _, anchor = target.partition("#")
        place = (page.parent / path).resolve() if path else page
        if not place.exists() or (anchor and anchor not in anchors(place)):
            yield target


def test_anchors_are_those_of_github(tmp_path):
    page = tmp_path / "page.md"
    page.write_text(
        "# A plan for 100,000 cases\n```\n# no\n```\n## [One](x.md): `run`, two\n## A b\n## A b\n"
    )
    assert anchors(page) == {"a-plan-for-100000-cases", "one-run-two", "a-b", "a-b-1"}
    page.write_text("# One\n[a](#one) [b](#two) [c](page.md#one) ![d](none.png) `[e](no)`\n")
    anchors.cache_clear()
    assert list(broken(page)) == ["#two", "none.png"]


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_links_and_anchors_lead_somewhere(page):
    assert list(broken(page)) == []


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_no_page_is_long(page):
    lines = len(page.read_text("utf-8").splitlines())
    most = 200 if page == ROOT / "README.md" else MOST_LINES
    assert lines <= most


def test_every_page_is_reached_from_the_main_page():
    """In two links, but for pages of the papers and of tests' data."""
    reached = {ROOT / "README.md"}
    for _ in range(2):
        reached |= {
            (page.parent / target.partition("#")[0]).resolve()
            for page in reached if page.suffix == ".md"
            for target in links(page) if target.partition("#")[0]
        }  # fmt: skip
    left = {name_of(page) for page in PAGES if page not in reached}
    papers, statistics = "examples/papers/", "/appendix.md"
    assert not {n for n in left if not n.startswith("tests/bodies/data/")
                and not (n.startswith(papers) and n.endswith(statistics))}  # fmt: skip


def test_the_gallery_names_every_example():
    text = text_of("examples/README.md")
    files = [p for p in (ROOT / "examples").iterdir() if p.suffix in (".py", ".toml", ".ipynb")]
    assert len(files) > 9 and not [p.name for p in files if f"]({p.name})" not in text]


def cases():
    """Blocks of TOML that are cases, each with a preset where it has none."""
    for name, presets in CASES.items():
        found = blocks(text_of(name), "toml")
        found = found[: len(found) - NOT_CASES.get(name, 0)]
        for block, preset in zip(found, presets, strict=True):
            block = block.replace("cage.msh", str(ROOT / "meshes" / "n1013_normal.msh"))
            yield f'bearing.preset = "{preset}"\n{block}' if preset else block


@pytest.mark.parametrize("text", cases())
def test_cases_of_the_pages_load(text):
    assert in_motion(type(load_case(text).bearing))


def test_every_block_of_toml_is_looked_at():
    with_toml = {name_of(p) for p in PAGES if blocks(p.read_text("utf-8"), "toml")}
    assert with_toml == {*CASES, *NOT_CASES}


def test_the_machine_of_the_page_is_solved():
    (block,) = blocks(text_of("examples/machines.md"), "toml")
    solution = flexcage.solve_machine(flexcage.load_machine(block))
    assert [b.name for b in solution.bearings] == ["pair_left", "pair_right", "rear"]
    assert sum(b.force[0] for b in solution.bearings) == pytest.approx(400.0, abs=1e-5)


def test_the_study_of_the_page_loads(tmp_path):
    pytest.importorskip("dask")
    (block,) = blocks(text_of("examples/studies.md"), "toml")
    (tmp_path / "n1013.toml").write_text(text_of("examples/n1013.toml"))
    (tmp_path / "study.toml").write_text(block)
    study = flexcage.load_study(tmp_path / "study.toml")
    assert study.repeat.count == 3 and [len(axis.expand()) for axis in study.axes] == [3, 2]


def commands():
    """Lines of the pages' blocks that call flexcage."""
    for page in PAGES:
        for block in blocks(page.read_text("utf-8"), "sh", "text"):
            for line in block.splitlines():
                if line.startswith("flexcage "):
                    yield line


@pytest.mark.parametrize("line", sorted(set(commands())))
def test_commands_of_the_pages_are_understood(line):
    arguments = shlex.split(line, comments=True)[1:]
    assert isinstance(cli.build_parser().parse_args(arguments), argparse.Namespace)


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_python_of_the_pages_names_what_is_there(page):
    for block in blocks(page.read_text("utf-8"), "python"):
        ast.parse(block)
        for name in re.findall(r"flexcage\.([\w.]+)\(", block):
            assert callable(attrgetter(name)(flexcage))


def test_snippets_of_clusters_name_only_what_they_import():
    found = blocks(text_of("examples/studies.md"), "python")
    assert len(found) == 2
    for block in found:
        tree = list(ast.walk(ast.parse(block)))
        given = {a.asname or a.name for n in tree if isinstance(n, ast.ImportFrom | ast.Import)
                 for a in n.names}  # fmt: skip
        names = [n for n in tree if isinstance(n, ast.Name)]
        given |= {n.id for n in names if isinstance(n.ctx, ast.Store)}
        assert {n.id for n in names} <= given
        for name in re.findall(r"flexcage\.([\w.]+)\(", block):
            assert callable(attrgetter(name)(flexcage))
        assert re.search(r"nthreads 1|cores=1,\s+processes=1", block)


def test_the_cluster_on_loopback_is_one_that_dask_and_flexcage_know():
    (block,) = (b for b in blocks(text_of("examples/studies.md"), "sh") if "dask" in b)
    scheduler, worker, study = (line.split() for line in block.strip().splitlines())
    pytest.importorskip("distributed")
    from distributed.cli import dask_scheduler, dask_worker

    dask_scheduler.main.make_context("scheduler", scheduler[2:])
    dask_worker.main.make_context("worker", worker[2:])
    parsed = cli.build_parser().parse_args(study[1:])
    assert parsed.scheduler == worker[2] and (ROOT / parsed.study).is_file()


@pytest.mark.parametrize(
    ("page", "folder", "value"),
    [("bearings", "ball", "Family"), ("cages", "window", "CageType")],
)
def test_a_wings_page_names_its_slots_and_files(page, folder, value):
    """Every slot of its value has a row; files in rows are there, names are in the code."""
    text = text_of(f"flexcage/{page}/README.md")
    home = ROOT / "flexcage" / page
    rows = [line.split("|")[1:3] for line in text.splitlines() if line.startswith("| `")]
    slots = {s for names, _ in rows for s in re.findall(r"`([\w.]+)`", names)}
    kind = getattr(importlib.import_module(f"flexcage.{page}"), value)
    fields = {f.name for f in dataclasses.fields(kind)}
    assert fields - slots <= {"name", "other_designs"}
    files = {file for _, names in rows for file in re.findall(r"`(\w+\.py)`", names)}
    assert len(files) > 4 and all((home / folder / file).is_file() for file in files)
    spans = re.findall(r"`([^`\n]+)`", text)
    paths = {s for s in spans if s.endswith(".py") and "/" in s}
    assert all(any((p / s).is_file() for p in (ROOT, ROOT / "flexcage", home)) for s in paths)
    code = "\n".join(
        p.read_text("utf-8") for f in ("flexcage", "tests") for p in (ROOT / f).rglob("*.py")
    )
    words = set(re.findall(r"\w+", code))
    named = {
        n
        for s in spans
        if "/" not in s and not s.endswith(".py")
        for n in re.findall(r"[a-zA-Z_]\w+", s)
    }
    assert len(named) > 15 and not named - words, named - words


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_files_that_pages_name_are_there(page):
    """A path with a folder in it, from the tree's or the package's root or from the page."""
    text = prose(page.read_text("utf-8"))
    found = re.findall(r"`((?:[\w.\-]+/)+[\w.\-]+\.(?:py|toml|msh|md))`", text)
    places = (ROOT, ROOT / "flexcage", page.parent, ROOT / "examples" / "papers")
    assert not [f for f in found if not any((place / f).is_file() for place in places)]
