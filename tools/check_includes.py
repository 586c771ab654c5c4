#!/usr/bin/env python3
"""Checks that every folder of src/ includes only what it may.

    tools/check_includes.py [--table | --dot]

- A folder may include the folders that its CMakeLists.txt names after DEPENDS, and those that they depend on. The
  dependencies have no circle.
- Some folders have rooms. A room may include those that stand before it in ROOMS; files beside the rooms may include all.
- app/ includes public headers (<lamina/...>), its own headers, and those of tables of options (PROGRAM_HEADERS) alone.
- A public header includes public headers alone, of its own folder or of those that this folder depends on.
- Inside a folder headers do not include each other in a circle.
- Stages get their own options: only the sources of src/pipeline in WHOLE_OPTIONS take CaseOptions, the options of all.
- Commands declare their options by app/command_line.hpp: only the sources in COMMAND_LINE include CLI11.
- The drawing docs/images/folders.svg shows these dependencies.

Prints one line for each violation; the exit status is 1 where there is one. --table prints who may include whom, --dot
the same as a graph for Graphviz: docs/images/folders.svg.
"""

import argparse
import html
import pathlib
import re
import sys

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent
SOURCE = REPOSITORY / "src"
PUBLIC = REPOSITORY / "include" / "lamina"

# The rooms of folders, each after those that it may include.
ROOMS = {
    "geometry": ["drawings"],
    "delaunay": ["triangulate", "constrain", "refine", "queries", "dynamic", "pieces"],
    "layers": ["wake", "directions", "heights", "room", "cells", "border"],
}

# The sources of src/pipeline that see the options of all stages: what is public, what checks and derives them, and run().
WHOLE_OPTIONS = {"budget", "compressible_flow", "curve_mesh", "forecast", "options", "pipeline", "presets", "refined", "run"}

# The sources of src/app that include CLI11, whose headers take longer to compile than most commands.
COMMAND_LINE = {"arguments.cpp", "command_facts.cpp", "command_line.cpp", "mesh_command_options.cpp", "run_program.cpp"}

# The private headers that app/ may include: its tables of options have rows of their own.
PROGRAM_HEADERS = {"core/option_builders.hpp", "core/suggestion.hpp"}

# The folder that owns each public header; a header that is not listed belongs to the folder of its name.
OWNERS = {name: "core" for name in ("angle_bounds", "conditions", "error", "export", "files", "ids", "interruption",
                                    "latin_hypercube", "length", "limits", "marker_names", "option", "point", "predicates",
                                    "ranks", "threads", "value_range", "version", "warning")}
OWNERS["transformation"] = "geometry"
OWNERS["compressible_flow"] = OWNERS["coupled_flow"] = "flow"
OWNERS["solution"] = "io"
OWNERS["metric"] = "io"
OWNERS["solution_sizes"] = "adaptation"
OWNERS["solution_metric"] = "adaptation"
OWNERS["transfer"] = "adaptation"
OWNERS["remesh"] = "remeshing"
OWNERS["triangle_files"] = "io"
for name in "delaunay_connectivity delaunay_input delaunay_queries dynamic_triangulation triangulation voronoi".split():
    OWNERS[name] = "delaunay"
OWNERS["morph"] = "morphing"
OWNERS["places"] = "mesh"
OWNERS["former_options"] = "pipeline"
OWNERS["forecast"] = "pipeline"
OWNERS["plate"] = "pipeline"
OWNERS["presets"] = "pipeline"
OWNERS["mesh_sink"] = "mesh"
OWNERS["curved_mesh"] = "mesh"
OWNERS["stream"] = "pipeline"
OWNERS["mpi_ranks"] = "mpi"
OWNERS["solver_case"] = "cases"

# The colours of docs/images/stages.dot.
COLOURS = {"geometry": "#cfe3f7", "surface": "#d8ecd0", "layers": "#fbe3c0", "sizing": "#f3d3e2",
           "decoupling": "#e0d8f0", "pipeline": "#e8e8e8", "mesh": "#d4efef", "io": "#f4efc4", "plot": "#f0dccf",
           "adaptation": "#dfe7c8", "morphing": "#e6dccb", "remeshing": "#dfe7c8",
           "cases": "#dfe8cf", "page": "#f0dccf"}

def dependencies():
    """Returns the set of folders that each folder may include: its DEPENDS list, and those of the folders in it."""
    direct = {}
    for file in sorted(SOURCE.glob("*/CMakeLists.txt")):
        call = re.search(r"lamina_library\(\s*(\w+)(.*?)\)", file.read_text(), re.S)
        if not call:
            continue
        listed = re.search(r"DEPENDS\s+((?:[a-z]+\s+)+)SOURCES", call.group(2))
        direct[call.group(1)] = set(listed.group(1).split()) if listed else set()
    closed = {}

    def close(folder, path):
        if folder in path:
            sys.exit("dependencies run in a circle: " + " -> ".join([*path, folder]))
        if folder not in closed:
            closed[folder] = set(direct[folder])
            for below in direct[folder]:
                closed[folder] |= close(below, [*path, folder])
        return closed[folder]

    for folder in direct:
        close(folder, [])
    return closed

def includes(file):
    """Yields (line number, "public" or "private", path) for each include of a header of lamina."""
    for number, line in enumerate(file.read_text().splitlines(), 1):
        if found := re.match(r"#include <lamina/([\w]+)\.hpp>", line):
            yield number, "public", found.group(1)
        elif found := re.match(r'#include "([\w/]+\.hpp)"', line):
            yield number, "private", found.group(1)

def owner(header):
    return OWNERS.get(header, header)

def is_room_allowed(rooms, room, included):
    """Returns whether a room may include another; files beside the rooms may include all, and may be included by all."""
    return room not in rooms or included not in rooms or rooms.index(included) <= rooms.index(room)

def check_file(file, folder, allowed):
    """Yields the violations of one source file or private header."""
    inside = file.relative_to(SOURCE)
    for number, kind, path in includes(file):
        where = f"{file.relative_to(REPOSITORY)}:{number}"
        if kind == "public":
            if folder != "app" and owner(path) not in allowed | {folder}:
                yield f"{where}: {folder} may not include <lamina/{path}.hpp> of {owner(path)}"
            continue
        target = path.split("/")[0]
        if folder == "app":
            if target != "app" and path not in PROGRAM_HEADERS:
                yield f'{where}: app may not include "{path}"'
        elif target not in allowed | {folder}:
            yield f'{where}: {folder} may not include "{path}"'
        elif folder == target and not is_room_allowed(ROOMS.get(folder, []), inside.parts[1], path.split("/")[1]):
            yield f'{where}: {folder}/{inside.parts[1]} may not include "{path}"'

def check_options():
    """Yields the sources of stages that take the options of all stages."""
    for file in sorted((SOURCE / "pipeline").rglob("*.[ch]pp")):
        if file.stem in WHOLE_OPTIONS:
            continue
        for number, line in enumerate(file.read_text().splitlines(), 1):
            if re.search(r"\bCaseOptions\b(?!::)", line.split("//")[0]):
                yield f"{file.relative_to(REPOSITORY)}:{number}: a stage takes CaseOptions: hand it its own options"

def check_command_line():
    """Yields the sources of the program that include CLI11 beside those that read the command line."""
    for file in sorted((SOURCE / "app").glob("*.[ch]pp")):
        if file.name not in COMMAND_LINE and "#include <CLI/" in file.read_text():
            yield f"{file.relative_to(REPOSITORY)}: includes CLI11: declare options by app/command_line.hpp"

def check_public(file, allowed):
    folder = owner(file.stem)
    for number, kind, path in includes(file):
        where = f"{file.relative_to(REPOSITORY)}:{number}"
        if kind == "private":
            yield f'{where}: a public header may not include "{path}"'
        elif owner(path) not in allowed.get(folder, set()) | {folder}:
            yield f"{where}: {folder} may not include <lamina/{path}.hpp> of {owner(path)}"

def circles():
    """Yields the circles of includes among the private headers."""
    graph = {}
    for file in SOURCE.rglob("*.hpp"):
        name = str(file.relative_to(SOURCE))
        graph[name] = [path for _, kind, path in includes(file) if kind == "private"]
    state = {}

    def visit(name, path):
        if state.get(name) == "done":
            return
        if name in path:
            yield "headers include each other: " + " -> ".join([*path[path.index(name):], name])
            return
        for other in graph.get(name, []):
            yield from visit(other, [*path, name])
        state[name] = "done"

    for name in sorted(graph):
        yield from visit(name, [])

def as_dot(allowed):
    """Yields the lines of the dependencies in the language of Graphviz, without those that follow from others."""
    allowed = {**allowed, "app": set(allowed)}
    yield "digraph folders {"
    yield '    ranksep=0.4; nodesep=0.3; bgcolor="white"; edge [color="#555555", arrowsize=0.7];'
    yield '    node [fontname="Helvetica", fontsize=12, height=0.36, shape=box, style="filled,rounded", color="#555555"];'
    for folder, below in sorted(allowed.items()):
        yield f'    {folder} [label=<<b>{folder}</b>>, fillcolor="{COLOURS.get(folder, "#ffffff")}"];'
        for other in sorted(below - set().union(*(allowed[name] for name in below))):
            yield f"    {folder} -> {other};"
    yield "}"

def check_drawing(dot):
    drawn = (REPOSITORY / "docs/images/folders.svg").read_text()
    shown = {html.unescape(title) for title in re.findall(r"<title>(.*?)</title>", drawn)}
    if any(f"{start}->{end}" not in shown for start, end in re.findall(r"(\w+) -> (\w+);", dot)):
        yield "docs/images/folders.svg lacks an arrow: draw it anew with ./dev pictures"

def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--table", action="store_true", help="print who may include whom")
    parser.add_argument("--dot", action="store_true", help="print the same as a graph for Graphviz")
    settings = parser.parse_args()
    allowed = dependencies()
    if settings.table:
        for folder, below in sorted(allowed.items(), key=lambda row: len(row[1])):
            print(f"{folder:<12}{' '.join(sorted(below, key=lambda name: len(allowed[name])))}")
        return 0
    if settings.dot:
        print("\n".join(as_dot(allowed)))
        return 0

    violations = []
    for folder in [*allowed, "app"]:
        for file in sorted((SOURCE / folder).rglob("*.[ch]pp")):
            violations += check_file(file, folder, allowed.get(folder, set()))
    for file in sorted(PUBLIC.glob("*.hpp")):
        violations += check_public(file, allowed)
    violations += circles()
    violations += check_options()
    violations += check_command_line()
    violations += check_drawing("\n".join(as_dot(allowed)))
    print("\n".join(violations) or "includes run one way")
    return 1 if violations else 0

if __name__ == "__main__":
    sys.exit(main())
