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
_SWITCH = re.compile(r"([a-zA-Z])(\d*\.?\d*(?:[eE][-+]?\d+)?)")
#: Switches with numbers; those whose effect lies in the algorithm, or in what is printed, are taken and do nothing here.
_WITH_NUMBER, _WITHOUT_EFFECT = "qaSoX", "CFIilOQSVXsvyz"
_KNOWN = "prqaAcDjeEnNBPoY" + _WITHOUT_EFFECT
_DEFAULT_ANGLE = 20.0


def _switches(options: str) -> dict[str, str]:
    """Returns the switches and their numbers. Raises UsageError for those that Triangle has not, and for u."""
    text = options.lstrip("-")
    found = dict(_SWITCH.findall(text))
    unknown = [letter for letter, number in found.items() if letter not in _KNOWN or (number and letter not in _WITH_NUMBER)]
    if unknown or _SWITCH.sub("", text):
        raise UsageError(f"options: '{options}' has a switch that is not known: {(unknown or [text])[0]}")
    return found


def _column(given: Mapping[str, Any], key: str, count: int) -> np.ndarray:
    """Returns the integers of an (n, 1) array; zeros where there is none."""
    values = np.asarray(given.get(key, np.zeros(count)), dtype=np.int64).reshape(-1)
    if len(values) != count:
        raise UsageError(f"{key} must have {count} rows, not {len(values)}")
    return values


def _coarse(given: Mapping[str, Any], switches: dict[str, str], points: np.ndarray) -> Triangulation:
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


def _refined(given: Mapping[str, Any], switches: dict[str, str], coarse: Triangulation) -> Triangulation:
    """Returns the triangulation with the bounds of -q, -a and -D, and with regions."""
    angle = float(switches["q"] or _DEFAULT_ANGLE) if "q" in switches else 0.0
    area = float(switches["a"]) if switches.get("a") else None
    seeds = np.asarray(given.get("regions", np.empty((0, 4))), dtype=np.float64).reshape(-1, 4) if "p" in switches else \
        np.empty((0, 4))
    by_region = "a" in switches and area is None and "r" not in switches
    regions = [(x, y, bound if by_region else area or 0.0) for x, y, _, bound in seeds.tolist()]
    bounds: Any = area
    if "a" in switches and "r" in switches and "triangle_max_area" in given:
        bounds = np.asarray(given["triangle_max_area"], dtype=np.float64).reshape(-1)
        bounds = bounds if area is None else np.where(bounds > 0, np.minimum(bounds, area), area)
    if not (angle or bounds is not None or any(bound > 0 for *_, bound in regions) or "D" in switches):
        return replace(coarse, regions=_regions(coarse, seeds)) if len(seeds) else coarse
    return refine(coarse, math.inf, min_angle=angle, max_area=bounds, regions=regions, conforming="D" in switches,
                  split_segments="Y" not in switches, smoothing=2 if angle or bounds is not None or by_region else 0)


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


def _segments(given: Mapping[str, Any], switches: dict[str, str], t: Triangulation,
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


def _attributes(given: Mapping[str, Any], coarse: Triangulation, t: Triangulation) -> np.ndarray:
    """Returns the attributes of the points; those of new ones are linear in the coarse triangles."""
    own = np.asarray(given["vertex_attributes"], dtype=np.float64).reshape(t.given_points, -1)
    old = np.concatenate([own, np.zeros((len(coarse.points) - len(own), own.shape[1]))])
    # Rounding puts points of the boundary outside: what is asked is beside them, in a triangle.
    inside = np.array(t.points)
    inside[t.triangles.reshape(-1)] += 1e-9 * (np.repeat(t.points[t.triangles].mean(axis=1), 3, axis=0)
                                               - t.points[t.triangles.reshape(-1)])
    new = coarse.interpolate(old, inside[t.given_points:])
    return np.concatenate([own, new.reshape(-1, own.shape[1])])


def triangulate(tri: Mapping[str, Any], opts: str = "") -> dict[str, Any]:
    """Returns the triangulation that Triangle's switches ask for.

    tri: a dictionary with `vertices` (n, 2), and where they are wanted `vertex_attributes`, `vertex_markers`, `segments`
    (k, 2), `segment_markers`, `holes` (h, 2), `regions` (r, 4: x, y, attribute, largest area), `triangles`,
    `triangle_max_area`. opts: p, r, q[angle], a[area], A, c, D, Y, e, n, o2, j, B, P, N and E have their meaning; s, i, F,
    l, v, C, I, O, Q, S, V, X, y and z are taken. Raises UsageError for other switches, and what
    `lamina.constrained_delaunay()` and `lamina.refine()` raise.
    """
    switches = _switches(opts)
    points = points_array(tri["vertices"], "vertices")
    coarse = _coarse(tri, switches, points)
    t = _refined(tri, switches, coarse)
    edges = find_edges(t.triangles, np.empty((0, 4), dtype=np.uint32))
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
    _add_connectivity(result, switches, t, edges, segments, marks)
    if "j" in switches:
        _drop_unused(result)
    if "o" in switches and switches["o"] == "2":
        _add_quadratic_nodes(result, t, boundary)
    for letter, key in (("N", "vertices"), ("E", "triangles")):
        if letter in switches:
            del result[key]
    for key in ("vertex_markers", "segment_markers", "edge_markers"):
        if key in result:
            result[key] = result[key].astype(np.int32)[:, None]
    return {key: values for key, values in result.items() if len(values)}


def _add_connectivity(result: dict[str, Any], switches: dict[str, str], t: Triangulation, edges: MeshEdges,
                      segments: np.ndarray, marks: np.ndarray) -> None:
    """Adds what -n and -e ask for."""
    if "n" in switches:
        result["neighbors"] = t.neighbours.astype(np.int32)
    if "e" in switches:
        result["edges"] = edges.ends.astype(np.int32)
        of_edge = dict(zip(map(tuple, np.sort(segments, axis=1).tolist()), marks.tolist()))
        given = np.array([of_edge.get(tuple(edge), 0) for edge in edges.ends.tolist()], dtype=np.int64)
        if "B" not in switches:
            result["edge_markers"] = np.where((given == 0) & (edges.cells[:, 1] < 0), 1, given)


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


def _add_quadratic_nodes(result: dict[str, Any], t: Triangulation, boundary: np.ndarray) -> None:
    """Puts the middles of edges behind the points, as nodes of the triangles."""
    points, nodes = t.quadratic_nodes()
    added = len(points) - len(t.points)
    ends = nodes[:, [[1, 2], [2, 0], [0, 1]]].reshape(-1, 2)
    of_middle = np.zeros((added, 2), dtype=np.int64)
    of_middle[nodes[:, 3:].reshape(-1) - len(t.points)] = ends
    result["vertices"], result["triangles"] = points, nodes.astype(np.int32)
    if "vertex_markers" in result:
        outer = {tuple(edge) for edge in boundary.tolist()}
        markers = [int(tuple(edge) in outer) for edge in np.sort(of_middle, axis=1).tolist()]
        result["vertex_markers"] = np.concatenate([result["vertex_markers"], markers])
    if "vertex_attributes" in result:
        middles = result["vertex_attributes"][of_middle].mean(axis=1)
        result["vertex_attributes"] = np.concatenate([result["vertex_attributes"], middles])
