"""The notebook runs from top to bottom, what it shows holds, and its stored results are of it.

``python tests/examples/test_first_look.py`` runs it and stores its results anew.
"""

import base64
import hashlib
import io
import json
import re
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

import flexcage

NOTEBOOK = Path(__file__).parents[2] / "examples" / "first_look.ipynb"
ASKED = "import json; print(json.dumps([line, turns, float(spectrum['frequency'][1])]))"
WIDTH, COLOURS = 900, 128  # of a stored picture
LARGEST = 1_000_000  # bytes of the notebook: code hosts show no larger one at once


def stored():
    return json.loads(NOTEBOOK.read_text("utf-8"))


def code_cells(book):
    return {cell["id"]: cell for cell in book["cells"] if cell["cell_type"] == "code"}


def sources(book):
    """Digest of all code."""
    text = "\n\n".join("".join(cell["source"]) for cell in code_cells(book).values())
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def printed(cell):
    """What a cell printed, without warnings, and the text of its value."""
    outputs = [out for out in cell["outputs"] if out.get("name") != "stderr"]
    said = ["".join(out.get("text", "")) for out in outputs]
    return "".join(said + ["".join(out.get("data", {}).get("text/plain", "")) for out in outputs])


def pictures(book):
    return [
        name for name, cell in code_cells(book).items()
        for out in cell["outputs"] if "image/png" in out.get("data", {})
    ]  # fmt: skip


def execute(folder):
    """The notebook with results, computed in a folder."""
    nbformat = pytest.importorskip("nbformat", reason="pip install '.[notebook]'")
    nbclient = pytest.importorskip("nbclient", reason="pip install '.[notebook]'")
    pytest.importorskip("ipykernel", reason="pip install '.[notebook]'")
    book = nbformat.read(NOTEBOOK, as_version=4)
    book.cells.append(nbformat.v4.new_code_cell(ASKED))
    resources = {"metadata": {"path": str(folder)}}
    nbclient.NotebookClient(book, timeout=3000, record_timing=False, resources=resources).execute()
    return book


def small(png):
    """A picture in base64 with fewer pixels and colours."""
    from PIL import Image

    picture = Image.open(io.BytesIO(base64.b64decode(png))).convert("RGB")
    if picture.width > WIDTH:
        height = round(picture.height * WIDTH / picture.width)
        picture = picture.resize((WIDTH, height), Image.Resampling.LANCZOS)
    buffer = io.BytesIO()
    picture.quantize(COLOURS, dither=Image.Dither.NONE).save(buffer, "PNG", optimize=True)
    return base64.b64encode(buffer.getvalue()).decode()


def store(book):
    """Write the notebook with its results, made small."""
    import nbformat

    book.metadata = {
        "kernelspec": book.metadata["kernelspec"], "language_info": {"name": "python"},
        "flexcage": {"version": flexcage.__version__, "code": sources(book)},
    }  # fmt: skip
    for cell in code_cells(book).values():
        cell["outputs"] = [out for out in cell["outputs"] if "IProgress" not in out.get("text", "")]
        for out in cell["outputs"]:
            if "image/png" in out.get("data", {}):
                out["data"]["image/png"] = small(out["data"]["image/png"])
    nbformat.write(book, NOTEBOOK)


def test_the_notebook_is_stored_with_its_pictures():
    book = stored()
    assert NOTEBOOK.stat().st_size < LARGEST
    assert pictures(book) == ["mesh", "stress", "force", "fft"]
    assert [cell["execution_count"] for cell in code_cells(book).values()] == [1, 2, 3, 4, 5, 6, 7]
    for cell in code_cells(book).values():
        for out in cell["outputs"]:
            assert out["output_type"] != "error", cell["id"]
            text = "".join(out.get("text", "")) + "".join(out.get("data", {}).get("text/html", ""))
            assert not re.search(r"/(tmp|home|work|root)/", text), "no path of a machine"


def test_its_results_are_of_its_code_and_of_this_version():
    """Else store it anew: the docstring of this file says how."""
    book = stored()
    assert book["metadata"]["flexcage"] == {
        "version": flexcage.__version__, "code": sources(book)
    }  # fmt: skip
    names: dict = {}
    text = "".join(code_cells(book)["case"]["source"])
    exec(text, {"fc": flexcage}, names)
    assert printed(code_cells(book)["case"]).startswith(repr(names["case"]))  # its hash as well


def test_notebook_runs_and_finds_the_turns_of_the_cage(tmp_path):
    book = execute(tmp_path)
    line, turns, apart = json.loads(book.cells.pop().outputs[0].text)
    # a pocket meets the load zone once a turn of the cage, which follows pure rolling
    assert abs(line - turns) < apart
    assert turns == pytest.approx(6000 / 60 / 2 * (1 - 8 / 82.5), rel=0.03)
    assert (tmp_path / "runs/first_look/images/stress_peak.png").stat().st_size > 50_000
    assert pictures(book) == ["mesh", "stress", "force", "fft"]

    new, old = code_cells(book), code_cells(stored())
    for name in new:  # the same words, and numbers of a chaotic motion
        words = [re.sub(r"[\d.]+", "#", printed(cells[name])) for cells in (new, old)]
        assert name == "case" or words[0].split() == words[1].split(), name
    for name, share in (("run", (0.01, 1e-3, 0.5, 0.5)), ("fft", (0.3, 0.01))):
        now, then = (
            [float(n) for n in re.findall(r"[\d.]+\d", printed(cells[name]))[: len(share)]]
            for cells in (new, old)
        )
        assert all(abs(a - b) <= s * b for a, b, s in zip(now, then, share)), (name, now, then)


if __name__ == "__main__":
    with TemporaryDirectory() as folder:
        found = execute(folder)
        del found.cells[-1]
        store(found)
