#!/usr/bin/env python3
"""Meshes one case many times on different numbers of threads and compares the hashes of the meshes.

    tools/same_mesh.py [--program LAMINA] [--runs N] [--threads 1,2,3,4,8,16] -- INPUT... [OPTIONS of lamina mesh]

The exit status is 1 if a run failed or if two hashes differ.
"""

import argparse
import collections
import json
import pathlib
import subprocess
import sys
import tempfile

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent


def mesh(program, case, threads):
    """Meshes the case once. Returns the hash of the mesh and its number of triangles."""
    with tempfile.TemporaryDirectory() as scratch:
        report = f"{scratch}/report.json"
        subprocess.run([program, "mesh", *case, "--threads", str(threads), "--quiet", "-o", f"{scratch}/mesh.vtu",
                        "--report", report], check=True)
        made = json.loads(pathlib.Path(report).read_text())
    return made["hash"], made["triangles"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", default=str(REPOSITORY / "build/release/src/app/lamina"),
                        help="lamina [%(default)s]")
    parser.add_argument("--runs", type=int, default=10, help="runs for each number of threads [%(default)s]")
    parser.add_argument("--threads", default="1,2,3,4,8,16", help="numbers of threads [%(default)s]")
    parser.add_argument("case", nargs="+", help="inputs and options of lamina mesh, after --")
    settings = parser.parse_args()

    hashes = collections.Counter()
    for threads in settings.threads.split(","):
        try:
            hashes.update(mesh(settings.program, settings.case, threads) for _ in range(settings.runs))
        except subprocess.CalledProcessError as error:
            sys.exit(f"{threads} threads: exit code {error.returncode}")
    for (value, triangles), runs in hashes.items():
        print(f"{value}  {triangles} triangles, {runs} runs")
    sys.exit(0 if len(hashes) == 1 else 1)


if __name__ == "__main__":
    main()
