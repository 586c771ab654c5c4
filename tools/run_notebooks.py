#!/usr/bin/env python3
"""Runs the notebooks of docs/notebooks, and keeps what comes out with small pictures: ./dev pictures.

usage: run_notebooks.py [NAME...]

Needs nbclient, ipykernel, matplotlib and pngquant, and the Python package. Nothing is kept of who ran them, and when.
"""

import base64
import pathlib
import re
import subprocess
import sys
import tempfile

import nbclient
import nbformat

FOLDER = pathlib.Path(__file__).resolve().parents[1] / "docs/notebooks"


def small(picture):
    """Returns a PNG in base64 with 32 colours."""
    run = subprocess.run(["pngquant", "--speed", "1", "--nofs", "32", "-"], input=base64.b64decode(picture), check=True,
                         capture_output=True)
    return base64.b64encode(run.stdout).decode()


def run(file):
    notebook = nbformat.read(file, as_version=4)
    with tempfile.TemporaryDirectory() as folder:
        nbclient.NotebookClient(notebook, resources={"metadata": {"path": folder}}).execute()
    notebook.metadata = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"},
                         "language_info": {"name": "python"}}
    for number, cell in enumerate(notebook.cells):
        cell.id, cell.metadata = f"cell-{number}", {}
        for output in cell.get("outputs", []):
            data = output.get("data", {})
            if "image/png" in data:
                data["image/png"] = small(data["image/png"])
            if "text/html" in data:
                data["text/html"] = re.sub("(?<=data:image/png;base64,)[A-Za-z0-9+/=]+", lambda found: small(found[0]),
                                           data["text/html"])
            output.get("metadata", {}).clear()
    nbformat.validate(notebook)
    nbformat.write(notebook, file)
    print(file.relative_to(FOLDER.parents[1]), f"{file.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    for path in sorted(FOLDER.glob("*.ipynb")):
        if path.stem in sys.argv[1:] or len(sys.argv) == 1:
            run(path)
