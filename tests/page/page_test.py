#!/usr/bin/env python3
"""Pages of meshes: what they hold is the mesh, within the promised precision and size, and they load nothing.

usage: page_test.py LAMINA
"""
import json
import math
import os
import random
import re
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from packed_mesh import part_of, unpacked

lamina = str(Path(sys.argv.pop(1)).resolve())
step_bits, coordinate_bits = 16, 49   # src/page/steps.hpp
bytes_of_page, bytes_of_triangle = 150_000, 12


def run(*arguments, code=0):
    done = subprocess.run([lamina, *map(str, arguments)], capture_output=True, text=True,
                          env={**os.environ, "DISPLAY": "", "PATH": "/nowhere"}, check=False)
    assert done.returncode == code, done.stderr
    return done


def read_vtu(file):
    """Reads what src/io/vtu_write.cpp describes, uncompressed."""
    data = Path(file).read_bytes()
    head, body = data.split(b"_", 1) if b'encoding="raw"' not in data else re.split(rb'encoding="raw">\s*_', data, 1)
    letters = {"Float64": "d", "Float32": "f", "Int64": "q", "UInt32": "I", "UInt16": "H", "UInt8": "B"}
    arrays = {}
    for tag in re.findall(r"<DataArray [^>]*>", head.decode()):
        field = dict(re.findall(r'(\w+)="([^"]*)"', tag))
        at = int(field["offset"])
        size = struct.unpack_from("<Q", body, at)[0]
        letter = letters[field["type"]]
        count = size // struct.calcsize(letter)
        arrays[field["Name"]] = struct.unpack_from(f"<{count}{letter}", body, at + 8)
    return arrays


def mesh_of_vtu(file):
    arrays = read_vtu(file)
    points = next(v for k, v in arrays.items() if k.lower() == "points")
    cells, begin = [], 0
    for end in arrays["offsets"]:
        cells.append(list(arrays["connectivity"][begin:end]))
        begin = end
    count = sum(len(cell) > 2 for cell in cells)
    names = bytes(arrays["marker_names"]).decode().split("\0")
    markers = {name: [] for name in names if name}
    for cell, marker in zip(cells[count:], arrays["marker"][count:]):
        markers[names[marker - 1]].append(tuple(cell))
    data = {key: list(arrays[key][:count]) if key in arrays else None for key in ("region", "piece", "layer")}
    return {"points": list(zip(points[::3], points[1::3])), "cells": cells[:count], "markers": markers, **data}


def turned(cell):
    first = cell.index(min(cell))
    return cell[first:] + cell[:first]


def smallest_heights(mesh):
    """Returns the smallest height of the triangles at each vertex; quadrilaterals have one at each corner."""
    heights = [math.inf] * len(mesh["points"])
    for cell in mesh["cells"]:
        n = len(cell)
        for k in range(1 if n == 3 else n):
            corners = [cell[(k + j) % n] for j in range(3)]
            (ax, ay), (bx, by), (cx, cy) = (mesh["points"][v] for v in corners)
            longest = max(math.hypot(bx - ax, by - ay), math.hypot(cx - bx, cy - by), math.hypot(ax - cx, ay - cy))
            twice = abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax))
            for v in corners:
                heights[v] = min(heights[v], twice / longest if longest > 0 else 0)
    return heights


class Pages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def expect_equal(self, mesh, page):
        """Expects the mesh of a page to be this one."""
        found = unpacked(page)
        self.assertEqual([turned(c) for c in found["cells"]], [turned(c) for c in mesh["cells"]])
        used = {v for cell in mesh["cells"] for v in cell}
        least = max((abs(x) for v in used for x in mesh["points"][v]), default=0) * 2.0 ** -coordinate_bits
        worst = 0
        for v, height in enumerate(smallest_heights(mesh)):
            if v not in used:
                self.assertIsNone(found["points"][v])
                continue
            allowed = max(height * 2.0 ** -(step_bits + 1), least)
            error = max(abs(a - b) for a, b in zip(found["points"][v], mesh["points"][v]))
            self.assertLessEqual(error, allowed)
            worst = max(worst, error / allowed)
        self.assertEqual({name: edges for name, (_, edges) in found["markers"].items()}, mesh["markers"])
        for key in ("region", "piece", "layer"):
            if mesh.get(key):
                self.assertEqual(found[key], mesh[key], key)
        return found

    def expect_closed(self, page):
        """Expects a page that loads nothing and holds no markup of others."""
        without_mesh = page.replace(part_of(page, "mesh"), "")
        self.assertEqual(set(re.findall(r"\w+://[^\s\"'`<>)]*", without_mesh)), {"http://www.w3.org/2000/svg"})
        self.assertIn("default-src 'none'", page)
        self.assertEqual(re.findall(r"<(?:link|img|script|iframe)[^>]*\s(?:src|href)=(?!\"data:)", page), [])
        self.assertEqual(len(re.findall("<script", page)), 3)
        self.assertEqual(len(re.findall("</script>", page)), 3)
        self.assertIsNone(re.search(r"^\s*(import|export) ", page, re.MULTILINE))
        json.loads(part_of(page, "facts"))

    def expect_small(self, page, mesh):
        triangles = sum(len(cell) - 2 for cell in mesh["cells"])
        self.assertLessEqual(len(page.encode()), bytes_of_page + bytes_of_triangle * triangles)

    def test_page_of_a_run_holds_its_mesh(self):
        for topology in ("delaunay", "quads"):
            vtu, html = self.folder / f"{topology}.vtu", self.folder / f"{topology}.html"
            run("mesh", "naca:0012", "naca:2412", "--transform", "naca2412:shift:1.1,-0.1", "--reynolds", 1e5,
                "--y-plus", 5, "--layer-topology", topology, "--far-field", 10, "-o", vtu, "--html", html,
                "--report", self.folder / "r.json", "--quiet")
            page, mesh = html.read_text(), mesh_of_vtu(vtu)
            found = self.expect_equal(mesh, page)
            self.expect_closed(page)
            self.expect_small(page, mesh)
            facts = json.loads(part_of(page, "facts"))
            self.assertEqual(facts["report"], json.loads((self.folder / "r.json").read_text()))
            given = {option["name"] for option in facts["configuration"] if option["given"]}
            self.assertLessEqual({"reynolds", "html", "layer-topology"}, given)
            names = [place["name"] for place in facts["places"]]
            self.assertEqual(names, ["all", "walls", "nose:1", "tail:1", "nose:2", "tail:2", "slot:1"])
            # Walls: two bodies, whose first cells are as high as the report says.
            self.assertEqual(len(found["walls"]), 2)
            wanted = facts["report"]["quality"]["walls"]["first_heights"]
            for (vertices, heights), marker in zip(found["walls"], wanted):
                self.assertEqual(len(vertices), len(set(vertices)))
                self.assertAlmostEqual(sorted(heights)[len(heights) // 2] / marker["median"], 1, delta=0.02)
            self.assertGreater(sum(found["growth"]), 1000)

    def write_su2(self, name, points, cells, markers):
        lines = ["NDIME= 2", f"NELEM= {len(cells)}"]
        lines += [" ".join(map(str, [5 if len(c) == 3 else 9, *c])) for c in cells]
        lines += [f"NPOIN= {len(points)}"] + [f"{x!r} {y!r}" for x, y in points]
        lines += [f"NMARK= {len(markers)}"]
        for tag, edges in markers.items():
            lines += [f"MARKER_TAG= {tag}", f"MARKER_ELEMS= {len(edges)}"] + [f"3 {a} {b}" for a, b in edges]
        (self.folder / name).write_text("\n".join(lines) + "\n")

    def view(self, name):
        html = self.folder / "view.html"
        run("view", self.folder / name, "-o", html, "--no-open")
        return html.read_text()

    def test_page_of_any_mesh(self):
        """Grids with holes, quadrilaterals, several parts, parts that share a vertex, in any order, valid or not."""
        random.seed(7)
        for case in range(60):
            n, m = random.randint(1, 9), random.randint(1, 9)
            # A grid of cells, some of which are missing, so that parts fall off and meet at vertices.
            points = [(x + 0.2 * random.random(), (y + 0.2 * random.random()) * 10.0 ** random.choice((0, -6)))
                      for y in range(m + 1) for x in range(n + 1)]
            vertex = lambda x, y: y * (n + 1) + x
            cells = []
            for y in range(m):
                for x in range(n):
                    a, b, c, d = vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)
                    kind = random.random()
                    if kind < 0.4:
                        cells += [[a, b, c], [a, c, d]]
                    elif kind < 0.7:
                        cells.append([a, b, c, d])
                    elif kind < 0.8:
                        cells.append([d, c, b])   # clockwise, and an edge that two cells use in one direction
            if not cells:
                continue
            order = list(range(len(points)))
            random.shuffle(order)
            random.shuffle(cells)
            cells.sort(key=len)   # readers number triangles first
            placed = [None] * len(points)
            for old, new in enumerate(order):
                placed[new] = points[old]
            cells = [[order[v] for v in cell] for cell in cells]
            markers = {"hull": [(cells[0][0], cells[0][1])]}
            self.write_su2("any.su2", placed, cells, markers)
            with self.subTest(case=case):
                page = self.view("any.su2")
                self.expect_equal({"points": placed, "cells": cells, "markers": markers}, page)
                self.expect_small(page, {"cells": cells})

    def test_several_meshes_get_several_pages(self):
        few = ["--first-height", "1e-3", "--layers", 3, "--far-field", 5, "--quiet"]
        done = run("family", "naca:0012:60", *few, "--levels", 2, "--surface", "resample", "-o",
                   self.folder / "m_{level}.su2", "--html", self.folder / "m.html", code=2)
        self.assertIn("--html", done.stderr)
        run("batch", "naca:0012:60", "naca:2412:60", *few, "--surface", "keep", "-o", self.folder / "{name}.su2", "--html",
            self.folder / "{name}.html")
        pages = sorted(self.folder.glob("*.html"))
        self.assertEqual(len(pages), 2)
        for page in pages:
            self.assertGreater(len(unpacked(page.read_text())["cells"]), 200)

    def test_names_are_text(self):
        hostile = '</script><script>alert(1)<!--&"'
        self.write_su2("<b>&amp;.su2", [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)], [[0, 1, 2]],
                       {hostile.replace(" ", ""): [(0, 1), (1, 2), (2, 0)]})
        page = self.view("<b>&amp;.su2")
        self.expect_closed(page)
        self.assertIn("<title>&lt;b&gt;&amp;amp;.su2</title>", page)
        self.assertEqual(json.loads(part_of(page, "facts"))["title"], "<b>&amp;.su2")
        self.assertEqual(list(unpacked(page)["markers"]), [hostile])

    def test_invalid_meshes_are_shown_with_their_defects(self):
        self.write_su2("folded.su2", [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.2, 0.2)],
                       [[0, 1, 3], [1, 2, 3], [0, 2, 3]], {"wall": [(0, 1), (1, 2), (2, 0)]})
        report = json.loads(part_of(self.view("folded.su2"), "facts"))["report"]
        self.assertFalse(report["valid"])
        self.assertGreater(len(report["defects"]), 0)

    def test_view_names_its_page_and_refuses_to_replace_the_mesh(self):
        self.write_su2("m.su2", [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)], [[0, 1, 2]], {"w": [(0, 1), (1, 2), (2, 0)]})
        before = (self.folder / "m.su2").read_text()
        run("view", self.folder / "m.su2", "-o", self.folder / "m.su2", code=2)
        run("view", self.folder / "none.su2", code=5)
        run("view", self.folder / "m.su2", "-o", self.folder / "nowhere" / "m.html", code=5)
        self.assertEqual((self.folder / "m.su2").read_text(), before)
        self.assertEqual(sorted(os.listdir(self.folder)), ["m.su2"])
        done = subprocess.run([lamina, "view", "m.su2", "--no-open"], cwd=self.folder, capture_output=True, text=True,
                              check=True)
        self.assertEqual(done.stdout, "m.html: written\n")
        piped = subprocess.run([lamina, "view", "m.su2", "-o", "-"], cwd=self.folder, capture_output=True, text=True,
                               check=True)
        self.assertEqual(piped.stdout, (self.folder / "m.html").read_text())

    def test_a_desktop_opens_the_page(self):
        self.write_su2("m.su2", [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)], [[0, 1, 2]], {"w": [(0, 1), (1, 2), (2, 0)]})
        opener = self.folder / "xdg-open"
        opener.write_text('#!/bin/sh\nprintf %s "$1" > "$(dirname "$0")/opened"\n')
        opener.chmod(0o755)
        for screen, opens in (({"DISPLAY": ":0"}, True), ({"WAYLAND_DISPLAY": "w"}, True), ({}, False)):
            environment = {"PATH": f"{self.folder}:/usr/bin:/bin", **screen}
            done = subprocess.run([lamina, "view", "m.su2"], cwd=self.folder, env=environment, capture_output=True,
                                  text=True, check=True)
            opened = self.folder / "opened"
            self.assertEqual(done.stdout, "m.html: written and opened\n" if opens else "m.html: written\n")
            self.assertEqual(opened.exists(), opens)
            if opens:
                self.assertEqual(Path(opened.read_text()).resolve(), (self.folder / "m.html").resolve())
                opened.unlink()


if __name__ == "__main__":
    unittest.main()
