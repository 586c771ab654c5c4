"""Triangulations that change."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _lamina
from ._arrays import index_array, points_array, signed
from ._triangulation import Triangulation


class DynamicTriangulation:
    """A constrained Delaunay triangulation of a convex hull to which points and segments are added and taken away.

    After each change it is the triangulation that constrained_delaunay() makes of the points and segments it has then.
    Points keep their numbers; those of removed points are not used again. Calls on several threads must not overlap.

    Examples
    --------
    >>> dynamic = lamina.DynamicTriangulation([[0, 0], [1, 0], [0, 1]])
    >>> dynamic.insert([[1, 1]]).tolist()
    [3]
    >>> len(dynamic.triangulation())
    2
    """

    def __init__(self, points: Any = (), segments: Any = ()) -> None:
        """Makes the triangulation of points and segments between them."""
        self._data = _lamina.DynamicTriangulation()
        if len(points):
            self.insert(points)
        for a, b in index_array(segments, 2, "segments").tolist():
            self.insert_segment(a, b)

    def insert(self, points: Any) -> np.ndarray:
        """Inserts points, an (n, 2) array, and returns their numbers.

        A point that lies where there is one already gets the number of that one. Batches are quicker than single points.
        """
        array = points_array(points)
        numbers = signed(np.array(self._data.insert(array)))
        for i in np.flatnonzero([n not in self for n in numbers.tolist()]):
            numbers[i] = self.find(array[i])
        return numbers

    def remove(self, numbers: Any) -> None:
        """Removes points by their numbers. Ends of segments have to lose these before; InputError names one."""
        self._data.remove(index_array(np.atleast_1d(numbers), 1, "numbers"))

    def insert_segment(self, a: int, b: int) -> np.ndarray:
        """Inserts the segment from point a to point b and returns its edges, (k, 2): points on it cut it.

        Raises InputError where it crosses another one (`error.points` holds the ends of both).
        """
        return signed(self._data.insert_segment(a, b))

    def remove_segment(self, a: int, b: int) -> None:
        """Removes all edges of segments on the straight way from point a to point b."""
        self._data.remove_segment(a, b)

    def find(self, point: Any) -> int | None:
        """Returns the number of the point at this place, if there is one."""
        return self._data.find(float(point[0]), float(point[1]))

    @property
    def points(self) -> np.ndarray:
        """(n, 2) coordinates of all points by their numbers, removed ones included."""
        return self._data.points()

    @property
    def triangles(self) -> np.ndarray:
        """(m, 3), counter-clockwise, in no particular order."""
        return signed(self._data.triangles())

    @property
    def segments(self) -> np.ndarray:
        """(k, 2) edges of segments, each once with the smaller number first, sorted."""
        return signed(self._data.segments())

    def triangulation(self) -> Triangulation:
        """Returns the present state. Removed points are among its points, but in no triangle."""
        segments = self.segments
        return Triangulation(self.points, self.triangles, segments, np.arange(len(segments), dtype=np.int32),
                             len(self.points))

    def __len__(self) -> int:
        """Returns the number of points that were not removed."""
        return self._data.size()

    def __contains__(self, number: int) -> bool:
        """Returns whether this is the number of a point that was not removed."""
        return 0 <= number < 2**32 and self._data.contains(number)

    def __bool__(self) -> bool:
        return True  # also without points

    def __repr__(self) -> str:
        return (f"<lamina.DynamicTriangulation: {len(self):,} points, {len(self.triangles):,} triangles, "
                f"{len(self.segments):,} edges of segments>")
