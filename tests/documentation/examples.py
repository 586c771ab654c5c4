#!/usr/bin/env python3
"""Writes a program that runs the C++ examples of the documentation.

usage: examples.py OUTPUT PAGE...
       examples.py OUTPUT HEADER...

Each block of a page marked `cpp` becomes a function, in which `points`, `segments` and, where a page has gone on from an
earlier block, the names of that block are known: the blocks of a section share a function. Blocks marked `c` or `c++`
belong to other libraries.

The example of a header is the indented code behind the line `// Example:` of the comment that the header opens with. It
becomes a function of its own, in which assertions hold. A header of public functions without an example is an error.
"""

import pathlib
import re
import sys

INCLUDES = """#include <cmath>
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

"""

FIXTURES = """/// A square with a square hole and some points.
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

# Headers that need no example: marks, numbers, and what several processes need.
WITHOUT_EXAMPLE = {"angle_bounds", "export", "mpi_ranks", "ranks"}

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

def example(header):
    """Returns the code of the example of a header, which errors point into; empty where there is none."""
    code, inside = "", False
    for number, line in enumerate(header.read_text().splitlines(), 1):
        if not line.startswith("//") or (inside and not line.startswith("//     ")):
            break
        if inside:
            code += line.removeprefix("//") + "\n"
        elif line == "// Example:":
            inside = True
            code = f'#line {number + 1} "{header}"\n'
    return code

def program_of_pages(pages):
    bodies = {f"{page.name}: {section}": body for page in pages for section, body in functions(page).items()}
    return INCLUDES + FIXTURES, bodies

def program_of_headers(headers):
    includes = "#undef NDEBUG\n#include <cassert>\n"
    includes += "".join(f"#include <lamina/{header.name}>\n" for header in headers if header.stem != "mpi_ranks")
    bodies = {header.name: example(header) for header in headers}
    missing = {pathlib.Path(name).stem for name, body in bodies.items() if not body} ^ WITHOUT_EXAMPLE
    if missing:
        sys.exit(f"with an example or without one against WITHOUT_EXAMPLE: {', '.join(sorted(missing))}")
    return includes + INCLUDES, {name: body for name, body in bodies.items() if body}

def main():
    output, *sources = map(pathlib.Path, sys.argv[1:])
    program, bodies = (program_of_headers if sources[0].suffix == ".hpp" else program_of_pages)(sources)
    if len(bodies) < 10:
        sys.exit("too few examples were found")
    for i, (name, body) in enumerate(bodies.items()):
        program += f"// {name}\nvoid example_{i}() {{\n{body}}}\n\n"
    calls = "".join(f"    example_{i}();\n" for i in range(len(bodies)))
    output.write_text(program + "}  // namespace\n\nint main() {\n" + calls + "}\n")

if __name__ == "__main__":
    main()
