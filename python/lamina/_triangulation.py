"""Delaunay triangulation, constrained triangulation and refinement; they know no airfoils (docs/library.md)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _lamina
from ._arrays import (Values, doubles, immutable, index_array, points_array, queries_array, signed,
                      unsigned)
from ._errors import InputError, OptionError, UsageError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True, eq=False, repr=False)
class IndexLists(Values, Sequence[np.ndarray]):
    """Lists of different lengths in one array: list i is `items[starts[i]:starts[i + 1]]`.

    Examples
    --------
    >>> made = lamina.delaunay([[0, 0], [1, 0], [1, 1], [0, 1]])
    >>> lists = made.half_edges_at_points
    >>> len(lists), len(lists[0])
    (4, 2)
    """

    starts: np.ndarray  #: (n + 1,) where the lists begin, and the end of the last one
    items: np.ndarray  #: those of all lists

    def __post_init__(self) -> None:
        object.__setattr__(self, "starts", signed(self.starts))
        object.__setattr__(self, "items", signed(self.items))

    def __len__(self) -> int:
        return len(self.starts) - 1

    def __getitem__(self, i: Any) -> Any:
        if isinstance(i, slice):
            return [self[k] for k in range(*i.indices(len(self)))]
        if not -len(self) <= i < len(self):
            raise IndexError(i)
        i %= len(self)
        return self.items[self.starts[i]:self.starts[i + 1]]


@dataclass(frozen=True, eq=False, repr=False)
class VoronoiDiagram(Values):
    """A Voronoi diagram. Corners have the indices of the triangles whose centres they are.

    Examples
    --------
    >>> diagram = lamina.delaunay([[0, 0], [2, 0], [1, 2]]).voronoi()
    >>> diagram.corners.tolist()
    [[1.0, 0.75]]
    """

    corners: np.ndarray  #: (m, 2)
    cells: IndexLists  #: for each point the corners of its cell, counter-clockwise; those of points on the hull are open
    rays: np.ndarray  #: (h, 3) the two points of each hull edge, and the triangle from whose centre the ray starts
    directions: np.ndarray  #: (h, 2) the directions of the rays


_NO_REGIONS = np.empty(0, dtype=np.int32)


@dataclass(frozen=True, eq=False, repr=False)
class Triangulation:
    """A triangulation of points. Indices refer to `points`: those handed in, followed by Steiner points.

    It never changes: its arrays are its own, and cannot be written to. It can be pickled. Two are equal if their arrays
    of points, triangles and segments are.

    Examples
    --------
    >>> made = lamina.delaunay([[0, 0], [1, 0], [1, 1], [0, 1]])
    >>> made
    <lamina.Triangulation: 4 points, 2 triangles, 0 edges of segments>
    >>> made.triangles.tolist()
    [[0, 2, 3], [1, 2, 0]]
    """

    points: np.ndarray  #: (n, 2) coordinates
    triangles: np.ndarray  #: (m, 3), counter-clockwise
    segments: np.ndarray  #: (k, 2) edges that are parts of segments, in their direction; of a plain one: none
    parents: np.ndarray  #: (k,) for each of them the index of the segment that it is a part of
    given_points: int  #: number of the points handed in
    stats: Mapping[str, int] = field(default_factory=dict)  #: of a refinement: what could not be refined as asked
    #: (given_points,) for each point that was handed in the one that stands for it; empty unless points were merged
    merged_into: np.ndarray = field(default_factory=lambda: np.empty(0, dtype=np.int32))
    #: (m,) for each triangle the index of its region in refine(), -1 elsewhere; empty where no regions were given
    regions: np.ndarray = field(default_factory=lambda: _NO_REGIONS)

    def __post_init__(self) -> None:
        arrays = ("points", "triangles", "segments", "parents", "merged_into")
        for name in arrays if self.regions is _NO_REGIONS else (*arrays, "regions"):
            object.__setattr__(self, name, immutable(signed(getattr(self, name))))
        object.__setattr__(self, "stats", MappingProxyType(dict(self.stats)))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Triangulation):
            return NotImplemented
        return all(np.array_equal(getattr(self, name), getattr(other, name))
                   for name in ("points", "triangles", "segments"))

    def __hash__(self) -> int:
        return hash((len(self.points), self.triangles.tobytes()))

    def __len__(self) -> int:
        return len(self.triangles)

    def __bool__(self) -> bool:
        return True  # also where there are no triangles

    def __repr__(self) -> str:
        return (f"<lamina.Triangulation: {len(self.points):,} points, {len(self.triangles):,} triangles, "
                f"{len(self.segments):,} edges of segments>")

    def __copy__(self) -> Triangulation:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Triangulation:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        # What queries have prepared is left out, and made anew where it is asked for.
        return Triangulation, (self.points, self.triangles, self.segments, self.parents, self.given_points,
                               dict(self.stats), self.merged_into, self.regions)

    @cached_property
    def half_edges(self) -> np.ndarray:
        """(3 m,) for each half-edge the opposite one; -1 on the boundary. Number 3 t + i runs from corner i of triangle
        t to the next one."""
        return signed(_lamina.half_edges(len(self.points), unsigned(self.triangles)))

    @cached_property
    def neighbours(self) -> np.ndarray:
        """(m, 3) the triangles across the edges opposite the corners; -1 across the boundary."""
        return signed(_lamina.neighbours(unsigned(self.half_edges)))

    @cached_property
    def half_edges_at_points(self) -> IndexLists:
        """For each point the half-edges that start there, counter-clockwise; half-edge h is in triangle h // 3."""
        return IndexLists(*_lamina.half_edges_at_points(len(self.points), unsigned(self.triangles),
                                                        unsigned(self.half_edges)))

    @property
    def boundary(self) -> list[np.ndarray]:
        """The loops of the boundary as indices of points: counter-clockwise round triangles, clockwise round holes."""
        corners = self.triangles.reshape(-1)
        return [corners[loop] for loop in self._boundary_loops]

    @cached_property
    def _boundary_loops(self) -> IndexLists:
        return IndexLists(*_lamina.boundary_loops(unsigned(self.half_edges)))

    @cached_property
    def _index(self) -> _lamina.TriangulationIndex:
        return _lamina.TriangulationIndex(self.points, unsigned(self.triangles))

    def check(self, *, require_delaunay: bool = True) -> list[str]:
        """Returns the first 20 defects, one line each; none: the triangulation is valid. Exact. Defects are clockwise
        and flat triangles, overlaps, segments that are no edges, and, with `require_delaunay`, edges that are not
        Delaunay."""
        return _lamina.check_triangulation(self.points, unsigned(self.triangles), unsigned(self.segments),
                                           require_delaunay)

    def quadratic_nodes(self) -> tuple[np.ndarray, np.ndarray]:
        """Returns points with the middles of all edges behind them, and (m, 6) nodes of the triangles: the corners,
        then the middles of the edges opposite of them."""
        triangles = self.triangles.astype(np.int64)
        ends = np.sort(np.stack([triangles[:, [1, 2]], triangles[:, [2, 0]], triangles[:, [0, 1]]], axis=1), axis=2)
        edges, of_side = np.unique(ends.reshape(-1, 2), axis=0, return_inverse=True)
        middles = 0.5 * (self.points[edges[:, 0]] + self.points[edges[:, 1]])
        return (np.concatenate([self.points, middles]),
                np.concatenate([triangles, len(self.points) + of_side.reshape(-1, 3)], axis=1))

    def locate(self, points: ArrayLike) -> Any:
        """Returns for each of (n, 2) points the triangle that holds it, -1 outside; for one point an int. Exact; on edges
        and vertices the triangle with the smallest index. The first call prepares the triangulation for this one and
        those below."""
        queries, is_one = queries_array(points)
        found = self._index.locate(queries)[0]
        return int(found[0]) if is_one else found

    def nearest(self, points: ArrayLike) -> Any:
        """Returns for each of (n, 2) points the index of the nearest vertex; for one point an int. Exact. For Delaunay
        triangulations of points; UsageError for others."""
        queries, is_one = queries_array(points)
        found = signed(self._index.nearest(queries))
        return int(found[0]) if is_one else found

    def interpolate(self, values: ArrayLike, points: ArrayLike, *, method: str = "linear") -> Any:
        """Returns at each of (n, 2) points the value between `values`, one number or a vector for each point of the
        triangulation; NaN outside. For one point it returns its value. method: "linear" in each triangle; or "sibson", by
        natural neighbours, which is smooth but at the vertices and needs the Delaunay triangulation of points (UsageError
        for others)."""
        if method not in ("linear", "sibson"):
            raise OptionError(f"method: '{method}' is neither 'linear' nor 'sibson'")
        numbers = doubles(values, "values")
        if numbers.ndim == 0 or len(numbers) != len(self.points):
            raise InputError(f"values must have the shape ({len(self.points)}, ...), one for each point, not "
                             f"{numbers.shape}")
        ask = self._index.linear if method == "linear" else self._index.sibson
        queries, is_one = queries_array(points)
        found = np.empty((len(queries), math.prod(numbers.shape[1:])))
        for k, column in enumerate(numbers.reshape(len(numbers), found.shape[1]).T):
            found[:, k] = ask(np.ascontiguousarray(column), queries)
        values_there = found.reshape(len(queries), *numbers.shape[1:])
        if not is_one:
            return values_there
        return values_there[0] if numbers.ndim > 1 else float(values_there[0])

    def natural_neighbours(self, point: Sequence[float]) -> tuple[np.ndarray, np.ndarray]:
        """Returns the indices of the natural neighbours of a point, counter-clockwise, and Sibson's weights; both empty
        outside."""
        vertices, weights = self._index.natural_neighbours(float(point[0]), float(point[1]))
        return signed(vertices), weights

    def voronoi(self) -> VoronoiDiagram:
        """Returns the Voronoi diagram of the points. For Delaunay triangulations of points."""
        corners, (starts, items), rays, directions = _lamina.voronoi_diagram(self.points, unsigned(self.triangles))
        return VoronoiDiagram(corners, IndexLists(starts, items), signed(rays), directions)

    def voronoi_cells(self, polygon: ArrayLike) -> list[np.ndarray]:
        """Returns for each point the part of its Voronoi cell in a convex, counter-clockwise polygon: (k, 2) corners,
        none where it has no part. For Delaunay triangulations of points."""
        starts, corners = _lamina.clipped_voronoi_cells(self.points, unsigned(self.triangles),
                                                        points_array(polygon, "polygon"))
        return np.split(corners, starts[1:-1]) if len(starts) > 1 else []

    def plot(self, ax: Any = None, **style: Any) -> Any:
        """Draws the triangles with matplotlib and returns the axes."""
        from ._picture import draw_triangles

        return draw_triangles(self, ax, style)


def delaunay(points: ArrayLike) -> Triangulation:
    """Returns the Delaunay triangulation of distinct points.

    points: (n, 2) coordinates, zero or of a magnitude between 1e-60 and 1e60. All decisions are exact, and one rule
    decides between cocircular points, so the set of triangles does not depend on the order of the points. Uses all
    cores from 50,000 points on. Raises InputError for points that appear twice (`error.points` holds their indices).

    Examples
    --------
    >>> lamina.delaunay([[0, 0], [1, 0], [0, 1]]).triangles.tolist()
    [[0, 1, 2]]
    """
    array = points_array(points)
    return Triangulation(array, _lamina.delaunay(array), index_array((), 2, ""), index_array((), 1, ""), len(array))


def constrained_delaunay(points: ArrayLike, segments: ArrayLike, *, keep: str = "convex_hull",
                         crossings: str = "refuse", holes: ArrayLike = (), merge_distance: float | None = None, drop_flat: float = 0) -> Triangulation:
    """Returns the constrained Delaunay triangulation of points and segments.

    segments: (k, 2) indices into `points`; they may overlap, repeat and run through points. keep: which triangles stay:
    those of the "convex_hull", "inside_segments" (not reached from outside), "left_of_segments" (outer loops
    counter-clockwise, holes clockwise), or inside closed loops in any direction by the rule "even_odd" (GeoJSON) or
    "non_zero" (fonts). crossings: "refuse" raises InputError where segments cross (`error.segments`),
    "insert" adds a Steiner point there. holes: (h, 2) coordinates, one point in each hole.
    merge_distance: points at most this far apart count as one (`merged_into`), 0: equal ones; None: equal points raise
    InputError. drop_flat: with keep="convex_hull", triangles within this share of the length of an edge of the convex
    hull from that edge are dropped, such as 1e-10: rounding makes them of points on straight sides; 0: none is.

    Examples
    --------
    >>> made = lamina.constrained_delaunay([[0, 0], [2, 0], [2, 1], [0, 1]], [[0, 2]])
    >>> made.segments.tolist()
    [[0, 2]]
    """
    array = points_array(points)
    steiner, triangles, edges, parents, merged_into = _lamina.constrained_delaunay(
        array, index_array(segments, 2, "segments"), keep, crossings, points_array(holes, "holes"), merge_distance,
        float(drop_flat))
    return Triangulation(_joined(array, steiner), triangles, edges, parents, len(array), merged_into=merged_into)


def constrain_triangles(points: ArrayLike, triangles: ArrayLike, segments: ArrayLike = (),
                        merged_into: ArrayLike = ()) -> Triangulation:
    """Returns a triangulation from elsewhere as one that refine() takes: edges are flipped until it is constrained
    Delaunay.

    triangles: (m, 3), counter-clockwise; without overlaps. segments: (k, 2) edges of triangles that stay.
    merged_into: that of the triangulation whose triangles these are; segments may then end at points that others stand
    for. Where it is empty, equal points stand for ends that are in no triangle.

    Examples
    --------
    >>> made = lamina.constrain_triangles([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    >>> len(made)
    2
    """
    array, merged = points_array(points), index_array(merged_into, 1, "merged_into")
    result, edges, parents = _lamina.constrain_triangles(array, index_array(triangles, 3, "triangles"),
                                                         index_array(segments, 2, "segments"), merged)
    return Triangulation(array, result, edges, parents, len(array), merged_into=merged)


def merge_points(points: ArrayLike, distance: float) -> np.ndarray:
    """Returns for each point the index of the one that stands for it: the first one that stands for itself and is at
    most `distance` away.

    Examples
    --------
    >>> lamina.merge_points([[0, 0], [1, 0], [0, 1e-9]], 1e-6).tolist()
    [0, 1, 0]
    """
    return signed(_lamina.merge_points(points_array(points), float(distance)))


def ring_segments(rings: Iterable[ArrayLike]) -> tuple[np.ndarray, np.ndarray]:
    """Returns points and segments of closed rings, each an (n, 2) array that may repeat its first point at its end.

    Rings that repeat points need `merge_distance` in constrained_delaunay().

    Examples
    --------
    >>> points, segments = lamina.ring_segments([[[0, 0], [1, 0], [0, 1]]])
    >>> segments.tolist()
    [[0, 1], [1, 2], [2, 0]]
    """
    arrays = [points_array(ring, "ring") for ring in rings]
    starts = np.cumsum([0] + [len(a) for a in arrays])
    points = np.concatenate(arrays) if arrays else np.empty((0, 2))
    return points, signed(_lamina.ring_segments(len(points), index_array(starts[:-1], 1, "starts")))


#: Where areas are bounded and nothing else is said, triangles have at most this much more area than the equilateral one
#: of the mean edge, so that their number is least.
_AREA_RATIO = 1.1


def _size_for_area(area: float, max_area_ratio: float) -> float:
    """Returns the size whose triangles have at most this area; unbounded unless it is positive. Ratios that are not are
    left to the C++ part, which refuses them."""
    bounded = area > 0 and max_area_ratio > 0
    return math.sqrt(area / (max_area_ratio * 0.25 * math.sqrt(3))) if bounded else math.inf


def refine(triangulation: Triangulation, size: Any = math.inf, *, gradation: float = 0.1,
           min_angle: float | None = None, split_segments: bool = True, smoothing: int = 2,
           max_triangles: int | None = None, max_area: ArrayLike | None = None,
           max_area_ratio: float | None = None, regions: Sequence[tuple[float, float, float]] = (),
           conforming: bool = False) -> Triangulation:
    """Refines a triangulation to sizes and angles. Segments and the boundary are split where that needs it.

    size: the edge length that is wanted, in units of the input. A number; an array with one size for each point of the
    triangulation; a background (points, triangles, sizes) whose sizes are linear in its triangles; or a function of an
    (n, 2) array of points that returns n sizes. A function is sampled on squares that are divided until they are four
    edges wide, which is slow: a sample costs more than a triangle. The number may be infinite: angles and areas alone count.
    gradation: growth of the edge length per unit of distance from places that ask for less.
    min_angle: smallest angle of a triangle, in degrees, up to 33; None: 20.7, up to which the end is proved. Corners of
    the input below 60 degrees may hold smaller ones (`stats["exempt"]`).
    split_segments: if False, triangles beside long segments may stay beyond the bounds.
    smoothing: how often all vertices move to the means of their neighbours.
    max_triangles: a refinement that needs more, by estimate, raises LimitError before the work.
    max_area: largest area of a triangle: a number, or one for each triangle of the triangulation, of which those that are
    not positive are no bound; these do not go with regions (UsageError).
    max_area_ratio: largest area over that of the equilateral triangle of the wanted edge; None: 1.1 where areas have
    bounds, else 1.7.
    regions: (x, y, area) for each: a point in a region that segments bound, and its largest area, which replaces `size`
    there; 0: no bound but `max_area`, which holds in all regions. `regions` of the result says which triangle lies in which.
    conforming: segments are split until all triangles are Delaunay, and not only constrained Delaunay.

    Examples
    --------
    >>> square = lamina.constrained_delaunay([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1], [1, 2], [2, 3], [3, 0]])
    >>> fine = lamina.refine(square, 0.1)
    >>> len(fine) > 100
    True
    """
    t = triangulation
    bounds_areas = max_area is not None or any(area > 0 for _, _, area in regions)
    ratio = max_area_ratio if max_area_ratio is not None else _AREA_RATIO if bounds_areas else None
    areas, everywhere = _area_bounds(max_area, len(t.triangles))
    if areas is not None and len(regions):
        raise UsageError("max_area: give one number with regions, and not one for each triangle")
    largest_size = _size_for_area(everywhere, ratio or _AREA_RATIO)
    if largest_size < math.inf:
        size = _smaller_size(size, largest_size)
    seeds = points_array([(x, y) for x, y, _ in regions], "regions")
    sizes = np.array([min(_size_for_area(area, ratio or _AREA_RATIO), largest_size) for _, _, area in regions],
                     dtype=np.float64)
    bound = _lamina.proved_min_angle if min_angle is None else min_angle
    steiner, triangles, edges, parents, stats, of_region = _lamina.refine(
        t.points, unsigned(t.triangles), unsigned(t.segments), unsigned(t.parents), _size_argument(t, size, gradation),
        float(gradation), float(bound), split_segments, smoothing, max_triangles, conforming, ratio, areas, seeds, sizes)
    if isinstance(size, (int, float)) and math.isinf(size) and not bounds_areas:
        # The sizes that stand for no bound are finite, and flat triangles have circles that are larger.
        stats["oversized"] = 0
        stats["refused"] *= stats["below_bound"] != stats["exempt"]
    return Triangulation(_joined(t.points, steiner), triangles, edges, parents, t.given_points, stats, t.merged_into,
                         signed(of_region) if len(regions) else _NO_REGIONS)


def _smaller_size(size: Any, other: float) -> Any:
    """Returns the size argument of refine() that asks for no more than another size."""
    if callable(size):
        return lambda points: np.minimum(size(points), other)
    if isinstance(size, tuple):
        return size[0], size[1], np.minimum(doubles(size[2], "sizes"), other)
    return np.minimum(doubles(size, "size"), other)


def _area_bounds(max_area: Any, count: int) -> tuple[np.ndarray | None, float]:
    """Returns the largest area of each triangle, if they have their own, and else that of all of them; 0: no bound."""
    if max_area is None:
        return None, 0.0
    array = doubles(max_area, "max_area")
    if array.ndim == 0 and not array > 0:
        raise OptionError(f"max_area: must be positive, not {max_area}")
    if array.ndim > 0 and array.shape != (count,):
        raise InputError(f"max_area must be a number or have the shape ({count},), one for each triangle, not "
                         f"{array.shape}")
    return (array, 0.0) if array.ndim > 0 else (None, float(array))


def _joined(points: np.ndarray, steiner: np.ndarray) -> np.ndarray:
    return np.concatenate([points, steiner]) if len(steiner) else points


def _sizes_array(sizes: Any, count: int) -> np.ndarray:
    array = doubles(sizes, "sizes")
    if array.shape != (count,):
        raise InputError(f"sizes must have the shape ({count},), one for each point, not {array.shape}")
    if not np.all(np.isfinite(array) & (array > 0)):
        raise InputError("sizes must be positive numbers")
    return array


def _size_argument(t: Triangulation, size: Any, gradation: float) -> Any:
    if callable(size):
        return _sampled(size, t.points)
    if isinstance(size, tuple):
        points, triangles, sizes = size
        background = points_array(points, "background points")
        return background, index_array(triangles, 3, "background triangles"), _sizes_array(sizes, len(background))
    array = doubles(size, "size")
    return float(array) if array.ndim == 0 else (t.points, unsigned(t.triangles),
                                                      _sizes_array(array, len(t.points)))


#: A square is divided while its side exceeds this many edges.
_EDGES_PER_SQUARE = 4.0
_MAX_SAMPLES = 20_000_000


def _sampled(function: Callable[[np.ndarray], Any],
             points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
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
