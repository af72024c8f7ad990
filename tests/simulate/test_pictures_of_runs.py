"""Pictures of a run by name and format, in Python and on the command line."""

import pytest
from simulate_cases import bent, n1013

from flexcage import load_run, simulate
from flexcage.cli import main
from flexcage.core.errors import InputError
from flexcage.run.run import Run


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("run")
    simulate(n1013({"solver.duration": "0.4 ms"}, defects=bent("0.2 mm")), out=folder)
    return folder


@pytest.fixture
def no_stress(monkeypatch):
    """Stress cannot be computed."""

    def refuse(*_, **__):
        raise AssertionError("no picture that is asked for shows stress")

    monkeypatch.setattr(Run, "stress_history", property(refuse))
    monkeypatch.setattr(Run, "stress", refuse)


def test_only_what_is_asked_for_is_computed_and_drawn(folder, tmp_path, no_stress):
    run = load_run(folder)
    assert [p.name for p in run.draw(tmp_path, only=["orbit"], format="svg")] == ["orbit.svg"]
    assert [p.name for p in tmp_path.iterdir()] == ["orbit.svg"]
    text = (tmp_path / "orbit.svg").read_text("utf-8")
    assert text.count("<path") > 50 and text.count("<image") <= 1  # of the colour bar
    again = run.draw(tmp_path / "again", only="orbit", format="svg")
    assert again[0].read_text("utf-8") == text


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (
            ["--only", "orbits"],
            "no picture 'orbits'; the nearest known one is 'orbit'; its picture",
        ),
        (["--only", "outer_ring"], "its pictures are mesh, bearing, orbit, histories, modes, "),
        (["--only", "orbit", "--format", "eps"], "'eps' is not known; choose from png, svg, pdf"),
    ],
)
def test_a_wrong_name_or_format_is_one_sentence(folder, tmp_path, no_stress, capsys, words, told):
    argv = ["render", str(folder), "-o", str(tmp_path / "new"), *words]
    try:
        code = main(argv)
    except SystemExit as stopped:  # argparse
        code = stopped.code
    said = capsys.readouterr().err
    assert code == 2 and told in said and said.count("\n") == 1
    assert not (tmp_path / "new").exists()


def test_the_command_draws_what_is_named(folder, tmp_path):
    argv = ["render", str(folder), "-o", str(tmp_path), "--only", "orbit", "histories"]
    assert main([*argv, "--format", "pdf"]) == 0
    assert sorted(p.name for p in tmp_path.iterdir()) == ["histories.pdf", "orbit.pdf"]
    with pytest.raises(InputError, match="format of pictures is 'eps', but must be png, svg or pd"):
        load_run(folder).draw(tmp_path, format="eps")


@pytest.mark.parametrize(
    ("look", "names"),
    [
        (["--view", "30 deg"], ["mesh", "stress_peak", "stress_envelope", "deformation"]),
        (["--stress-limit", "20 MPa"], ["stress_peak", "stress_pocket", "stress_envelope"]),
        (["--scale", "20"], ["stress_peak", "deformation"]),
        (["--scale", "20", "--only", "orbit"], ["orbit"]),
    ],
)
def test_a_look_draws_anew_what_it_changes(folder, tmp_path, monkeypatch, capsys, look, names):
    drawn = []
    monkeypatch.setattr(Run, "draw", lambda *_, only=(), **__: drawn.append([*only]))
    argv = ["render", str(folder), "-o", str(tmp_path), *look]
    if "--only" not in look:
        assert main(argv) == 0
        assert drawn.pop() == [], "all pictures, where there are none yet"
    (tmp_path / "orbit.png").touch()
    assert main(argv) == 0
    assert drawn == [names] and f"Drawn anew: {', '.join(names)}. " in capsys.readouterr().out


def test_a_look_that_changes_no_picture_of_a_rigid_cage(tmp_path, capsys):
    case = n1013({"solver.duration": "0.4 ms", "cage.model": "rigid"})
    simulate(case, out=tmp_path / "run")
    (tmp_path / "mesh.png").touch()
    argv = ["render", str(tmp_path / "run"), "-o", str(tmp_path), "--scale", "20"]
    assert main(argv) == 2
    assert "No picture of this run changes with --scale: its cage is rigid." in (
        capsys.readouterr().err
    )


def test_a_page_draws_the_pictures_that_are_missing(folder, tmp_path, monkeypatch):
    run, drawn = load_run(folder), []
    (folder / "images").mkdir()
    (folder / "images" / "orbit.png").write_bytes(b"")
    monkeypatch.setattr(Run, "draw", lambda self, into, *, only: drawn.append(only) or [])
    run._images(tmp_path)
    assert drawn == [[name for name in run.picture_names if name != "orbit"]]
