#!/usr/bin/env python3
"""Writes the metric of an oblique front, as a shock is: edges across it are short, those along it long.

usage: metric_of_a_front.py MESH.su2 METRIC.sol
"""

import math
import sys


def tensor(x, y):
    """Returns xx, xy and yy of the metric at a point: 1 / h^2 across the front and along it."""
    angle = math.radians(60)
    normal = math.sin(angle), -math.cos(angle)
    away = abs((x - 0.5) * normal[0] + y * normal[1])
    across = 0.01 + 0.2 * away
    along = max(across, min(8 * across, 0.1 + 0.2 * away))
    if y < 0:
        across = along = 0.1 + 0.2 * math.hypot(x - 0.5, y)
    a, b = across**-2, along**-2
    return [a * normal[i] * normal[j] + b * ((i == j) - normal[i] * normal[j]) for i, j in ((0, 0), (0, 1), (1, 1))]


def main():
    mesh, metric = sys.argv[1:]
    lines = open(mesh, encoding="ascii").read().splitlines()
    first = next(i for i, line in enumerate(lines) if line.startswith("NPOIN="))
    count = int(lines[first].split()[1])
    points = [tuple(map(float, line.split()[:2])) for line in lines[first + 1:first + 1 + count]]
    with open(metric, "w", encoding="ascii") as out:
        print("MeshVersionFormatted 2\n\nDimension 2\n\nSolAtVertices", count, "1 3", sep="\n", file=out)
        for point in points:
            print(*tensor(*point), file=out)
        print("\nEnd", file=out)


if __name__ == "__main__":
    main()
