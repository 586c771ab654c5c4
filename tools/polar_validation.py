#!/usr/bin/env python3
"""Computes polars with OpenFOAM, on one mesh that serves all angles and on a mesh for each, and compares them.

  polar_validation.py LAMINA FOLDER PAGE FX63137 LS417 SLAT MAIN FLAP [--only NAME...] [--jobs N] [--iterations N]

The last five are coordinates of the sections FX 63-137 and LS(1)-0417 and of the three elements of the CRM-HL. FOLDER
holds the cases. What is there already is not run again, so that an interrupted run goes on. Forces are stored in
polars.json beside this file: with --only the others keep what is there. The section "Polars" of PAGE, a Markdown file,
is written anew; a picture goes into the folder images beside it. Needs simpleFoam, NumPy and matplotlib.
"""
import argparse
import concurrent.futures
import csv
import datetime
import json
import os
import pathlib
import subprocess
import sys
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from solver_validation import run_case

# C. L. Ladson, NASA TM 4074 (1988): NACA 0012, Re 6e6, transition fixed by grit of number 80. Angle, CL, CD; from
# NASA's Turbulence Modeling Resource.
LADSON = [(-0.05, -0.0126, 0.00809), (2.05, 0.2125, 0.00816), (4.04, 0.4316, 0.00823), (6.09, 0.6546, 0.00885),
          (8.3, 0.8873, 0.0105), (10.12, 1.0707, 0.01201), (11.13, 1.1685, 0.01239), (12.12, 1.2605, 0.01332),
          (13.08, 1.3455, 0.01503), (14.22, 1.4365, 0.01625), (15.26, 1.5129, 0.019), (16.3, 1.5739, 0.02218)]
HEADING = "## Polars"
HIGH_LIFT_VERTICES = 60000
STORED = pathlib.Path(__file__).with_name("polars.json")


class Polar:
    """A section with its angles: first, last and step of one mesh, and those that have a mesh of their own."""

    def __init__(self, title, name, inputs, reynolds, angles, own_angles, more=(), experiment=(), trip=None):
        self.title, self.name, self.angles, self.own_angles = title, name, angles, own_angles
        self.experiment, self.trip = experiment, trip
        self.arguments = [*map(str, inputs), "--reynolds", f"{reynolds:g}", *more]
        self.reynolds = reynolds

    def run_on_one_mesh(self, program, folder):
        """Returns what to say about the polar on one mesh."""
        first, last, step = self.angles
        out = folder / f"{self.name}_one"
        code = run([program, "polar", *self.arguments, "--solver", "openfoam", "--alpha", f"{first}:{last}:{step}",
                    "-o", out], folder / f"{self.name}_one.log")
        if code not in (0, 4):  # 4: some angle is not steady, and its row says so
            raise RuntimeError(f"{out}.log: exit code {code}")
        return f"{self.title}: one mesh, {len(self.read_one_mesh(folder))} angles"

    def run_own_mesh(self, program, folder, alpha, iterations):
        """Returns what to say about one angle on its own mesh."""
        case = folder / f"{self.name}_{alpha}"
        command = [program, "case", "openfoam", *self.arguments, "--alpha", f"{alpha}", "-o", case]
        if not case.is_dir() and run(command, folder / f"{self.name}_{alpha}.log"):
            raise RuntimeError(f"{case}.log: no case")
        return f"{self.title} on its own mesh: {run_case(case, iterations)}"

    def read(self, folder, iterations):
        """Returns what is stored of the runs in this folder."""
        return {"date": datetime.date.today().isoformat(), "iterations": iterations,
                "one": self.read_one_mesh(folder), "own": self.read_own_mesh(folder)}

    def read_one_mesh(self, folder):
        """Returns the rows of the polar on one mesh by angle."""
        with open(folder / f"{self.name}_one" / "polar.csv", newline="") as file:
            rows = [row for row in csv.DictReader(file) if row["CL"]]
        return {f"{float(row['alpha']):g}": {"CL": float(row["CL"]), "CD": float(row["CD"]),
                                               "steady": row["state"] == "steady"} for row in rows}

    def read_own_mesh(self, folder):
        """Returns the results on meshes of their own by angle."""
        results = {}
        for alpha in self.own_angles:
            file = folder / f"{self.name}_{alpha}" / "result.json"
            if file.exists():
                result = json.loads(file.read_text())
                results[f"{alpha:g}"] = {"CL": result["CL"], "CD": result["CD"],
                                         "steady": result["steady"] or result["steady_in_the_mean"]}
        return results

    def flow(self, program, folder):
        """Returns angles, CL and CD by lamina's own flow, where it finds one."""
        first, last, step = self.angles
        out = folder / f"{self.name}_flow"
        trip = ["--trip", self.trip] if self.trip else []
        run([program, "polar", *self.arguments, *trip, "--alpha", f"{first}:{last}:{step}", "-o", out],
            folder / f"{self.name}_flow.log")
        with open(out / "polar.csv", newline="") as file:
            rows = [row for row in csv.DictReader(file) if row["steady"] == "yes"]
        return [(float(row["alpha"]), float(row["CL"]), float(row["CD"])) for row in rows]


def run(command, log):
    """Runs a command with its output at the end of a file, and returns its exit code."""
    with open(log, "a") as file:
        return subprocess.run([str(word) for word in command], stdout=file, stderr=subprocess.STDOUT).returncode


def table(polars, results):
    """Returns the lines of the table: at each angle the forces on one mesh, and how far they are from those of its own
    mesh."""
    lines = ["| section | angle | one mesh: CL | CD | own mesh: CL | CD | CL | CD |",
             "|---|---:|---:|---:|---:|---:|---:|---:|"]
    mark = lambda result: "" if result["steady"] else " (not steady)"
    for polar in polars:
        one, own = results[polar.name]["one"], results[polar.name]["own"]
        for alpha in polar.own_angles:
            alpha = f"{alpha:g}"
            if alpha not in one or alpha not in own:
                lines.append(f"| {polar.title} | {alpha} | no result | | | | | |")
                continue
            a, b = one[alpha], own[alpha]
            lift = f"{100 * (a['CL'] / b['CL'] - 1):+.2f} %" if abs(b["CL"]) > 0.01 else f"{a['CL'] - b['CL']:+.4f}"
            lines.append(f"| {polar.title} | {alpha} | {a['CL']:.4f} | {a['CD']:.6f}{mark(a)} | {b['CL']:.4f} | "
                         f"{b['CD']:.6f}{mark(b)} | {lift} | {100 * (a['CD'] / b['CD'] - 1):+.2f} % |")
    return lines


def draw(polars, results, program, folder, picture):
    """Draws lift over the angle, and drag over lift."""
    figure, axes = plt.subplots(2, len(polars), figsize=(3.6 * len(polars), 7), squeeze=False)
    for column, polar in enumerate(polars):
        top, bottom = axes[0][column], axes[1][column]

        def plot(points, style, label):
            top.plot([p[0] for p in points], [p[1] for p in points], style, label=label, ms=5, lw=1, mfc="none")
            bottom.plot([p[1] for p in points], [p[2] for p in points], style, label=label, ms=5, lw=1, mfc="none")

        points_of = lambda rows: sorted((float(alpha), row["CL"], row["CD"]) for alpha, row in rows.items())
        one, own = results[polar.name]["one"], results[polar.name]["own"]
        plot(points_of(one), "o-", "OpenFOAM, one mesh")
        plot(points_of(own), "x", "OpenFOAM, a mesh for each angle")
        plot(polar.flow(program, folder), "k--",
             f"lamina flow, transition at {polar.trip} chords" if polar.trip else "lamina flow, free transition")
        if polar.experiment:
            plot(polar.experiment, "s", "Ladson, 80 grit")
        top.set_title(f"{polar.title}, Re {polar.reynolds:g}", fontsize=10)
        top.set_xlabel("angle of attack, degrees")
        bottom.set_xlabel("CL")
        bottom.set_ylim(0, 1.15 * max(row["CD"] for row in own.values()))
        for axis in (top, bottom):
            axis.grid(alpha=0.3)
        bottom.legend(fontsize=7)
    axes[0][0].set_ylabel("CL")
    axes[1][0].set_ylabel("CD")
    figure.tight_layout()
    figure.savefig(picture, dpi=100)
    plt.close(figure)


def section(polars, results, picture):
    """Returns the section of the page."""
    runs = [f"{polar.title} {results[polar.name]['date']}, {results[polar.name]['iterations']:,}" for polar in polars]
    text = ("`./dev test-polars FX63137 LS417 SLAT MAIN FLAP` wrote this section: simpleFoam with Spalart and "
            "Allmaras's model, turbulent from the nose on. On one mesh (`lamina polar --solver openfoam`) each angle "
            "begins with the flow of the one before; on meshes of their own (`lamina case openfoam`) each begins from "
            "rest. The last two columns say how far the former are from the latter. Days of the runs, and their most "
            f"iterations: {'; '.join(runs)}. The meshes of the CRM-HL have {HIGH_LIFT_VERTICES:,} vertices.")
    lines = [HEADING, "", textwrap.fill(text, 118), ""]
    lines += table(polars, results)
    lines += ["", f"![Lift over the angle, and drag over lift](images/{picture.name})", "",
              "Experiment: C. L. Ladson, NASA TM 4074 (1988), as NASA's Turbulence Modeling Resource gives it."]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("page", type=pathlib.Path)
    for name in ("fx63137", "ls417", "slat", "main", "flap"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--only", nargs="+", metavar="NAME",
                        help="run these alone: naca0012 naca4412 fx63137 ls417 crmhl")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--iterations", type=int, default=3000)
    arguments = parser.parse_args()
    folder = arguments.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    os.environ["ITERATIONS"] = str(arguments.iterations)  # of Allrun

    angles, own = (0, 16, 2), (0, 4, 8, 10, 12, 14, 16)
    polars = [Polar("NACA 0012", "naca0012", ["naca:0012"], 6e6, angles, own, experiment=LADSON, trip="0.05"),
              Polar("NACA 4412", "naca4412", ["naca:4412"], 3e6, angles, own, trip="0.05"),
              Polar("FX 63-137", "fx63137", [arguments.fx63137], 1e6, angles, own, trip="0.05"),
              Polar("LS(1)-0417", "ls417", [arguments.ls417], 6e6, angles, own, trip="0.05"),
              Polar("CRM-HL", "crmhl", [arguments.slat, arguments.main, arguments.flap], 5e6, (4, 16, 4),
                    (4, 8, 12, 16), ["--chord", "1", "--vertices", f"{HIGH_LIFT_VERTICES}"])]
    chosen = [polar for polar in polars if not arguments.only or polar.name in arguments.only]
    tasks = []
    for polar in chosen:
        tasks.append(lambda polar=polar: polar.run_on_one_mesh(arguments.program, folder))
        tasks += [lambda polar=polar, alpha=alpha: polar.run_own_mesh(arguments.program, folder, alpha,
                                                                              arguments.iterations)
                  for alpha in polar.own_angles]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for text in pool.map(lambda task: task(), tasks):
            print(text, flush=True)
    picture = arguments.page.parent / "images" / "validation-polars.png"
    results = json.loads(STORED.read_text()) if STORED.exists() else {}
    for polar in chosen:
        results[polar.name] = polar.read(folder, arguments.iterations)
    STORED.write_text(json.dumps(results, indent=1) + "\n")
    draw(polars, results, arguments.program, folder, picture)
    before = arguments.page.read_text().split(f"\n{HEADING}\n")[0]
    arguments.page.write_text(before + "\n" + section(polars, results, picture))
    print(f"wrote {arguments.page} and {picture}")


if __name__ == "__main__":
    sys.exit(main())
