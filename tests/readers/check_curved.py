#!/usr/bin/env python3
"""Has MFEM read curved meshes of lamina, and evaluate the Jacobian of each cell at many points.

usage: check_curved.py LAMINA FOLDER [OPTIONS of lamina mesh]

Needs PyMFEM (the package mfem of PyPI); `./dev test-readers` installs it and runs this. MFEM orders nodes by tables of
its own, from its own format and from MSH 2.2, so that a wrong order shows as cells inside out or as another area. Files
of Nektar++ are judged by the rules of its source, TriGeom.cpp and QuadGeom.cpp.
"""

import json
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import mfem.ser as mfem
import numpy as np

LAMINA, FOLDER = sys.argv[1], Path(sys.argv[2])
OPTIONS = sys.argv[3:] or ["naca:0012", "--first-height", "1e-5", "--layers", "10", "--far-field", "5", "--gradation",
                           "0.4"]
RULE_ORDER = 16  # of the points at which determinants are evaluated; it integrates them exactly
STEPS = 8        # of an even lattice of further points, the border of the cell included


def places(geometry):
    """Returns points of a rule, with weights, and those of an even lattice."""
    rule = mfem.IntRules.Get(geometry, RULE_ORDER)
    of_rule = [rule.IntPoint(i) for i in range(rule.GetNPoints())]
    lattice = []
    for i in range(STEPS + 1):
        for j in range(STEPS + 1 - (i if geometry == mfem.Geometry.TRIANGLE else 0)):
            lattice.append(mfem.IntegrationPoint())
            lattice[-1].Set2(i / STEPS, j / STEPS)
    return of_rule, lattice


def judge(file):
    """Returns the number of cells, of those with a determinant that is not positive, the smallest ratio of the smallest
    determinant in a cell to the largest, and the area of the mesh."""
    mesh = mfem.Mesh(str(file), 1, 0, False)
    by_shape, bad, ratio, area = {}, 0, 1.0, 0.0
    for cell in range(mesh.GetNE()):
        shape, cell_map = mesh.GetElementBaseGeometry(cell), mesh.GetElementTransformation(cell)
        of_rule, lattice = by_shape.setdefault(shape, places(shape))

        def determinant(place, cell_map=cell_map):
            cell_map.SetIntPoint(place)
            return cell_map.Jacobian().Det()

        at_rule = [determinant(place) for place in of_rule]
        area += sum(place.weight * value for place, value in zip(of_rule, at_rule))
        values = at_rule + [determinant(place) for place in lattice]
        bad += min(values) <= 0
        ratio = min(ratio, min(values) / max(values))
    return mesh.GetNE(), bad, ratio, area


def nektar_places(shape, order):
    """Returns the places of the nodes of a reference cell with so many corners, in the order of Nektar++."""
    rows = [(i, j) for j in range(order + 1) for i in range(order + 1 - (j if shape == 3 else 0))]
    if shape == 3:
        corners = [(0, 0), (order, 0), (0, order)]
        edges = [[(i, 0) for i in range(1, order)], [(order - j, j) for j in range(1, order)],
                 [(0, order - j) for j in range(1, order)]]
        border = corners + sum(edges, [])
        rows = border + [place for place in rows if place not in border]
    return np.array(rows) / order


def powers(shape, order, places, by=None):
    """Returns all products of powers of a cell's order at places, or their derivatives by one coordinate."""
    columns = []
    for i in range(order + 1):
        for j in range(order + 1 - (i if shape == 3 else 0)):
            u, v = places[:, 0], places[:, 1]
            columns.append({None: u**i * v**j, 0: i * u**max(i - 1, 0) * v**j, 1: j * u**i * v**max(j - 1, 0)}[by])
    return np.array(columns).T


def judge_nektar(file):
    """Does what judge() does with a file of Nektar++."""
    geometry = ElementTree.parse(file).getroot().find("GEOMETRY")
    numbers = lambda element: [int(word) for word in element.text.split()]
    points = lambda element: np.array(element.text.split(), float).reshape(-1, 3)[:, :2]
    vertices = [points(v)[0] for v in geometry.find("VERTEX")]
    edges = [numbers(e) for e in geometry.find("EDGE")]
    curved = geometry.find("CURVED")
    of_edges = {int(c.get("EDGEID")): points(c) for c in curved.findall("E")}
    of_cells = {int(c.get("FACEID")): points(c) for c in curved.findall("F")}
    bad, ratio, area, rules = 0, 1.0, 0.0, {}
    for cell in geometry.find("ELEMENT"):
        own = numbers(cell)
        shape, curve = len(own), of_cells.get(int(cell.get("ID")))
        corners = []  # where an edge begins that goes to the next one
        for e, after in zip(own, own[1:] + own[:1]):
            corners.append(edges[e][0] if edges[e][1] in edges[after] else edges[e][1])
        order = 1 if curve is None else len(of_edges[own[0]]) - 1
        nodes = nektar_places(shape, order)
        if curve is None:
            curve = np.array([vertices[c] for c in (corners if shape == 3 else [corners[k] for k in (0, 1, 3, 2)])])
        for k, e in enumerate(own if order > 1 else ()):
            ends = np.array([(0, 0), (1, 0), (0, 1)] if shape == 3 else [(0, 0), (1, 0), (1, 1), (0, 1)])
            along = of_edges[e] if edges[e][0] == corners[k] else of_edges[e][::-1]
            for step, point in enumerate(along):
                place = ends[k] + step / order * (ends[(k + 1) % shape] - ends[k])
                node = np.argmin(np.sum((nodes - place) ** 2, axis=1))
                bad += np.any(curve[node] != point)  # Nektar++ warns of curves that do not fit
        if (shape, order) not in rules:
            at_rule, lattice = places(mfem.Geometry.TRIANGLE if shape == 3 else mfem.Geometry.SQUARE)
            at = np.array([(place.x, place.y) for place in at_rule + lattice])
            inverse = np.linalg.inv(powers(shape, order, nodes))
            rules[shape, order] = ([place.weight for place in at_rule],
                                   powers(shape, order, at, 0) @ inverse, powers(shape, order, at, 1) @ inverse)
        weights, by_u, by_v = rules[shape, order]
        u, v = by_u @ curve, by_v @ curve
        values = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
        area += weights @ values[:len(weights)]
        bad += min(values) <= 0
        ratio = min(ratio, min(values) / max(values))
    return len(geometry.find("ELEMENT")), bad, ratio, area


def check(topology, order):
    """Returns whether all judges find the cells of all files of this order valid, as good as proved, and of equal area
    in all; prints what they find."""
    made = [("mesh", "equidistant"), ("msh", "equidistant"), ("xml", "equidistant")]
    if order > 2:  # below, both distributions are the same
        made.append(("mesh", "gauss-lobatto"))
    judged, proved, report = [], [], FOLDER / "report.json"
    for ending, distribution in made:
        file = FOLDER / f"{topology}{order}-{distribution}.{ending}"
        chosen = ["--format", "msh22"] if ending == "msh" else []
        subprocess.run([LAMINA, "mesh", *OPTIONS, "--order", str(order), "--node-distribution", distribution,
                        "--layer-topology", topology, *chosen, "-o", file, "--report", report, "--quiet"], check=True)
        judged.append(judge_nektar(file) if ending == "xml" else judge(file))
        proved.append(json.loads(report.read_text())["curved"]["min_scaled_jacobian"])
    cells, _, _, area = judged[0]
    good = all(own_cells == cells and bad == 0 and abs(own_area - area) < 1e-9 * area and ratio >= least * (1 - 1e-6)
               for (own_cells, bad, ratio, own_area), least in zip(judged, proved))
    print(f"{'ok  ' if good else 'FAIL'} {topology} of order {order}: {cells} cells, area {area:.9f}; determinants "
          "over the largest in their cell (proved): " +
          ", ".join(f"{'.'.join(kind[::-1])} {ratio:.4f} ({least:.4f}), {bad} invalid"
                    for kind, (_, bad, ratio, _), least in zip(made, judged, proved)), flush=True)
    return good


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    good = [check(topology, order) for topology in ("quads", "layered") for order in (2, 3, 4)]
    sys.exit(0 if all(good) else 1)


if __name__ == "__main__":
    main()
