"""A cage whose matrices stand in a file, in N, mm and t, as another program writes them."""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import flexcage
from flexcage.stages import flexible_cage


def write_as_another_program(case: flexcage.Case, path: Path) -> None:
    """Full stiffness and mass of the cage's mesh, in N/mm and t; nodes in mm."""
    body = flexible_cage(case).as_full_body()
    arrays = {"NODES": body.nodes * 1e3}
    for name, matrix in (("K", body.stiffness * 1e-3), ("M", body.mass * 1e-3)):
        for part in ("data", "indices", "indptr", "shape"):
            arrays[f"{name}.{part}"] = np.asarray(getattr(matrix, part))
    np.savez(path, **arrays)


def main(**settings: str) -> float:
    """First frequency of the cage from the file over that of the cage made here."""
    case = flexcage.load_case(Path(__file__).with_name("n1013.toml"), overrides=settings)
    case = case.replace("mesh.order", 1)  # linear elements: a small file
    with TemporaryDirectory() as folder:
        file = Path(folder) / "cage.npz"
        write_as_another_program(case, file)
        theirs = case.replace(**{"modes.body": str(file), "modes.body_units": "mm-t-s"})
        tables = [flexible_cage(each).table for each in (case, theirs)]
    for here, there in list(zip(*(table.frequency for table in tables), strict=True))[:6]:
        print(f"{here:8.2f} Hz made here, {there:8.2f} Hz from the file")
    return float(tables[1].frequency[0] / tables[0].frequency[0])


if __name__ == "__main__":
    ratio = main()
    assert abs(ratio - 1.0) < 1e-6, ratio  # the same matrices, by another road
