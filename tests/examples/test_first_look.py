"""The notebook is stored without results, runs from top to bottom, and what it shows holds."""

import json
from pathlib import Path

import pytest

NOTEBOOK = Path(__file__).parents[2] / "examples" / "first_look.ipynb"
ASKED = "import json; print(json.dumps([line, turns, float(spectrum['frequency'][1])]))"


def test_notebook_is_stored_without_results():
    cells = json.loads(NOTEBOOK.read_text("utf-8"))["cells"]
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    assert len(code) > 5
    assert not [cell["id"] for cell in code if cell["outputs"] or cell["execution_count"]]


def test_notebook_runs_and_finds_the_turns_of_the_cage(tmp_path):
    nbformat = pytest.importorskip("nbformat", reason="pip install '.[notebook]'")
    nbclient = pytest.importorskip("nbclient", reason="pip install '.[notebook]'")
    pytest.importorskip("ipykernel", reason="pip install '.[notebook]'")
    book = nbformat.read(NOTEBOOK, as_version=4)
    book.cells.append(nbformat.v4.new_code_cell(ASKED))
    nbclient.NotebookClient(
        book, timeout=600, resources={"metadata": {"path": str(tmp_path)}}
    ).execute()

    line, turns, apart = json.loads(book.cells[-1].outputs[0].text)
    # a pocket meets the load zone once a turn of the cage, which follows pure rolling
    assert abs(line - turns) < apart
    assert turns == pytest.approx(6000 / 60 / 2 * (1 - 8 / 82.5), rel=0.03)
    assert (tmp_path / "runs/first_look/images/stress_peak.png").stat().st_size > 50_000
    shown = [cell.id for cell in book.cells for out in cell.get("outputs", ())
             if "image/png" in out.get("data", {})]  # fmt: skip
    assert shown == ["mesh", "stress", "force", "fft"]
