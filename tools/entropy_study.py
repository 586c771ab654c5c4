#!/usr/bin/env python3
"""Runs inviscid flow round a circular cylinder in PyFR on curved and on straight meshes, and draws the entropy error.

  entropy_study.py LAMINA FOLDER PICTURE [--levels N] [--orders 1,2,3] [--times T]

Entropy is the same everywhere in this flow: what a solver makes of it is its error. FOLDER holds the cases, and what
ran there already does not run again. Needs pyfr 3.1 in PATH, with libxsmm for its OpenMP backend, matplotlib and pngquant.
"""
import argparse
import csv
import math
import pathlib
import subprocess

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

MACH, GAMMA = 0.2, 1.4
RADIUS = 0.5
NEAR = 1.5  # half-width of the box in which errors are measured, in diameters

# The compressible flow of constant entropy and total enthalpy whose velocity is that of the potential flow.
CASE = """[backend]
precision = double

[constants]
gamma = {gamma}

[solver]
system = euler
order = {order}

[solver-time-integrator]
scheme = rk45
controller = pi
tstart = 0
tend = {end}
dt = 1e-4
atol = 1e-6
rtol = 1e-6

[solver-interfaces]
riemann-solver = hllc

[solver-interfaces-line]
flux-pts = gauss-legendre

[solver-elements-tri]
soln-pts = williams-shunn

[solver-elements-quad]
soln-pts = gauss-legendre

[soln-ics]
rho = {density}
u = {u}
v = {v}
p = pow({density}, gamma)/gamma

[soln-bcs-airfoil]
type = slp-adia-wall

[soln-bcs-farfield]
type = char-riem-inv
rho = 1
u = {mach}
v = 0
p = {pressure}

[soln-plugin-nancheck]
nsteps = 50

[soln-plugin-integrate-entropy]
nsteps = 50
file = entropy.csv
quad-deg = {degree}
region = box((-{near}, -{near}), ({near}, {near}))
int-error = pow(gamma*p*pow(rho, -gamma) - 1, 2)

[soln-plugin-writer]
basename = flow-{{t:.6g}}
dt-out = {end}
"""


def potential_flow():
    """Returns density, u and v of the flow as expressions of x and y, with the speed of sound 1 far away."""
    radius_2 = "(x*x + y*y)"
    ratio = f"({RADIUS**2}/{radius_2})"
    u = f"{MACH}*(1 - {ratio}*(x*x - y*y)/{radius_2})"
    v = f"{MACH}*(-2*{ratio}*x*y/{radius_2})"
    sound_2 = f"(1 + {(GAMMA - 1) / 2}*({MACH**2} - pow({u}, 2) - pow({v}, 2)))"
    return f"pow({sound_2}, {1 / (GAMMA - 1)})", u, v


def write_circle(file):
    points = [2 * math.pi * i / 4000 for i in range(4000)] + [0]
    file.write_text("circle\n" + "".join(f"{RADIUS * math.cos(a):.17g} {RADIUS * math.sin(a):.17g}\n" for a in points))


def make_case(lamina, circle, level, order, case):
    """Writes a case whose edges are half as long on each next level. Its mesh alone is used: that of a case of PyFR."""
    finer = 2**level
    subprocess.run([lamina, "case", "pyfr", circle, "--surface-points", str(16 * finer), "--spacing-max", "0.3",
                    "--far-field", "15", "--far-field-shape", "circle", "--gradation", str(0.6 / finer), "--first-height",
                    str(0.1 / finer), "--layers", str(2 * finer), "--growth", str(1.4 ** (1 / finer)), "--max-ray-angle",
                    "40", "--order", str(order), "--reynolds", "100", "--mach", str(MACH), "--use-flow", "no", "-o", case,
                    "--overwrite", "--quiet"], check=True, stderr=subprocess.DEVNULL)


def run_case(lamina, circle, folder, level, order, curved, times):
    """Runs a case unless it has a result. Returns the number of cells and the root of the mean square of the error in the
    last quarter of all times, which is infinite where the flow diverged."""
    case = folder / f"{'curved' if curved else 'straight'}-{order}-{level}"
    end = times * 2 * RADIUS / MACH
    if not (case / "log").exists():
        make_case(lamina, circle, level, order if curved else 1, case)
        density, u, v = potential_flow()
        (case / "case.ini").write_text(CASE.format(gamma=GAMMA, order=order, end=end, density=density, u=u, v=v, mach=MACH,
                                                   pressure=1 / GAMMA, degree=2 * order + 4, near=NEAR))
        with open(case / "log", "w") as log:
            for command in (["import", "mesh.msh", "mesh.pyfrm"], ["run", "-b", "openmp", "mesh.pyfrm", "case.ini"]):
                subprocess.run(["pyfr", *command], cwd=case, stdout=log, stderr=subprocess.STDOUT)
    with open(case / "entropy.csv", newline="") as file:
        rows = [(float(row["t"]), float(row["int-error"])) for row in csv.DictReader(file)]
    late = [error for time, error in rows if time > 0.75 * end]
    area = (2 * NEAR) ** 2 - math.pi * RADIUS**2
    lines = (case / "mesh.msh").read_text().split("$Elements\n")[1].split("\n")[1:]
    cells = sum(1 for line in lines if len(line.split()) > 2 and int(line.split()[1]) not in (1, 8, 26, 27))
    has_ended = (case / f"flow-{end:.6g}.pyfrs").exists()
    return cells, math.sqrt(sum(late) / len(late) / area) if has_ended else math.inf


def draw(results, folder, picture):
    """Draws the errors of orders that diverged nowhere, with the rate at which they fall from the coarsest mesh to the
    finest."""
    figure, axes = plt.subplots(figsize=(7.5, 4.6))
    for (order, curved), rows in results.items():
        if not all(math.isfinite(error) for _, error in rows):
            continue
        cells, errors = zip(*rows)
        rate = math.log2(errors[0] / errors[-1]) / (len(rows) - 1)
        axes.loglog(cells, errors, "o-" if curved else "x--", color=f"C{order}",
                    label=f"order {order}, {'curved' if curved else 'straight'} cells: rate {rate:.1f}")
    axes.set_xticks(cells, [f"{n:,}" for n in cells])
    axes.minorticks_off()
    axes.set_xlabel("cells")
    axes.set_ylabel("entropy error within 1.5 diameters")
    axes.set_title(f"Inviscid flow round a cylinder, Mach {MACH}", fontsize=10)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8, loc="center left", bbox_to_anchor=(1, 0.5))
    figure.tight_layout()
    figure.savefig(folder / "entropy.png", dpi=110)
    subprocess.run(["pngquant", "--force", "--speed", "1", "--nofs", "-o", picture, "16", folder / "entropy.png"],
                   check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lamina", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("picture", type=pathlib.Path)
    parser.add_argument("--levels", type=int, default=3)
    parser.add_argument("--orders", default="1,2,3")
    parser.add_argument("--times", type=float, default=4, help="diameters that the stream goes")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    circle = arguments.folder.resolve() / "circle.dat"
    write_circle(circle)
    results = {}
    for order in map(int, arguments.orders.split(",")):
        for curved in (True, False) if order > 1 else (False,):
            rows = results[order, curved] = []
            for level in range(arguments.levels):
                rows.append(run_case(arguments.lamina.resolve(), circle, arguments.folder, level, order, curved,
                                     arguments.times))
                rate = math.log2(rows[-2][1] / rows[-1][1]) if level and math.isfinite(rows[-2][1]) else math.nan
                print(f"order {order}, {'curved' if curved else 'straight'} cells: {rows[-1][0]} cells, error "
                      f"{rows[-1][1]:.3e}, rate {rate:.2f}", flush=True)
    draw(results, arguments.folder, arguments.picture)


if __name__ == "__main__":
    main()
