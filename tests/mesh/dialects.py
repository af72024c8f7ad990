"""Small random meshes, and writers of them in the dialects of other programs."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.spatial import Delaunay

from flexcage.mesh.cage_mesh import signed_volumes

FACES = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))  # S1 to S4 of a tetrahedron in Abaqus
EDGES = ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))  # with nodes of ten-node tetrahedra
NAMES = ("end+x", "land_outer", "pocket0_front", "pocket12_wall")


@dataclass
class Small:
    """Tetrahedra of random points, numbers in a file, and groups of boundary triangles."""

    points: np.ndarray
    tets: np.ndarray
    numbers: np.ndarray  # of points
    elements: np.ndarray  # numbers of tetrahedra
    groups: dict[str, np.ndarray] = field(default_factory=dict)
    owner: dict[frozenset, tuple[int, int]] = field(default_factory=dict)  # tetrahedron, its face


def small(rng) -> Small:
    """Of 8 to 30 points, well apart; with numbers in disorder, with gaps."""
    count = int(rng.integers(8, 31))
    points = rng.permutation(np.stack(np.meshgrid(*[np.arange(4.0)] * 3), -1).reshape(-1, 3))
    points = points[:count] + rng.uniform(-0.3, 0.3, (count, 3))
    tets = Delaunay(points).simplices.astype(int)
    turned = signed_volumes(points, tets) < 0.0
    tets[turned] = tets[turned][:, [0, 2, 1, 3]]
    tets = tets[signed_volumes(points, tets) > 1e-3]
    used = np.unique(tets)
    place = np.full(count, -1)
    place[used] = np.arange(len(used))
    points, tets = points[used], place[tets]
    numbers = rng.choice(5000, len(points), replace=False) + 1
    mesh = Small(points, tets, numbers, rng.choice(5000, len(tets), replace=False) + 10_000)
    seen: dict[frozenset, list[tuple[int, int]]] = {}
    for i, tet in enumerate(tets):
        for s, face in enumerate(FACES):
            seen.setdefault(frozenset(tet[list(face)].tolist()), []).append((i, s))
    mesh.owner = {face: own[0] for face, own in seen.items() if len(own) == 1}
    faces = np.array([sorted(face) for face in mesh.owner])
    parts = np.array_split(rng.permutation(faces), len(NAMES))
    mesh.groups = dict(zip(NAMES, parts))
    return mesh


def middles(mesh: Small) -> tuple[np.ndarray, np.ndarray]:
    """Ten nodes (m, 10) of every tetrahedron, rows of points and of the middles after them; and
    the middles' places."""
    pairs = np.sort(mesh.tets[:, EDGES].reshape(-1, 2), axis=1)
    edges, which = np.unique(pairs, axis=0, return_inverse=True)
    ten = np.hstack([mesh.tets, len(mesh.points) + which.reshape(-1, 6)])
    return ten, mesh.points[edges].mean(axis=1)


def number(value: float, rng) -> str:
    """A number as Fortran and people write it."""
    value = float(value)
    return [f"{value!r}", f"{value:.17E}", f"{value:.17E}".replace("E", "D"),
            f"{value:.17e}".replace("e", "d"), f"  {value!r}  "][rng.integers(5)]  # fmt: skip


def ranges(values, rng) -> list[str]:
    """Data lines of GENERATE that hold the values: upwards, downwards or single."""
    lines = []
    values = sorted(values)
    while values:
        run = 1
        while run < len(values) and values[run] == values[0] + run:
            run += 1
        part, values = values[:run], values[run:]
        if run == 1:
            lines.append([f"{part[0]}, {part[0]}, 1", f"{part[0]}, {part[0]}"][rng.integers(2)])
        else:
            up = rng.integers(2)
            first, last = (part[0], part[-1]) if up else (part[-1], part[0])
            lines.append(f"{first}, {last}, {1 if up else -1}")
    return lines


def abaqus(mesh: Small, rng) -> bytes:
    """A deck with what decks may have: parts, moved instances, systems of coordinates, ranges,
    sets of sets, combined surfaces, any encoding and line ends."""
    word = [str, str.upper, str.title][rng.integers(3)]
    part, cylinder = bool(rng.integers(2)), bool(rng.integers(2))
    points, turn = mesh.points.copy(), bool(rng.integers(2))
    move = rng.uniform(-5.0, 5.0, 3).round(3) if part and rng.integers(2) else np.zeros(3)
    shift = rng.uniform(-5.0, 5.0, 3).round(3) if rng.integers(2) else np.zeros(3)
    ten, extra = middles(mesh) if rng.integers(2) else (mesh.tets, np.empty((0, 3)))
    points = np.vstack([points, extra])
    numbers = np.concatenate([mesh.numbers, 6000 + np.arange(len(extra))])
    if part and move.any() and turn:  # by 90 degrees about z, after the move
        points = points @ np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    points = points - move - shift
    lines = ["*Heading", "** caf\xe9 \x85 a comment, of any kind", "a cage"]
    lines += [word("*part, name=CAGE")] if part else []
    lines += [word("*system"), ", ".join(map(str, shift))] if shift.any() else []
    if cylinder:
        x, y, z = points.T
        points = np.column_stack([np.hypot(x, y), np.rad2deg(np.arctan2(y, x)), z])
    lines.append(word(f"*node, nset=all{', system=c' if cylinder else ''}"))
    for i in rng.permutation(len(points)):
        row = [number(c, rng) if c else "" for c in points[i]]
        lines.append(f" {numbers[i]},\t" + ", ".join(row) + ["", ","][rng.integers(2)])
    lines += [word("*system")] if shift.any() else []
    lines.append(word(f"*element, type=C3D{ten.shape[1]}"))
    for i in rng.permutation(len(ten)):
        row = [str(mesh.elements[i]), *map(str, numbers[ten[i]])]
        cut = int(rng.integers(3, len(row)))
        lines += [", ".join(row)] if rng.integers(2) else [
            ", ".join(row[:cut]) + ",", ", ".join(row[cut:])]  # fmt: skip
    shells, after = _abaqus_groups(mesh, rng, word, part)
    lines += shells
    lines += ["*Solid Section, elset=none, material=brass", "1.,"]
    if part:
        lines += ["*End Part", "*Assembly, name=all", "*Instance, name=CAGE-1, part=CAGE"]
        lines += [", ".join(map(str, move))] if move.any() else []
        lines += ["0., 0., 0., 0., 0., 2., 90."] if move.any() and turn else []
        lines += ["*End Instance", "*Node", "1, 7., 7., 7."]
    lines += [
        *after,
        *(["*End Assembly"] if part else []),
        "*Step",
        "*Node Print",
        "u",
        "*End Step",
    ]
    ends = ["\n", "\r\n"][rng.integers(2)]
    coding = ["utf-8", "utf-8-sig", "latin-1", "utf-16"][rng.integers(4)]
    return (ends.join(lines) + ends).encode(coding)


def _abaqus_groups(mesh: Small, rng, word, part: bool) -> tuple[list[str], list[str]]:
    """Lines of shells in the part, and of sets and surfaces after it."""
    shells, after, count = [], [], 20_000
    of = ", instance=CAGE-1" if part else ""
    for name, triangles in mesh.groups.items():
        name, own = word(name), f"_{name}_"
        if rng.integers(2):  # an element set of shells
            rows = []
            for triangle in triangles:
                count += int(rng.integers(1, 3))
                rows.append(count)
                shells.append(word("*element, type=S3"))
                shells.append(", ".join(map(str, [count, *mesh.numbers[triangle]])))
            half = len(rows) // 2
            after += [f"*Elset, elset={own}1{of}", ", ".join(map(str, rows[:half]))] if half else []
            after += [f"*Elset, elset={own}2{of}, generate", *ranges(rows[half:], rng)]
            after += [f"*Elset, elset={name}", f"{own}1, {own}2" if half else f"{own}2"]
            continue
        pairs = [mesh.owner[frozenset(t.tolist())] for t in triangles]
        sides = {s: sorted({int(mesh.elements[i]) for i, side in pairs if side == s})
                 for s in {side for _, side in pairs}}  # fmt: skip
        made = []
        for s, elements in sides.items():
            after += [f"*ELSET, ELSET={own}S{s}{of}, GENERATE", *ranges(elements, rng)]
            after += [f"*SURFACE, NAME={own}T{s}, TYPE=ELEMENT", f"{own}S{s}, S{s + 1}"]
            made.append(f"{own}T{s}")
        if rng.integers(2):
            after += [f"*SURFACE, NAME={name}, COMBINE=UNION", ", ".join(made)]
        else:
            after += [word(f"*surface, type=element,\nname={name}")]
            after += [f"{own}S{s}, S{s + 1}" for s in sides]
    return shells, after


def msh(mesh: Small, rng, path, *, version: float, binary: bool, order: int = 1) -> None:
    """By gmsh, each group as two entities, some of which are in a second physical group."""
    import gmsh

    gmsh.initialize(interruptible=False, readConfigFiles=False)
    try:
        gmsh.option.setNumber("General.Verbosity", 0)
        model = gmsh.model
        model.addDiscreteEntity(3, 1)
        model.mesh.addNodes(3, 1, mesh.numbers, mesh.points.ravel())
        model.mesh.addElementsByType(1, 4, mesh.elements, mesh.numbers[mesh.tets].ravel())
        model.addPhysicalGroup(3, [1], 1, "cage")
        if rng.integers(2):
            model.addPhysicalGroup(3, [1], 2, "brass")
        tag, count = 0, 20_000
        for name, triangles in mesh.groups.items():
            tags = []
            for part in np.array_split(triangles, 2):
                tag += 1
                tags.append(tag)
                model.addDiscreteEntity(2, tag)
                ids = count + np.arange(len(part))
                count += len(part)
                model.mesh.addElementsByType(tag, 2, ids, mesh.numbers[part].ravel())
            model.addPhysicalGroup(2, tags, tag + 100, name)
            model.addPhysicalGroup(2, tags[:1], tag + 200, f"gauge {name}")
        if order > 1:
            model.mesh.setOrder(order)
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.option.setNumber("Mesh.Binary", int(binary))
        gmsh.write(str(path))
    finally:
        gmsh.finalize()


def ansys(mesh: Small, rng, path) -> None:
    """Blocked nodes and elements, element components of surface triangles by number or range."""
    kind = [185, 285, 187][rng.integers(3)]
    ten, extra = middles(mesh) if kind == 187 else (mesh.tets, np.empty((0, 3)))
    points = np.vstack([mesh.points, extra])
    numbers = np.concatenate([mesh.numbers, 6000 + np.arange(len(extra))])
    order = np.argsort(numbers)
    lines = ["/COM,ANSYS", "*IF,_CDRDOFF,EQ,1,THEN", "_CDRDOFF=", "*ENDIF", "NUMOFF,NODE,9",
             f"ET,1,{kind}", "ET,2,154", f"NBLOCK,6,SOLID,{numbers.max()},{len(points)}",
             "(3i9,6e21.13e3)"]  # fmt: skip
    for i in order:
        lines.append(f"{numbers[i]:9d}{0:9d}{0:9d}" + "".join(f"{c:21.13E}" for c in points[i]))
    lines.append("N,R5.3,LOC,       -1,")
    shells, groups, count = [], {}, 20_000
    for name, triangles in mesh.groups.items():
        ids = count + 1 + np.arange(len(triangles)) * int(rng.integers(1, 3))
        count = int(ids[-1])
        groups[name] = ids
        shells += [(int(e), 2, [*t, t[2]]) for e, t in zip(ids, numbers[triangles])]
    solids = []
    for e, tet in zip(mesh.elements, numbers[ten]):
        a, b, c, d, *rest = tet
        solids.append((int(e), 1, [a, b, c, c, d, d, d, d] if kind == 185 else [a, b, c, d, *rest]))
    lines += [f"EBLOCK,19,SOLID,{count},{len(solids) + len(shells)}", "(19i9)"]
    for e, ref, nodes in [*solids, *shells]:
        row = [1, ref, 1, 1, 0, 0, 0, 0, len(nodes), 0, e, *nodes]
        lines += ["".join(f"{n:9d}" for n in row[:19])]
        lines += ["".join(f"{n:9d}" for n in row[19:])] if row[19:] else []
    lines.append("       -1")
    for name, ids in groups.items():
        runs = np.array_split(ids, np.flatnonzero(np.diff(ids) != 1) + 1)
        flat = [int(v) for run in runs for v in ([run[0], -run[-1]] if len(run) > 2 else run)]
        written = name.upper().replace("+X", "_PX")
        lines += [f"CMBLOCK,{written},ELEM,{len(flat):8d}", "(8i10)"]
        lines += ["".join(f"{n:10d}" for n in flat[i : i + 8]) for i in range(0, len(flat), 8)]
    ends = ["\n", "\r\n"][rng.integers(2)]
    path.write_bytes(ends.join([*lines, "FINISH", ""]).encode("latin-1"))


def nastran(mesh: Small, rng, path) -> None:
    """GRID entries in small, large and free fields, with tabs, D exponents and any encoding."""
    lines = ["$ caf\xe9", "BEGIN BULK"]
    for n, place in zip(mesh.numbers, mesh.points):
        x, y, z = (f"{c:.9E}".replace("E", "DE"[rng.integers(2)]) for c in place)
        lines += [
            [f"GRID*   {n:16d}{'':16s}{x:>16s}{y:>16s}", f"*       {z:>16s}"],
            [f"GRID,{n},,{place[0]:.5f},{place[1]:.5f},{place[2]:.5f}"],
            [f"GRID\t{n}\t\t{place[0]:.4f}\t{place[1]:.4f}\t{place[2]:.4f}"],
        ][rng.integers(3)]
    ends = ["\n", "\r\n"][rng.integers(2)]
    coding = ["utf-8", "utf-8-sig", "latin-1", "utf-16"][rng.integers(4)]
    path.write_bytes(ends.join([*lines, "ENDDATA", ""]).encode(coding))
