"""The Python of the pages runs: the blocks of a page one after the other, as a reader would type them."""

import ast
import contextlib
import importlib.util
import io
import json
import pathlib
import re
import shutil
import warnings

import numpy as np
import pytest

import lamina

PAGES = ["README.md", "docs/python.md", "docs/recipes/batch.md", "docs/recipes/morphing.md",
         "docs/reference/formats.md", "python/README.md"]
# What pages name without making it first.
FILES = {"section.dat": "rae2822.dat", "slat.dat": "crmhl2d_slat.dat", "main.dat": "crmhl2d_main.dat",
         "flap.dat": "crmhl2d_flap.dat"}
MESHES = ["mesh.msh", "mesh.vtu"]


NOTEBOOKS = sorted((pathlib.Path(__file__).resolve().parents[2] / "docs/notebooks").glob("*.ipynb"))


def names_of_readers():
    """Returns the variables that a reader is taken to have."""
    naca = lamina.naca("2412")
    points = np.random.default_rng(1).random((200, 2))
    grid = np.array([[x, y] for y in (-1, 0, 1, 2) for x in (-1, 0, 1, 2)], dtype=float)
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    return {"queries": 0.2 + 0.6 * points, "frame": square, "outer": square, "inner": 0.3 + 0.4 * square[::-1],
            "more_points": 2 + points, "np": np, "lamina": lamina, "coordinates": naca, "x": naca[:, 0], "y": naca[:, 1], "section": naca,
            "main": naca, "flap": 0.3 * naca + [1.02, -0.08], "files": ["naca:0012", "naca:2412"], "points": points,
            "segments": [[0, 1]], "grid": grid, "grid_triangles": lamina.delaunay(grid).triangles,
            "grid_sizes": np.full(len(grid), 0.2),
            # A reader would have an array; how long it must be is known only when the page comes to it.
            "sizes": lambda at: np.full(len(at), 0.2)}


@pytest.mark.parametrize("page", PAGES)
def test_blocks_run(page, repository, small, tmp_path, monkeypatch):
    for name, original in FILES.items():
        shutil.copy(repository / "examples/geometry" / original, tmp_path / name)
    for name in MESHES:
        small.write(tmp_path / name)
    if importlib.util.find_spec("pyvista") is None:  # 100 MB of packages
        monkeypatch.setattr(lamina.Mesh, "to_pyvista", lamina.Mesh.to_meshio)
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```python\n(.*?)^```$", (repository / page).read_text(), flags=re.M | re.S)
    assert blocks
    names = {}
    for block in blocks:
        names |= names_of_readers()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", lamina.MeshWarning)
            exec(compile(block, page, "exec"), names)


def test_no_page_is_left_out(repository):
    pages = [page for page in [*repository.glob("*.md"), *repository.glob("docs/**/*.md"), *repository.glob("*/README.md")]
             if "```python" in page.read_text()]
    assert sorted(str(page.relative_to(repository)) for page in pages) == sorted(PAGES)


def test_pages_of_registries_stand_alone(repository):
    """Where packages are shown, a link to a file of the clone leads nowhere."""
    for page in ("python/README.md", "web/README.md"):
        text = (repository / page).read_text()
        assert all(target.startswith("https://") for target in re.findall(r"\]\(([^)]*)\)", text)), page
    assert 'readme = "python/README.md"' in (repository / "pyproject.toml").read_text()


def text_shown(code, names):
    """Runs a cell, and returns what a notebook shows below it: what it prints, and its last value."""
    body = ast.parse(code).body
    last = body.pop() if body and isinstance(body[-1], ast.Expr) else None
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(ast.Module(body, []), "cell", "exec"), names)
        value = eval(compile(ast.Expression(last.value), "cell", "eval"), names) if last else None
    return printed.getvalue() + (repr(value) if value is not None else "")


def stored_text(cell):
    texts = ["".join(output.get("text", []) or output.get("data", {}).get("text/plain", []))
             for output in cell["outputs"] if output["output_type"] != "display_data"]
    return "".join(texts)


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_show_what_they_print(notebook, tmp_path, monkeypatch):
    """Numbers may be 3 % off those of the notebook: `./dev pictures` runs it anew."""
    plots = pytest.importorskip("matplotlib.pyplot")
    monkeypatch.chdir(tmp_path)
    number, names, shown, stored = re.compile(r"[\d,]*\d(?:\.\d+)?(?:e[-+]?\d+)?"), {}, [], []
    for cell in json.loads(notebook.read_text())["cells"]:
        if cell["cell_type"] == "code":
            shown.append(text_shown("".join(cell["source"]), names).strip())
            stored.append(stored_text(cell).strip())
    plots.close("all")
    assert [number.sub("#", text) for text in shown] == [number.sub("#", text) for text in stored]
    values = [[float(found.replace(",", "")) for text in texts for found in number.findall(text)]
              for texts in (shown, stored)]
    assert len(values[0]) >= 4
    np.testing.assert_allclose(*values, rtol=0.03, atol=0.002)
    pictures = [output for cell in json.loads(notebook.read_text())["cells"] for output in cell.get("outputs", [])
                if "image/png" in output.get("data", {})]
    assert len(pictures) >= 3


def test_there_are_notebooks():
    assert len(NOTEBOOKS) == 2
