"""README's walk through a bearing type names files and things that are there."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_what_extending_names_is_there():
    section = (ROOT / "README.md").read_text("utf-8").split("**A bearing type in motion.**")[1]
    section = section.split("The kind below")[0]
    spans = re.findall(r"`([^`]+)`", section)
    files = [s for s in spans if s.endswith(".py")]
    assert len(files) > 25
    assert not [f for f in files if not (ROOT / "flexcage" / f).is_file()]
    code = "\n".join(p.read_text("utf-8") for p in (ROOT / "flexcage").rglob("*.py"))
    words = set(re.findall(r"\w+", code))
    names = {n for s in spans if s not in files and "/" not in s for n in re.findall(r"\w+", s)}
    assert len(names) > 50 and not names - words
