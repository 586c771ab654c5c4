#!/usr/bin/env python3
"""Feeds tools/exact_check.py with a mesh of lamina, and with meshes that are wrong.

    tests/tools/exact_check_test.py PROGRAM
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(REPOSITORY / "tools"))
import exact_check  # noqa: E402

PROGRAM = ""

# A square with a square hole in eight triangles: outer corners 0 to 3, corners of the hole 4 to 7.
POINTS = [(0, 0), (3, 0), (3, 3), (0, 3), (1, 1), (2, 1), (2, 2), (1, 2)]
CELLS = [t for i in range(4) for t in ((i, (i + 1) % 4, 4 + i), ((i + 1) % 4, 4 + (i + 1) % 4, 4 + i))]
MARKERS = [(i, (i + 1) % 4) for i in range(4)] + [(4 + i, 4 + (i + 1) % 4) for i in range(4)]


class ExactCheck(unittest.TestCase):
    def expect(self, text, points=None, cells=None, markers=None):
        """Expects that a fault with this text is found where a part of the mesh is replaced."""
        found = exact_check.faults(points or POINTS, cells or CELLS, markers or MARKERS)
        self.assertTrue(any(text in fault for fault in found), found)

    def test_a_right_mesh_has_no_faults(self):
        self.assertEqual(exact_check.faults(POINTS, CELLS, MARKERS), [])

    def test_faults_of_cells(self):
        self.expect("not convex", points=[*POINTS[:4], (4, 1), *POINTS[5:]])
        self.expect("not convex", cells=[CELLS[0][::-1], *CELLS[1:]])
        self.expect("belong to two cells", cells=[*CELLS, CELLS[0]])
        self.expect("points are unused", points=[*POINTS, (9, 9)])

    def test_faults_of_the_border(self):
        self.expect("markers are not the border", markers=MARKERS[1:])
        self.expect("markers are not the border", markers=[*MARKERS, MARKERS[0]])
        self.expect("markers are not the border", cells=CELLS[1:])
        self.expect("touch", points=[(0, 0), (2, 0), (1, 2), (3, 3), (0, 4)], cells=[(0, 1, 2), (2, 3, 4)],
                    markers=[(0, 1), (1, 2), (2, 0), (2, 3), (3, 4), (4, 2)])

    def test_cells_over_each_other(self):
        """A second triangle lies on the first and shares no vertex with it."""
        apart = [(0, 0), (4, 0), (0, 4), (9, 9), (13, 9), (9, 13)]
        pair = {"cells": [(0, 1, 2), (3, 4, 5)], "markers": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3)]}
        self.expect("2 loops are counter-clockwise", points=apart, **pair)
        self.expect("pairs of border edges meet", points=[*apart[:3], (1, 1), (5, 1), (1, 5)], **pair)

    def test_meshes_of_lamina(self):
        with tempfile.TemporaryDirectory() as scratch:
            for topology in ("delaunay", "quads"):
                mesh = f"{scratch}/{topology}.su2"
                subprocess.run([PROGRAM, "mesh", "naca:0012:60", "--first-height", "1e-3", "--layers", "6",
                                "--far-field", "2", "--layer-topology", topology, "--quiet", "-o", mesh],
                               check=True, capture_output=True)
                self.assertEqual(exact_check.faults(*exact_check.read(mesh)), [])


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
