"""Shards of a study: how cases are dealt, what each leaves, and what a merge gathers or refuses."""

from __future__ import annotations

import json
import shutil
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import fake_case
import pytest
from study_cases import short_case, short_study, study_file

from flexcage.cli import main
from flexcage.core.errors import InputError
from flexcage.core.hashing import sealed
from flexcage.core.locks import held
from flexcage.simulate import simulate
from flexcage.study import desk, sharded
from flexcage.study.axes import Grid, Points
from flexcage.study.case_row import Failure
from flexcage.study.folder import SHARDS, Folder
from flexcage.study.origin import Origin
from flexcage.study.plan import Planned, make_plan, points_of
from flexcage.study.run import run_study
from flexcage.study.sharded import merge_study, plan_study, run_shard
from flexcage.study.shards import Shard, dealt, shard_of, unmerged_words
from flexcage.study.spec import Repeat

LOADS = Grid("load.radial", ["500 N", "600 N", "700 N", "800 N", "900 N", "1 kN"])


@pytest.fixture
def fake(monkeypatch):
    """Cases that are finished at once; the hashes of those that were computed."""
    monkeypatch.setattr(desk, "do_case", fake_case.fake_do_case)
    fake_case.calls.clear()
    return fake_case.calls


def planned_cases(*axes, repeats=1):
    """Cases of these axes, whose hashes are made up: nothing is built."""
    points = points_of(axes)
    return [
        Planned(n, point, k, f"{hash_of(n, k):016x}")
        for n, point in enumerate(points)
        for k in range(repeats)
    ]


def hash_of(n, k):
    return (n * 2654435761 + k * 40503 + 12345) * 6364136223846793005 % 2**64


FAULTS = Points([{"label": f"fault {k}"} for k in range(6)], name="fault")


@pytest.mark.parametrize("count", [1, 2, 3, 6, 7, 10])
def test_every_shard_has_a_mixture(count):
    cases = planned_cases(FAULTS, Grid("load.radial", list(range(10))), repeats=2)
    numbers = dealt(cases, count)
    size = Counter(numbers)
    assert set(size) == set(range(1, count + 1)) and max(size.values()) - min(size.values()) <= 1
    faults = Counter((n, c.point.labels["fault"]) for n, c in zip(numbers, cases))
    assert max(faults.values()) - min(faults[s, f"fault {k}"] for s in size for k in range(6)) <= 1
    again = dealt(cases[::-1], count)[::-1]
    assert again == numbers  # whatever their order
    parts = [Shard(k, count).part(cases) for k in size]
    assert sorted(c.hash for part in parts for c in part) == sorted(c.hash for c in cases)


def test_a_shard_is_not_one_value_of_an_axis_that_repeats_as_often():
    cases = planned_cases(Grid("load.radial", list(range(50))), Grid("start.seed", list(range(10))))
    numbers = dealt(cases, 10)  # by stride each shard would have one seed
    for shard in range(1, 11):
        own = [c for n, c in zip(numbers, cases) if n == shard]
        assert Counter(c.point.values["start.seed"] for c in own) == dict.fromkeys(range(10), 5)


@pytest.mark.parametrize("text", ["0/3", "4/3", "3", "a/b", "1/0", "-1/3", "1/2/3"])
def test_a_shard_that_is_none(text):
    with pytest.raises(InputError, match=f"The shard is '{text}', but should be I/N"):
        shard_of(text)


def test_shards_are_computed_once_and_merged(tmp_path, fake):
    study = short_study(LOADS, keep="figures")
    states = [run_shard(study, out=tmp_path / "s", shard=f"{k}/4", workers=1) for k in range(1, 5)]
    assert [(s.done, s.failed, s.open) for s in states] == [(2, 0, 0), (2, 0, 0), (1, 0, 0)] + [
        (1, 0, 0)
    ]
    assert len(fake) == len(set(fake)) == 6
    assert str(states[0]) == "Shard 1/4: 2 of 2 cases done, 0 failed, 0 open"
    results, missing = merge_study(tmp_path / "s")
    assert not missing and results.count("done") == 6
    assert not (tmp_path / "s" / SHARDS).exists() and (tmp_path / "s" / "table.csv").is_file()
    run_shard(study, out=tmp_path / "s", shard="2/4", workers=1)
    run_study(study, out=tmp_path / "s", workers=1)
    assert len(fake) == 6


def test_a_missing_shard_is_named_and_what_is_there_is_gathered(tmp_path, fake, capsys):
    study = short_study(LOADS, keep="figures")
    for k in (1, 3):
        run_shard(study, out=tmp_path / "s", shard=f"{k}/3", workers=1)
    results, missing = merge_study(tmp_path / "s")
    assert missing == [Shard(2, 3)] and results.count("done") == 4
    run_shard(study, out=tmp_path / "s", shard="2/3", workers=1)
    assert not merge_study(tmp_path / "s")[1] and len(fake) == 6
    with pytest.raises(InputError, match="holds no shards to merge"):
        merge_study(tmp_path / "s")


def test_the_plain_run_takes_shards_over_and_computes_what_they_lack(tmp_path, fake, monkeypatch):
    study = short_study(LOADS, keep="figures")
    run_shard(study, out=tmp_path / "s", shard="1/3", workers=1)
    monkeypatch.setattr("flexcage.study.run.Crew", lambda *a, **k: desk.Crew(alone=True))
    assert run_study(study, out=tmp_path / "s").count("done") == 6
    assert len(fake) == len(set(fake)) == 6


def test_shards_take_the_plan_that_is_there(tmp_path, fake, monkeypatch):
    study = short_study(LOADS, keep="figures")
    whole = plan_study(study, out=tmp_path / "s")
    monkeypatch.setattr(sharded, "make_plan", lambda study: pytest.fail("planned again"))
    for k in (1, 2):
        run_shard(study, out=tmp_path / "s", shard=f"{k}/2", workers=1)
    assert sorted(fake) == sorted(c.hash for c in whole.cases)
    monkeypatch.undo()
    monkeypatch.setattr(desk, "do_case", fake_case.fake_do_case)
    other = short_study(Grid("load.radial", ["500 N", "650 N"]), keep="figures")
    run_shard(other, out=tmp_path / "s", shard="1/1", workers=1)  # an edited study plans anew
    assert [c.hash for c in Folder(tmp_path / "s").about()[1]] == [
        c.hash for c in make_plan(other).cases
    ]


@pytest.mark.parametrize("linked", ["plan.json", "study.toml"])
def test_no_plan_is_taken_through_a_link(tmp_path, fake, linked):
    study, out = short_study(LOADS, keep="figures"), tmp_path / "s"
    plan_study(study, out=out)
    (out / linked).rename(tmp_path / linked)
    (out / linked).symlink_to(tmp_path / linked)
    with pytest.raises(InputError, match=f"{linked}' is a link to"):
        run_shard(study, out=out, shard="1/2", workers=1)
    assert not fake


def test_a_plan_of_another_flexcage_or_a_damaged_one_is_made_anew(tmp_path, fake):
    study, folder = short_study(LOADS, keep="figures"), Folder(tmp_path / "s")
    assert folder.planned_by_this(study) == ()
    plan_study(study, out=folder.path)
    planned = folder.planned_by_this(study)
    assert planned == folder.about()[1] and len(planned) == 6
    file = folder.path / "plan.json"
    stored = json.loads(file.read_text())
    other = {**stored, "origin": {"version": "0.0.1", "physics": "f" * 16}}
    del other["seal"]
    for text in (json.dumps(sealed(other)), json.dumps(other), "[", "[]"):
        file.write_text(text)
        assert folder.planned_by_this(study) == ()
    run_shard(study, out=folder.path, shard="1/2", workers=1)
    assert folder.planned_by_this(study) == planned and len(fake) == 3


def test_what_a_merge_refuses(tmp_path, fake):
    study, out = short_study(LOADS, keep="figures"), tmp_path / "s"
    for k in (1, 2):
        run_shard(study, out=out, shard=f"{k}/2", workers=1)
    kept = shutil.copytree(out, tmp_path / "kept")
    with held(out / SHARDS / "1-of-2"), pytest.raises(InputError, match="Another process"):
        merge_in_another_thread(out)
    shutil.copytree(out / SHARDS / "1-of-2", out / SHARDS / "1-of-3")
    with pytest.raises(InputError, match="holds shards of 2 and of 3 parts; remove"):
        merge_study(out)
    shutil.rmtree(out / SHARDS / "1-of-3")
    first = next(iter(Folder(out / SHARDS / "1-of-2").finished()))
    rewrite(Folder(out / SHARDS / "1-of-2"), first, origin=Origin("0.0.1", "f" * 64))
    with pytest.raises(InputError, match=r"computed by flexcage .*--other-version"):
        merge_study(out)
    assert merge_study(out, other_version=True)[0].count("done") == 6
    again = Folder(kept / SHARDS / "2-of-2")
    name = next(iter(again.finished()))
    merge_study(kept)
    shutil.copytree(out / "cases" / name, kept / SHARDS / "2-of-2" / "cases" / name)
    assert merge_study(kept)[0].count("done") == 6  # the same again is no conflict
    shutil.copytree(out / "cases" / name, kept / SHARDS / "2-of-2" / "cases" / name)
    row = Folder(kept).row(name)
    rewrite(again, name, figures={**row.figures, "cage_speed": row.figures["figure_1"]})
    with pytest.raises(InputError, match=f"Case {name} is in .* with other figures"):
        merge_study(kept)
    shutil.copytree(kept / SHARDS, tmp_path / "alone" / SHARDS)
    with pytest.raises(InputError, match="holds shards and no plan"):
        merge_study(tmp_path / "alone")


def merge_in_another_thread(out):
    """A lock keeps out other threads as well."""
    with ThreadPoolExecutor(1) as pool:
        pool.submit(merge_study, out).result()


def rewrite(folder, name, **changes):
    folder.write_row(folder.case(name), replace(folder.row(name), **changes))


def test_more_shards_than_cases_and_failures(tmp_path, fake):
    study, out = short_study(LOADS, keep="figures"), tmp_path / "s"
    with pytest.raises(InputError, match="has 6 cases, fewer than 7 shards"):
        run_shard(study, out=out, shard="1/7", workers=1)
    assert not out.exists()
    state = run_shard(study, out=out, shard="1/2", workers=1)
    shard, name = Folder(state.folder), fake[0]
    shutil.rmtree(shard.case(name))
    shard.write_failure(name, Failure("RunFailed", "it stopped", final=True))
    results, missing = merge_study(out)
    assert results.count("failed") == 1 and missing == [Shard(2, 2)]
    state = run_shard(study, out=out, shard="1/2", workers=1)
    assert fake.count(name) == 1 and (state.done, state.failed, state.open) == (2, 1, 0)
    run_shard(study, out=out, shard="1/2", workers=1, retry=True)
    assert fake.count(name) == 2
    assert merge_study(out)[0].count("failed") == 0


def test_a_case_that_is_done_and_failed_counts_once(tmp_path, fake):
    """A shard tried it again after another had finished it, or a merge was killed."""
    study, out = short_study(LOADS, keep="figures"), tmp_path / "s"
    state = run_shard(study, out=out, shard="1/2", workers=1)
    Folder(state.folder).write_failure(fake[0], Failure("OSError", "a full disk", final=False))
    state = run_shard(study, out=out, shard="1/2", workers=1)
    assert (state.done, state.failed, state.open) == (3, 0, 0)
    merge_study(out)
    assert not (out / SHARDS).exists() and not any(Folder(out).failures())


def test_nothing_is_said_of_a_shard_that_is_merged(tmp_path, fake):
    study, out = short_study(LOADS, keep="figures"), tmp_path / "s"
    shards = [Folder(run_shard(study, out=out, shard=f"{k}/2", workers=1).folder) for k in (1, 2)]
    shutil.rmtree(shards[0].case(fake[0]))
    shards[0].write_failure(fake[0], Failure("RunFailed", "it stopped", final=True))
    for shard in shards:
        shard.part("0123456789abcdef").mkdir()
        (shard.part("0123456789abcdef") / "case.toml").write_text("")
    assert "Not merged: 6 cases in 2 of 2 shards;" in unmerged_words(out)
    merge_study(out)
    assert (out / SHARDS).is_dir() and not unmerged_words(out)
    run_shard(study, out=out, shard="1/2", workers=1, retry=True)
    assert "Not merged: 1 case in 1 of 2 shards;" in unmerged_words(out)


def test_the_commands_say_what_to_do_next(tmp_path, fake, capsys):
    axis = '[[axes]]\npath = "load.radial"\nvalues = ["500 N", "600 N", "700 N"]'
    path, out = study_file(tmp_path, axis, 'keep = "figures"'), str(tmp_path / "s")
    path.write_text('keep = "figures"\n' + path.read_text().replace('keep = "figures"', ""))
    assert main(["study", "plan", str(path), "-o", out]) == 0
    assert "3 cases are planned in" in capsys.readouterr().out
    shard = ["study", "run", str(path), "-o", out, "--workers", "1", "--shard"]
    assert main([*shard, "1/2"]) == 0
    said = capsys.readouterr().out
    assert "Shard 1/2: 2 of 2 cases done" in said and f"'flexcage study merge {out}'" in said
    assert main(["study", "status", out]) == 0
    said = capsys.readouterr().out
    assert "3 cases: 0 done" in said and "Not merged: 2 cases in 1 of 2 shards;" in said
    assert main(["study", "merge", out]) == 1
    assert "Missing: shard 2 of 2; compute it with" in capsys.readouterr().out
    assert main([*shard, "2/2"]) == 0 and main(["study", "merge", out]) == 0
    assert main([*shard, "3/2"]) == 2
    both = ["study", "run", str(path), "--shard", "1/2", "--scheduler", "tcp://x"]
    assert main(both) == 2 and "leave out --scheduler" in capsys.readouterr().err


def test_real_shards_agree_with_a_study_and_share_cages(tmp_path):
    study = short_study(Grid("load.radial", ["500 N", "1 kN"]), repeat=Repeat(count=1))
    for k in (1, 2):
        run_shard(study, out=tmp_path / "s", shard=f"{k}/2", workers=1)
    results, missing = merge_study(tmp_path / "s")
    assert not missing and len(list((tmp_path / "s" / "cages").glob("*.zip"))) == 1
    found = results.run(1).summary_at_end["cage_speed"]
    assert found == results.table["cage_speed [rad/s]"][1]
    alone = simulate(short_case(**{"load.radial": "1 kN"})).summary_at_end["cage_speed"]
    assert alone == pytest.approx(found, rel=1e-12)
