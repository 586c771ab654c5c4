#!/usr/bin/env python3
"""What is each mechanism of the layer worth?

    ablate.py PROGRAM STRESS [FOLDER] [--only NAME,...] [--random COUNT] [--rows OUT] [--against ROWS]

PROGRAM and STRESS are lamina and lamina_stress built with LAMINA_ABLATION. Each mechanism, which the code names in
`uses("NAME")`, is left out of the meshes of the cases below. The page on standard output has a row of continuous figures
for each: how many meshes stay the same to the byte, and how the figures move on the mean and on the case on which they move
most. FOLDER adds cases of iced sections and of several elements. The meshes with all mechanisms are compared with figures
of an earlier run, tools/ablation.jsonl or ROWS, so that changes of any kind can be judged: `--only= --rows OUT` makes such
figures, and changes no mechanism. --random also meshes COUNT random configurations with all
mechanisms, without all those together that move nothing on the cases, and prints both results.
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

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
FLOW = ["--y-plus", "1", "--reynolds", "5e6", "--alpha", "4"]
AUTOMATIC = ["--first-height", "1e-5"]
FIXED = ["--first-height", "2e-6", "--growth", "1.2", "--layers", "25"]
QUADS = ["--layer-topology", "quads"]
KEPT = ["--surface", "keep"]

# The figures: title, and what makes them better: -1 smaller, 1 larger, 0 near 1.
FIGURES = {
    "triangles": -1,
    "cells made %": 1,
    "largest layer angle": -1,
    "area ratio 1 %": 1,
    "area ratio 50 %": 0,
    "area ratio 99 %": -1,
    "first heights off": -1,
    "uneven columns": -1,
    "largest step": -1,
    "smallest isotropic angle": 1,
    "isotropic angle 1 %": 1,
    "non-orthogonality": -1,
    "skewness": -1,
}


def naca_slot(width):
    """Returns two NACA 0012, of which the upper is this far above the lower where both are thickest."""
    return ["naca:0012", "naca:0012", "--names", "upper,lower", "--transform", f"lower:shift:0,{-0.12003 - width}"]


def plate_slot(folder, width):
    """Writes two plates that are this far apart, and returns their files."""
    files = []
    for name, below in (("upper", 0), ("lower", 0.02 + width)):
        along = [i / 100 for i in range(101)]
        points = [(1 - x, 0.02 - below) for x in along] + [(x, -below) for x in along]
        files.append(str(folder / f"{name}_{width}.dat"))
        pathlib.Path(files[-1]).write_text("".join([f"{name}\n", *(f"{x:.6f} {y:.6f}\n" for x, y in points)]))
    return files


def cases(folder, written):
    """Returns the files and options of each case by its name. Files that are missing are written to the second folder."""
    own = lambda *names: [str(ROOT / "examples/geometry" / f"{name}.dat") for name in names]
    crm = own("crmhl2d_slat", "crmhl2d_main", "crmhl2d_flap")
    found = {
        "naca 0012": (["naca:0012"], FLOW),
        "naca 0012, auto": (["naca:0012"], AUTOMATIC),
        "naca 4415, blunt": (["naca:4415:blunt"], FLOW),
        "rae 2822": (own("rae2822"), FLOW),
        "rae 2822, 25 layers": (own("rae2822"), FIXED),
        "rae 2822, quads": (own("rae2822"), FLOW + QUADS),
        "rae 2822, wake": (own("rae2822"), FLOW + ["--wake-layers", "yes"]),
        "crm-hl": (crm, FLOW),
        "crm-hl, quads": (crm, FLOW + QUADS),
        "crm-hl, 25 layers": (crm, FIXED),
        "rae 2822, kept": (own("rae2822"), FLOW + KEPT),
        "crm-hl, kept": (crm, FLOW + KEPT),
        "naca slot 1e-4": (naca_slot(1e-4), FLOW),
        "naca slot 1e-2": (naca_slot(1e-2), FLOW),
        "plate slot 1e-4, auto": (plate_slot(written, 1e-4), AUTOMATIC),
        "plate slot 1e-2, auto": (plate_slot(written, 1e-2), AUTOMATIC),
    }
    if folder:
        iced = lambda name: [str(folder / "special/iced" / f"iced_{name}.dat")]
        high_lift = [str(folder / "multielement" / f"30p30n_{name}_stl_mm.dat") for name in ("slat", "main", "flap")]
        found |= {
            "30p-30n": (high_lift, FLOW),
            "williams": ([str(folder / "multielement/williams_two_element.dat")], FLOW),
            "glc305": (iced("glc305_07250436"), FLOW),
            "glc305, 25 layers": (iced("glc305_07250436"), FIXED),
            "nlf414": (iced("nlf414_623"), FLOW),
            "lths": (iced("lths_12530"), FLOW),
            "lths, auto": (iced("lths_12530"), AUTOMATIC),
            "4415 iced": (iced("4415mod_8436"), FLOW),
            "lths 11342": (iced("lths_11342"), FLOW),
            "glc305, kept": (iced("glc305_07250436"), FLOW + KEPT),
            "23014 iced, quads": (iced("23014mod_25130"), FLOW + QUADS),
        }
    return found


def mechanisms():
    """Returns the names that the code uses."""
    names = []
    for path in sorted((ROOT / "src").rglob("*.cpp")):
        names += re.findall(r'\buses\("(\w+)"\)', path.read_text())
    return sorted(set(names))


def first_percentile(histogram):
    """Returns the 1st percentile of smallest angles that are counted in classes of 5 degrees."""
    total, below = sum(histogram), 0
    for i, count in enumerate(histogram):
        if below + count >= 0.01 * total:
            return 5 * (i + (0.01 * total - below) / count)
        below += count
    return 90.0


def faces_of_quads(path):
    """Returns the largest non-orthogonality, in degrees, and skewness of faces between quads of an SU2 file, as checkMesh
    measures them."""
    points, quads, lines = [], [], iter(path.read_text().splitlines())
    for line in lines:
        if line.startswith("NELEM="):
            for _ in range(int(line.split("=")[1])):
                words = next(lines).split()
                if words[0] == "9":
                    quads.append([int(word) for word in words[1:5]])
        elif line.startswith("NPOIN="):
            points = np.array([[float(word) for word in next(lines).split()[:2]] for _ in range(int(line.split("=")[1].split()[0]))])
    if not quads:
        return {}
    quads = np.array(quads)
    origins = points[quads[:, 0]]  # areas of cells 1e-6 long at coordinates of 1 would be those of rounding
    corners = points[quads] - origins[:, None]
    after = np.roll(corners, -1, axis=1)
    doubled = corners[..., 0] * after[..., 1] - after[..., 0] * corners[..., 1]
    areas = doubled.sum(axis=1)
    centres = origins + ((corners + after) * doubled[..., None]).sum(axis=1) / (3 * areas[:, None])
    edges = np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    owner = np.repeat(np.arange(len(quads)), 4)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    edges, owner = edges[order], owner[order]
    pairs = np.flatnonzero((edges[1:] == edges[:-1]).all(axis=1))
    a, b = centres[owner[pairs]], centres[owner[pairs + 1]]
    p, q = points[edges[pairs, 0]], points[edges[pairs, 1]]
    along, between = q - p, b - a
    normal = np.stack([along[:, 1], -along[:, 0]], axis=1)
    across = np.abs((normal * between).sum(axis=1))
    cosine = across / np.linalg.norm(normal, axis=1) / np.linalg.norm(between, axis=1)
    share = (normal * (0.5 * (p + q) - a)).sum(axis=1) / (normal * between).sum(axis=1)
    off = 0.5 * (p + q) - a - share[:, None] * between
    distance = np.linalg.norm(off, axis=1) + 1e-300
    extent = np.maximum(0.2 * np.linalg.norm(between, axis=1), np.abs((off * 0.5 * along).sum(axis=1)) / distance)
    return {
        "non-orthogonality": float(np.degrees(np.arccos(np.clip(cosine, 0, 1)).max())),
        "skewness": float((distance / extent).max()),
    }


def mesh(program, files, options, without):
    """Meshes a case without these mechanisms, and returns its figures, or why there is no mesh."""
    with tempfile.TemporaryDirectory() as folder:
        out, report = pathlib.Path(folder, "mesh.su2"), pathlib.Path(folder, "report.json")
        command = [program, "mesh", *files, *options, "--threads", "1", "--quiet", "--allow-defects"]
        environment = os.environ | {"LAMINA_WITHOUT": ",".join(without)}
        try:
            run = subprocess.run([*command, "-o", out, "--report", report], env=environment, capture_output=True,
                                 text=True, timeout=300)
        except subprocess.TimeoutExpired:
            return {"failed": "no end in 300 s"}
        if run.returncode:
            return {"failed": run.stderr.strip().splitlines()[-1]}
        results = json.loads(report.read_text())
        quality = results["quality"]
        layer, walls, isotropic, transition = (quality[k] for k in ("layer", "walls", "isotropic", "transition"))
        return {
            "hash": results["hash"],
            "triangles": results["triangles"] + 2 * results["quads"],
            "cells made %": 100 * results["layer_cells"]["share"],
            "largest layer angle": layer["max_angle_deg"],
            "area ratio 1 %": transition["p01_area_ratio"],
            "area ratio 50 %": transition["median_area_ratio"],
            "area ratio 99 %": transition["p99_area_ratio"],
            "first heights off": walls["first_cells"] * (1 - walls["share_of_kept_heights"]),
            "uneven columns": layer["border"]["uneven_columns"],
            "largest step": layer["border"]["max_step"],
            "smallest isotropic angle": isotropic["min_angle_deg"],
            "isotropic angle 1 %": first_percentile(isotropic["angle_histogram"]),
        } | (faces_of_quads(out) if "quads" in options else {})


def change(figure, before, after):
    """Returns by how much a figure moves: percents for triangles, else differences."""
    return 100 * (after / before - 1) if figure == "triangles" else after - before


def gain(figure, before, after):
    """Returns the change, of which more than 0 is better."""
    if FIGURES[figure] == 0:
        return abs(before - 1) - abs(after - 1)
    return FIGURES[figure] * change(figure, before, after)


def row(base, results):
    """Returns a row of the table: how many meshes are the same, and the mean and the largest change of each figure."""
    failed = [name for name, figures in results.items() if "failed" in figures]
    good = [name for name in results if name not in failed]
    same = sum(results[name]["hash"] == base[name]["hash"] for name in good)
    cells = [f"{same} of {len(results)}" + (f", failed: {', '.join(failed)}" if failed else "")]
    for figure in FIGURES:
        known = [name for name in good if figure in base[name]]
        changes = {name: change(figure, base[name][figure], results[name][figure]) for name in known}
        largest = max(known, key=lambda name: abs(changes[name]), default=None)
        if largest is None or abs(changes[largest]) < 0.005:
            cells.append("")
            continue
        mean = sum(gain(figure, base[name][figure], results[name][figure]) for name in known) / len(known)
        better = "+" if mean > 0 else "-"
        cells.append(f"{better} {sum(changes.values()) / len(known):+.2f}; {changes[largest]:+.2f} {largest}")
    return cells


def table(head, rows):
    """Returns a table in Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def compared(stored, base):
    """Returns the mean and the worst decile of each figure, stored and now, on the cases that both have."""
    rows = []
    for title, sets in (("stored", stored), ("now", base)):
        for statistic in ("mean", "worst decile"):
            cells = [f"{title}, {statistic}"]
            for figure, sign in FIGURES.items():
                values = [sets[case][figure] for case in base if figure in stored.get(case, {}) and figure in base[case]]
                worst = 90 if sign <= 0 else 10
                known = values and (np.mean(values) if statistic == "mean" else np.percentile(values, worst))
                cells.append(f"{known:.5g}" if values else "")
            rows.append(cells)
    return sorted(rows, key=lambda cells: cells[0].split(", ")[1])


def stored_figures(path):
    """Returns the figures of meshes with all mechanisms, by case, of rows that an earlier run wrote."""
    rows = [json.loads(line) for line in path.read_text().splitlines()]
    return {row["case"]: row for row in rows if not row["without"]}


def random_configurations(stress, count, without):
    """Returns what the random configurations become without these mechanisms."""
    environment = os.environ | {"LAMINA_WITHOUT": ",".join(without)}
    return subprocess.run([stress, str(count)], env=environment, capture_output=True, text=True).stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("stress")
    parser.add_argument("folder", nargs="?", type=pathlib.Path, help="holds multielement/ and special/iced/")
    parser.add_argument("--only", help="names, of which several joined by + are left out together")
    parser.add_argument("--random", type=int, default=0)
    parser.add_argument("--rows", type=pathlib.Path, help="writes all figures, one mesh a line, as JSON")
    parser.add_argument("--against", type=pathlib.Path, default=ROOT / "tools/ablation.jsonl",
                        help="rows of an earlier run, which the meshes with all mechanisms are compared with")
    with tempfile.TemporaryDirectory() as written:
        ablate(parser.parse_args(), pathlib.Path(written))


def ablate(options, written):
    """Prints the page; geometry that is no file yet is written to the folder."""
    inputs = cases(options.folder, written)
    tried = [""] + ([name for name in options.only.split(",") if name] if options.only is not None else mechanisms())
    jobs = [(name, case) for name in tried for case in inputs]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        figures = list(pool.map(lambda job: mesh(options.program, *inputs[job[1]], job[0].split("+")), jobs))
    results = {name: {} for name in tried}
    for (name, case), found in zip(jobs, figures):
        results[name][case] = found
        if options.rows:
            with options.rows.open("a") as file:
                file.write(json.dumps({"without": name, "case": case} | found) + "\n")
    base = results.pop("")
    if failed := {case: found["failed"] for case, found in base.items() if "failed" in found}:
        sys.exit(f"no mesh with all mechanisms: {failed}")
    print("The cases with all mechanisms:\n")
    print(table(["case", *FIGURES], [[case, *(f"{found[f]:.4g}" if f in found else "" for f in FIGURES)]
                                     for case, found in base.items()]))
    stored = {case: found for case, found in stored_figures(options.against).items() if case in base}
    print("The same figures, and those of an earlier run:\n")
    print(table(["", *FIGURES], compared(stored, base)))
    print("Since then: better (+) or worse (-), the mean change (percents of triangles), the largest:\n")
    print(table(["", "same bytes", *FIGURES], [["now", *row(stored, {case: base[case] for case in stored})]]))
    if not results:
        return
    print("Without one mechanism: better (+) or worse (-), the mean change (percents of triangles), the largest:\n")
    print(table(["without", "same bytes", *FIGURES], [[name, *row(base, found)] for name, found in results.items()]))
    idle = [name for name, found in results.items()
            if all("failed" not in f and f["hash"] == base[case]["hash"] for case, f in found.items())]
    print("They move nothing on these cases: " + (", ".join(idle) or "none") + "\n")
    if options.random:
        for without in ([], idle):
            print(f"{options.random} random configurations without {', '.join(without) or 'nothing'}:\n")
            print("```text\n" + random_configurations(options.stress, options.random, without) + "```\n")


if __name__ == "__main__":
    main()
