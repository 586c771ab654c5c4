#!/usr/bin/env python3
"""Writes a program that runs the C++ examples of the documentation.

usage: examples.py OUTPUT PAGE...

Each block marked `cpp` becomes a function, in which `points`, `segments` and, where a page has gone on from an earlier
block, the names of that block are known: the blocks of a section share a function. Blocks marked `c` or `c++` belong to
other libraries.
"""

import pathlib
import re
import sys

PRELUDE = """#include <cmath>
#include <iostream>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/delaunay_connectivity.hpp>
#include <lamina/delaunay_queries.hpp>
#include <lamina/dynamic_triangulation.hpp>
#include <lamina/error.hpp>
#include <lamina/io.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/voronoi.hpp>

using namespace lamina;

namespace {

/// A square with a square hole and some points.
const std::vector<Point> points = [] {
    std::vector<Point> p{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {2, 1}, {2, 2}, {1, 2}};
    for (int i = 1; i < 60; ++i) p.push_back({4 * std::fmod(0.618034 * i, 1.0), 4 * std::fmod(0.4142136 * i, 1.0)});
    return p;
}();
const std::vector<Segment> segments = [] {
    std::vector<Segment> s;
    for (std::size_t loop : {0, 4})
        for (std::size_t i = 0; i < 4; ++i) s.push_back({VertexId{loop + i}, VertexId{loop + (i + 1) % 4}});
    return s;
}();

"""

# Sections whose examples go on where the one before has ended.
JOINED = {"Queries": "Connectivity", "Voronoi diagrams": "Connectivity"}
JOINED_PAGES = {"library.md"}


def functions(page):
    """Returns the bodies of the functions of a page, by their names."""
    bodies = {}
    section = page.stem
    for line_or_block in re.split(r"(^## [^\n]*$|^```cpp\n.*?^```$)", page.read_text(), flags=re.M | re.S):
        if line_or_block.startswith("## "):
            section = line_or_block[3:].strip()
            section = JOINED.get(section, section)
        elif line_or_block.startswith("```cpp"):
            code = line_or_block[len("```cpp\n"):-len("```")]
            code = "".join(l for l in code.splitlines(True) if not l.startswith(("#include", "using namespace")))
            key = section if page.name in JOINED_PAGES else f"{section} {len(bodies)}"
            bodies[key] = bodies.get(key, "") + code
    return bodies


def main():
    output, *pages = map(pathlib.Path, sys.argv[1:])
    program, calls = PRELUDE, ""
    for page in pages:
        for i, (section, body) in enumerate(functions(page).items()):
            name = re.sub(r"\W", "_", f"{page.stem}_{i}").lower()
            program += f"// {page.name}: {section}\nvoid {name}() {{\n{body}}}\n\n"
            calls += f"    {name}();\n"
    if calls.count("(") < 10:
        sys.exit("too few examples were found")
    output.write_text(program + "}  // namespace\n\nint main() {\n" + calls + "}\n")


if __name__ == "__main__":
    main()
