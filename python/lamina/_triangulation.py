"""Delaunay triangulation, constrained triangulation and refinement; they know no airfoils (docs/library.md)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import _lamina
from ._arrays import index_array, points_array
from ._errors import InputError, OptionError


@dataclass(frozen=True)
class Triangulation:
    """A triangulation of points. Indices refer to `points`: those handed in, followed by Steiner points."""

    points: np.ndarray  #: (n, 2) coordinates
    triangles: np.ndarray  #: (m, 3), counter-clockwise
    segments: np.ndarray  #: (k, 2) edges that are parts of segments, in their direction; of a plain one: none
    parents: np.ndarray  #: (k,) for each of them the index of the segment that it is a part of
    given_points: int  #: number of the points handed in
    stats: dict[str, int] = field(default_factory=dict)  #: of a refinement: what could not be refined as asked

    def plot(self, ax=None, **style):
        """Draws the triangles with matplotlib and returns the axes."""
        from ._picture import draw_triangles

        return draw_triangles(self, ax, style)


def delaunay(points) -> Triangulation:
    """Returns the Delaunay triangulation of distinct points.

    points: (n, 2) coordinates, zero or of a magnitude between 1e-60 and 1e60. All decisions are exact, and one rule
    decides between cocircular points, so the set of triangles does not depend on the order of the points. Uses all
    cores from 50,000 points on. Raises InputError for points that appear twice (`error.points` holds their indices).
    """
    array = points_array(points)
    return Triangulation(array, _lamina.delaunay(array), index_array((), 2, ""), index_array((), 1, ""), len(array))


def constrained_delaunay(points, segments, *, keep: str = "convex_hull", crossings: str = "refuse",
                         holes=()) -> Triangulation:
    """Returns the constrained Delaunay triangulation of points and segments.

    segments: (k, 2) indices into `points`; they may overlap, repeat and run through points. keep: which triangles stay:
    those of the "convex_hull", "inside_segments" (not reached from outside), or "left_of_segments" (outer loops
    counter-clockwise, holes clockwise). crossings: "refuse" raises InputError where segments cross (`error.segments`),
    "insert" adds a Steiner point there. holes: (h, 2) coordinates, one point in each hole.
    """
    array = points_array(points)
    steiner, triangles, edges, parents = _lamina.constrained_delaunay(
        array, index_array(segments, 2, "segments"), keep, crossings, points_array(holes, "holes"))
    return Triangulation(_joined(array, steiner), triangles, edges, parents, len(array))


def refine(triangulation: Triangulation, size, *, gradation: float = 0.1, min_angle: float | None = None,
           split_segments: bool = True, smoothing: int = 2, max_triangles: int | None = None) -> Triangulation:
    """Refines a triangulation to sizes and angles. Segments and the boundary are split where that needs it.

    size: the edge length that is wanted, in units of the input. A number; an array with one size for each point of the
    triangulation; a background (points, triangles, sizes) whose sizes are linear in its triangles; or a function of an
    (n, 2) array of points that returns n sizes. A function is sampled on squares that are divided until they are four
    edges wide, which is slow: a sample costs more than a triangle.
    gradation: growth of the edge length per unit of distance from places that ask for less.
    min_angle: smallest angle of a triangle, in degrees, up to 33; None: 20.7, up to which the end is proved. Corners of
    the input below 60 degrees may hold smaller ones (`stats["exempt"]`).
    split_segments: if False, triangles beside long segments may stay beyond the bounds.
    smoothing: how often all vertices move to the means of their neighbours.
    max_triangles: a refinement that needs more, by estimate, raises LimitError before the work.
    """
    t = triangulation
    size_argument = _size_argument(t, size, gradation)
    bound = _lamina.proved_min_angle if min_angle is None else min_angle
    steiner, triangles, edges, parents, stats = _lamina.refine(
        t.points, t.triangles, t.segments, t.parents, size_argument, float(gradation), float(bound), split_segments,
        smoothing, max_triangles)
    return Triangulation(_joined(t.points, steiner), triangles, edges, parents, t.given_points, stats)


def _joined(points: np.ndarray, steiner: np.ndarray) -> np.ndarray:
    return np.concatenate([points, steiner]) if len(steiner) else points


def _sizes_array(sizes: Any, count: int) -> np.ndarray:
    array = np.ascontiguousarray(sizes, dtype=np.float64)
    if array.shape != (count,):
        raise InputError(f"sizes must have the shape ({count},), one for each point, not {array.shape}")
    if not np.all(np.isfinite(array) & (array > 0)):
        raise InputError("sizes must be positive numbers")
    return array


def _size_argument(t: Triangulation, size: Any, gradation: float):
    if callable(size):
        return _sampled(size, t.points)
    if isinstance(size, tuple):
        points, triangles, sizes = size
        background = points_array(points, "background points")
        return background, index_array(triangles, 3, "background triangles"), _sizes_array(sizes, len(background))
    if np.ndim(size) == 0:
        return float(size)
    return t.points, t.triangles, _sizes_array(size, len(t.points))


#: A square is divided while its side exceeds this many edges.
_EDGES_PER_SQUARE = 4.0
_MAX_SAMPLES = 20_000_000


def _sampled(function: Callable[[np.ndarray], Any], points: np.ndarray):
    """Returns a background that samples the function on a quadtree over the box round the points."""

    def sizes_at(places: np.ndarray) -> np.ndarray:
        return _sizes_array(function(places), len(places))

    lower, upper = points.min(axis=0), points.max(axis=0)
    side = float((upper - lower).max())
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5]])
    squares = lower[None, :]
    samples: list[np.ndarray] = []
    values: list[np.ndarray] = []
    while len(squares):
        places = (squares[:, None, :] + side * corners[None, :, :]).reshape(-1, 2)
        sizes = sizes_at(places)
        samples.append(places)
        values.append(sizes)
        if sum(map(len, samples)) > _MAX_SAMPLES:
            raise OptionError(f"size: the function needs more than {_MAX_SAMPLES:,} samples")
        coarse = squares[sizes.reshape(-1, 5).min(axis=1) * _EDGES_PER_SQUARE < side]
        side *= 0.5
        squares = (coarse[:, None, :] + side * corners[None, :4, :]).reshape(-1, 2)
    places, first = np.unique(np.concatenate(samples), axis=0, return_index=True)
    return places, _lamina.delaunay(places), np.ascontiguousarray(np.concatenate(values)[first])
