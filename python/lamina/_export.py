"""Meshes as those of other packages."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._optional import packages_of

if TYPE_CHECKING:
    from ._mesh import Mesh


def _cell_data(mesh: Mesh) -> dict[str, np.ndarray]:
    return {name: values for name in ("layer", "region") if len(values := getattr(mesh, name))}


def _point_data(mesh: Mesh) -> dict[str, np.ndarray]:
    data = {name: np.array(values) for name in ("node_type", "node_marker", "node_layer")
            if len(values := getattr(mesh, name))}
    # Without walls there is no distance to them.
    if "wall" in mesh.marker_kinds.values():
        data["wall_distance"] = np.array(mesh.wall_distance)
    return data


def _points_3d(mesh: Mesh) -> np.ndarray:
    return np.column_stack([mesh.points, np.zeros(len(mesh.points))])


def to_meshio(mesh: Mesh) -> Any:
    """Mesh.to_meshio()."""
    with packages_of("meshio"):
        import meshio  # type: ignore[import-not-found, import-untyped, unused-ignore]

    blocks = [("triangle", mesh.triangles), ("quad", mesh.quads)]
    cells = [(kind, np.asarray(block, dtype=np.int64)) for kind, block in blocks if len(block)]
    surface_blocks = len(cells)
    cells += [("line", np.asarray(edges, dtype=np.int64)) for edges in mesh.markers.values()]
    starts = np.cumsum([0] + [len(block) for _, block in cells[:surface_blocks]])
    data = {name: [values[a:b] for a, b in zip(starts[:-1], starts[1:])]
            + [np.zeros(len(edges), dtype=values.dtype) for edges in mesh.markers.values()]
            for name, values in _cell_data(mesh).items()}
    sets = {}
    for number, (name, edges) in enumerate(mesh.markers.items()):
        members = [np.empty(0, dtype=np.int64) for _ in cells]
        members[surface_blocks + number] = np.arange(len(edges))
        sets[name] = members
    return meshio.Mesh(_points_3d(mesh), cells, point_data=_point_data(mesh), cell_data=data, cell_sets=sets)


def to_pyvista(mesh: Mesh) -> Any:
    """Mesh.to_pyvista()."""
    with packages_of("pyvista"):
        import pyvista  # type: ignore[import-not-found, unused-ignore]

    blocks = {pyvista.CellType.TRIANGLE: mesh.triangles, pyvista.CellType.QUAD: mesh.quads}
    grid = pyvista.UnstructuredGrid({kind: block for kind, block in blocks.items() if len(block)}, _points_3d(mesh))
    for name, values in _cell_data(mesh).items():
        grid.cell_data[name] = values
    for name, values in _point_data(mesh).items():
        grid.point_data[name] = values
    for name, edges in mesh.markers.items():
        grid.field_data[f"marker {name}"] = edges.astype(np.int64)
    return grid


def _edge_lengths(mesh: Mesh) -> np.ndarray:
    return np.asarray(np.hypot(*(mesh.points[mesh.edges[:, 1]] - mesh.points[mesh.edges[:, 0]]).T))


def to_pyg(mesh: Mesh) -> Any:
    """Mesh.to_pyg()."""
    with packages_of("graphs"):
        import torch  # type: ignore[import-not-found, import-untyped, unused-ignore]
        from torch_geometric.data import Data  # type: ignore[import-not-found, import-untyped, unused-ignore]

    index = mesh.edge_index(both_directions=True)
    step = mesh.points[index[1]] - mesh.points[index[0]]
    attributes = np.column_stack([step, np.hypot(*step.T)])
    arrays = {"pos": np.array(mesh.points), "edge_index": index, "edge_attr": attributes, **_point_data(mesh)}
    if len(mesh.quads) == 0:
        arrays["face"] = np.ascontiguousarray(mesh.triangles.T, dtype=np.int64)
    return Data(**{name: torch.from_numpy(array) for name, array in arrays.items()})


def to_networkx(mesh: Mesh) -> Any:
    """Mesh.to_networkx()."""
    with packages_of("networkx"):
        import networkx  # type: ignore[import-not-found, import-untyped, unused-ignore]

    graph = networkx.Graph()
    graph.add_nodes_from(range(len(mesh.points)))
    networkx.set_node_attributes(graph, dict(enumerate(map(tuple, mesh.points.tolist()))), "pos")
    for name, values in _point_data(mesh).items():
        networkx.set_node_attributes(graph, dict(enumerate(values.tolist())), name)
    graph.add_weighted_edges_from(zip(*mesh.edges.T.tolist(), _edge_lengths(mesh).tolist()), weight="length")
    return graph


def _face_nodes(mesh: Mesh) -> np.ndarray:
    """Returns the corners of all cells, (cells, 4); -1 in place of the fourth one of triangles."""
    nodes = np.full((len(mesh), 4), -1, dtype=np.int64)
    nodes[:len(mesh.triangles), :3] = mesh.triangles
    nodes[len(mesh.triangles):] = mesh.quads
    return nodes


def to_xarray(mesh: Mesh) -> Any:
    """Mesh.to_xarray(). UGRID: https://ugrid-conventions.github.io/ugrid-conventions, "2D flexible mesh topology"."""
    with packages_of("xarray"):
        import xarray  # type: ignore[import-not-found, unused-ignore]

    topology = {"cf_role": "mesh_topology", "topology_dimension": 2, "node_coordinates": "x y",
                "face_node_connectivity": "face_nodes", "edge_node_connectivity": "edge_nodes",
                "edge_face_connectivity": "edge_faces", "face_dimension": "face", "edge_dimension": "edge"}
    index = {"start_index": 0, "_FillValue": -1}
    variables: dict[str, Any] = {
        "mesh": ((), 0, topology), "x": ("node", mesh.points[:, 0]), "y": ("node", mesh.points[:, 1]),
        "face_nodes": (("face", "corner"), _face_nodes(mesh), index),
        "edge_nodes": (("edge", "end"), np.array(mesh.edges), index),
        "edge_faces": (("edge", "end"), np.array(mesh.edge_cells), index)}
    variables |= {name: ("node", values) for name, values in _point_data(mesh).items()}
    variables |= {name: ("face", values) for name, values in _cell_data(mesh).items()}
    variables |= {f"marker_{name}": ((f"edges_{name}", "end"), edges.astype(np.int64), {"kind": mesh.marker_kinds[name]})
                  for name, edges in mesh.markers.items()}
    return xarray.Dataset(variables, attrs={"Conventions": "UGRID-1.0", "hash": mesh.hash})


def to_row(mesh: Mesh) -> dict[str, Any]:
    """Mesh.to_row()."""
    return {"hash": mesh.hash, "x": np.array(mesh.points[:, 0]), "y": np.array(mesh.points[:, 1]),
            "triangles": mesh.triangles.astype(np.int64).reshape(-1), "quads": mesh.quads.astype(np.int64).reshape(-1),
            "edge_from": np.array(mesh.edges[:, 0]), "edge_to": np.array(mesh.edges[:, 1]),
            **_point_data(mesh), **{name: np.array(values) for name, values in _cell_data(mesh).items()}}
