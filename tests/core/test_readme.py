"""README's examples of cases load, and its walk through a bearing type names what is there."""

import re
from pathlib import Path

import pytest

from flexcage.case import load_case

ROOT = Path(__file__).parents[2]


def cases():
    """Blocks of "What a case may say", each with a preset where it has none."""
    text = (ROOT / "README.md").read_text("utf-8").split("## What a case may say")[1]
    text = text.split("## Static solution")[0]
    for block, preset in zip(
        re.findall(r"```toml\n(.*?)```", text, flags=re.S), ("N1013", "", "7010C-PI", "")
    ):
        yield f'bearing.preset = "{preset}"\n{block}' if preset else block


@pytest.mark.parametrize("text", cases())
def test_what_a_case_may_say(text):
    assert load_case(text).bearing.in_motion


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
