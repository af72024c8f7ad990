"""A mesh of one's own whose pockets have sharp corners is taken, and the run says what it costs."""

import meshio
import numpy as np
from hex_cage import hex_mesh

from flexcage.case import load_case
from flexcage.case.presets import load_preset
from flexcage.mesh.cage_mesh import signed_volumes
from flexcage.simulate import simulate

N1013 = load_preset("N1013")
Z = N1013.bearing.roller_count


def facet_groups(mesh):
    """Triangles on the cage's surface by the names that flexcage wants, no fillets among them."""
    cage, facets = N1013.cage, mesh.facets[:, mesh.boundary_facets()]
    x, y, z = mesh.p[:, facets].mean(axis=1)
    corners = mesh.p[:, facets]
    radius = np.hypot(corners[1], corners[2])
    pocket = np.round(np.arctan2(z, y) * Z / (2 * np.pi)).astype(int) % Z
    turn = 2 * np.pi * pocket / Z
    across = z * np.cos(turn) - y * np.sin(turn)

    def at(values, place):
        return np.isclose(values, place, atol=1e-9).all(axis=0)

    pairs = {
        "land_inner": at(radius, 0.5 * cage.bore),
        "land_outer": at(radius, 0.5 * cage.outside_diameter),
        "end+x": at(corners[0], 0.5 * cage.width),
        "end-x": at(corners[0], -0.5 * cage.width),
    }
    left = ~np.any(list(pairs.values()), axis=0)
    sides = {
        "side+x": at(corners[0], 0.5 * cage.pocket_length),
        "side-x": at(corners[0], -0.5 * cage.pocket_length),
    }
    walls = left & ~sides["side+x"] & ~sides["side-x"]
    sides |= {"front": walls & (across > 0), "rear": walls & (across < 0)}
    for k in range(Z):
        pairs |= {f"pocket{k}_{name}": where & (pocket == k) for name, where in sides.items()}
    return {name: facets.T[where] for name, where in pairs.items()}


def test_an_own_mesh_with_sharp_corners(tmp_path):
    mesh = hex_mesh(N1013.cage, Z).to_meshtet()
    groups = facet_groups(mesh)
    inverted = signed_volumes(mesh.p.T, mesh.t.T) < 0.0
    tets = np.where(inverted[:, None], mesh.t.T[:, [0, 2, 1, 3]], mesh.t.T)
    triangles = np.concatenate(list(groups.values()))
    numbers = np.repeat(np.arange(len(groups)) + 2, [len(g) for g in groups.values()])
    meshio.Mesh(
        mesh.p.T,
        [("tetra", tets), ("triangle", triangles)],
        cell_data={"gmsh:physical": [np.ones(len(tets), int), numbers],
                   "gmsh:geometrical": [np.ones(len(tets), int), numbers]},
        field_data={"cage": np.array([1, 3])} | {
            name: np.array([k + 2, 2]) for k, name in enumerate(groups)
        },
    ).write(tmp_path / "sharp.msh", file_format="gmsh22")  # fmt: skip
    case = load_case({
        "bearing": {"preset": "N1013"}, "load": {"radial": "1 kN"}, "modes": {"count": 6},
        "mesh": {"file": str(tmp_path / "sharp.msh")},
        "solver": {"duration": "0.1 ms"},
    })  # fmt: skip
    (found,) = [w for w in simulate(case).warnings if w.key == "sharp_corners"]
    assert found.text.startswith("The mesh has no fillets in the corners of all pockets")
    assert "cage.fillet_radius = 0.5 mm is not in it" in found.text
