#!/usr/bin/env python3
"""Draws how points are divided: their projection on a paraboloid, its lower hull, and the path that comes of it.

usage: dividing_path.py PROGRAM PICTURE

The points are those of a layer round the nose of NACA 0012. The path is found as the thesis has it; each of its edges
must be one of the triangulation that lamina makes, or the program fails. Source: Blelloch et al., Algorithmica 24 (1999).
"""

import pathlib
import subprocess
import sys
import tempfile


def read_node(path):
    lines = [line.split() for line in path.read_text().splitlines() if line.strip() and not line.startswith("#")]
    return [(float(words[1]), float(words[2])) for words in lines[1:1 + int(lines[0][0])]]


def read_ele(path):
    lines = [line.split() for line in path.read_text().splitlines() if line.strip() and not line.startswith("#")]
    first = min(int(word) for line in lines[1:] for word in line[1:4])
    return [[int(word) - first for word in line[1:4]] for line in lines[1:]]


def lower_hull(points):
    """Returns the indices of the lower hull of points of the plane, from the left."""
    hull = []
    for i in sorted(range(len(points)), key=points.__getitem__):
        while len(hull) > 1:
            (ax, ay), (bx, by), (cx, cy) = points[hull[-2]], points[hull[-1]], points[i]
            if (bx - ax) * (cy - ay) - (by - ay) * (cx - ax) > 0:
                break
            hull.pop()
        hull.append(i)
    return hull


def layer_points(program, folder):
    """Returns the points of a coarse layer at a nose."""
    subprocess.run([program, "mesh", "naca:0012:70", "--surface", "keep", "--first-height", "0.004", "--growth", "1.2",
                    "--layers", "7", "--far-field", "3", "--quiet", "-o", folder / "mesh.node", "--format", "triangle"],
                   check=True)
    layer = {v for line in (folder / "mesh.ele").read_text().splitlines()[1:]
             if not line.startswith("#") and len(words := line.split()) > 4 and float(words[4]) == 0
             for v in map(int, words[1:4])}
    first = min(layer)
    points = read_node(folder / "mesh.node")
    return [points[v - first] for v in sorted(layer) if points[v - first][0] < 0.2]


def main():
    program, picture = map(pathlib.Path, sys.argv[1:3])
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        points = layer_points(program, folder)
        (folder / "points.node").write_text(f"{len(points)} 2 0 0\n" + "".join(
            f"{i} {x!r} {y!r}\n" for i, (x, y) in enumerate(points)))
        subprocess.run([program, "delaunay", folder / "points.node", "-o", folder / "out", "--quiet"], check=True)
        triangles = read_ele(next(folder.glob("out*.ele")))
    # The cut is a vertical line through the median; distances along it, and heights over it on the paraboloid.
    middle = sorted(points)[len(points) // 2]
    lifted = [(y, (x - middle[0]) ** 2 + (y - middle[1]) ** 2) for x, y in points]
    path = lower_hull(lifted)
    edges = {frozenset((t[i], t[i - 1])) for t in triangles for i in range(3)}
    missing = [pair for pair in zip(path, path[1:]) if frozenset(pair) not in edges]
    if missing:
        sys.exit(f"dividing_path.py: {missing} are no edges of the triangulation")

    import matplotlib.pyplot as plot
    figure, (plane, paraboloid) = plot.subplots(1, 2, figsize=(10, 4.6), dpi=100)
    plane.triplot([p[0] for p in points], [p[1] for p in points], triangles, color="#9aa5b1", linewidth=0.7)
    plane.axvline(middle[0], color="#2f7fb8", linestyle="--", linewidth=1, label="cut at the median")
    plane.plot([points[i][0] for i in path], [points[i][1] for i in path], color="#c0392b", linewidth=2.2,
               label="dividing path")
    plane.set_aspect("equal")
    plane.legend(loc="center right", fontsize=9)
    plane.set_title("points, and their triangulation", fontsize=11)
    paraboloid.plot([p[0] for p in lifted], [p[1] for p in lifted], ".", color="#5b6773", markersize=4)
    paraboloid.plot([lifted[i][0] for i in path], [lifted[i][1] for i in path], color="#c0392b", linewidth=2.2,
                    label="lower hull")
    paraboloid.set_xlabel("distance along the cut")
    paraboloid.set_ylabel("height on the paraboloid")
    paraboloid.legend(loc="upper center", fontsize=9)
    paraboloid.set_title("the same points, lifted and projected on the cut", fontsize=11)
    figure.tight_layout()
    figure.savefig(picture)


if __name__ == "__main__":
    main()
