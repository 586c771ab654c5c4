#!/usr/bin/env python3
"""Makes curved boundary layers round NACA 0012 with Gmsh and lamina: a table of invalid cells and seconds of one core.

  beside_gmsh.py LAMINA [FOLDER]

Gmsh gets the points of the section as a spline, 120 wall edges, and its boundary-layer field with quadrilaterals, first
height 1e-5, growth 1.2. lamina gets the same numbers. Cells of both are judged by Gmsh's minDetJac. Needs the package
gmsh of PyPI.
"""
import math
import pathlib
import resource
import subprocess
import sys
import tempfile

import gmsh

EDGES, FIRST_HEIGHT, GROWTH, LAYERS = 120, 1e-5, 1.2, 35
THICKNESS = FIRST_HEIGHT * (GROWTH**LAYERS - 1) / (GROWTH - 1)
# What Gmsh does with curved cells: nothing, its optimiser, its elastic smoother.
MEANS = {"as made": 0, "optimised": 1, "elastic": 3}


def half_thickness(x):
    return 0.6 * (0.2969 * math.sqrt(x) + x * (-0.1260 + x * (-0.3516 + x * (0.2843 - 0.1036 * x))))


def seconds_of(who):
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def begin():
    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 0)
    gmsh.option.setNumber("General.NumThreads", 1)
    gmsh.model.add("section")


def invalid_cells():
    """Returns the number of cells of the plane, and of those whose smallest determinant is not positive."""
    tags = [tag for kind, tags in zip(*gmsh.model.mesh.getElements(2)[:2]) for tag in tags]
    determinants = gmsh.model.mesh.getElementQualities(tags, "minDetJac")
    return len(tags), sum(value <= 0 for value in determinants)


def gmsh_mesh():
    """Makes a mesh of straight cells."""
    add = gmsh.model.geo
    stations = [0.5 * (1 - math.cos(math.pi * i / 100)) for i in range(101)]
    upper = [add.addPoint(x, half_thickness(x), 0) for x in reversed(stations)]
    lower = [add.addPoint(x, -half_thickness(x), 0) for x in stations[1:-1]]
    walls = [add.addSpline(upper), add.addSpline([upper[-1], *lower, upper[0]])]
    corners = [add.addPoint(10 * x, 10 * y, 0, 2) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    sides = [add.addLine(a, b) for a, b in zip(corners, corners[1:] + corners[:1])]
    add.addPlaneSurface([add.addCurveLoop(sides), add.addCurveLoop(walls)])
    add.synchronize()
    for wall in walls:
        gmsh.model.mesh.setTransfiniteCurve(wall, EDGES // 2 + 1, "Bump", 0.1)
    field = gmsh.model.mesh.field
    layer = field.add("BoundaryLayer")
    field.setNumbers(layer, "CurvesList", walls)
    field.setNumbers(layer, "PointsList", [upper[0]])
    field.setNumbers(layer, "FanPointsList", [upper[0]])
    for name, value in (("Size", FIRST_HEIGHT), ("Ratio", GROWTH), ("Thickness", THICKNESS), ("Quads", 1)):
        field.setNumber(layer, name, value)
    field.setAsBoundaryLayer(layer)
    gmsh.model.mesh.generate(2)


def run_gmsh(order, means):
    """Returns what happened, by a process of its own, which Gmsh's optimiser may end."""
    start = seconds_of(resource.RUSAGE_CHILDREN)
    run = subprocess.run([sys.executable, __file__, "--gmsh", str(order), str(means)], capture_output=True, text=True)
    return run.stdout.strip() if run.returncode == 0 else f"gave up after {seconds_of(resource.RUSAGE_CHILDREN) - start:.2g} s"


def run_gmsh_here(order, means):
    begin()
    start = seconds_of(resource.RUSAGE_SELF)
    gmsh_mesh()
    gmsh.model.mesh.setOrder(order)
    if means == 1:
        gmsh.model.mesh.optimize("HighOrder")
    elif means == 3:
        gmsh.model.mesh.optimize("HighOrderElastic")
    seconds = seconds_of(resource.RUSAGE_SELF) - start
    print(what_is(*invalid_cells(), seconds))


def what_is(cells, invalid, seconds):
    return f"{invalid} of {cells:,}, {seconds:.2g} s"


def run_lamina(lamina, order, folder):
    file = folder / "curved.msh"
    start = seconds_of(resource.RUSAGE_CHILDREN)
    subprocess.run([lamina, "mesh", "naca:0012", "--surface-points", str(EDGES), "--first-height", str(FIRST_HEIGHT),
                    "--growth", str(GROWTH), "--layers", str(LAYERS), "--layer-topology", "quads", "--far-field", "10",
                    "--gradation", "0.2", "--order", str(order), "--threads", "1", "-o",
                    file, "--quiet"], check=True, stderr=subprocess.DEVNULL)
    seconds = seconds_of(resource.RUSAGE_CHILDREN) - start
    begin()
    gmsh.open(str(file))
    result = what_is(*invalid_cells(), seconds)
    gmsh.finalize()
    return result


def main():
    if sys.argv[1] == "--gmsh":
        return run_gmsh_here(*map(int, sys.argv[2:]))
    lamina = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else scratch)
        print("| order | lamina | " + " | ".join(f"Gmsh {gmsh.__version__}, {name}" for name in MEANS) + " |")
        print("|---" * (2 + len(MEANS)) + "|")
        for order in (2, 3, 4):
            rows = [run_lamina(lamina, order, folder)] + [run_gmsh(order, means) for means in MEANS.values()]
            print(f"| {order} | " + " | ".join(rows) + " |", flush=True)


if __name__ == "__main__":
    main()
