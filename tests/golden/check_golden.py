#!/usr/bin/env python3
"""Meshes the cases of hashes.json and compares their hashes with those that stand there.

    tests/golden/check_golden.py PROGRAM [--threads 1,2] [--update]

A difference means that a mesh changed. Where that was meant, --update writes the new hashes, and the commit says why
they changed. The exit status is 1 where a hash differs or a run failed.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent.parent
HASHES = pathlib.Path(__file__).with_name("hashes.json")


def mesh_hash(program, arguments, threads):
    with tempfile.TemporaryDirectory() as scratch:
        report = pathlib.Path(scratch) / "report.json"
        subprocess.run([program, "mesh", *arguments, "--threads", threads, "--quiet", "-o", f"{scratch}/mesh.vtu",
                        "--report", str(report)], check=True, cwd=REPOSITORY)
        return json.loads(report.read_text())["hash"]


def write(cases):
    rows = (json.dumps(case) for case in cases)
    HASHES.write_text("[\n  " + ",\n  ".join(rows) + "\n]\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", help="the program lamina")
    parser.add_argument("--threads", default="1,2", help="numbers of threads to mesh each case on [%(default)s]")
    parser.add_argument("--update", action="store_true", help="write the hashes that come out")
    settings = parser.parse_args()
    program = str(pathlib.Path(settings.program).resolve())

    cases = json.loads(HASHES.read_text())
    different = 0
    for case in cases:
        hashes = {mesh_hash(program, case["arguments"], threads) for threads in settings.threads.split(",")}
        if len(hashes) > 1:
            print(f"{case['name']}: the mesh depends on the number of threads")
            different += 1
        elif settings.update:
            case["hash"] = hashes.pop()
        elif hashes != {case["hash"]}:
            print(f"{case['name']}: {hashes.pop()} instead of {case['hash']}")
            different += 1
    if settings.update and different == 0:
        write(cases)
    print(f"{len(cases)} cases, {different} differ")
    sys.exit(1 if different else 0)


if __name__ == "__main__":
    main()
