#!/usr/bin/env python3
"""Checks SU2 meshes with the integers of Python, by an argument of its own.

    tools/exact_check.py MESH.su2...

It shares no line with lamina. Coordinates are doubles, hence integers times a common power of two, and every sign below
is exact. A mesh covers its domain once if

- every cell is strictly convex and counter-clockwise;
- no directed edge belongs to two cells, so that each edge has two cells, or one cell and exactly one marker edge;
- the boundary, left by the cells that have no neighbour, consists of simple loops that neither cross nor touch;
- exactly one of the loops, the far field, is counter-clockwise.

For the number of cells over a point is the winding number of the boundary round it. Simple loops that do not meet, one
of them counter-clockwise, wind at most once round any point, and cells of positive area wind at least 0 times. Every
point must be used. The exit status is 1 if a mesh is wrong.
"""

import sys
from collections import Counter

CORNERS = {"5": 3, "9": 4}   # VTK numbers of triangle and quadrilateral


def read(name):
    """Returns the points as integers, the cells, and the edges of all markers."""
    sections, current = {}, None
    with open(name, encoding="utf-8") as file:
        for line in file:
            key, equals, value = line.partition("=")
            if equals:
                known = key.strip() in ("NPOIN", "NELEM", "MARKER_ELEMS")
                current = sections.setdefault(key.strip(), []) if known else None
            elif current is not None and line.strip() and not line.startswith("%"):
                current.append(line.split())
    ratios = [[float(word).as_integer_ratio() for word in words[:2]] for words in sections["NPOIN"]]
    unit = max(denominator for point in ratios for _, denominator in point)
    points = [tuple(n * (unit // d) for n, d in point) for point in ratios]
    cells = [tuple(map(int, words[1:1 + CORNERS[words[0]]])) for words in sections["NELEM"]]
    markers = [(int(words[1]), int(words[2])) for words in sections["MARKER_ELEMS"]]
    return points, cells, markers


def turn(a, b, c):
    """Returns twice the signed area of a triangle."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def sign(value):
    """Returns -1, 0 or 1."""
    return (value > 0) - (value < 0)


def meet(a, b, c, d):
    """Returns True if the closed segments ab and cd have a point in common."""
    abc, abd, cda, cdb = (sign(turn(*t)) for t in ((a, b, c), (a, b, d), (c, d, a), (c, d, b)))
    if abc == abd == 0:
        return all(max(min(a[i], b[i]), min(c[i], d[i])) <= min(max(a[i], b[i]), max(c[i], d[i])) for i in (0, 1))
    return abc * abd <= 0 and cda * cdb <= 0


def crossings(points, border):
    """Returns the number of pairs of border edges that meet although they share no vertex."""
    boxes = sorted((min(points[a][0], points[b][0]), max(points[a][0], points[b][0]), a, b) for a, b in border)
    active, found = [], 0
    for left, right, a, b in boxes:
        active = [edge for edge in active if edge[0] >= left]
        found += sum(not {a, b} & {c, d} and meet(points[a], points[b], points[c], points[d]) for _, c, d in active)
        active.append((right, a, b))
    return found


def loop_areas(points, border):
    """Returns twice the signed area of each loop of the border, which has one edge from each of its vertices."""
    follower, areas = dict(border), []
    while follower:
        start, at = follower.popitem()
        area = points[start][0] * points[at][1] - points[at][0] * points[start][1]
        while at != start:
            after = follower.pop(at)
            area += points[at][0] * points[after][1] - points[after][0] * points[at][1]
            at = after
        areas.append(area)
    return areas


def faults(points, cells, markers):
    """Returns what is wrong with a mesh, in words."""
    found = []
    corners = [(cell[i - 2], cell[i - 1], cell[i]) for cell in cells for i in range(len(cell))]
    bad = sum(turn(points[a], points[b], points[c]) <= 0 for a, b, c in corners)
    found += [f"{bad} corners are not convex"] if bad else []
    edges = Counter((cell[i - 1], cell[i]) for cell in cells for i in range(len(cell)))
    twice = sum(n > 1 for n in edges.values())
    found += [f"{twice} directed edges belong to two cells"] if twice else []
    border = [edge for edge in edges if edge[::-1] not in edges]
    if Counter(map(frozenset, markers)) != Counter(map(frozenset, border)):
        found.append("the markers are not the border")
    unused = len(points) - len({v for cell in cells for v in cell})
    found += [f"{unused} points are unused"] if unused else []
    if len({a for a, _ in border}) != len(border) or len({b for _, b in border}) != len(border):
        return found + ["loops of the border touch"]
    met = crossings(points, border)
    found += [f"{met} pairs of border edges meet"] if met else []
    outer = sum(area > 0 for area in loop_areas(points, border))
    return found + ([f"{outer} loops are counter-clockwise"] if outer != 1 else [])


def main():
    """Checks the meshes of the command line."""
    wrong = 0
    for name in sys.argv[1:]:
        mesh = read(name)
        found = faults(*mesh)
        wrong += bool(found)
        print(f"{name}: {len(mesh[1])} cells: {'; '.join(found) or 'covers its domain once'}", flush=True)
    sys.exit(1 if wrong or len(sys.argv) < 2 else 0)


if __name__ == "__main__":
    main()
