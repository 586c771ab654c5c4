#!/usr/bin/env python3
"""Writes the triangulation kernel as one header and one source that need nothing but the standard library.

usage: amalgamate.py FOLDER

FOLDER/lamina_delaunay.hpp holds the public headers of triangulation, connectivity, queries, Voronoi diagrams and
changing triangulations; FOLDER/lamina_delaunay.cpp holds their code, for the calling thread alone. Refinement is left
out: it needs size fields. The result is to be compiled with -ffp-contract=off where the compiler would contract
(GCC on machines with fused multiply-add), and without -ffast-math: the predicates have to be exact.
"""

import pathlib
import re
import sys

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent
PUBLIC = REPOSITORY / "include"
SOURCE = REPOSITORY / "src"

HEADERS = ["triangulation", "delaunay_connectivity", "delaunay_queries", "dynamic_triangulation", "predicates",
           "threads", "voronoi"]
# The sources of public functions; those of private headers are found by the names of the headers.
SOURCES = ["core/error.cpp", "core/length.cpp", "core/option.cpp", "core/parallel_none.cpp", "core/suggestion.cpp",
           "delaunay/check_triangulation.cpp", "delaunay/connectivity.cpp", "delaunay/constrained.cpp",
           "delaunay/dynamic/dynamic_triangulation.cpp", "delaunay/dynamic/remove_point.cpp",
           "delaunay/merge_points.cpp", "delaunay/pieces/decomposition_options.cpp",
           "delaunay/pieces/pieces.cpp", "delaunay/queries/locate.cpp",
           "delaunay/queries/make_query_index.cpp", "delaunay/queries/natural_neighbours.cpp",
           "delaunay/queries/triangulation_index.cpp", "delaunay/voronoi.cpp"]

INCLUDE = re.compile(r'^\s*#include (?:<(?P<public>lamina/[^>]+)>|"(?P<private>[^"]+)"|<(?P<system>[^>]+)>)')


class Amalgamation:
    """Texts of files, each once, behind those that they include."""

    def __init__(self, seen=()):
        self.seen = set(seen)
        self.system = set()
        self.headers = []  # private headers, whose sources are needed
        self.parts = []

    def add(self, path):
        """Appends a file and, before it, what it includes."""
        if path in self.seen:
            return
        self.seen.add(path)
        lines = []
        for line in path.read_text().splitlines():
            include = INCLUDE.match(line)
            if include is None:
                if line.strip() != "#pragma once":
                    lines.append(line)
            elif include["system"]:
                self.system.add(include["system"])
            elif include["public"]:
                self.add(PUBLIC / include["public"])
            else:
                self.headers.append(include["private"])
                self.add(SOURCE / include["private"])
        self.parts.append(f"// ---- {path.relative_to(REPOSITORY)} ----\n\n" + "\n".join(lines).strip() + "\n")

    def text(self):
        """Returns the system's headers, then all files."""
        return "".join(f"#include <{name}>\n" for name in sorted(self.system)) + "\n" + "\n".join(self.parts)


def amalgamate():
    """Returns the texts of the header and of the source."""
    header = Amalgamation()
    for name in HEADERS:
        header.add(PUBLIC / "lamina" / f"{name}.hpp")
    source = Amalgamation(header.seen)
    pending = list(SOURCES)
    while pending:
        source.add(SOURCE / pending.pop(0))
        for private in source.headers:
            code = pathlib.Path(private).with_suffix(".cpp")
            if (SOURCE / code).exists() and SOURCE / code not in source.seen and str(code) not in pending:
                pending.append(str(code))
    licence = (REPOSITORY / "LICENSE").read_text().strip().splitlines()
    notice = "// lamina, the triangulation kernel in one file. Made by tools/amalgamate.py; do not edit.\n//\n"
    notice += "".join(f"// {line}".rstrip() + "\n" for line in licence)
    return (notice + "#pragma once\n\n" + header.text(),
            notice + '#include "lamina_delaunay.hpp"\n\n' + source.text())


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in zip(("lamina_delaunay.hpp", "lamina_delaunay.cpp"), amalgamate()):
        (folder / name).write_text(text)


if __name__ == "__main__":
    main()
