"""Finds the cases of a folder of coordinate files, for collection.py."""

import dataclasses
import json
import pathlib
import re
from collections import Counter

# Files with these endings are no coordinates of sections: documents, pictures, meshes and other inputs.
NOT_SECTIONS = frozenset(
    ".md .py .sh .json .toml .html .pdf .png .svg .jpg .gif .zip .gz .cpp .hpp "
    ".poly .node .ele .neigh .su2 .vtu .vtk .msh .cgns .ugrid .mesh .stl".split())
NOT_SECTION_NAMES = frozenset(["CMakeLists.txt"])


@dataclasses.dataclass(frozen=True)
class Case:
    """Files that are meshed together."""
    files: tuple          # absolute paths
    names: tuple          # the same as they appear on the page
    options: tuple = ()   # options of its own; with them the common options do not hold


@dataclasses.dataclass
class Listing:
    """What a folder holds."""
    cases: list
    left_out: Counter     # number of files that are no coordinates, by ending


def listed_groups(folder):
    """Returns the groups of files that the README of the folder lists."""
    readme = folder / "README.md"
    if not readme.is_file():
        return []
    groups = []
    inside = False
    for line in readme.read_text(encoding="utf-8", errors="replace").splitlines():
        if line.startswith("#"):
            inside = "Element groups" in line
        cells = line.split("|")
        if not inside or len(cells) < 4:
            continue
        names = re.findall(r"`([^`]+)`", cells[2])
        found = [next(iter(sorted(folder.rglob(name))), None) for name in names]
        if names and None not in found:
            groups.append(found)
    return groups


def described_cases(folder):
    """Returns the groups of files that a `case.json` describes, with the options that belong to them."""
    described = []
    for file in sorted(folder.rglob("case.json")):
        try:
            content = json.loads(file.read_text(encoding="utf-8"))
            inputs = [file.parent / name for name in content["inputs"]]
            options = tuple(str(option) for option in content.get("args", []))
        except (ValueError, KeyError, TypeError, AttributeError, OSError):
            continue
        if inputs and all(f.is_file() for f in inputs):
            described.append((inputs, options))
    return described


def groups_alike(files):
    """Returns groups of files of one folder whose names differ in the words slat, main and flap only."""
    by_stem = {}
    for file in files:
        stem, parts = re.subn(r"_(slat|main|flap)(?=[_.])", "", file.name)
        if parts:
            by_stem.setdefault(file.with_name(stem), []).append(file)
    order = ("_slat", "_main", "_flap")
    return [sorted(group, key=lambda f: next(i for i, part in enumerate(order) if part in f.name))
            for group in by_stem.values() if len(group) > 1]


def groups_of_folders(files, top):
    """Returns the files of each folder below `top` as one group."""
    by_folder = {}
    for file in files:
        if file.parent != top:
            by_folder.setdefault(file.parent, []).append(file)
    return [group for group in by_folder.values() if len(group) > 1]


def find(folder, by_name, by_folder, base):
    """Returns all cases of a folder, sorted. `by_name` and `by_folder` say whether files are grouped whose names are
    alike, and those of one subfolder; names of cases are relative to `base`."""
    everything = sorted(f for f in folder.rglob("*")
                        if f.is_file() and not any(p.startswith(".") for p in f.relative_to(folder).parts))
    others = [f for f in everything if f.suffix.lower() in NOT_SECTIONS or f.name in NOT_SECTION_NAMES]
    files = sorted(set(everything) - set(others))
    groups = [(tuple(group), ()) for group in listed_groups(folder)]
    groups += [(tuple(group), options) for group, options in described_cases(folder)]

    def alone():
        grouped = {f for group, _ in groups for f in group}
        return [f for f in files if f not in grouped]

    if by_name:
        groups += [(tuple(group), ()) for group in groups_alike(alone())]
    if by_folder:
        groups += [(tuple(group), ()) for group in groups_of_folders(alone(), folder)]
    groups += [((f,), ()) for f in alone()]
    cases = [Case(group, tuple(str(pathlib.Path(f).relative_to(base)) for f in group), options)
             for group, options in sorted(groups)]
    return Listing(cases, Counter(f.suffix.lower() for f in others))
