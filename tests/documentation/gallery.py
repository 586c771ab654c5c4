#!/usr/bin/env python3
"""Each picture of docs/gallery.md stands beside the commands that make it, those of tools/pictures.toml.

usage: gallery.py SOURCE

Pictures of files that are not in the repository are left out. commands.py runs the commands.
"""

import pathlib
import re
import shlex
import sys
import tomllib

from commands import commands_of


def options_of(words):
    """Returns the inputs of a command, and its options without files and the width of the picture, in any order."""
    inputs, options = [], []
    words = iter(words)
    for word in words:
        if not word.startswith("-"):
            inputs.append(pathlib.Path(word).name.replace("crmhl2d_", ""))
        elif word in ("-o", "--width"):
            next(words)
        else:
            options.append((word, next(words)))
    return inputs, sorted(options)


def output_of(words):
    return words[words.index("-o") + 1]


def main():
    source = pathlib.Path(sys.argv[1])
    table = tomllib.loads((source / "tools/pictures.toml").read_text())
    page = (source / "docs/gallery.md").read_text()
    meshes, plots = {}, {}
    for command in map(shlex.split, commands_of(page)):
        if command[:2] == ["lamina", "mesh"]:
            meshes[output_of(command)] = options_of(command[2:])
        elif command[:2] == ["lamina", "plot"]:
            plots[output_of(command)] = (command[2], options_of(command[3:])[1])
    problems, seen = [], 0
    for name in re.findall(r"\]\(images/([\w-]+)\.png\)", page):
        mesh, options = table["pictures"].get(name, (None, None))
        if mesh is None or "COLLECTION" in table["meshes"][mesh]:
            continue
        seen += 1
        file, shown = plots.get(f"{name}.png", (None, None))
        if file is None:
            problems.append(f"{name}: no command of the page makes it")
        elif shown != options_of(options.split())[1]:
            problems.append(f"{name}: the page draws it with {shown}")
        elif meshes.get(file) != options_of(table["meshes"][mesh].split()):
            problems.append(f"{name}: the page makes its mesh with {meshes.get(file)}")
    if seen < 15:
        problems.append(f"only {seen} pictures were found")
    print("\n".join([*problems, f"{seen} pictures, {len(problems)} problems"]))
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
