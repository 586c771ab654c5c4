#!/usr/bin/env python3
"""Meshes every airfoil file of a folder and writes the results as a Markdown table.

    tools/collection.py FOLDER [--program LAMINA] [--output TABLE.md] [-- OPTIONS of lamina mesh]

A case is one file, or a group of files that belong together. There are two kinds of groups: the rows of the table under
"## Element groups" in FOLDER/README.md, whose second column names the files between backquotes; and files of one folder
whose names differ in slat, main and flap only. The first height is relative to the chord of the configuration (its
extent in x), because the files come in all units.

lamina judges each mesh twice: before it writes the file, and with `lamina check` on the file. The exit status is 1 if a
case crashed, hung, left an invalid mesh, or ended with an exit code other than 0 (meshed) or 3 (input refused).
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent
NOT_GEOMETRY = {".md", ".py", ".json", ".toml"}


# ---- cases ----

def listed_groups(folder):
    """Returns the groups that the README of the folder lists."""
    readme = folder / "README.md"
    if not readme.is_file():
        return []
    groups = []
    inside = False
    for line in readme.read_text(encoding="utf-8").splitlines():
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


def alike_groups(files):
    """Returns groups of files whose names differ in the words slat, main and flap only."""
    by_stem = {}
    for file in files:
        stem, parts = re.subn(r"_(slat|main|flap)(?=[_.])", "", file.name)
        if parts:
            by_stem.setdefault(file.with_name(stem), []).append(file)
    order = ("_slat", "_main", "_flap")
    return [sorted(group, key=lambda f: next(i for i, part in enumerate(order) if part in f.name))
            for group in by_stem.values() if len(group) > 1]


def cases_of(folder):
    """Returns all cases of the folder, sorted, each as a list of files."""
    files = sorted(f for f in folder.rglob("*") if f.is_file() and f.suffix not in NOT_GEOMETRY)
    groups = listed_groups(folder)
    grouped = {f for group in groups for f in group}
    groups += alike_groups([f for f in files if f not in grouped])
    grouped |= {f for group in groups for f in group}
    return sorted(groups + [[f] for f in files if f not in grouped])


# ---- one case ----

def run(command, limit):
    """Runs a command. Returns its exit code (None: it ran past the limit; negative: a signal killed it), its standard
    output and the last line of its standard error."""
    try:
        done = subprocess.run(command, capture_output=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None, "", f"no end within {limit:g} s"
    errors = done.stderr.decode("utf-8", "replace").strip().splitlines()
    return done.returncode, done.stdout.decode("utf-8", "replace"), errors[-1] if errors else ""


def chord_of(program, files, limit):
    """Returns the extent in x of all elements, or None if lamina cannot read the input."""
    code, text, _ = run([program, "info", *files], limit)
    spans = re.findall(r"^  box\s+x (\S+) to (\S+),", text, re.MULTILINE)
    if code != 0 or not spans:
        return None
    return max(float(high) for _, high in spans) - min(float(low) for low, _ in spans)


def mesh_case(case, settings):
    """Meshes and checks one case. Returns the result as a dictionary."""
    program, limit = settings.program, settings.limit
    files = [str(f) for f in case]
    result = {"files": [str(f.relative_to(settings.folder)) for f in case]}
    chord = chord_of(program, files, limit)
    heights = ["--first-height", repr(settings.first_height * chord)] if chord else []
    with tempfile.TemporaryDirectory() as scratch:
        mesh, report_file = f"{scratch}/mesh.vtu", f"{scratch}/report.json"
        start = time.monotonic()
        code, _, error = run([program, "mesh", *files, *heights, "--threads", "1", "--quiet", *settings.options,
                              "-o", mesh, "--report", report_file], limit)
        result |= {"code": code, "reason": error, "seconds": time.monotonic() - start}
        if code == 0:
            code, text, error = run([program, "check", mesh, "--json"], limit)
            report = json.loads(pathlib.Path(report_file).read_text())
            result |= {"report": report, "check": json.loads(text) if text else {}}
            if code != 0:
                result |= {"code": "invalid", "reason": f"lamina check: {error}"}
    for folder in {str(f.parent) for f in case}:
        result["reason"] = result["reason"].replace(folder + "/", "")
    return result


def failed(result):
    """Returns True if the case gave no valid mesh although lamina did not refuse its input."""
    return result["code"] not in (0, 3)


# ---- the table ----

def share(part, whole):
    """Returns a part of a whole in per cent, as text."""
    return f"{100 * part / whole:.1f}" if whole else "-"


def row(result):
    """Returns the row of the table for one case."""
    names = "<br>".join(f"`{f}`" for f in result["files"])
    if result["code"] != 0:
        outcome = {3: "refused", None: "**hangs**"}.get(result["code"], f"**fails ({result['code']})**")
        return f"| {names} | {outcome} | | | | | | | {result['seconds']:.1f} |"
    report, check = result["report"], result["check"]
    cells, isotropic = report["layer_cells"], report["quality"]["isotropic"]
    open_cells = cells.get("open", cells)
    return (f"| {names} | valid | {report['triangles']} "
            f"| {share(cells['rays'] - report['quality']['layer']['incomplete_rays'], cells['rays'])} "
            f"| {share(cells['made'], cells['requested'])} "
            f"| {share(open_cells['made'], open_cells['requested'])} "
            f"| {check['quality']['isotropic']['min_angle_deg']:.1f} "
            f"| {isotropic['refused_points']} / {isotropic['oversized']} "
            f"| {result['seconds']:.1f} |")


def table(results, settings):
    """Returns the whole page: head, table, and the reasons of the cases that gave no mesh."""
    outcomes = {"valid": sum(r["code"] == 0 for r in results),
                "refused": sum(r["code"] == 3 for r in results),
                "failed": sum(failed(r) for r in results)}
    options = " ".join(settings.options) or "none"
    lines = [
        "# Every file of the collection, meshed",
        "",
        f"`tools/collection.py` made this page. Of {len(results)} cases, {outcomes['valid']} gave a valid mesh, "
        f"{outcomes['refused']} were refused, and",
        f"{outcomes['failed']} failed. The first height is {settings.first_height:g} chords. "
        f"Further options: {options}. Each case ran on one thread.",
        "",
        "- *rays*: per cent of the rays that carry all requested layers",
        "- *cells*: per cent of the requested layer cells that were made",
        "- *open*: the same in the open, where nothing lies in front of the wall ([guide](guide.md#report))",
        "- *angle*: smallest angle of the isotropic region in degrees, by `lamina check`",
        "- *unmet*: points refused / triangles larger than the size field asks for",
        "- *time*: seconds",
        "",
        "| files | outcome | triangles | rays | cells | open | angle | unmet | time |",
        "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |",
        *map(row, results),
    ]
    refused = [r for r in results if r["code"] != 0]
    if refused:
        lines += ["", "## Cases without a mesh, and why", ""]
        lines += [f"- `{' '.join(r['files'])}`: {r['reason'].removeprefix('lamina: error: ')}" for r in refused]
    return "\n".join(lines) + "\n"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=lambda text: pathlib.Path(text).resolve(), help="folder of airfoil files")
    parser.add_argument("--program", default=str(REPOSITORY / "build/release/src/app/lamina"),
                        help="lamina [%(default)s]")
    parser.add_argument("--output", type=pathlib.Path, help="file for the page; else standard output")
    parser.add_argument("--first-height", type=float, default=1e-5, metavar="H",
                        help="first height in chords [%(default)s]")
    parser.add_argument("--limit", type=float, default=60, metavar="S",
                        help="seconds that a case may take [%(default)s]")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="number of cases at a time [%(default)s]")
    parser.add_argument("--only", default="", metavar="TEXT", help="run only cases with a file whose path holds TEXT")
    parser.add_argument("options", nargs="*", help="options of lamina mesh, after --")
    return parser.parse_args()


def main():
    settings = arguments()
    cases = [case for case in cases_of(settings.folder) if any(settings.only in str(f) for f in case)]
    if not cases:
        sys.exit(f"no cases in {settings.folder}")
    with concurrent.futures.ThreadPoolExecutor(settings.jobs) as pool:
        results = list(pool.map(lambda case: mesh_case(case, settings), cases))
    text = table(results, settings)
    if settings.output:
        settings.output.write_text(text, encoding="utf-8")
    else:
        sys.stdout.write(text)
    sys.exit(1 if any(map(failed, results)) else 0)


if __name__ == "__main__":
    main()
