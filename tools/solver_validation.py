#!/usr/bin/env python3
"""Makes families of cases of OpenFOAM with lamina, runs them, and writes a page with tables and pictures.

  solver_validation.py LAMINA FOLDER PAGE [--levels N] [--jobs N] [--iterations N] [--high-lift SLAT MAIN FLAP]

FOLDER holds the cases. What is steady there already is not run again, so that an interrupted run goes on. PAGE is a
Markdown file; pictures go into the folder images beside it. Needs rhoSimpleFoam, NumPy and matplotlib.
"""
import argparse
import concurrent.futures
import csv
import datetime
import json
import os
import pathlib
import re
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

# NASA's Turbulence Modeling Resource, Spalart-Allmaras: NACA 0012 at Mach 0.15 and the 2-D CRM-HL at Mach 0.2. The
# lift of incompressible flow is less by Prandtl and Glauert's factor.
REFERENCES = {0: (None, 0.0082), 10: (1.0909, 0.0123), 15: (1.546, 0.0212)}
INCOMPRESSIBLE_REFERENCES = {0: (None, 0.0082), 10: (1.0786, 0.0123), 15: (1.5287, 0.0212)}
HIGH_LIFT_REFERENCE = (3.803, 0.0605)
SECTION, REYNOLDS, MACH, HIGH_LIFT_MACH = "naca:0012:extended", 6e6, 0.15, 0.2


class Study:
    """A family of cases at one angle of attack. Level `base` is what lamina makes of no further option; `run` of the
    levels are run, the coarsest first."""

    def __init__(self, title, name, inputs, reynolds, alpha, reference, levels, base, more=(), run=None):
        self.title, self.name, self.alpha, self.reference = title, name, alpha, reference
        self.arguments = [*inputs, "--reynolds", f"{reynolds:g}", "--alpha", f"{alpha:g}", *more]
        self.inputs, self.reynolds = inputs, reynolds
        self.count, self.base, self.run = levels, base, run or levels

    def make(self, program, folder):
        """Writes the cases."""
        self.cases = [folder / f"{self.name}_{level}" for level in range(self.count)]
        self.table = folder / f"{self.name}_family.csv"
        if not all(case.is_dir() for case in self.cases) or not self.table.exists():
            subprocess.run([program, "case", "openfoam", *self.arguments, "--levels", str(self.count), "--base-level",
                            str(self.base), "-o", str(folder / f"{self.name}_{{level}}"), "--overwrite", "--quiet"],
                           check=True)
        self.cases = self.cases[:self.run]

    def read(self):
        """Reads what the runs left: one dictionary per level."""
        with open(self.table, newline="") as file:
            rows = list(csv.DictReader(file))
        self.levels = []
        for case, row in zip(self.cases, rows):
            level = json.loads((case / "result.json").read_text())
            level.update(cells=int(row["cells"]), h=float(row["h_over_finest"]), mesh=mesh_check(case / "log.checkMesh"))
            self.levels.append(level)


def mesh_check(log):
    """Returns what checkMesh measured."""
    text = log.read_text()
    number = lambda pattern: float(re.search(pattern + r"\s*=?:?\s*([0-9.e+-]+)", text).group(1))
    return {"angle": number("non-orthogonality Max"), "skewness": number("Max skewness")}


def run_case(case, iterations):
    """Runs a case unless it has a result, and returns what to say about it."""
    if not (case / "result.json").exists():
        subprocess.run([case / "Allclean"], check=True)
        with open(case.with_suffix(".log"), "w") as log:
            code = subprocess.run([case / "Allrun"], stdout=log, stderr=subprocess.STDOUT,
                                  env={**os.environ, "ITERATIONS": str(iterations)}).returncode
        if code not in (0, 2):  # 2: not steady
            raise RuntimeError(f"{case}/Allrun ended with exit code {code}: see {case.with_suffix('.log')}")
    result = json.loads((case / "result.json").read_text())
    return f"{case.name}: CL {result['CL']:.5f}, CD {result['CD']:.6f}, {result['iterations']} iterations"


def order_and_limit(h, f):
    """Fits f = limit + c h^order to all levels by least squares, and returns order, limit and the fit's standard
    deviation, which is 0 for three levels; or None for fewer levels, and where the order is below a half or has no
    bound, from which nothing can be extrapolated. Eca and Hoekstra, J. Comput. Phys. 262, 2014."""
    lowest, highest, step = 0.5, 20.0, 0.01
    h, f = np.array(h), np.array(f)
    if len(h) < 3:
        return None

    def fit(order):
        matrix = np.stack([np.ones_like(h), h**order], axis=1)
        limit, factor = np.linalg.lstsq(matrix, f, rcond=None)[0]
        return np.sum((f - limit - factor * h**order) ** 2), order, limit

    squares, order, limit = min(fit(order) for order in np.arange(lowest, highest + step / 2, step))
    if not lowest < order < highest - step:
        return None
    return order, limit, np.sqrt(squares / (len(h) - 3)) if len(h) > 3 else 0.0


def wall_table(case):
    with open(case / "walls.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0] if name != "wall"}


def split_sides(table):
    """Returns the indices of the upper and the lower side of a symmetric section, each from its nose to its tail."""
    order = np.argsort(table["x"])
    return order[table["y"][order] > 0], order[table["y"][order] <= 0]


def potential_flow(program, study, folder, lift):
    """Returns the potential flow with this lift, as lamina flow computes it: x, pressure coefficient and skin friction
    of each side. Viscosity takes lift away, so the angle is smaller."""
    file = folder / f"{study.name}_flow.csv"

    def at(alpha):
        out = subprocess.run([program, "flow", *study.inputs, "--reynolds", f"{study.reynolds:g}", "--alpha",
                              f"{alpha:.6g}", "-o", str(file)], check=True, capture_output=True, text=True).stdout
        return float(re.search(r"lift coefficient ([-0-9.e]+)", out).group(1))

    alpha = study.alpha
    if alpha:
        for _ in range(3):  # lift grows with the sine of the angle
            alpha *= lift / at(alpha)
    else:
        at(0)
    with open(file, newline="") as table:
        rows = list(csv.DictReader(table))
    return alpha, {side: np.array([[float(row["x"]), float(row["cp"]), float(row["skin_friction"])] for row in rows
                                   if row["side"] == side]) for side in ("upper", "lower")}


def draw_walls(program, studies, folder, picture):
    """Draws pressure and skin friction of all levels over x, and beside them those of lamina flow."""
    figure, axes = plt.subplots(2, len(studies), figsize=(4.2 * len(studies), 7), squeeze=False)
    for column, study in enumerate(studies):
        alpha, flow = potential_flow(program, study, folder, study.levels[-1]["CL"])
        top, bottom = axes[0][column], axes[1][column]
        for k, case in enumerate(study.cases):
            table = wall_table(case)
            colour = plt.cm.viridis(0.85 * (1 - k / max(1, len(study.cases) - 1)))
            for n, side in enumerate(split_sides(table)):
                label = f"{study.levels[k]['cells']:,} cells" if n == 0 else None
                top.plot(table["x"][side], table["cp"][side], "-", color=colour, lw=1, label=label)
                along = np.hypot(table["cf_x"], table["cf_y"]) * np.sign(table["cf_x"])
                bottom.plot(table["x"][side], along[side], "-", color=colour, lw=1)
        for n, values in enumerate(flow.values()):
            top.plot(values[:, 0], values[:, 1], "k--", lw=0.8,
                     label=f"lamina flow, {alpha:.2f} degrees" if n == 0 else None)
            bottom.plot(values[:, 0], values[:, 2], "k--", lw=0.8)
        top.invert_yaxis()
        top.set_title(study.title, fontsize=10)
        bottom.set_ylim(-0.002, 0.02 if study.alpha else 0.01)
        bottom.set_xlabel("x / chord")
        for axis in (top, bottom):
            axis.grid(alpha=0.3)
        top.legend(fontsize=7)
    axes[0][0].set_ylabel("pressure coefficient")
    axes[1][0].set_ylabel("skin friction coefficient")
    figure.tight_layout()
    figure.savefig(picture, dpi=110)
    plt.close(figure)


def error(value, reference):
    return "" if reference is None else f" ({100 * (value / reference - 1):+.2f} %)"


def rows_of(study):
    """Returns the rows of the table for one family: its levels, the limit that a fit to them has, and the reference."""
    rows = []
    lift, drag = study.reference
    for level in study.levels:
        y_plus = max(wall["largest"] for wall in level["y_plus"].values())
        steady = "" if level["steady"] else " (mean)" if level["steady_in_the_mean"] else " (not steady)"
        mesh = level["mesh"]
        rows.append(f"| {study.title} | {level['cells']:,} | {level['h']:.3f} | "
                    f"{level['CL']:.4f}{error(level['CL'], lift)} | {level['CD']:.6f}{error(level['CD'], drag)} | "
                    f"{y_plus:.2f} | {level['iterations']}{steady} | {mesh['angle']:.1f} | {mesh['skewness']:.2f} |")
    cells = []
    for name, reference in (("CL", lift), ("CD", drag)):
        fit = order_and_limit([l["h"] for l in study.levels], [l[name] for l in study.levels]) if reference else None
        if fit is None:
            cells.append("")
            continue
        order, limit, deviation = fit
        cells.append(f"{limit:.6g}{error(limit, reference)}, order {order:.1f}" +
                     (f", deviation {100 * deviation / limit:.2f} %" if deviation else ""))
    if any(cells):
        rows.append(f"| | fit | 0 | {cells[0]} | {cells[1]} | | | | |")
    rows.append(f"| | reference | | {lift or 0} | {drag} | | | | |")
    return rows


def page(studies, picture, command, version):
    today = datetime.date.today().isoformat()
    lines = ["# Validation", "",
             f"`{command}` wrote this page on {today}, with {version}, from",
             "cases of `lamina case openfoam` with no options but those of the flow and `--levels`: rhoSimpleFoam where",
             "there is a Mach number, else simpleFoam. References are those of NASA's Turbulence Modeling Resource",
             "(Spalart-Allmaras, compressible; the lift of incompressible flow is theirs over Prandtl and Glauert's",
             "factor, the drag is theirs).", "",
             "| case | cells | h / finest | CL | CD | largest y+ | iterations | non-orthogonality | skewness |",
             "|---|---:|---:|---:|---:|---:|---:|---:|---:|"]
    for study in studies:
        lines += rows_of(study)
    lines += ["", "A fit is value = limit + c h^order by least squares over all levels (Eça and Hoekstra 2014), with its",
              "standard deviation where there are more than three; none is given below half an order. Runs end where",
              "drag and lift are [steady](recipes/solver-cases.md#openfoam), or steady in the mean, which is marked;",
              "\"not steady\": neither. The CRM-HL is the coarser of two levels. The last two columns are the largest",
              "values of checkMesh.", "", f"![Pressure and skin friction](images/{picture.name})", "",
              "Dashed is the potential flow with the integral boundary layer that lamina meshes by (`lamina flow`), at",
              "the angle that has the same lift. It ends where it finds the flow separated."]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--levels", type=int, default=3)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--iterations", type=int, default=4000)
    parser.add_argument("--high-lift", nargs=3, metavar=("SLAT", "MAIN", "FLAP"),
                        help="the 2-D CRM-HL, too, on the coarser of two levels")
    arguments = parser.parse_args()
    folder = arguments.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)

    base = arguments.levels - 1
    # The families at 10 degrees go beyond, to show the order.
    sections = [Study(f"NACA 0012, Mach {MACH}, {alpha} degrees", f"naca0012_{alpha}", [SECTION], REYNOLDS, alpha,
                      reference, arguments.levels + (alpha == 10), base, ["--mach", f"{MACH:g}"])
                for alpha, reference in REFERENCES.items()]
    studies = sections + [Study(f"NACA 0012, incompressible, {alpha} degrees", f"naca0012_{alpha}_incompressible",
                                [SECTION], REYNOLDS, alpha, reference, arguments.levels + (alpha == 10), base)
                          for alpha, reference in INCOMPRESSIBLE_REFERENCES.items()]
    if arguments.high_lift:
        studies.append(Study(f"CRM-HL, Mach {HIGH_LIFT_MACH}, 16 degrees", "crmhl", arguments.high_lift, 5e6, 16,
                             HIGH_LIFT_REFERENCE, 2, 1, ["--chord", "1", "--mach", f"{HIGH_LIFT_MACH:g}"], run=1))
    for study in studies:
        study.make(arguments.program, folder)
    # The finest take longest and go first.
    cases = sorted((case for study in studies for case in study.cases), key=lambda case: case.name[-1], reverse=True)
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for text in pool.map(lambda case: run_case(case, arguments.iterations), cases):
            print(text, flush=True)
    for study in studies:
        study.read()
    picture = arguments.page.parent / "images" / "validation-walls.png"
    picture.parent.mkdir(parents=True, exist_ok=True)
    draw_walls(arguments.program, sections, folder, picture)
    log = (sections[0].cases[-1] / "log.rhoSimpleFoam").read_text()
    version = "OpenFOAM " + re.search(r"OPENFOAM=(\S+)", log).group(1)
    command = "./dev test-solvers" + (" --high-lift SLAT MAIN FLAP" if arguments.high_lift else "")
    # The section that polar_validation.py writes stays.
    polars = arguments.page.read_text().partition("\n## Polars\n") if arguments.page.exists() else ("", "", "")
    arguments.page.write_text(page(studies, picture, command, version) + "".join(polars[1:]))
    print(f"wrote {arguments.page} and {picture}")


if __name__ == "__main__":
    sys.exit(main())
