"""Ansys archives: a mesh with components, written by hand as Ansys writes them."""

from __future__ import annotations

import numpy as np
import pytest

from flexcage.core.errors import InputError
from flexcage.mesh.io import read_mesh

pytest.importorskip("mapdl_archive")


def component(name, numbers):
    lines = [f"CMBLOCK,{name},NODE,{len(numbers):8d}", "(8i10)"]
    return [*lines, *("".join(f"{n:10d}" for n in numbers[i : i + 8])
                      for i in range(0, len(numbers), 8))]  # fmt: skip


def write_cdb(mesh, path, *, kind=285, scale=1e3, leave_out=""):
    """NBLOCK, EBLOCK and node components, in mm."""
    lines = ["/PREP7", f"ET,1,{kind}", f"NBLOCK,6,SOLID,{len(mesh.points)},{len(mesh.points)}"]
    lines.append("(3i9,6e21.13e3)")
    for i, point in enumerate(mesh.points * scale):
        lines.append(f"{i + 1:9d}{0:9d}{0:9d}" + "".join(f"{c:21.13E}" for c in point))
    lines.append("N,R5.3,LOC,       -1,")
    lines += [f"EBLOCK,19,SOLID,{len(mesh.tets)},{len(mesh.tets)}", "(19i9)"]
    for i, (a, b, c, d) in enumerate(mesh.tets + 1):
        nodes = [a, b, c, c, d, d, d, d] if kind == 185 else [a, b, c, d]
        head = [1, 1, 1, 1, 0, 0, 0, 0, len(nodes), 0, i + 1]
        lines.append("".join(f"{n:9d}" for n in [*head, *nodes]))
    lines.append("       -1")
    for name, triangles in mesh.groups.items():
        if name != leave_out:
            written = name.upper().replace("+X", "_PX").replace("-X", "_MX")
            lines += component(written, np.unique(triangles) + 1)
    path.write_text("\n".join([*lines, "FINISH", ""]))
    return path


@pytest.mark.parametrize("kind", [285, 185])
def test_a_cage_in_millimetres(n1013, tmp_path, kind):
    mesh = n1013(fineness="coarse")
    read = read_mesh(write_cdb(mesh, tmp_path / "cage.cdb", kind=kind), unit="mm")
    assert read.volume == pytest.approx(mesh.volume, rel=1e-9)
    assert set(read.groups) == set(mesh.groups)
    for name in ("pocket4_side-x", "pocket0_front", "land_inner", "end+x"):
        assert len(read.groups[name]) == len(mesh.groups[name]), name


def test_a_component_that_is_missing_is_named(n1013, tmp_path):
    path = write_cdb(n1013(fineness="coarse"), tmp_path / "cage.cdb", leave_out="pocket3_rear")
    with pytest.raises(InputError, match="has no surface group 'pocket3_rear'"):
        read_mesh(path, unit="mm")


def test_bricks_and_no_archive(n1013, tmp_path):
    path = write_cdb(n1013(fineness="coarse"), tmp_path / "cage.cdb")
    text = path.read_text().splitlines()
    first = next(i for i, line in enumerate(text) if line.startswith("EBLOCK")) + 2
    numbers = [1, 1, 1, 1, 0, 0, 0, 0, 8, 0, 1, 1, 2, 3, 4, 5, 6, 7, 8]
    brick = "".join(f"{n:9d}" for n in numbers)
    path.write_text(
        "\n".join([*text[:first], brick, *text[first + 1 :]]).replace("ET,1,285", "ET,1,185")
    )
    with pytest.raises(InputError, match="elements of type 185 that are no tetrahedra"):
        read_mesh(path, unit="mm")
    other = tmp_path / "other.cdb"
    other.write_text("no archive\n")
    with pytest.raises(InputError, match="other.cdb"):
        read_mesh(other)
