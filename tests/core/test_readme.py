"""README's examples of cases load, and its walk through a bearing type names what is there."""

import ast
import re
from pathlib import Path

import pytest

import flexcage
from flexcage import cli
from flexcage.case import load_case

ROOT = Path(__file__).parents[2]


def cases():
    """Blocks of "What a case may say", each with a preset where it has none."""
    text = (ROOT / "README.md").read_text("utf-8").split("## What a case may say")[1]
    text = text.split("## Static solution")[0]
    presets = ("N1013", "", "15x37x10", "N1013", "N1013", "N1013", "7010C-PI", "")
    blocks = re.findall(r"```toml\n(.*?)```", text, flags=re.S)
    for block, preset in zip(blocks, presets, strict=True):
        yield f'bearing.preset = "{preset}"\n{block}' if preset else block


@pytest.mark.parametrize("text", cases())
def test_what_a_case_may_say(text):
    assert load_case(text).bearing.in_motion


def test_snippets_of_clusters_name_only_what_they_import():
    section = (ROOT / "README.md").read_text("utf-8").split("## Studies")[1].split("\n## ")[0]
    blocks = re.findall(r"```python\n(.*?)```", section, flags=re.S)
    assert len(blocks) == 2
    for block in blocks:
        tree = list(ast.walk(ast.parse(block)))
        given = {a.asname or a.name for n in tree if isinstance(n, ast.ImportFrom | ast.Import)
                 for a in n.names}  # fmt: skip
        names = [n for n in tree if isinstance(n, ast.Name)]
        given |= {n.id for n in names if isinstance(n.ctx, ast.Store)}
        assert {n.id for n in names} <= given
        for name in re.findall(r"flexcage\.(\w+)\(", block):
            assert callable(getattr(flexcage, name))
        assert re.search(r"nthreads 1|cores=1,\s+processes=1", block)


def test_the_cluster_on_loopback_is_one_that_dask_and_flexcage_know():
    section = (ROOT / "README.md").read_text("utf-8").split("## Studies")[1].split("\n## ")[0]
    block = next(b for b in re.findall(r"```sh\n(.*?)```", section, flags=re.S) if "dask" in b)
    scheduler, worker, study = (line.split() for line in block.strip().splitlines())
    pytest.importorskip("distributed")
    from distributed.cli import dask_scheduler, dask_worker

    dask_scheduler.main.make_context("scheduler", scheduler[2:])
    dask_worker.main.make_context("worker", worker[2:])
    parsed = cli.build_parser().parse_args(study[1:])
    assert parsed.scheduler == worker[2] and (ROOT / parsed.study).is_file()


def test_what_extending_names_is_there():
    section = (ROOT / "README.md").read_text("utf-8").split("**A bearing type in motion.**")[1]
    section = section.split("The kind below")[0]
    spans = re.findall(r"`([^`]+)`", section)
    files = [s for s in spans if s.endswith(".py")]
    assert len(files) > 25
    places = (ROOT, ROOT / "flexcage")
    assert not [f for f in files if not any((place / f).is_file() for place in places)]
    code = "\n".join(p.read_text("utf-8") for p in (ROOT / "flexcage").rglob("*.py"))
    words = set(re.findall(r"\w+", code))
    names = {n for s in spans if s not in files and "/" not in s for n in re.findall(r"\w+", s)}
    assert len(names) > 50 and not names - words
