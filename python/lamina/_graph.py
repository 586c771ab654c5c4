"""Meshes as graphs: what finite volumes and graph networks ask for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _lamina
from ._arrays import Values, immutable
from ._errors import WrongTypeError

#: The names of the numbers in Mesh.node_type.
NODE_TYPES = ("inside", *_lamina.marker_kinds)


@dataclass(frozen=True, eq=False, repr=False)
class MeshEdges(Values):
    """The edges of a mesh, each once, and the cells beside them."""

    ends: np.ndarray  #: (e, 2) points, the smaller number first; sorted
    cells: np.ndarray  #: (e, 2) the cells beside, the smaller number first; -1: there is no second one
    first_along: np.ndarray  #: (e,) whether the first cell has the ends in this order, and not the other one
    neighbours: np.ndarray  #: (cells, 3 or 4) the cell across the edge from corner i to the next one; -1: none


def _edges_of_cells(cells: np.ndarray, first: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Returns ends, cell and side of each directed edge. `first` is the number of the first cell."""
    count, corners = cells.shape
    ends = np.stack([cells, np.roll(cells, -1, axis=1)], axis=2).reshape(-1, 2).astype(np.int64)
    return ends, np.repeat(np.arange(first, first + count), corners), np.tile(np.arange(corners), count)


def find_edges(triangles: np.ndarray, quads: np.ndarray) -> MeshEdges:
    """Returns the edges of triangles and quadrilaterals.

    Directed edges are sorted by their ends; two in a row with the same ends are those of two cells beside each other.
    """
    parts = [_edges_of_cells(triangles, 0), _edges_of_cells(quads, len(triangles))]
    ends, cell, side = (np.concatenate(column) for column in zip(*parts))
    is_along = ends[:, 0] < ends[:, 1]
    ends.sort(axis=1)
    # One number for both ends. The order of cells stays where these are equal.
    order = np.argsort(ends[:, 0] * (int(ends.max(initial=0)) + 1) + ends[:, 1], kind="stable")
    ends, cell, side = ends[order], cell[order], side[order]
    is_first = np.ones(len(ends), dtype=bool)
    is_first[1:] = (ends[1:] != ends[:-1]).any(axis=1)
    first = np.flatnonzero(is_first)
    is_paired = np.diff(np.append(first, len(ends))) > 1
    second = first[is_paired] + 1
    beside = np.full((len(first), 2), -1, dtype=np.int64)
    beside[:, 0] = cell[first]
    beside[is_paired, 1] = cell[second]
    neighbours = np.full((len(triangles) + len(quads), 4 if len(quads) else 3), -1, dtype=np.int64)
    neighbours[cell[first[is_paired]], side[first[is_paired]]] = cell[second]
    neighbours[cell[second], side[second]] = cell[first[is_paired]]
    return MeshEdges(immutable(ends[first]), immutable(beside), immutable(is_along[order[first]]), immutable(neighbours))


def _areas_and_centres(points: np.ndarray, cells: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the area and the centre of gravity of each cell, as sums over the triangles at its first corner."""
    corners = points[cells]
    base = corners[:, :1]
    left, right = corners[:, 1:-1] - base, corners[:, 2:] - base
    parts = 0.5 * (left[..., 0] * right[..., 1] - left[..., 1] * right[..., 0])
    areas = parts.sum(axis=1)
    moments = (parts[..., None] * (left + right) / 3).sum(axis=1)
    return areas, base[:, 0] + moments / areas[:, None]


def areas_and_centres(points: np.ndarray, triangles: np.ndarray, quads: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the area of each cell, (cells,), and its centre of gravity, (cells, 2)."""
    parts = [_areas_and_centres(points, cells) for cells in (triangles, quads)]
    areas, centres = (np.concatenate(column) for column in zip(*parts))
    return immutable(areas), immutable(centres)


def edge_normals(points: np.ndarray, edges: MeshEdges, areas: np.ndarray) -> np.ndarray:
    """Returns the unit normals of the edges, out of the first cell beside: to the right of the way round it, to the left
    where it is clockwise. The centre of gravity says less, for it may be outside."""
    along = points[edges.ends[:, 1]] - points[edges.ends[:, 0]]
    normals = np.column_stack([along[:, 1], -along[:, 0]]) / np.hypot(along[:, 0], along[:, 1])[:, None]
    normals[edges.first_along != (areas[edges.cells[:, 0]] > 0)] *= -1
    return immutable(normals)


def node_markers(mesh: Any) -> np.ndarray:
    """Returns Mesh.node_marker. Where markers meet, the kind that comes first in NODE_TYPES counts, then the first one."""
    markers = np.full(len(mesh.points), -1, dtype=np.int64)
    names = list(mesh.markers)
    for name in sorted(names, key=lambda name: NODE_TYPES.index(mesh.marker_kinds[name]))[::-1]:
        markers[mesh.markers[name].reshape(-1)] = names.index(name)
    return immutable(markers)


def node_types(mesh: Any) -> np.ndarray:
    """Returns Mesh.node_type."""
    kinds = np.array([NODE_TYPES.index(kind) for kind in mesh.marker_kinds.values()] + [0])  # inside there is no marker
    return immutable(kinds[mesh.node_marker])


def node_layers(mesh: Any) -> np.ndarray:
    """Returns Mesh.node_layer."""
    per_cell = mesh.layer.astype(np.int64)
    if len(per_cell) == 0:
        return immutable(per_cell)
    outside = np.iinfo(np.int64).max
    layers = np.full(len(mesh.points), outside)
    for cells, numbers in zip((mesh.triangles, mesh.quads), np.split(per_cell, [len(mesh.triangles)])):
        np.minimum.at(layers, cells[numbers > 0], numbers[numbers > 0, None])
    layers[layers == outside] = 0
    return immutable(layers)


def edge_index(pairs: np.ndarray, both_directions: bool, dtype: Any) -> np.ndarray:
    """Returns pairs of nodes as PyTorch Geometric takes them, (2, E); the second half are the others turned round."""
    try:
        kind = np.dtype(dtype)
    except TypeError:
        kind = None
    if kind not in (np.int64, np.int32):
        raise WrongTypeError(f"dtype must be int64 or int32, not {kind or repr(dtype)}")
    columns = np.ascontiguousarray(pairs.T, dtype=kind)
    return np.concatenate([columns, columns[::-1]], axis=1) if both_directions else columns
