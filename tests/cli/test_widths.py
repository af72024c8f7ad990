"""What commands print fits into the terminal: no line is longer, and words are wrapped."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from flexcage import cli

STATIC = Path(__file__).parents[2] / "examples" / "c7010_static.toml"
COMMANDS = {
    "presets": ["presets"],
    "a preset": ["presets", "7010C-PI"],
    "sections": ["keys"],
    "keys": ["keys", "cage", "contacts"],
    "variables": ["variables"],
    "figures": ["figures"],
    "new": ["new", "NU 210 C3", "-o", "new.toml", "--force"],
    "static": ["static", str(STATIC)],
    "known answers": ["verify", "--list"],
    "doctor": ["doctor"],
}


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path / "cache"))


def printed(command: list[str], width: int, monkeypatch, capsys) -> str:
    monkeypatch.setenv("COLUMNS", str(width))
    cli.main(command)
    return capsys.readouterr().out


@pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS)
def test_lines_are_no_longer_than_the_terminal_and_lose_nothing(command, monkeypatch, capsys):
    found = {}
    for width in (80, 120, 1000):
        text = printed(command, width, monkeypatch, capsys)
        long = [line for line in text.splitlines() if len(line) > width]
        assert not long
        found[width] = set(re.findall(r"[^\s./_=,;\]+-]+", text))
    assert found[80] >= found[1000] and found[120] >= found[1000]


def test_a_wide_table_of_elements_stands_in_parts(monkeypatch, capsys):
    text = printed(COMMANDS["static"], 80, monkeypatch, capsys)
    heads = [line for line in text.splitlines() if line.lstrip().startswith("element ")]
    assert len(heads) == 2, "both parts name the elements"
