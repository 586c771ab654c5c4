#!/usr/bin/env python3
"""Draws made-up results with tools/bench_picture.py and reads the picture."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ET

TOOL = pathlib.Path(__file__).resolve().parent.parent.parent / "tools" / "bench_picture.py"
SVG = "{http://www.w3.org/2000/svg}"


def draw(results):
    with tempfile.TemporaryDirectory() as folder:
        source, picture = pathlib.Path(folder, "results.json"), pathlib.Path(folder, "picture.svg")
        source.write_text(json.dumps({"benchmarks": results}))
        done = subprocess.run([sys.executable, TOOL, source, picture], capture_output=True, text=True)
        return done, ET.parse(picture).getroot() if picture.exists() else None


def row(family, **ratios):
    return {"name": f"points_of/{family}/1000/iterations:5/manual_time", "median_s": 1e-4,
            **{f"ratio_to_{name}": ratio for name, ratio in ratios.items()}}


class BenchPicture(unittest.TestCase):
    def test_marks_stand_where_ratios_are(self):
        done, picture = draw([row("two_lines", CGAL=2.0), row("fan", CGAL=0.5), row("far", CGAL=1e6)])
        self.assertEqual(done.returncode, 0, done.stderr)
        texts = [text.text for text in picture.iter(SVG + "text")]
        self.assertIn("two lines", texts)
        self.assertIn("100 ns a point", texts)
        one = next(float(line.get("x1")) for line in picture.iter(SVG + "line") if line.get("stroke-width") == "2")
        _, quicker, slower, far = [float(c.get("cx")) for c in picture.iter(SVG + "circle")]
        self.assertAlmostEqual(quicker - one, one - slower, delta=0.2)
        self.assertGreater(quicker, one)
        self.assertLess(far, float(picture.get("viewBox").split()[2]))

    def test_no_results_are_an_error(self):
        done, picture = draw([])
        self.assertNotEqual(done.returncode, 0)
        self.assertIsNone(picture)


if __name__ == "__main__":
    unittest.main()
