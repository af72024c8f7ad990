"""Rebuild every mesh of this folder from the TOML beside it:  python meshes/regenerate.py [OUT]

``normal``, ``deltaq_*`` (crossbeam 5 bent towards pocket 4) and ``deltap_*`` (+x side beam of
pocket 5) of the N1013's cage, coarse so that each file stays under 1 MB. Metres, gmsh 2.2 binary.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

from flexcage.cages.build import build_cage_mesh
from flexcage.case import load_case
from flexcage.mesh.io import write_mesh
from flexcage.mesh.quality import MeshReport, report_mesh

HERE = Path(__file__).resolve().parent


def regenerate(out: Path = HERE) -> Iterator[tuple[Path, MeshReport]]:
    """Write the .msh of every TOML of this folder to ``out``; yields each path and its report."""
    for toml in sorted(HERE.glob("*.toml")):
        case = load_case(toml)
        mesh = build_cage_mesh(**case.cage_shape)
        path = write_mesh(mesh, out / f"{toml.stem}.msh")
        yield path, report_mesh(mesh, density=case.cage.material.density)


def main(arguments: list[str]) -> None:
    out = Path(arguments[0]) if arguments else HERE
    out.mkdir(parents=True, exist_ok=True)
    for path, report in regenerate(out):
        sys.stdout.write(f"{path}\n{report}\n\n")


if __name__ == "__main__":
    main(sys.argv[1:])
