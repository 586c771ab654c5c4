#!/usr/bin/env python3
"""Meshes every section of a folder, and writes a page that says what became of each.

    tools/collection.py [FOLDER] [--together] [-- OPTIONS of lamina mesh]

A case is one file. Files belong together where the table under "## Element groups" of FOLDER/README.md names them, or
where a `case.json` beside them lists them as "inputs" (with their options as "args"). With --together, files of one
folder whose names differ in slat, main and flap only are one case, and so are all files of a subfolder.

Without FOLDER the cases are the project's own collection: ../shared/geometry, ../shared/cases and examples/. The page
is docs/collection.md then, and out/collection.md for a folder of yours. Its options are what a user types who wants to
solve the Navier-Stokes equations: --y-plus 1 --reynolds 5e6 --alpha 4.

The first height is relative to the chord of the configuration (its extent in x), since files come in all units. Each
mesh is judged twice: by lamina before it writes the file, and by `lamina check` on the file. Refusals are compared with
the judgements of tools/collection_refusals.toml. The exit status is 1 if a case failed: if it crashed, ran past its
limit, left an invalid mesh, or ended with an exit code other than 0 (meshed) or 3 (input refused).
"""

import argparse
import concurrent.futures
import dataclasses
import json
import os
import pathlib
import sys

import collection_cases
import collection_page
import collection_run

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent
OWN_OPTIONS = ["--y-plus", "1", "--reynolds", "5e6", "--alpha", "4"]
OWN_FOLDERS = (REPOSITORY.parent / "shared/geometry", REPOSITORY.parent / "shared/cases", REPOSITORY / "examples")


def split_at_dashes(words):
    """Returns the words before the first `--`, and those after it."""
    where = words.index("--") if "--" in words else len(words)
    return words[:where], words[where + 1:]


def arguments():
    """Returns what the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0], prog="collection",
                                     epilog="What follows -- are options of lamina mesh.")
    parser.add_argument("folder", nargs="?", type=pathlib.Path,
                        help="folder of coordinate files [the project's own collection]")
    parser.add_argument("--together", action="store_true", help="mesh the files of a subfolder as one configuration")
    parser.add_argument("--program", default=str(REPOSITORY / "build/release/src/app/lamina"),
                        help="lamina [%(default)s]")
    parser.add_argument("--output", type=pathlib.Path, metavar="PAGE.md", help="file for the page")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE.json", help="file for the figures of all cases")
    parser.add_argument("--judgements", type=pathlib.Path, metavar="FILE.toml",
                        default=REPOSITORY / "tools/collection_refusals.toml",
                        help="table of the refusals that somebody has judged [%(default)s]")
    parser.add_argument("--first-height", type=float, default=1e-5, metavar="H",
                        help="first height in chords [%(default)s]")
    parser.add_argument("--limit", type=float, default=300, metavar="S",
                        help="seconds that a case may take [%(default)s]")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, metavar="N",
                        help="number of cases at a time [%(default)s]")
    parser.add_argument("--exact", action="store_true",
                        help="check each mesh once more with tools/exact_check.py: 15 microseconds a triangle")
    parser.add_argument("--only", default="", metavar="TEXT", help="run only cases with a file whose path holds TEXT")
    words, options = split_at_dashes(sys.argv[1:])
    settings = parser.parse_args(words)
    settings.own = settings.folder is None
    settings.options = options or (OWN_OPTIONS if settings.own else [])
    settings.output = settings.output or REPOSITORY / ("docs" if settings.own else "out") / "collection.md"
    return settings


def find(settings):
    """Returns all cases that are asked for, and how many files of each ending are no coordinates."""
    if settings.own:
        present = [folder for folder in OWN_FOLDERS if folder.is_dir()]
        listings = [collection_cases.find(folder, by_name=True, by_folder=False, base=folder.parent)
                    for folder in present]
    elif settings.folder.is_dir():
        listings = [collection_cases.find(settings.folder.resolve(), by_name=settings.together,
                                          by_folder=settings.together, base=settings.folder.resolve())]
    else:
        sys.exit(f"collection: {settings.folder} is not a folder")
    cases = [case for listing in listings for case in listing.cases if any(settings.only in n for n in case.names)]
    if not cases:
        sys.exit(f"collection: no cases in {settings.folder or 'the collection'}")
    return cases, sum((listing.left_out for listing in listings), start=collection_cases.Counter())


def run_all(cases, settings):
    """Runs all cases, some at a time, and shows on standard error how far it is. Returns the results in order."""
    results = {}
    with concurrent.futures.ThreadPoolExecutor(max(1, settings.jobs)) as pool:
        waiting = {pool.submit(collection_run.mesh_case, case, settings): i for i, case in enumerate(cases)}
        for done in concurrent.futures.as_completed(waiting):
            results[waiting[done]] = done.result()
            if len(results) % 20 == 0:
                print(f"{len(results)} of {len(cases)} cases done", file=sys.stderr, flush=True)
    return [results[i] for i in range(len(cases))]


def main():
    settings = arguments()
    if not os.access(settings.program, os.X_OK):
        sys.exit(f"collection: no program {settings.program}: ./dev build makes it")
    cases, left_out = find(settings)
    results = run_all(cases, settings)
    judgements = collection_page.read_judgements(settings.judgements)
    text = collection_page.page(results, left_out, judgements, settings)
    settings.output.parent.mkdir(parents=True, exist_ok=True)
    settings.output.write_text(text, encoding="utf-8", errors="backslashreplace")
    if settings.json:
        settings.json.write_text(json.dumps([dataclasses.asdict(result) for result in results], indent=1))
    print(f"{collection_page.summary(results)}: {settings.output}")
    sys.exit(1 if any(result.outcome == "failed" for result in results) else 0)


if __name__ == "__main__":
    main()
