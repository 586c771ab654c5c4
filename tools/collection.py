#!/usr/bin/env python3
"""Meshes every case of a folder of airfoil files and writes what became of each as a Markdown table.

    tools/collection.py FOLDER [--program LAMINA] [--output TABLE.md] [-- OPTIONS of lamina mesh]

A case is one file, or the files of a group: the rows of the table under "## Element groups" in FOLDER/README.md (files
between backquotes in the second column), and files of a folder that differ in slat, main and flap alone. Heights are
relative to the chord of the configuration (its extent in x), as files come in all units.

Each mesh is judged twice: by the program that made it, and by `lamina check` on the file it wrote. The exit status is 1
where a case crashed, hung, left an invalid mesh or ended with another code than 0 (meshed) or 3 (input refused).
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
    """Groups of files named in the README, each under the folder that holds its first file."""
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
    """Files with one name but for the words slat, main and flap belong together."""
    by_stem = {}
    for file in files:
        stem, parts = re.subn(r"_(slat|main|flap)(?=[_.])", "", file.name)
        if parts:
            by_stem.setdefault(file.with_name(stem), []).append(file)
    order = ("_slat", "_main", "_flap")
    return [sorted(group, key=lambda f: next(i for i, part in enumerate(order) if part in f.name))
            for group in by_stem.values() if len(group) > 1]


def cases_of(folder):
    files = sorted(f for f in folder.rglob("*") if f.is_file() and f.suffix not in NOT_GEOMETRY)
    groups = listed_groups(folder)
    grouped = {f for group in groups for f in group}
    groups += alike_groups([f for f in files if f not in grouped])
    grouped |= {f for group in groups for f in group}
    return sorted(groups + [[f] for f in files if f not in grouped])


# ---- one case ----

def run(command, limit):
    """Exit code (None: ran past the limit; negative: killed by a signal), standard output, last line of errors."""
    try:
        done = subprocess.run(command, capture_output=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None, "", f"no end within {limit:g} s"
    errors = done.stderr.decode("utf-8", "replace").strip().splitlines()
    return done.returncode, done.stdout.decode("utf-8", "replace"), errors[-1] if errors else ""


def chord_of(program, files, limit):
    """Extent in x of all elements; None where the input cannot be read."""
    code, text, _ = run([program, "info", *files], limit)
    spans = re.findall(r"^  box\s+x (\S+) to (\S+),", text, re.MULTILINE)
    if code != 0 or not spans:
        return None
    return max(float(high) for _, high in spans) - min(float(low) for low, _ in spans)


def mesh_case(case, settings):
    """What became of one case, as a dictionary."""
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
    return result["code"] not in (0, 3)


# ---- the table ----

def share(part, whole):
    return f"{100 * part / whole:.1f}" if whole else "-"


def row(result):
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
    outcomes = {"valid": sum(r["code"] == 0 for r in results),
                "refused": sum(r["code"] == 3 for r in results),
                "failed": sum(failed(r) for r in results)}
    options = " ".join(settings.options) or "none"
    lines = [
        "# Every file of the collection, meshed",
        "",
        f"Made by `tools/collection.py`: {len(results)} cases, {outcomes['valid']} meshed and valid, "
        f"{outcomes['refused']} refused, {outcomes['failed']} failed. First height {settings.first_height:g} chords; "
        f"options besides: {options}; one thread each.",
        "",
        "*Rays*: per cent of the rays that carry all the layers asked for. *Cells*: per cent of the layer cells asked",
        "for that were made; *open*: the same where nothing lies in front of the wall (see docs/guide.md). *Angle*:",
        "smallest angle of the isotropic region in degrees, by `lamina check`. *Left over*: points refused / triangles",
        "larger than the size field asks for. *Time*: seconds.",
        "",
        "| files | outcome | triangles | rays | cells | open | angle | left over | time |",
        "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |",
        *map(row, results),
    ]
    refused = [r for r in results if r["code"] != 0]
    if refused:
        lines += ["", "## Not meshed, and why", ""]
        lines += [f"- `{' '.join(r['files'])}`: {r['reason'].removeprefix('lamina: error: ')}" for r in refused]
    return "\n".join(lines) + "\n"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("--program", default=str(REPOSITORY / "build/release/src/app/lamina"))
    parser.add_argument("--output", type=pathlib.Path, help="the table's file; else standard output")
    parser.add_argument("--first-height", type=float, default=1e-5, metavar="H", help="in chords [%(default)s]")
    parser.add_argument("--limit", type=float, default=60, metavar="S", help="seconds a case may take [%(default)s]")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="cases at a time [%(default)s]")
    parser.add_argument("--only", default="", metavar="TEXT", help="cases with a file whose path holds TEXT")
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
