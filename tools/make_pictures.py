#!/usr/bin/env python3
"""Makes the pictures of the documentation: ./dev pictures.

usage: make_pictures.py PROGRAM [--collection FOLDER] [--only NAME...]

tools/pictures.toml says what each picture is. Needs matplotlib, pngquant, which makes pictures a fifth as large, and
Graphviz.
"""

import argparse
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[1]
IMAGES = ROOT / "docs/images"
WIDTH = 1000


def run(*command, **options):
    subprocess.run(list(map(str, command)), check=True, cwd=ROOT, **options)


def small(source, target, colors=16):
    """Writes a picture with so many colours."""
    run("pngquant", "--force", "--speed", 1, "--nofs", "-o", target, colors, source)
    print(target.relative_to(ROOT), f"{target.stat().st_size / 1000:.0f} kB", flush=True)


class Maker:
    def __init__(self, program, table, collection, scratch):
        self.program, self.table, self.collection, self.scratch = program, table, collection, scratch

    def arguments(self, text):
        """Returns the words of a command; nothing where they need a collection that is not there."""
        if "COLLECTION" in text and not self.collection:
            return None
        return text.replace("COLLECTION", str(self.collection)).split()

    def mesh(self, words, file):
        run(self.program, "mesh", *words, "--quiet", "-o", file, stderr=subprocess.DEVNULL)
        return file

    def named_mesh(self, name):
        """Returns the file of a mesh of the table, which is made once."""
        file = self.scratch / f"{name}.vtu"
        if name in self.table["commands"]:
            first, *commands = self.table["commands"][name]
            self.named_mesh(first)
            for command in commands if not file.exists() else ():
                words = [self.program if word == "lamina" else ROOT / word if word.startswith("tools/") else word
                         for word in command.split()]
                subprocess.run(words, check=True, cwd=self.scratch, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
            return file
        words = self.arguments(self.table["meshes"][name])
        if words is not None and not file.exists():
            self.mesh(words, file)
        return file if words is not None else None

    def plot(self, mesh, options, file, width=WIDTH):
        run(self.program, "plot", mesh, "-o", file, "--width", width, *options)
        return file

    def picture(self, name):
        mesh, options = self.table["pictures"][name]
        file = self.named_mesh(mesh)
        if file:
            small(self.plot(file, options.split(), self.scratch / f"{name}.png"), IMAGES / f"{name}.png",
                  64 if "--color" in options else 16)

    def sheet(self, name):
        """Draws the places of a sheet beside each other, with their names."""
        if not self.collection:
            return
        places = []
        for line in (ROOT / "tools/places.txt").read_text().splitlines():
            if not line.startswith("#"):
                sheet, place, window, files = line.split("|")
                if sheet == self.table["sheets"][name]:
                    places.append((place, window, files.split()))

        def drawn(entry):
            place, window, files = entry
            inputs = [file if file.startswith("naca:") else self.collection / file for file in files]
            mesh = self.mesh([*inputs, "--y-plus", "1", "--reynolds", "5e6", "--layers", "auto"],
                             self.scratch / f"{place}.vtu")
            return self.plot(mesh, ["--window", window], self.scratch / f"{place}.png")

        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            files = list(pool.map(drawn, places))
        self.beside_each_other(name, files, 3, [file.stem for file in files])

    def beside_each_other(self, name, files, columns, titles, colors=16):
        """Draws pictures in rows, with their titles below them."""
        import matplotlib.pyplot as plot
        rows = -(-len(files) // columns)
        figure, axes = plot.subplots(rows, columns, figsize=(15.2, 4.5 * rows), dpi=100, squeeze=False)
        for axis in axes.flat:
            axis.axis("off")
        for axis, file, title in zip(axes.flat, files, titles):
            axis.imshow(plot.imread(file), interpolation="lanczos")
            axis.set_title(title, y=-0.1, fontsize=13)
        figure.tight_layout()
        figure.savefig(self.scratch / f"{name}.png")
        small(self.scratch / f"{name}.png", IMAGES / f"{name}.png", colors)

    def row(self, name):
        """Draws several meshes beside each other."""
        options, *meshes = self.table["rows"][name]
        files = [self.plot(self.named_mesh(mesh), options.split(), self.scratch / f"{name}-{mesh}.png", 700)
                 for mesh, _ in meshes]
        self.beside_each_other(name, files, len(files), [title for _, title in meshes],
                               64 if "--color" in options else 16)

    def zoom(self, name):
        """Draws windows of a mesh, each a part of the one before: the first above, the others below it."""
        mesh, first, *others = self.table["zooms"][name]
        file = self.named_mesh(mesh)
        import matplotlib.pyplot as plot
        from matplotlib.patches import ConnectionPatch, Rectangle
        windows = [tuple(map(float, window.split(","))) for window in (first, *others)]
        figure = plot.figure(figsize=(12, 7.6), dpi=125)
        grid = figure.add_gridspec(2, len(others), height_ratios=[1.25, 1], hspace=0.03, wspace=0.03, left=0.004,
                                   right=0.996, top=0.996, bottom=0.004)
        axes = [figure.add_subplot(grid[0, :]), *(figure.add_subplot(grid[1, i]) for i in range(len(others)))]
        for i, (axis, window, text) in enumerate(zip(axes, windows, (first, *others))):
            picture = self.plot(file, ["--window", text, "--color", "size"], self.scratch / f"{name}-{i}.png",
                                1500 if i == 0 else 700)
            axis.imshow(plot.imread(picture), extent=window, interpolation="lanczos", aspect="auto")
            axis.set_xticks([])
            axis.set_yticks([])
            times = (windows[0][1] - windows[0][0]) / (window[1] - window[0])
            if i:
                axis.text(0.03, 0.95, f"{times:,.0f} times as near", transform=axis.transAxes, va="top", fontsize=12,
                          bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.9})
            if i + 1 < len(windows):
                x0, x1, y0, y1 = windows[i + 1]
                axis.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, fill=False, color="#d1451b", linewidth=2))
                corners = [((x0, y0), (0, 1)), ((x1, y0), (1, 1))] if i == 0 else [((x1, y1), (0, 1)),
                                                                                   ((x1, y0), (0, 0))]
                for corner, other in corners:
                    figure.add_artist(ConnectionPatch(corner, other, "data", "axes fraction", axesA=axis,
                                                      axesB=axes[i + 1], color="#d1451b", linewidth=1.2))
        figure.savefig(self.scratch / f"{name}.png")
        small(self.scratch / f"{name}.png", IMAGES / f"{name}.png", 64)

    def drawing(self, name):
        run("bash", "-euo", "pipefail", "-c", self.table["drawings"][name],
            env={**os.environ, "LAMINA": str(self.program), "PATH": f"{pathlib.Path(sys.executable).parent}:"
                                                                    f"{os.environ['PATH']}"})
        if name.endswith(".png"):
            small(IMAGES / name, IMAGES / name)
        else:
            print(f"docs/images/{name}", flush=True)

    def taken(self, name):
        command, file = self.table["taken"][name]
        if not file:
            return
        if (ROOT / file).is_file():
            small(ROOT / file, IMAGES / name, 64)
        else:
            print(f"docs/images/{name} is left: {file} is not there; {command} makes it", flush=True)


def require_rows(table):
    """Ends the program where a picture has no row in the table."""
    files = {f"{name}.png" for kind in ("pictures", "rows", "zooms", "sheets") for name in table[kind]}
    files |= {*table["drawings"], *table["taken"]}
    unlisted = sorted(path.name for path in IMAGES.iterdir() if path.name not in files and path.suffix != ".dot")
    if unlisted:
        sys.exit(f"tools/pictures.toml lacks {', '.join(unlisted)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--collection", type=pathlib.Path)
    parser.add_argument("--only", nargs="+", default=[])
    arguments = parser.parse_args()
    table = tomllib.loads((ROOT / "tools/pictures.toml").read_text())
    require_rows(table)
    if not shutil.which("pngquant"):
        sys.exit("make_pictures.py: pngquant is missing")
    with tempfile.TemporaryDirectory() as scratch:
        maker = Maker(arguments.program.resolve(), table,
                      arguments.collection and arguments.collection.resolve(), pathlib.Path(scratch))
        for kind, make in (("pictures", maker.picture), ("rows", maker.row), ("zooms", maker.zoom), ("sheets", maker.sheet),
                           ("drawings", maker.drawing), ("taken", maker.taken)):
            for name in table[kind]:
                if not arguments.only or name.partition(".")[0] in arguments.only:
                    make(name)


if __name__ == "__main__":
    main()
