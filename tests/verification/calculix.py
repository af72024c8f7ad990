"""CalculiX (ccx) on the elements of a model: input decks, runs, and what its .dat files say.

    python tests/verification/calculix.py

solves the shipped meshes of ``CAGES`` and writes ``data/calculix_n1013.json``. Only the mesh and
the material's numbers go over: elements, mass, loads, supports and solution are CalculiX's own.
Its C3D10 has the four Gauss points of flexcage's stiffness, takes the same four for the mass, and
numbers nodes as scikit-fem does. ccx reads no number longer than 20 characters.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from flexcage.case.presets import load_preset
from flexcage.fem.model import FEModel, assemble
from flexcage.mesh.io import read_mesh

ROOT = Path(__file__).resolve().parents[2]
STORED = Path(__file__).parent / "data" / "calculix_n1013.json"
CAGES = ("n1013_normal", "n1013_deltaq_0p2")  # sound; crossbeam 5 bent by 0.2 mm
LOADED = ("pocket4_front",)  # a face of crossbeam 5
HELD = ("pocket3_front", "pocket4_rear", "pocket5_front", "pocket6_rear")  # crossbeams 4 and 6
ROOT_OF = "pocket4_fillet"  # where stress is kept
PRESSURE = 1e6  # [Pa] on the loaded face
FREQUENCIES = 20
KEPT = 12  # nodes and Gauss points that the stored reference keeps
_RIGID = 6
_MIRROR = np.array([1, 0, 2, 3, 4, 6, 5, 8, 7, 9])  # of a tetrahedron's nodes, corners 0 and 1
_FACES = ((0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3))  # P1 to P4 of the manual


@dataclass(frozen=True)
class Answer:
    """What CalculiX answers for a cage; stress in Voigt order xx, yy, zz, xy, yz, xz."""

    frequencies: np.ndarray  # (20,) [Hz] elastic, of the free cage
    displacement: np.ndarray  # (n_nodes, 6) place [m] and displacement [m]
    stress: np.ndarray  # (4 n_tets, 9) place [m] and stress [Pa] at Gauss points


def available() -> bool:
    """Whether ``ccx`` is installed (Debian: calculix-ccx)."""
    return shutil.which("ccx") is not None


def cage_model(name: str) -> FEModel:
    """Quadratic model of a shipped mesh, in brass."""
    return assemble(read_mesh(ROOT / "meshes" / f"{name}.msh"), load_preset("N1013").cage.material)


def solve(model: FEModel) -> Answer:
    """Free frequencies, and displacement and stress under the pressure."""
    with tempfile.TemporaryDirectory() as folder:
        frequencies = free_frequencies(model, Path(folder))
        loaded = _run(Path(folder), "loaded", [*_mesh(model), *_loaded_step(model)])
    tables = _tables(loaded)
    moved = np.array(tables["displacements"])
    stress, place = np.array(tables["stresses"]), np.array(tables["global coordinates"])
    assert np.array_equal(stress[:, :2], place[:, :2])  # element and point
    voigt = stress[:, [2, 3, 4, 5, 7, 6]]  # ccx prints xy, xz, yz
    return Answer(
        frequencies,
        np.hstack([model.nodes[moved[:, 0].astype(int) - 1], moved[:, 1:4]]),
        np.hstack([place[:, 2:5], voigt]),
    )


def free_frequencies(model: FEModel, folder: Path) -> np.ndarray:
    """First elastic frequencies (FREQUENCIES,) [Hz] of a free body, worked out in ``folder``."""
    free = _run(folder, "free", [*_mesh(model), *_free_step()])
    modes = np.array(_tables(free)["E I G E N V A L U E O U T P U T"])
    return modes[_RIGID : _RIGID + FREQUENCIES, 3]


def version() -> str:
    """Of the ccx that is installed."""
    said = subprocess.run(["ccx", "-v"], capture_output=True, text=True, check=False).stdout
    return said.split()[-1]


def _mesh(model: FEModel) -> list[str]:
    """Nodes, elements and material of an input deck."""
    m = model.material
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{k}, {x:.13e}, {y:.13e}, {z:.13e}" for k, (x, y, z) in enumerate(model.nodes, 1)]
    lines.append("*ELEMENT, TYPE=C3D10, ELSET=CAGE")
    lines += [f"{k}, {', '.join(map(str, nodes + 1))}" for k, nodes in enumerate(_cells(model), 1)]
    return [
        *lines,
        "*MATERIAL, NAME=M",
        "*ELASTIC",
        f"{m.youngs_modulus:.13e}, {m.poisson_ratio:.13e}",
        "*DENSITY",
        f"{m.density:.13e}",
        "*SOLID SECTION, ELSET=CAGE, MATERIAL=M",
    ]


def node_set(name: str, nodes: np.ndarray) -> list[str]:
    """A named set of nodes of an input deck."""
    return [f"*NSET, NSET={name}", *(f"{node + 1}," for node in nodes)]


def _cells(model: FEModel) -> np.ndarray:
    """Nodes (n_tets, 10) of every element, right-handed."""
    corners = model.points[model.tets]
    left = np.linalg.det(corners[:, 1:] - corners[:, :1]) < 0.0
    return np.where(left[:, None], model.cells[:, _MIRROR], model.cells)


def _free_step() -> list[str]:
    return ["*STEP", "*FREQUENCY", f"{_RIGID + FREQUENCIES + 4}", "*END STEP"]


def _loaded_step(model: FEModel) -> list[str]:
    held = ["*BOUNDARY", *(f"{node + 1}, 1, 3" for node in held_nodes(model))]
    loads = [f"{k}, {face}, {PRESSURE:.13e}" for k, face in _loaded_faces(model)]
    ask = ["*NODE PRINT, NSET=ALL", "U", "*EL PRINT, ELSET=CAGE", "S", "*EL PRINT, ELSET=CAGE"]
    return [*held, "*STEP", "*STATIC", "*DLOAD", *loads, *ask, "COORD", "*END STEP"]


def held_nodes(model: FEModel) -> np.ndarray:
    """Nodes of the faces that are held."""
    triangles = np.concatenate([model.group(name) for name in HELD])
    return np.unique(model.face_nodes(triangles))


def _loaded_faces(model: FEModel) -> list[tuple[int, str]]:
    """Element number and face label of every loaded triangle."""
    wanted = {tuple(sorted(t)) for name in LOADED for t in model.group(name)}
    tets = _cells(model)[:, :4]
    found = [
        (k + 1, f"P{f + 1}")
        for k in np.flatnonzero(np.isin(tets, [v for t in wanted for v in t]).sum(axis=1) > 2)
        for f, corners in enumerate(_FACES)
        if tuple(sorted(tets[k, list(corners)])) in wanted
    ]
    assert len(found) == len(wanted)
    return found


def _run(folder: Path, name: str, deck: list[str]) -> str:
    """Text of the .dat file that ccx writes for a deck."""
    (folder / f"{name}.inp").write_text("\n".join(deck) + "\n", encoding="ascii")
    done = subprocess.run(["ccx", name], cwd=folder, capture_output=True, text=True, check=False)
    dat = folder / f"{name}.dat"
    if done.returncode or not dat.exists() or not dat.stat().st_size:
        raise RuntimeError(f"ccx failed on {name}: {done.stdout[-500:]}")
    return dat.read_text(encoding="ascii")


def _tables(text: str) -> dict[str, list[list[float]]]:
    """Rows of numbers under each heading of a .dat file."""
    tables: dict[str, list[list[float]]] = {}
    rows: list[list[float]] = []
    heading = False
    for words in filter(None, map(str.split, text.splitlines())):
        try:
            rows.append([float(word) for word in words])
            heading = False
        except ValueError:
            if not heading:  # further lines of a heading name columns
                rows = tables.setdefault(" ".join(words).split(" (")[0], [])
            heading = True
    return tables


def kept(model: FEModel, answer: Answer) -> dict[str, list]:
    """What is stored: all frequencies, the largest displacements, and the largest stresses of
    elements at the fillets of the pocket."""
    size = np.linalg.norm(answer.displacement[:, 3:], axis=1)
    root = np.isin(model.tets, model.group(ROOT_OF)).any(axis=1).repeat(4)
    heavy = np.abs(answer.stress[:, 3:]).max(axis=1) * root
    return {
        "frequencies_hz": answer.frequencies.tolist(),
        "displacement_m": answer.displacement[np.argsort(size)[-KEPT:]].tolist(),
        "stress_pa": answer.stress[np.argsort(heavy)[-KEPT:]].tolist(),
    }


def main() -> None:
    """Solve all cages and store what ``kept`` keeps."""
    if not available():
        raise SystemExit("ccx is not installed (Debian: apt-get install calculix-ccx)")
    models = {name: cage_model(name) for name in CAGES}
    cages = {name: kept(model, solve(model)) for name, model in models.items()}
    stored = {"source": f"CalculiX {version()}", "cages": cages}
    STORED.parent.mkdir(exist_ok=True)
    STORED.write_text(json.dumps(stored, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
