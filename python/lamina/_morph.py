"""Meshes moved to other shapes of their bodies, with the same cells, and the derivative of the places of the vertices."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from . import _lamina
from ._arrays import points_array, signed
from ._errors import InputError, MeshError, UsageError
from ._mesh import Mesh
from ._sections import Sections, section_list


class MorphMap:
    """The map from places of the wall vertices to those of all vertices of a mesh, factored once.

    Layers move as rigid bodies with their walls, and the rest smoothly; the outer boundary stays. Arrays of
    wall points are (n, 2) coordinates in the order of `wall`, in units of the input. Raises MeshError for a mesh that is
    not valid.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> moving = lamina.MorphMap(mesh)
    >>> moved = moving.morph(mesh.points[moving.wall] + [0, 0.01])
    >>> moved.quality().valid
    True
    """

    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh  #: that it is made for
        self._map = _lamina.MorphMap(mesh._data)
        self.wall = signed(self._map.wall())  #: (n,) indices of the wall vertices into Mesh.points
        self.wall_points = self._map.wall_points()  #: (n, 2) where they are in the mesh

    def __len__(self) -> int:
        return len(self.wall)

    def __repr__(self) -> str:
        return f"<lamina.MorphMap of {len(self.wall):,} wall vertices of {self.mesh!r}>"

    def walls_on(self, shape: Sections) -> np.ndarray:
        """Returns the wall points on other shapes, one per body in the order of the mesh: files, names or arrays.

        Vertices keep their shares of the arc length between corners. Raises InputError for another number of bodies, and
        where sharp corners, above 60 degrees, appear or vanish.
        """
        return self._map.walls_on(section_list(shape)[0])

    def walls_moved(self, *changes: str) -> np.ndarray:
        """Returns the wall points with bodies changed, as `transform` of `lamina.mesh()` does: "flap:rotate:-5:0.8,0"."""
        return self._map.walls_moved(list(changes))

    def morph(self, wall: Any, *, as_far_as_possible: bool = False, incremental: bool = False,
              reconnect: bool = False) -> Mesh:
        """Returns the mesh with its wall vertices at these points.

        Raises MeshError, which names the cell, where a cell would turn over on the way; with `as_far_as_possible` the
        mesh goes as far as it can, and `facts["fraction"]` says how far. With `incremental` the motion goes on from a mesh
        half as far, by a map of that mesh. `reconnect` then swaps diagonals and moves vertices beyond the layer, where this
        makes triangles better: vertices keep their numbers, and `piece` of the result is empty. With it, or with more than
        one of `facts["maps"]`, the derivative is not that of the result.
        """
        data, fraction, maps, stopped_by = self._map.morph(points_array(wall, "wall"), as_far_as_possible, incremental,
                                                           reconnect)
        facts = {"fraction": fraction, "maps": maps, **({"stopped_by": stopped_by} if stopped_by else {}),
                 **self._map.compare(data)}
        return Mesh._from(data, facts=facts, columns=self.mesh._columns)

    def morph_all(self, walls: Iterable[Any]) -> tuple[np.ndarray, list[str]]:
        """Returns the points of many shapes, (shapes, vertices, 2), and for each its error, which is empty where there is
        none. The points of shapes that cannot be reached are NaN."""
        points, errors = [], []
        for wall in walls:
            try:
                points.append(self._map.morph(points_array(wall, "wall"), False, False, False)[0].points())
                errors.append("")
            except MeshError as error:
                points.append(np.full_like(self.mesh.points, np.nan))
                errors.append(str(error))
        return np.array(points).reshape(-1, *self.mesh.points.shape), errors

    def positions(self, wall: Any) -> np.ndarray:
        """Returns the places of all vertices, (vertices, 2), whether cells turn over or not."""
        return self._map.positions(points_array(wall, "wall"))

    def jacobian_vector(self, wall: Any, direction: Any) -> np.ndarray:
        """Returns the derivative of `positions(wall)` in a direction of the wall points, (vertices, 2)."""
        return self._map.jacobian_vector(points_array(wall, "wall"), points_array(direction, "direction"))

    def vector_jacobian(self, wall: Any, gradient: Any) -> np.ndarray:
        """Returns the gradient by the wall points, (n, 2), of a function whose gradient by all vertices is given."""
        return self._map.vector_jacobian(points_array(wall, "wall"), points_array(gradient, "gradient"))


def morph(mesh: Mesh, to: Sections | None, transform: str | Sequence[str], displacements: Any,
          as_far_as_possible: bool, incremental: bool, reconnect: bool) -> Mesh:
    """Does what Mesh.morph() says."""
    changes = [transform] if isinstance(transform, str) else list(transform)
    if (to is not None) + bool(changes) + (displacements is not None) != 1:
        raise UsageError("give one of to, transform and displacements")
    moving = MorphMap(mesh)
    if to is not None:
        wall = moving.walls_on(to)
    elif changes:
        wall = moving.walls_moved(*changes)
    else:
        by = points_array(displacements, "displacements")
        if by.shape != moving.wall_points.shape:
            raise InputError(f"{len(by)} displacements for the {len(moving.wall)} wall vertices of the mesh")
        wall = moving.wall_points + by
    return moving.morph(wall, as_far_as_possible=as_far_as_possible, incremental=incremental, reconnect=reconnect)
