"""The function of the package `triangle` (https://rufat.be/triangle), which wraps Shewchuk's program Triangle.

    from lamina.compat.triangle import triangulate

    triangulate({"vertices": [[0, 0], [1, 0], [1, 1], [0, 1]]}, "qa0.1")

Keys, types and shapes are those of that package. Without `q` and `a` so are the triangles; with them the bounds hold, and
the points are others. Numbers count from 0, whether the switches say z or not.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from .._arrays import index_array, points_array
from .._errors import UsageError
from .._graph import MeshEdges, find_edges
from .._triangulation import Triangulation, constrain_triangles, constrained_delaunay, refine

#: A switch and its number.
_SWITCH = re.compile(r"([a-zA-Z])((?:(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)?)")
#: Switches with numbers; those whose effect lies in the algorithm, or in what is printed, are taken and do nothing here.
_WITH_NUMBER, _WITHOUT_EFFECT = "qaoX", "CFIilOQVXsvyz"
_KNOWN = "prqaAcDjeEnNBPoY" + _WITHOUT_EFFECT
_DEFAULT_ANGLE = 20.0
#: The switches that were given, each with its number, or with "", as often as it was given.
_Switches = dict[str, list[str]]


def _switches(options: str) -> _Switches:
    """Returns the switches and their numbers. Raises UsageError for those that Triangle has not, and for S and u."""
    text = options.lstrip("-")
    found: _Switches = {}
    for letter, number in _SWITCH.findall(text):
        found.setdefault(letter, []).append(number)
    if "S" in found:
        raise UsageError(f"options: '{options}' has the switch S, which has no counterpart here: lamina.refine() takes "
                         "max_triangles")
    unknown = [letter for letter, numbers in found.items()
               if letter not in _KNOWN or (any(numbers) and letter not in _WITH_NUMBER)]
    if unknown or _SWITCH.sub("", text):
        raise UsageError(f"options: '{options}' has a switch that is not known: {(unknown or [text])[0]}")
    return found


def _number(switches: _Switches, letter: str) -> float | None:
    """Returns the last number of a switch."""
    return next((float(number) for number in reversed(switches.get(letter, [])) if number), None)


def _column(given: Mapping[str, Any], key: str, count: int) -> np.ndarray:
    """Returns the integers of an (n, 1) array; zeros where there is none."""
    values = np.asarray(given.get(key, np.zeros(count)), dtype=np.int64).reshape(-1)
    if len(values) != count:
        raise UsageError(f"{key} must have {count} rows, not {len(values)}")
    return values


def _coarse(given: Mapping[str, Any], switches: _Switches, points: np.ndarray) -> Triangulation:
    """Returns the triangulation that -r, -p or neither asks for, without refinement."""
    segments = index_array(given.get("segments", ()), 2, "segments")
    if "r" in switches:
        corners = index_array(np.asarray(given["triangles"])[:, :3], 3, "triangles")  # middles of edges may follow
        return constrain_triangles(points, corners, segments if "p" in switches else ())
    if "p" not in switches:
        return constrained_delaunay(points, (), merge_distance=0)
    keep = "convex_hull" if "c" in switches else "inside_segments"
    return constrained_delaunay(points, segments, keep=keep, crossings="insert", merge_distance=0,
                                holes=given.get("holes", ()))


def _area_bounds(given: Mapping[str, Any], switches: _Switches, seeds: np.ndarray) -> tuple[Any, list[Any]]:
    """Returns the largest areas of all triangles and the regions with their own, as refine() takes both. An `a` without a
    number stands for areas of regions, and with -r for those of triangles; one with a number may come beside it."""
    area = _number(switches, "a")
    if "" not in switches.get("a", []):
        return area, []
    if "r" not in switches:
        return area, [(x, y, bound) for x, y, _, bound in seeds.tolist() if bound > 0]
    if "triangle_max_area" not in given:
        return area, []
    bounds = np.asarray(given["triangle_max_area"], dtype=np.float64).reshape(-1)
    return bounds if area is None else np.where(bounds > 0, np.minimum(bounds, area), area), []


def _refined(given: Mapping[str, Any], switches: _Switches, coarse: Triangulation) -> Triangulation:
    """Returns the triangulation with the bounds of -q, -a and -D, and with the regions of all seeds."""
    angle = 0.0 if "q" not in switches else _DEFAULT_ANGLE if not switches["q"][-1] else float(switches["q"][-1])
    no_seeds = np.empty((0, 4))
    seeds = np.asarray(given.get("regions", no_seeds) if "p" in switches else no_seeds, dtype=np.float64).reshape(-1, 4)
    bounds, bounded = _area_bounds(given, switches, seeds)
    t = coarse
    if angle or bounds is not None or bounded or "D" in switches:
        t = refine(coarse, math.inf, min_angle=angle, max_area=bounds, regions=bounded, conforming="D" in switches,
                   split_segments="Y" not in switches, smoothing=2 if angle or bounds is not None or bounded else 0)
    return replace(t, regions=_regions(t, seeds)) if len(seeds) else t


def _regions(t: Triangulation, seeds: np.ndarray) -> np.ndarray:
    """Returns for each triangle the first seed that it can be reached from without crossing a segment; -1: none."""
    count = len(t.points)
    ends = np.sort(np.stack([t.triangles[:, [1, 2]], t.triangles[:, [2, 0]], t.triangles[:, [0, 1]]], axis=1)
                   .astype(np.int64), axis=2)
    walls = np.sort(t.segments.astype(np.int64), axis=1)
    crossing = np.where(np.isin(ends[..., 0] * count + ends[..., 1], walls[:, 0] * count + walls[:, 1]), -1, t.neighbours)
    regions = np.full(len(t), -1, dtype=np.int32)
    for number, start in enumerate(t.locate(seeds[:, :2]).tolist()):
        front = np.array([start]) if start >= 0 and regions[start] < 0 else np.empty(0, dtype=int)
        while len(front):
            regions[front] = number
            beyond = np.unique(crossing[front])
            front = beyond[beyond >= 0]
            front = front[regions[front] < 0]
    return regions


def _segments(given: Mapping[str, Any], switches: _Switches, t: Triangulation,
              boundary: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Returns the edges of segments, the markers that were given, and the same with 1 on the boundary where that is 0."""
    markers = _column(given, "segment_markers", len(given.get("segments", ()))) if "p" in switches else np.zeros(0, np.int64)
    segments = t.segments.astype(np.int64)
    marks = markers[t.parents] if len(markers) else np.zeros(len(segments), dtype=np.int64)
    known = {tuple(edge) for edge in np.sort(segments, axis=1).tolist()}
    more = [edge for edge in boundary.tolist() if tuple(edge) not in known]
    if more and "c" in switches:  # the hull becomes segments
        segments = np.concatenate([segments, np.array(more, dtype=np.int64)])
        marks = np.concatenate([marks, np.zeros(len(more), dtype=np.int64)])
    on_boundary = {tuple(edge) for edge in boundary.tolist()}
    outer = np.array([tuple(edge) in on_boundary for edge in np.sort(segments, axis=1).tolist()], dtype=bool)
    return segments, marks, np.where(outer & (marks == 0), 1, marks)


def _vertex_markers(given: Mapping[str, Any], t: Triangulation, segments: np.ndarray, marks: np.ndarray,
                    boundary: np.ndarray) -> np.ndarray:
    """Returns the markers of the points: their own, else that of a segment, else 1 on the boundary."""
    result = np.zeros(len(t.points), dtype=np.int64)
    result[:t.given_points] = _column(given, "vertex_markers", t.given_points)
    whole = given.get("segments", ()) if "segment_markers" in given and len(t.parents) == 0 else ()
    if len(whole):  # holes have eaten all of them
        segments, marks = index_array(whole, 2, "segments"), _column(given, "segment_markers", len(whole))
    for (a, b), mark in zip(segments.tolist(), marks.tolist()):
        for end in (a, b):
            result[end] = result[end] or mark
    outer = np.unique(boundary)
    result[outer[result[outer] == 0]] = 1
    return result


def _coarse_attributes(given: Mapping[str, Any], coarse: Triangulation) -> np.ndarray:
    """Returns the attributes of the points of the coarse triangulation; those where segments cross are linear along one of
    them, as in Triangle's segmentintersection()."""
    points = coarse.points[:coarse.given_points]
    own = np.asarray(given["vertex_attributes"], dtype=np.float64).reshape(len(points), -1)
    if len(coarse.points) == len(points):
        return own
    # Outside and in holes all triangles have to stay for this, else there are crossings without a segment.
    segments = index_array(given["segments"], 2, "segments")
    whole = constrained_delaunay(points, segments, crossings="insert", merge_distance=0)
    crossings, first = np.unique(whole.segments, return_index=True)
    is_new = crossings >= len(points)
    a, b = segments[whole.parents[first[is_new] // 2]].T
    along, before = points[b] - points[a], whole.points[crossings[is_new]] - points[a]
    share = (before * along).sum(axis=1) / (along * along).sum(axis=1)
    return np.concatenate([own, own[a] + share[:, None] * (own[b] - own[a])])


def _attributes(given: Mapping[str, Any], coarse: Triangulation, t: Triangulation) -> np.ndarray:
    """Returns the attributes of the points; those that refinement added are linear in the coarse triangles."""
    old = _coarse_attributes(given, coarse)
    # Rounding puts points of the boundary outside: what is asked is beside them, in a triangle.
    inside = np.array(t.points)
    inside[t.triangles.reshape(-1)] += 1e-9 * (np.repeat(t.points[t.triangles].mean(axis=1), 3, axis=0)
                                               - t.points[t.triangles.reshape(-1)])
    new = coarse.interpolate(old, inside[len(old):])
    return np.concatenate([old, new.reshape(-1, old.shape[1])])


def triangulate(tri: Mapping[str, Any], opts: str = "") -> dict[str, Any]:
    """Returns the triangulation that Triangle's switches ask for.

    tri: a dictionary with `vertices` (n, 2), and where they are wanted `vertex_attributes`, `vertex_markers`, `segments`
    (k, 2), `segment_markers`, `holes` (h, 2), `regions` (r, 4: x, y, attribute, largest area), `triangles`,
    `triangle_max_area`. opts: p, r, q[angle], a[area], A, c, D, Y, e, n, o2, j, B, P, N and E have their meaning; s, i, F,
    l, v, C, I, O, Q, V, X, y and z are taken. Raises UsageError for other switches, and what
    `lamina.constrained_delaunay()` and `lamina.refine()` raise.
    """
    switches = _switches(opts)
    points = points_array(tri["vertices"], "vertices")
    coarse = _coarse(tri, switches, points)
    t = _refined(tri, switches, coarse)
    edges = find_edges(t.triangles, np.empty((0, 4), dtype=np.int32))
    boundary = edges.ends[edges.cells[:, 1] < 0]
    segments, given, marks = _segments(tri, switches, t, boundary)
    result: dict[str, Any] = {"vertices": np.array(t.points), "triangles": t.triangles.astype(np.int32)}
    if "B" not in switches:
        result["vertex_markers"] = _vertex_markers(tri, t, segments, given, boundary)
    if "vertex_attributes" in tri:
        result["vertex_attributes"] = _attributes(tri, coarse, t)
    if "A" in switches and len(t.regions):
        numbers = np.append(np.asarray(tri["regions"], dtype=np.float64)[:, 2], 0.0)  # regions of -1 have the last one
        result["triangle_attributes"] = numbers[t.regions][:, None]
    if ("p" in switches or "c" in switches) and "P" not in switches:
        result.update({key: np.asarray(tri[key], dtype=np.float64) for key in ("holes", "regions")
                       if key in tri and "p" in switches})
        result["segments"] = segments.astype(np.int32)
        if "B" not in switches:
            result["segment_markers"] = marks
    edge_markers = _edge_markers(edges, segments, marks)
    _add_connectivity(result, switches, t, edges, edge_markers)
    if _number(switches, "o") == 2:
        _add_quadratic_nodes(result, t, edges, edge_markers)
    if "j" in switches:
        _drop_unused(result)
    for letter, key in (("N", "vertices"), ("E", "triangles")):
        if letter in switches:
            del result[key]
    for key in ("vertex_markers", "segment_markers", "edge_markers"):
        if key in result:
            result[key] = result[key].astype(np.int32)[:, None]
    return {key: values for key, values in result.items() if len(values)}


def _edge_markers(edges: MeshEdges, segments: np.ndarray, marks: np.ndarray) -> np.ndarray:
    """Returns the marks of the segments that edges are, else 1 on the boundary."""
    markers = (edges.cells[:, 1] < 0).astype(np.int64)
    # One number for both ends, in whose order the edges are.
    weights = np.array([int(edges.ends.max(initial=0)) + 1, 1])
    markers[np.searchsorted(edges.ends @ weights, np.sort(segments, axis=1) @ weights)] = marks
    return markers


def _add_connectivity(result: dict[str, Any], switches: _Switches, t: Triangulation, edges: MeshEdges,
                      edge_markers: np.ndarray) -> None:
    """Adds what -n and -e ask for."""
    if "n" in switches:
        result["neighbors"] = t.neighbours.astype(np.int32)
    if "e" in switches:
        result["edges"] = edges.ends.astype(np.int32)
        if "B" not in switches:
            result["edge_markers"] = edge_markers


def _add_quadratic_nodes(result: dict[str, Any], t: Triangulation, edges: MeshEdges, edge_markers: np.ndarray) -> None:
    """Puts the middles of edges behind the points, as nodes of the triangles. They come in the order of the edges."""
    points, nodes = t.quadratic_nodes()
    result["vertices"], result["triangles"] = points, nodes.astype(np.int32)
    if "vertex_markers" in result:
        result["vertex_markers"] = np.concatenate([result["vertex_markers"], edge_markers])
    if "vertex_attributes" in result:
        middles = result["vertex_attributes"][edges.ends].mean(axis=1)
        result["vertex_attributes"] = np.concatenate([result["vertex_attributes"], middles])


def _drop_unused(result: dict[str, Any]) -> None:
    """Leaves points out that are in no triangle, and numbers the others anew."""
    used = np.zeros(len(result["vertices"]), dtype=bool)
    used[result["triangles"]] = True
    number = np.cumsum(used) - 1
    for key in ("vertices", "vertex_markers", "vertex_attributes"):
        if key in result:
            result[key] = result[key][used]
    for key in ("triangles", "segments", "edges"):
        if key in result:
            result[key] = number[result[key]].astype(np.int32)
