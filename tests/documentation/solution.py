"""Stands in for a flow solver: a smooth flow on the vertices of a mesh.

usage: solution.py MESH.su2 SOLUTION.vtu
"""

import math
import pathlib
import sys


def read_su2(path):
    """Returns points and cells of a plane SU2 mesh."""
    points, cells = [], []
    lines = iter(pathlib.Path(path).read_text().splitlines())
    for line in lines:
        key, _, value = line.partition("=")
        if key == "NELEM":
            for _ in range(int(value)):
                kind, *vertices = map(int, next(lines).split())
                cells.append(vertices[:{5: 3, 9: 4}[kind]])
        elif key == "NPOIN":
            points = [tuple(map(float, next(lines).split()[:2])) for _ in range(int(value.split()[0]))]
    return points, cells


def array(name, kind, components, values):
    return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">\n'
            + "\n".join(values) + "\n</DataArray>\n")


def write(mesh, path):
    """Writes a VTU file with a flow at the vertices of an SU2 mesh: a wake, and a decay to all sides.

    The arrays are Mach, Pressure, U, p, and Ua and pa, which stand for the adjoint.
    """
    points, cells = read_su2(mesh)
    speed = [1 - math.exp(-4 * abs(y)) * (1 if x > 1 else 0.5) / (1 + x * x + y * y) for x, y in points]
    offsets, end = [], 0
    for cell in cells:
        end += len(cell)
        offsets.append(str(end))
    pathlib.Path(path).write_text(
        '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>\n'
        f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">\n<Points>\n'
        + array("Points", "Float64", 3, [f"{x!r} {y!r} 0" for x, y in points]) + "</Points>\n<Cells>\n"
        + array("connectivity", "Int64", 1, [" ".join(map(str, cell)) for cell in cells])
        + array("offsets", "Int64", 1, offsets)
        + array("types", "UInt8", 1, [{3: "5", 4: "9"}[len(cell)] for cell in cells]) + "</Cells>\n<PointData>\n"
        + array("Mach", "Float64", 1, [repr(0.15 * v) for v in speed])
        + array("Pressure", "Float64", 1, [repr(1 - v * v) for v in speed])
        + array("p", "Float64", 1, [repr(-v * v) for v in speed])
        + array("pa", "Float64", 1, [repr(v) for v in speed])
        + "".join(array(name, "Float64", 3, [f"{v!r} 0 0" for v in speed]) for name in ("U", "Ua")) + "</PointData>\n</Piece>\n"
        "</UnstructuredGrid></VTKFile>\n")


if __name__ == "__main__":
    write(*sys.argv[1:3])
