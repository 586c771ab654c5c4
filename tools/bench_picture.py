#!/usr/bin/env python3
"""Draws the results of lamina_bench_families: how many times as fast as other programs lamina is, for each family.

usage: bench_picture.py RESULTS.json PICTURE.svg

RESULTS.json is what lamina_bench_families wrote with --benchmark_out. The axis is logarithmic, lamina is at 1, and a
program that is quicker stands on the left of it.
"""

import json
import math
import pathlib
import sys
from xml.sax.saxutils import escape

# Each program with its colour, from a palette that colour-blind readers can tell apart (Okabe, Ito), and its mark.
PROGRAMS = {"CGAL": ("#0072b2", "circle"), "Triangle": ("#d55e00", "square"), "CDT": ("#009e73", "triangle"),
            "delaunator": ("#cc79a7", "diamond")}
LOWEST, HIGHEST = 0.25, 32.0
LEFT, RIGHT, TOP, ROW = 150, 880, 74, 24


def read_results(file):
    """Returns (family, number of points, seconds, ratios by program) for each row of a file of Google Benchmark."""
    rows = []
    for row in json.loads(pathlib.Path(file).read_text(encoding="utf-8"))["benchmarks"]:
        _, family, points, *_ = row["name"].split("/")
        ratios = {name: row[f"ratio_to_{name}"] for name in PROGRAMS if f"ratio_to_{name}" in row}
        rows.append((family.replace("_", " "), int(points), row["median_s"], ratios))
    if not rows:
        raise SystemExit(f"{file}: no results")
    return rows


def place(ratio):
    """Returns the x coordinate of a ratio; those beyond the ends of the axis are drawn there."""
    share = math.log(min(max(ratio, LOWEST), HIGHEST) / LOWEST) / math.log(HIGHEST / LOWEST)
    return LEFT + share * (RIGHT - LEFT)


def mark(shape, x, y, colour):
    """Returns a mark of about ten units."""
    if shape == "circle":
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="{colour}"/>'
    corners = {"square": [(-4.5, -4.5), (4.5, -4.5), (4.5, 4.5), (-4.5, 4.5)],
               "triangle": [(0, -5.5), (5.5, 4.5), (-5.5, 4.5)],
               "diamond": [(0, -6), (6, 0), (0, 6), (-6, 0)]}[shape]
    points = " ".join(f"{x + dx:.1f},{y + dy:.1f}" for dx, dy in corners)
    return f'<polygon points="{points}" fill="{colour}"/>'


def draw(rows):
    """Returns the picture as SVG."""
    bottom = TOP + ROW * len(rows)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {RIGHT + 120} {bottom + 46}" '
             'font-family="sans-serif" font-size="13">', '<rect width="100%" height="100%" fill="white"/>',
             f'<text x="{LEFT}" y="22" font-size="15">How many times as fast as others: one thread, medians of five'
             "</text>"]
    for i, (name, (colour, shape)) in enumerate(PROGRAMS.items()):
        parts += [mark(shape, LEFT + 8 + 130 * i, 44, colour), f'<text x="{LEFT + 20 + 130 * i}" y="48">{name}</text>']
    ticks = [2.0**k for k in range(int(math.log2(LOWEST)), int(math.log2(HIGHEST)) + 1)]
    for tick in ticks:
        x, width = place(tick), 2 if tick == 1 else 0.5
        parts += [f'<line x1="{x:.1f}" y1="{TOP - 12}" x2="{x:.1f}" y2="{bottom}" stroke="#888" '
                  f'stroke-width="{width}"/>',
                  f'<text x="{x:.1f}" y="{bottom + 18}" text-anchor="middle">{tick:g}</text>']
    parts.append(f'<text x="{(LEFT + RIGHT) / 2}" y="{bottom + 38}" text-anchor="middle">'
                 "time of the other program over that of lamina</text>")
    for i, (family, points, seconds, ratios) in enumerate(rows):
        y = TOP + ROW * i
        parts += [f'<text x="{LEFT - 12}" y="{y + 4}" text-anchor="end">{escape(family)}</text>',
                  f'<text x="{RIGHT + 12}" y="{y + 4}" fill="#555">{1e9 * seconds / points:.0f} ns a point</text>']
        if ratios:
            low, high = min(map(place, ratios.values())), max(map(place, ratios.values()))
            parts.append(f'<line x1="{low:.1f}" y1="{y}" x2="{high:.1f}" y2="{y}" stroke="#bbb"/>')
        parts += [mark(PROGRAMS[name][1], place(ratio), y, PROGRAMS[name][0]) for name, ratio in ratios.items()]
    return "\n".join([*parts, "</svg>"]) + "\n"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    pathlib.Path(sys.argv[2]).write_text(draw(read_results(sys.argv[1])), encoding="utf-8")


if __name__ == "__main__":
    main()
