"""Meshes as those of other packages."""

from __future__ import annotations

import numpy as np


def _cell_data(mesh) -> dict[str, np.ndarray]:
    return {name: values for name in ("layer", "region") if len(values := getattr(mesh, name))}


def _points_3d(mesh) -> np.ndarray:
    return np.column_stack([mesh.points, np.zeros(len(mesh.points))])


def to_meshio(mesh):
    """Mesh.to_meshio()."""
    import meshio  # type: ignore[import-untyped]

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
    return meshio.Mesh(_points_3d(mesh), cells, cell_data=data, cell_sets=sets)


def to_pyvista(mesh):
    """Mesh.to_pyvista()."""
    import pyvista

    blocks = {pyvista.CellType.TRIANGLE: mesh.triangles, pyvista.CellType.QUAD: mesh.quads}
    grid = pyvista.UnstructuredGrid({kind: block for kind, block in blocks.items() if len(block)}, _points_3d(mesh))
    for name, values in _cell_data(mesh).items():
        grid.cell_data[name] = values
    return grid
