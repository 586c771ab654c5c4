"""The mesh and its check."""

from __future__ import annotations

import copy
import os
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any, Literal, Mapping, NoReturn

import numpy as np

from . import _lamina
from ._arrays import Values, immutable, index_array, points_array, signed
from ._errors import MeshWarning, UsageError
from ._graph import (MeshEdges, areas_and_centres, edge_index, edge_normals, find_edges, node_layers, node_markers,
                     node_types)
from ._sections import Sections

#: The kinds of markers, in the order of the C++ enumeration.
_KINDS = _lamina.marker_kinds


@dataclass(frozen=True, eq=False, repr=False)
class QualitySummary(Values):
    """Statistics of the cells of one region; all numbers are 0 where there are no cells. Angles are in degrees.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> lamina.check(mesh).isotropic.min_angle > 25
    True
    """

    cells: int  #: number of cells
    min_angle: float  #: smallest angle of all cells
    max_angle: float  #: largest angle of all cells
    mean_min_angle: float  #: mean of the smallest angles of the cells
    mean_max_angle: float  #: mean of the largest angles of the cells
    mean_ratio: float  #: mean of the mean ratios; 1 for equilateral triangles and squares
    share_below_40: float  #: share of the cells whose smallest angle is below 40 degrees
    angles_below_bound: int  #: cells whose smallest angle is below the bound of the check
    exempt: int  #: those of them at sharp corners, which no refinement could mend
    max_neighbour_area_ratio: float  #: of areas, over edges between isotropic cells, or those of cells of the layer
    max_neighbour_area_ratio_at: tuple[float, float]  #: the middle of this edge; of the layer alone
    p999_neighbour_area_ratio: float  #: 99.9th percentile of the same
    max_aspect_ratio: float  #: longest edge over the height on it
    angle_histogram: list[int]  #: numbers of smallest angles in [0, 5), [5, 10), ... degrees


@dataclass(frozen=True)
class TransitionSummary:
    """Areas of layer cells over those of the isotropic cells beyond; 1 is ideal.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> 0.3 < lamina.check(mesh).transition.median_area_ratio < 3
    True
    """

    edges: int  #: edges between the two regions
    p01_area_ratio: float  #: 1st percentile
    median_area_ratio: float  #: median
    p99_area_ratio: float  #: 99th percentile
    p90_height_ratio: float  #: height of isotropic cells over that of layer cells at their edges, 90th percentile


@dataclass(frozen=True)
class WallSummary:
    """How evenly the walls are divided, and how high the cells on them are.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> lamina.check(mesh).walls.edges == len(mesh.markers["airfoil"])
    True
    """

    edges: int  #: edges on walls
    max_ratio: float  #: largest ratio of the lengths of neighbouring edges
    max_ratio_at: tuple[float, float]  #: the vertex between the two
    uneven_vertices: int  #: vertices where the ratio exceeds 1.25
    bare_edges: int  #: edges without a cell of the layer, in a mesh with a layer
    first_cells: int  #: edges with a cell of the first layer
    median_first_height: float  #: in units of the input
    share_of_kept_heights: float  #: share of the first heights within 1 % of the height wanted
    worst_first_height: float  #: the height that differs most, over the height wanted
    worst_first_height_at: tuple[float, float]  #: the wall vertex at its edge's start


@dataclass(frozen=True, eq=False, repr=False)
class MeshCheck(Values):
    """The result of `lamina.check()`: whether the mesh is valid, exactly, and how good it is.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> lamina.check(mesh).valid, lamina.check(mesh).defects
    (True, [])
    """

    defects: list[tuple[str, tuple[float, float]]]  #: the first 20, each with a place; empty: the mesh is valid
    defect_count: int  #: number of all defects
    area: float  #: sum of the areas of the cells
    euler_characteristic: int  #: vertices - edges + cells
    boundary_loops: int  #: closed loops of boundary edges
    layer: QualitySummary  #: of the cells of the layer
    isotropic: QualitySummary  #: of the other cells
    transition: TransitionSummary  #: between the two
    walls: WallSummary  #: of all edges of walls
    interior_edges: int  #: edges between two isotropic triangles that are no constraints
    delaunay_violations: int  #: those of them that are not Delaunay (exact)
    edges_without_first_layer: int  #: boundary edges of layer cells that reach beyond the first layer

    @property
    def valid(self) -> bool:
        """Whether the mesh has no defects."""
        return self.defect_count == 0

    @classmethod
    def _from(cls, data: dict[str, Any]) -> MeshCheck:
        parts = {"layer": QualitySummary, "isotropic": QualitySummary, "transition": TransitionSummary,
                 "walls": WallSummary}
        return cls(**{key: parts[key](**value) if key in parts else value for key, value in data.items()})

    def _rows(self) -> list[tuple[str, str]]:
        """Returns what a person wants to know first, as names and texts."""
        rows = [("valid", "yes" if self.valid else f"no: {self.defects[0][0]}")]
        for name, part in (("layer", self.layer), ("isotropic", self.isotropic)):
            if part.cells:
                rows.append((f"{name} cells", f"{part.cells:,}, angles {part.min_angle:.3g} to "
                                              f"{part.max_angle:.4g} degrees"))
        if self.layer.cells:
            rows.append(("median first height", f"{self.walls.median_first_height:.4g}"))
        return rows

    def _repr_html_(self) -> str:
        return _html_table(self._rows())


@dataclass(frozen=True, eq=False, repr=False)
class WallVertices(Values):
    """The vertices of the walls, body by body in the order of the outline, counter-clockwise round each.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> len(mesh.wall) == len(mesh.markers["airfoil"])
    True
    >>> float(mesh.wall.arc_length[0])
    0.0
    """

    vertex: np.ndarray  #: (n,) indices into Mesh.points
    marker: np.ndarray  #: (n,) indices into list(Mesh.markers), of the edge that begins at the vertex
    arc_length: np.ndarray  #: (n,) from the first vertex of the body, in units of the input
    normal: np.ndarray  #: (n, 2) unit vectors into the flow: the bisectors at corners
    first_height: np.ndarray  #: (n,) height of the lowest vertex of the cells beside, in units of the input
    bodies: list[slice] = field(default_factory=list)  #: for each body its part of the arrays

    def __len__(self) -> int:
        return len(self.vertex)


class Mesh:
    """A valid mesh of triangles and quadrilaterals. It never changes: its arrays and mappings are read-only, and nothing
    can be assigned. Its arrays are no copies.

    Vertices of the walls come first, in the order of the input, then those of the layer, then the rest. Arrays per cell
    hold one entry per triangle, followed by one per quadrilateral; they are empty for meshes from files that do not
    hold them.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> mesh.points.shape[1], mesh.triangles.shape[1], sorted(mesh.markers)
    (2, 3, ['airfoil', 'farfield'])
    >>> mesh.marker_kinds["airfoil"]
    'wall'
    >>> mesh.quality().valid
    True
    """

    _data: _lamina.Mesh
    _warnings: tuple[MeshWarning, ...]
    _facts: dict[str, Any]
    _columns: tuple[np.ndarray, np.ndarray]

    def __init__(self) -> None:
        raise TypeError("meshes come from lamina.mesh(), lamina.read() and lamina.mesh_of_arrays()")

    @classmethod
    def _from(cls, data: _lamina.Mesh, warnings: list[MeshWarning] | None = None,
              facts: dict[str, Any] | None = None, columns: tuple[np.ndarray, np.ndarray] | None = None) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._set(data, warnings or [], facts or {},
                  columns or (np.empty(0, dtype=np.uint32), np.empty(0, dtype=np.uint32)))
        return mesh

    def _set(self, data: _lamina.Mesh, warnings: list[MeshWarning], facts: dict[str, Any],
             columns: tuple[np.ndarray, np.ndarray]) -> None:
        self.__dict__.update(_data=data, _warnings=tuple(warnings), _facts=facts,
                             _columns=tuple(immutable(part) for part in columns))

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"a mesh never changes: '{name}' cannot be assigned")

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"a mesh never changes: '{name}' cannot be deleted")

    def __copy__(self) -> Mesh:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Mesh:
        return self

    @cached_property
    def points(self) -> np.ndarray:
        """The vertices: (n, 2) doubles, in units of the input."""
        return self._data.points()

    @cached_property
    def triangles(self) -> np.ndarray:
        """(m, 3) indices into `points`, counter-clockwise."""
        return signed(self._data.triangles())

    @cached_property
    def quads(self) -> np.ndarray:
        """(m, 4) indices into `points`, counter-clockwise."""
        return signed(self._data.quads())

    @cached_property
    def _markers(self) -> list[tuple[str, int, np.ndarray]]:
        return [(name, kind, signed(edges)) for name, kind, edges in self._data.markers()]

    @cached_property
    def markers(self) -> Mapping[str, np.ndarray]:
        """The edges of each marker by its name: (k, 2) indices into `points`, with the mesh on the left of each edge.
        Together they are all edges of the boundary."""
        return MappingProxyType({name: edges for name, _, edges in self._markers})

    @cached_property
    def marker_kinds(self) -> Mapping[str, str]:
        """The kind of each marker by its name: "wall", "far_field", "symmetry", "other", "periodic" or "internal"."""
        return MappingProxyType({name: _KINDS[kind] for name, kind, _ in self._markers})

    @cached_property
    def _curved(self) -> tuple[int, np.ndarray, np.ndarray, np.ndarray, np.ndarray, bool]:
        order, places, triangles, quads, edges, is_lobatto = self._data.curved_nodes()
        return order, places, signed(triangles), signed(quads), signed(edges), is_lobatto

    @property
    def order(self) -> int:
        """The order of the cells: 1 where they are straight, else 2 to 4."""
        return self._curved[0]

    @property
    def node_distribution(self) -> str:
        """Where the nodes of curved cells are on straight ones: "equidistant" or "gauss-lobatto"."""
        return "gauss-lobatto" if self._curved[5] else "equidistant"

    @cached_property
    def nodes(self) -> np.ndarray:
        """(n + k, 2) the nodes of all cells: `points`, then those of curved cells beside their corners."""
        return immutable(np.concatenate([self.points, self._curved[1]]))

    @staticmethod
    def _nodes_of(corners: np.ndarray, beside: np.ndarray, nodes: int) -> np.ndarray:
        return immutable(np.hstack([corners, beside.reshape(len(corners), nodes - corners.shape[1])]))

    @cached_property
    def cell_nodes(self) -> Mapping[str, np.ndarray]:
        """The nodes of "triangles" and "quads", (m, (p + 1) (p + 2) / 2) and (m, (p + 1)^2) indices into `nodes` at the
        order p: corners, then the nodes within each edge, from each corner to the next, then those inside, which are
        ordered as the nodes of a smaller cell. It is the order of Gmsh:

            order 2     order 3          order 4                order 3
            2           2                2                      3--9--8--2
            | .         | .              | .                    |        |
            5  4        7  6             9  8                   10 15 14 7
            |    .      |    .           |    .                 |        |
            0--3--1     8  9  5          10 14  7               11 12 13 6
                        |       .        |        .             |        |
                        0--3--4--1       11 12 13  6            0--4--5--1
                                         |           .
                                         0--3--4--5---1
        """
        _, _, triangle_nodes, quad_nodes, _, _ = self._curved
        along = self.order + 1  # nodes along an edge
        return MappingProxyType({"triangles": self._nodes_of(self.triangles, triangle_nodes, along * (along + 1) // 2),
                                 "quads": self._nodes_of(self.quads, quad_nodes, along**2)})

    @cached_property
    def marker_nodes(self) -> Mapping[str, np.ndarray]:
        """The nodes of the edges of each marker by its name: (k, order + 1) indices into `nodes`, the two ends and those
        between from the first to the second."""
        ends = [len(edges) * (self.order - 1) for edges in self.markers.values()]
        parts = np.split(self._curved[4], np.cumsum(ends)[:-1]) if ends else []
        return MappingProxyType({name: self._nodes_of(edges, part, self.order + 1)
                                 for (name, edges), part in zip(self.markers.items(), parts)})

    @cached_property
    def region(self) -> np.ndarray:
        """Per cell: 0 in the layer, 1 in the isotropic region."""
        return self._data.region()

    @cached_property
    def layer(self) -> np.ndarray:
        """Per cell: the number of its layer from the wall, from 1; 0 outside the layer."""
        return self._data.layer()

    @cached_property
    def column(self) -> np.ndarray:
        """Per cell: the column of the layer that it is part of, an index into `column_origin`; -1 for other cells.

        Columns stand between neighbouring rays, in the order of the outline. Cells behind bases are part of none.
        Empty for meshes from files, without layers, and with layer_topology="delaunay"."""
        of_layer = self._columns[0].astype(np.int64)
        if len(of_layer) == 0:
            return of_layer
        of_layer[of_layer == 2**32 - 1] = -1
        triangles = len(of_layer) - len(self.quads)
        column = np.full(len(self), -1)
        column[:triangles] = of_layer[:triangles]
        column[len(self.triangles):] = of_layer[triangles:]
        return immutable(column)

    @property
    def column_origin(self) -> np.ndarray:
        """Per column: the vertex that its first ray begins at, on a wall or on a wake; several at a fan of rays."""
        return signed(self._columns[1])

    @cached_property
    def piece(self) -> np.ndarray:
        """Per cell: the subdomain that made it."""
        return signed(self._data.piece())

    @cached_property
    def constraints(self) -> np.ndarray:
        """Interior edges that the triangulation was constrained to: the outer borders of the layer. (k, 2) indices."""
        return signed(self._data.constraints())

    @cached_property
    def wall_distance(self) -> np.ndarray:
        """Per point: the distance to the nearest edge of a wall, in units of the input. Computed on demand."""
        return self._data.wall_distances()

    @cached_property
    def _edges(self) -> MeshEdges:
        return find_edges(self.triangles, self.quads)

    @property
    def edges(self) -> np.ndarray:
        """(e, 2) the edges of all cells, each once, with the smaller index first; sorted. 64-bit, as all below."""
        return self._edges.ends

    @property
    def edge_cells(self) -> np.ndarray:
        """(e, 2) the cells beside each edge, the smaller index first; -1 in place of the second on the boundary."""
        return self._edges.cells

    @property
    def neighbours(self) -> np.ndarray:
        """(cells, 3), or (cells, 4) with quads: the cell across the edge from corner i to the next one; -1: none."""
        return self._edges.neighbours

    @cached_property
    def _areas_and_centres(self) -> tuple[np.ndarray, np.ndarray]:
        return areas_and_centres(self.points, self.triangles, self.quads)

    @property
    def areas(self) -> np.ndarray:
        """(cells,) signed areas, in units of the input: those of clockwise cells, which no valid mesh has, are negative."""
        return self._areas_and_centres[0]

    @property
    def cell_centres(self) -> np.ndarray:
        """(cells, 2) centres of gravity."""
        return self._areas_and_centres[1]

    @cached_property
    def edge_normals(self) -> np.ndarray:
        """(e, 2) unit normals of `edges`, out of the first of `edge_cells`: out of the mesh on the boundary."""
        return edge_normals(self.points, self._edges, self.areas)

    @cached_property
    def node_type(self) -> np.ndarray:
        """(n,) for each point an index into `lamina.NODE_TYPES`: 0 inside, 1 on a wall, 2 on the far field, and so on.
        Where markers meet, the smaller number counts."""
        return node_types(self)

    @cached_property
    def node_marker(self) -> np.ndarray:
        """(n,) for each point an index into `list(markers)`, which tells bodies apart; -1 inside. Where markers meet, the
        one of the smaller `node_type` counts, and of several the first."""
        return node_markers(self)

    @cached_property
    def node_layer(self) -> np.ndarray:
        """(n,) for each point the smallest `layer` of the cells of the layer beside; 0 where there are none. Empty where
        `layer` is."""
        return node_layers(self)

    def edge_index(self, *, both_directions: bool = False, of: Literal["points", "cells"] = "points",
                   dtype: Any = np.int64) -> np.ndarray:
        """Returns the edges as PyTorch Geometric takes them: (2, E), int64 or int32.

        of: the nodes of the graph are the points, or the cells, which are joined across edges. both_directions: each
        edge comes a second time turned round, in the second half.
        """
        if of not in ("points", "cells"):
            raise UsageError(f"of: must be 'points' or 'cells', not {of!r}")
        pairs = self.edges if of == "points" else self.edge_cells[self.edge_cells[:, 1] >= 0]
        return edge_index(pairs, both_directions, dtype)

    @property
    def wall(self) -> WallVertices:
        """The vertices of the walls in order, with arc length, normal and first height. Computed on demand."""
        return replace(self._wall, bodies=list(self._wall.bodies))

    @cached_property
    def _wall(self) -> WallVertices:
        vertex, marker, arc_length, normal, first_height, first = self._data.walls()
        bodies = [slice(a, b) for a, b in zip(first[:-1], first[1:])]
        return WallVertices(signed(vertex), signed(marker), arc_length, normal, first_height, bodies)

    @cached_property
    def hash(self) -> str:
        """32 hexadecimal digits that depend on the cells and markers, and not on their numbering: that of the report
        of the program."""
        return self._data.hash()

    @property
    def warnings(self) -> list[MeshWarning]:
        """What the user should know about the mesh; empty: nothing."""
        return list(self._warnings)

    @property
    def facts(self) -> dict[str, Any]:
        """What the run that made the mesh says beside it: chord, Reynolds number, elements, first heights, estimate,
        seconds. Empty for a mesh from a file."""
        return copy.deepcopy(self._facts)

    def quality(self, *, min_angle: float | None = None, first_height: float | None = None) -> MeshCheck:
        """Checks the mesh exactly and measures its quality: `lamina.check(mesh)`."""
        bound = _lamina.proved_min_angle if min_angle is None else min_angle
        return MeshCheck._from(self._data.check(bound, first_height))

    def morph(self, to: Sections | None = None, *, transform: str | Sequence[str] = (), displacements: Any = None,
              as_far_as_possible: bool = False, incremental: bool = False, reconnect: bool = False) -> Mesh:
        """Returns the same cells round other shapes of the bodies; the outer boundary stays.

        One of these says where the walls go: `to`, sections in the order of the bodies, whose arc lengths between corners
        are divided as those of the mesh; `transform`, changes as those of `lamina.mesh()`, such as
        "flap:rotate:-5:0.8,0"; `displacements`, (n, 2) in the order of `wall.vertex`. `facts` of the result compare both
        meshes. Raises InputError, and MeshError where a cell would turn over on the way, unless `as_far_as_possible`;
        `incremental` goes on in further steps there. `reconnect` then swaps diagonals and moves vertices beyond the layer,
        where this makes triangles better: the cells are no longer the same.
        `lamina.MorphMap` keeps the factors for many shapes, and has the derivative.
        """
        from ._morph import morph

        return morph(self, to, transform, displacements, as_far_as_possible, incremental, reconnect)

    def write(self, path: str | os.PathLike[str], *, format: str = "", wall_distance: bool = False, span: float = 0,
              span_cells: int = 1, span_ends: Literal["symmetry", "periodic"] = "symmetry") -> None:
        """Writes the mesh to a file.

        The extension of the file says its format, unless `format` names one of `lamina.formats()`. `wall_distance`
        adds the distance to the nearest wall as point data, in VTU files. With a `span`, a depth in units of the mesh, it
        becomes one of prisms and hexahedra in space, `span_cells` deep, between planes of symmetry or periodic ones
        (`span_ends`). Raises IoError, UsageError for unknown formats and those that take no span, MeshError for a mesh
        that the format cannot hold. A failure leaves nothing half-written. Names of markers that not every format takes
        are changed in the file, with a MeshWarning: "0012" to "wall_0012".
        """
        if span_ends not in ("symmetry", "periodic"):
            raise UsageError(f"span_ends: must be 'symmetry' or 'periodic', not {span_ends!r}")
        for warning in self._data.write(os.fspath(path), format, wall_distance, span, span_cells,
                                        span_ends == "periodic"):
            warnings.warn(MeshWarning._from(warning), stacklevel=2)

    def write_wall_data(self, path: str | os.PathLike[str]) -> None:
        """Writes the table of `wall` as CSV, as `lamina mesh --wall-data` does."""
        self._data.write_wall_data(os.fspath(path))

    def plot(self, ax: Any = None, *, window: tuple[float, float, float, float] | None = None, color: str = "none",
             **style: Any) -> Any:
        """Draws the mesh with matplotlib and returns the axes.

        `window` is (x0, x1, y0, y1) in units of the input, and else the bodies and some space round them. `color` says
        what the colours of the cells show: "none", "quality" (smallest angle), "size" (square root of the area),
        "piece" or "layer". Further arguments go to the collection of the edges, such as `linewidth`.
        """
        from ._picture import draw_mesh

        return draw_mesh(self, ax, window, color, style)

    def view(self, *, title: str = "mesh", height: int = 600) -> Any:
        """Returns a page to zoom into the mesh, which a notebook shows in a frame: `lamina.view(mesh)`."""
        from ._commands import view

        return view(self, title=title, height=height)

    def to_meshio(self) -> Any:
        """Returns the mesh as a `meshio.Mesh`: cells, one block of lines and one set for each marker; data `layer` and
        `region` of the cells, `wall_distance`, `node_type`, `node_marker` and `node_layer` of the points. Needs meshio."""
        from ._export import to_meshio

        return to_meshio(self)

    def to_pyvista(self) -> Any:
        """Returns the mesh as a `pyvista.UnstructuredGrid` with the data of `to_meshio()`; its field data
        "marker NAME" hold the edges of each marker. Needs pyvista."""
        from ._export import to_pyvista

        return to_pyvista(self)

    def to_pyg(self) -> Any:
        """Returns the mesh as a `torch_geometric.data.Data`: `pos`, `edge_index` in both directions, `edge_attr` (step
        in x and y, length), the data of the points of `to_meshio()`; `face` where all cells are triangles. Needs PyTorch
        Geometric."""
        from ._export import to_pyg

        return to_pyg(self)

    def to_networkx(self) -> Any:
        """Returns the points and edges as a `networkx.Graph`: nodes with `pos` and the data of the points of `to_meshio()`,
        edges with `length`. Needs networkx."""
        from ._export import to_networkx

        return to_networkx(self)

    def to_xarray(self) -> Any:
        """Returns the mesh as an `xarray.Dataset` by the UGRID conventions, which netCDF files keep. Needs xarray."""
        from ._export import to_xarray

        return to_xarray(self)

    def to_row(self) -> dict[str, Any]:
        """Returns the mesh as flat columns, one row of a data set: `pyarrow.Table.from_pylist([mesh.to_row()])` makes
        a table, which Parquet files hold."""
        from ._export import to_row

        return to_row(self)

    def __len__(self) -> int:
        return len(self.triangles) + len(self.quads)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mesh) or self.hash != other.hash or self._curved[0::5] != other._curved[0::5]:
            return False
        # The hash knows corners alone. Nodes, as cells, may be numbered otherwise.
        return self.order == 1 or np.array_equal(np.unique(self.nodes, axis=0), np.unique(other.nodes, axis=0))

    def __hash__(self) -> int:
        return hash(self.hash)

    def __repr__(self) -> str:
        walls = [name for name, kind in self.marker_kinds.items() if kind == "wall"]
        return (f"<lamina.Mesh round {', '.join(walls) or 'nothing'}: {len(self.points):,} points, "
                f"{len(self.triangles):,} triangles, {len(self.quads):,} quadrilaterals>")

    def _repr_html_(self) -> str:
        from ._picture import picture_html

        rows = [("points", f"{len(self.points):,}"), ("triangles", f"{len(self.triangles):,}"),
                ("quadrilaterals", f"{len(self.quads):,}"),
                ("markers", ", ".join(f"{name} ({len(edges):,})" for name, edges in self.markers.items()))]
        rows += self.quality()._rows()
        rows += [("warning", str(warning)) for warning in self._warnings]
        return f"<div>{picture_html(self)}{_html_table(rows)}</div>"

    def __getstate__(self) -> dict[str, Any]:
        arrays: dict[str, Any] = {
            name: np.array(getattr(self, name))
            for name in ("points", "triangles", "quads", "region", "piece", "layer", "constraints")}
        arrays["markers"] = [(name, kind, np.array(edges)) for name, kind, edges in self._markers]
        curved = (*(np.array(part) for part in self._data.curved_nodes()[1:5]), self._curved[5]) if self.order > 1 else ()
        return {"arrays": arrays, "order": self.order, "curved": curved, "warnings": list(self._warnings),
                "facts": self._facts, "columns": tuple(np.array(part) for part in self._columns)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        data = _data_of_arrays(**state["arrays"])
        if state["curved"]:
            data = data.with_curved_nodes(state["order"], *state["curved"])
        self._set(data, state["warnings"], state["facts"], state["columns"])


def _data_of_arrays(points: Any, triangles: Any, quads: Any, markers: Any, region: Any, piece: Any, layer: Any,
                    constraints: Any) -> _lamina.Mesh:
    def per_cell(values: Any, dtype: type[np.generic], name: str) -> np.ndarray:
        return np.ascontiguousarray(index_array(values, 1, name), dtype=dtype)

    return _lamina.mesh_of_arrays(
        points_array(points), index_array(triangles, 3, "triangles"), index_array(quads, 4, "quads"),
        [(name, kind, index_array(edges, 2, "markers")) for name, kind, edges in markers],
        (per_cell(region, np.uint8, "region"), per_cell(piece, np.uint32, "piece"),
         per_cell(layer, np.uint16, "layer")),
        index_array(constraints, 2, "constraints"))


def mesh_of_arrays(points: Any, triangles: Any, markers: Mapping[str, Any], *, quads: Any = (),
                   marker_kinds: Mapping[str, str] | None = None) -> Mesh:
    """Returns a mesh of arrays, such as one that another mesher made.

    points: (n, 2) coordinates. triangles: (m, 3), quads: (k, 4) indices into them, counter-clockwise. markers: for each
    name (l, 2) indices, with the mesh on the left of each edge. marker_kinds: "wall" (where nothing is said),
    "far_field", "symmetry", "other", "periodic" or "internal". `lamina.check()` says whether the mesh is valid.

    Examples
    --------
    >>> mesh = lamina.mesh_of_arrays([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]], {"side": [[0, 1], [1, 2], [2, 0]]})
    >>> lamina.check(mesh).valid
    True
    """
    kinds = dict(marker_kinds or {})
    named = [(name, _KINDS.index(kinds.get(name, "wall")), edges) for name, edges in markers.items()]
    return Mesh._from(_data_of_arrays(points, triangles, quads, named, (), (), (), ()))


def read(path: str | os.PathLike[str], *, format: str = "") -> Mesh:
    """Reads a mesh from a file. The extension says its format, unless `format` names one of `lamina.formats()`.

    Raises IoError where the file cannot be read, InputError where it is malformed, UsageError for unknown formats.

    Examples
    --------
    >>> lamina.mesh("naca:0012", first_height=1e-3).write("mesh.msh")
    >>> sorted(lamina.read("mesh.msh").markers)
    ['airfoil', 'farfield']
    """
    return Mesh._from(_lamina.read(os.fspath(path), format))


def write(mesh: Mesh, path: str | os.PathLike[str], **options: Any) -> None:
    """Writes a mesh to a file: `mesh.write(path, **options)`.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> lamina.write(mesh, "mesh.vtu", wall_distance=True)
    """
    mesh.write(path, **options)


def check(mesh: Mesh, *, min_angle: float | None = None, first_height: float | None = None) -> MeshCheck:
    """Checks a mesh exactly and measures its quality.

    A mesh is valid if its cells are counter-clockwise, conform, and cover its domain once, and if the markers are its
    boundary. Each curved cell must be proved valid, too. `min_angle`, in degrees, is the bound of
    `QualitySummary.angles_below_bound`; `first_height`, in units of the input, the height that first cells should have,
    else their median on each marker.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> lamina.check(mesh, first_height=1e-3).valid
    True
    """
    return mesh.quality(min_angle=min_angle, first_height=first_height)


def formats() -> list[str]:
    """Returns the names of the formats that meshes are written in.

    Examples
    --------
    >>> "su2" in lamina.formats()
    True
    """
    return _lamina.format_names()


def _html_table(rows: list[tuple[str, str]]) -> str:
    from html import escape

    cells = "".join(f"<tr><th style='text-align:left'>{escape(name)}</th><td style='text-align:left'>{escape(text)}"
                    "</td></tr>" for name, text in rows)
    return f"<table>{cells}</table>"
