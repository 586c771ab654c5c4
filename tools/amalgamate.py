#!/usr/bin/env python3
"""Writes the triangulation kernel as one header and one source that need nothing but the standard library.

usage: amalgamate.py FOLDER

FOLDER/lamina_delaunay.hpp holds the public headers of triangulation; FOLDER/lamina_delaunay.cpp holds their code, for
the calling thread alone. A second pair, lamina_delaunay_queries, adds connectivity, queries and Voronoi diagrams to the
first one, and a third, lamina_delaunay_dynamic, triangulations that change to both. Refinement is left out: it needs
size fields. Points are triangulated in one piece. The sources are to be compiled with -ffp-contract=off where the
compiler would contract (GCC on machines with fused multiply-add). The headers refuse -ffast-math: the predicates have to be
exact.
"""

import pathlib
import re
import sys

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent
PUBLIC = REPOSITORY / "include"
SOURCE = REPOSITORY / "src"

# The public headers and the sources of public functions of each pair; each pair includes the header of the one before
# it. The sources of private headers are found by the names of the headers.
PAIRS = {
    "lamina_delaunay": (
        ["triangulation", "error", "predicates", "threads"],
        ["core/error.cpp", "core/parallel_none.cpp", "delaunay/triangulate/check_triangulation.cpp", "delaunay/constrain/constrained.cpp",
         "delaunay/constrain/flat_triangles.cpp",
         "delaunay/triangulate/merge_points.cpp", "delaunay/constrain/triangulate_whole.cpp"]),
    "lamina_delaunay_queries": (
        ["delaunay_connectivity", "delaunay_queries", "voronoi"],
        ["delaunay/queries/connectivity.cpp", "delaunay/queries/locate.cpp", "delaunay/queries/make_query_index.cpp",
         "delaunay/queries/natural_neighbours.cpp", "delaunay/queries/triangulation_index.cpp",
         "delaunay/queries/voronoi.cpp"]),
    "lamina_delaunay_dynamic": (
        ["dynamic_triangulation"],
        ["delaunay/dynamic/dynamic_triangulation.cpp", "delaunay/dynamic/remove_point.cpp"]),
}
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
    """Returns the texts of the files by their names."""
    files = {}
    public, sources, includes = set(), set(), ""
    for name, (headers, roots) in PAIRS.items():
        header = Amalgamation(public)
        for root in headers:
            header.add(PUBLIC / "lamina" / f"{root}.hpp")
        public = header.seen
        # Private headers stand in each source that needs them; sources stand in one alone.
        source = Amalgamation(public | sources)
        pending = list(roots)
        while pending:
            source.add(SOURCE / pending.pop(0))
            for private in source.headers:
                code = pathlib.Path(private).with_suffix(".cpp")
                if (SOURCE / code).exists() and SOURCE / code not in source.seen and str(code) not in pending:
                    pending.append(str(code))
        sources |= {path for path in source.seen if path.suffix == ".cpp"}
        files[f"{name}.hpp"] = notice() + "#pragma once\n\n" + refuse_fast_math() + includes + header.text()
        includes = f'#include "{name}.hpp"\n\n'
        files[f"{name}.cpp"] = notice() + includes + source.text()
    return files


def refuse_fast_math():
    """Returns the lines that stop compilers which were told to compute inexactly."""
    return ("#ifdef __FAST_MATH__\n"
            "#error \"lamina needs exact arithmetic: compile without -ffast-math (and -Ofast)\"\n"
            "#endif\n\n")


def notice():
    """Returns the comment at the head of each file."""
    licence = (REPOSITORY / "LICENSE").read_text().strip().splitlines()
    text = "// lamina, the triangulation kernel in one file. Made by tools/amalgamate.py; do not edit.\n//\n"
    return text + "".join(f"// {line}".rstrip() + "\n" for line in licence)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in amalgamate().items():
        (folder / name).write_text(text)


if __name__ == "__main__":
    main()
