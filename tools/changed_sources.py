#!/usr/bin/env python3
"""Prints the sources that Clang has to look at after a change, one in a line: those of src/, tests/, tools/ and bench/.

usage: tools/changed_sources.py [BASE]

A change is what differs from BASE, committed or not. Without BASE it is where the branch has left origin/main or, on that
branch itself, the last commit. Where there is neither, as in a clone of a single commit, all sources are printed; so they
are where .clang-tidy has changed. A changed header is looked at through one source that includes it, itself or through
other headers.
"""

import pathlib
import re
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[1]
FOLDERS = ["src", "tests", "tools", "bench"]


def git(*words):
    """Returns what git prints, in lines; None where it fails."""
    run = subprocess.run(["git", *words], cwd=SOURCE, capture_output=True, text=True)
    return run.stdout.splitlines() if run.returncode == 0 else None


def base():
    """Returns the commit before the change; None if there is none."""
    head, left = git("rev-parse", "HEAD"), git("merge-base", "HEAD", "origin/main")
    if left and left != head:
        return left[0]
    parent = git("rev-parse", "--verify", "--quiet", "HEAD~1")
    return parent[0] if parent else None


def includers():
    """Returns for each header, as it is included, the files of src/ and include/ that include it."""
    found = {}
    for file in sorted([*(SOURCE / "src").rglob("*.[ch]pp"), *(SOURCE / "include").rglob("*.hpp")]):
        for header in re.findall(r'^#include [<"]([^>"]+)[>"]', file.read_text(), flags=re.M):
            found.setdefault(header, []).append(str(file.relative_to(SOURCE)))
    return found


def source_with(header, by_header):
    """Returns a source that includes a header, the nearest one; None if there is none."""
    front, seen = [header], {header}
    while front:
        next_front = []
        for name in front:
            files = by_header.get(re.sub("^(src|include)/", "", name), [])
            if sources := [f for f in files if f.endswith(".cpp")]:
                return sources[0]
            next_front += [f for f in files if f not in seen]
            seen.update(files)
        front = next_front
    return None


def main():
    before = sys.argv[1] if len(sys.argv) > 1 else base()
    changed = git("diff", "--name-only", "--diff-filter=d", before) if before else None
    if changed is not None:
        changed += git("ls-files", "--others", "--exclude-standard", "include", *FOLDERS) or []
    if changed is None or ".clang-tidy" in changed:
        changed = git("ls-files", *FOLDERS) or []
    sources = {f for f in changed if re.fullmatch(rf"({'|'.join(FOLDERS)})/.*\.cpp", f)}
    headers = [f for f in changed if re.fullmatch(r"(src|include)/.*\.hpp", f)]
    by_header = includers() if headers else {}
    sources |= {source for h in headers if (source := source_with(h, by_header))}
    print("".join(f"{source}\n" for source in sorted(sources)), end="")


if __name__ == "__main__":
    main()
