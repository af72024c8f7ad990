"""Files that are asked for and are not read, by their ending: what they are, and what to write in
their place."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

_ABAQUS = "export the mesh from its pre-processor as an Abaqus deck (.inp) with its surfaces"
_BY_GMSH = "gmsh converts it with its groups:  gmsh -save {path} -o {stem}.msh"
_PACKED = "is packed; unpack it, and name the file that was in it"
_NASTRAN = f"is a Nastran deck, in which surfaces have no names; {_ABAQUS}"
_SHAPE = (
    "is a shape without a volume mesh; mesh it with tetrahedra, name its surfaces, and save it "
)
_BINARY = "is the database of a program that alone reads it; "

#: what keeps anything in another form
PACKED: Mapping[str, str] = MappingProxyType(
    dict.fromkeys((".gz", ".zip", ".bz2", ".xz", ".7z", ".zst", ".tar", ".tgz"), _PACKED)
)
#: meshes
_MESHES = {
    **PACKED,
    **dict.fromkeys((".bdf", ".nas", ".dat", ".fem", ".pch"), _NASTRAN),
    ".unv": f"is a universal file; {_BY_GMSH}",
    ".med": f"is a mesh of Salome; {_BY_GMSH}",
    ".vtk": "is a VTK file of the older kind; save it in ParaView as .vtu, with its cell arrays",
    **dict.fromkeys(
        (".stl", ".step", ".stp", ".igs", ".iges", ".brep", ".obj", ".ply", ".geo", ".3mf", ".sat",
         ".x_t", ".x_b", ".catpart", ".sldprt", ".prt", ".ipt"),
        f"{_SHAPE}as .msh (gmsh) or .inp",
    ),
    **dict.fromkeys((".k", ".key", ".rad", ".hm", ".cmdb", ".hmascii", ".ans"),
                    f"is of a program whose decks are not read; {_ABAQUS}"),
    **dict.fromkeys((".cae", ".odb"), f"{_BINARY}write its input file (.inp) in Abaqus/CAE, by "
                    "Job, Write Input"),
    **dict.fromkeys((".db", ".rst", ".mechdb", ".wbpj"), f"{_BINARY}write an archive (.cdb) in "
                    "Ansys by CDWRITE,DB"),
    ".frd": "holds results of CalculiX, without surfaces; name the deck (.inp) that it is of, with "
    "its surfaces",
    **dict.fromkeys(
        (".exo", ".e", ".cgns", ".xdmf", ".mesh", ".meshb", ".neu", ".ugrid", ".su2"),
        "is a mesh whose groups are not read; save it as .msh (gmsh) or .vtu, with the surfaces "
        "named",
    ),
    ".mph": f"{_BINARY}export the mesh from COMSOL as Nastran or .vtu, and name its surfaces",
}  # fmt: skip


def no_mesh(path: Path, readable: str) -> str:
    """A sentence without its full stop on a file whose ending is not read as a mesh."""
    return known_reason(path, _MESHES, f"is no mesh file that can be read: {readable}")


def known_reason(path: Path, known: Mapping[str, str], otherwise: str) -> str:
    """What is ``known`` of a file's ending, with the file's name in it, or ``otherwise``."""
    what = known.get(path.suffix.lower(), otherwise)
    return f"{path} {what.format(path=path, stem=path.with_suffix(''))}"
