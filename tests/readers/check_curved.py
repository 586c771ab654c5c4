#!/usr/bin/env python3
"""Has MFEM read curved meshes of lamina, and evaluate the Jacobian of each cell at many points.

usage: check_curved.py LAMINA FOLDER [OPTIONS of lamina mesh]

Needs PyMFEM (the package mfem of PyPI); `./dev test-readers` installs it and runs this. MFEM orders nodes by tables of
its own, from its own format and from MSH 2.2, so that a wrong order shows as cells inside out or as another area.
"""

import json
import subprocess
import sys
from pathlib import Path

import mfem.ser as mfem

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


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    failed = False
    for topology in ("quads", "layered"):
        for order in ("2", "3", "4"):
            files = [FOLDER / f"{topology}{order}.{ending}" for ending in ("mesh", "msh")]
            report = FOLDER / "report.json"
            for file in files:
                chosen = ["--format", "msh22"] if file.suffix == ".msh" else []
                subprocess.run([LAMINA, "mesh", *OPTIONS, "--order", order, "--layer-topology", topology, *chosen, "-o",
                                file, "--report", report, "--quiet"], check=True)
            proved = json.loads(report.read_text())["curved"]["min_scaled_jacobian"]
            ours, theirs = judge(files[0]), judge(files[1])
            good = ours[1] == 0 and theirs[1] == 0 and ours[0] == theirs[0] and ours[2] >= proved * (1 - 1e-6) \
                and abs(ours[3] - theirs[3]) < 1e-9 * ours[3]
            failed = failed or not good
            print(f"{'ok  ' if good else 'FAIL'} {topology} of order {order}: {ours[0]} cells, {ours[1]} and "
                  f"{theirs[1]} invalid; determinants at least {ours[2]:.4f} of the largest (proved: {proved:.4f}); "
                  f"area {ours[3]:.9f}", flush=True)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
