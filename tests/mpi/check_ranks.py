#!/usr/bin/env python3
"""Compares what lamina-mpi makes on several processes with what lamina makes on one.

    tests/mpi/check_ranks.py LAMINA LAMINA_MPI MPIEXEC [--ranks 1,2,3]

The files must have the same bytes and the reports the same hash and the same check, with and without --stream. Failures
must end all processes with one line and the documented exit code, and leave no file behind. The exit status is 1 where
something differs.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

CASES = [
    ("layers, many pieces", "mesh.su2", ["naca:0012:80", "--far-field", "10", "--gradation", "0.008"]),
    ("quads", "mesh.vtu", ["naca:4412:80", "--far-field", "10", "--gradation", "0.01", "--layer-topology", "quads"]),
    ("two elements, no layer", "mesh.su2",
     ["naca:2412:60", "naca:0012:40", "--transform", "naca0012:scale:0.3", "--transform", "naca0012:shift:1.2,-0.1",
      "--preset", "euler", "--far-field", "10", "--gradation", "0.015"]),
]

REFUSALS = [
    ("an option out of range", 2, ["naca:0012", "--growth", "-1", "-o", "mesh.su2"], "--growth"),
    ("a missing input", 5, ["nothing.dat", "-o", "mesh.su2"], "nothing.dat"),
    ("a format that is written as a whole", 2, ["naca:0012", "-o", "mesh.msh"], "msh41"),
    ("a folder that is not there", 5, ["naca:0012", "-o", "no-folder/mesh.su2"], "no-folder"),
    ("a limit", 2, ["naca:0012", "--max-triangles", "500", "-o", "mesh.su2"], "500"),
    ("standard output", 2, ["naca:0012", "--format", "su2", "-o", "-"], "several processes"),
]


class Programs:
    def __init__(self, settings):
        self.lamina = str(pathlib.Path(settings.lamina).resolve())
        self.mpi = str(pathlib.Path(settings.lamina_mpi).resolve())
        self.mpiexec = settings.mpiexec
        self.errors = 0
        # Open MPI refuses to run as root, and on more processes than there are cores, unless it is told.
        self.environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                                OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_mpi_yield_when_idle="1")

    def run(self, ranks, arguments, folder):
        command = [self.mpiexec, "-n", str(ranks), self.mpi] if ranks else [self.lamina]
        return subprocess.run([*command, *arguments], cwd=folder, env=self.environment, capture_output=True, text=True,
                              timeout=300)

    def expect(self, holds, text):
        if not holds:
            print("FAILED:", text)
            self.errors += 1


def facts(report):
    """Returns what may not depend on the processes."""
    report = json.loads(report.read_text())
    return {key: report[key] for key in ("hash", "vertices", "triangles", "quads", "layer_triangles", "quality",
                                         "pieces", "warnings")}


def compare(programs, ranks, folder):
    for name, file, arguments in CASES:
        output, report = folder / file, folder / "report.json"
        base = ["mesh", *arguments, "--threads", "1", "--quiet", "-o", file, "--report", report.name]
        alone = programs.run(0, [*base, "--stream"], folder)
        programs.expect(alone.returncode == 0, f"{name}: {alone.stderr}")
        expected, expected_facts = output.read_bytes(), facts(report)
        programs.expect(expected_facts["pieces"]["inviscid"] >= 10, f"{name}: too few pieces for several processes")
        for n in ranks:
            for more in ([], ["--stream"]) if n > 1 else (["--stream"],):
                output.unlink(missing_ok=True)
                report.unlink(missing_ok=True)
                run = programs.run(n, [*base, *more], folder)
                what = f"{name}, {n} processes {' '.join(more)}"
                programs.expect(run.returncode == 0, f"{what}: exit code {run.returncode}: {run.stderr}")
                if run.returncode != 0:
                    continue
                programs.expect(output.read_bytes() == expected, f"{what}: other bytes")
                programs.expect(facts(report) == expected_facts, f"{what}: another report")
                programs.expect(sorted(os.listdir(folder)) == sorted([file, "report.json"]), f"{what}: files left")
        for left in folder.iterdir():
            left.unlink()


def compare_parts(programs, ranks, folder):
    """The parts of a PVTU file have all cells together, whatever the number of processes."""
    _, _, arguments = CASES[0]
    counts = set()
    for n in ranks:
        run = programs.run(n, ["mesh", *arguments, "--threads", "1", "--quiet", "-o", "mesh.pvtu", "--report",
                               "report.json"], folder)
        programs.expect(run.returncode == 0, f"PVTU, {n} processes: exit code {run.returncode}: {run.stderr}")
        if run.returncode != 0:
            continue
        parts = re.findall(r'Source="([^"]*)"', (folder / "mesh.pvtu").read_text())
        programs.expect(1 <= len(parts) <= n, f"PVTU, {n} processes: {len(parts)} parts")
        programs.expect(sorted(os.listdir(folder)) == sorted([*parts, "mesh.pvtu", "report.json"]), "files left")
        heads = [(folder / part).read_bytes()[:8192].decode("latin-1") for part in parts]
        counts.add(sum(int(re.search(r'NumberOfCells="(\d+)"', head).group(1)) for head in heads))
        programs.expect(json.loads((folder / "report.json").read_text())["triangles"] < max(counts), "too few cells")
        for left in folder.iterdir():
            left.unlink()
    programs.expect(len(counts) == 1, f"PVTU: numbers of cells {counts}")


def refuse(programs, n, folder):
    for name, code, arguments, said in REFUSALS:
        run = programs.run(n, ["mesh", *arguments], folder)
        lines = [line for line in run.stderr.splitlines() if line.startswith("lamina: error:")]
        programs.expect(run.returncode == code, f"{name}: exit code {run.returncode} instead of {code}")
        programs.expect(len(lines) == 1 and said in lines[0], f"{name}: {lines}")
        programs.expect(not list(folder.iterdir()), f"{name}: files left")
    run = programs.run(n, ["check", "mesh.su2"], folder)
    programs.expect(run.returncode == 2 and run.stderr.count("lamina: error:") == 1, "several processes run 'check'")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("lamina", help="the program lamina")
    parser.add_argument("lamina_mpi", help="the program lamina-mpi")
    parser.add_argument("mpiexec", help="the program that starts processes")
    parser.add_argument("--ranks", default="1,2,3", help="numbers of processes [%(default)s]")
    settings = parser.parse_args()
    programs = Programs(settings)
    ranks = [int(n) for n in settings.ranks.split(",")]
    with tempfile.TemporaryDirectory() as scratch:
        compare(programs, ranks, pathlib.Path(scratch))
        compare_parts(programs, ranks, pathlib.Path(scratch))
        refuse(programs, 2, pathlib.Path(scratch))
    print(f"{len(CASES)} cases on {settings.ranks} processes, {len(REFUSALS) + 1} failures: {programs.errors} errors")
    sys.exit(1 if programs.errors else 0)


if __name__ == "__main__":
    main()
