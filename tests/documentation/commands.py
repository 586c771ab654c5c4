#!/usr/bin/env python3
"""Runs the commands that the pages show.

usage: commands.py PROGRAM SOURCE [PAGE...]

Every line of a block marked `sh` is a command; of blocks without a mark, those that begin with `lamina` or `./dev`.
Each page has a folder of its own, in which its commands run one after the other, as a reader would give them, with the
files of FILES beside them. commands.toml names those that run otherwise, or do not run, and why. The exit status is 1
where a command fails, where commands.toml has a row that no page needs, and where too few commands were found.
"""

import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib

# What a reader is taken to have: names in the folder, and files of examples/geometry.
FILES = {
    "section.dat": "rae2822.dat", "wing.dat": "rae2822.dat", "slat.dat": "crmhl2d_slat.dat",
    "main.dat": "crmhl2d_main.dat", "flap.dat": "crmhl2d_flap.dat", "sections/one.dat": "rae2822.dat",
    "sections/two.dat": "dsma661_model_a.dat"}


def commands_of(text):
    """Returns the commands of a page: lines whose continuations are joined, without comments."""
    commands = []
    for mark, block in re.findall(r"^```([a-z+]*)\n(.*?)^```$", text, flags=re.M | re.S):
        if mark not in ("", "sh"):
            continue
        for line in block.replace("\\\n", " ").splitlines():
            line = re.sub(r"(^|\s+)# .*$", "", line)
            line = re.sub(r"  +", " ", line).strip()
            if line and (mark == "sh" or re.match(r"(lamina|\./dev) ", line)):
                commands.append(line)
    return commands


def prepare(folder, source):
    for name, original in FILES.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source / "examples/geometry" / original, folder / name)
    for link in ("examples", "tools"):
        (folder / link).symlink_to(source / link)
    (folder / ".zfunc").mkdir()
    (folder / ".config/fish/completions").mkdir(parents=True)


def run_page(page, source, environment, rows):
    """Returns what went wrong on a page, the commands that ran, and the rows of commands.toml that it needed."""
    problems, ran, used = [], 0, set()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        prepare(folder, source)
        for command in commands_of(page.read_text()):
            if command.startswith("./dev "):
                if f'\n    {command.split()[1]}) ' not in (source / "dev").read_text():
                    problems.append(f"{page}: {command}: ./dev has no such command")
                continue
            row = rows.get(command)
            if row is not None:
                used.add(command)
                if "run" not in row:
                    continue
            began = time.monotonic()
            run = subprocess.run(["bash", "-euo", "pipefail", "-c", row["run"] if row else command], cwd=folder,
                                 env={**environment, "HOME": name}, stdin=subprocess.DEVNULL, capture_output=True,
                                 text=True, errors="replace")
            if time.monotonic() - began > 5:
                print(f"{page}: {command}: took {time.monotonic() - began:.0f} s")
            ran += 1
            if run.returncode:
                problems.append(f"{page}: {command}: exit status {run.returncode}\n{run.stderr[-2000:]}")
    return problems, ran, used


def main():
    program, source = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
    rows = {row["shown"]: row for row in
            tomllib.loads(pathlib.Path(__file__).with_name("commands.toml").read_text())["command"]}
    pages = [pathlib.Path(name) for name in sys.argv[3:]]
    whole = not pages
    if whole:
        pages = [source / "README.md", *sorted(page for page in (source / "docs").rglob("*.md")
                                               if "decisions" not in page.parts)]
    environment = {**os.environ, "PATH": f"{program.parent}:{os.environ['PATH']}",
                   "SOLUTION": str(pathlib.Path(__file__).with_name("solution.py").resolve())}
    problems, ran, used = [], 0, set()
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for found in pool.map(lambda page: run_page(page, source, environment, rows), pages):
            problems += found[0]
            ran += found[1]
            used |= found[2]
    if whole:
        problems += [f"commands.toml: no page shows: {shown}" for shown in rows if shown not in used]
        if ran < 73:
            problems.append(f"only {ran} commands were found")
    print("\n".join(problems))
    print(f"{ran} commands of {len(pages)} pages were run, {len(problems)} problems")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
