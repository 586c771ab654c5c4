"""The Python of the pages runs: the blocks of a page one after the other, as a reader would type them."""

import importlib.util
import re
import shutil
import warnings

import numpy as np
import pytest

import lamina

PAGES = ["README.md", "docs/python.md", "docs/recipes/batch.md", "docs/recipes/morphing.md",
         "docs/reference/formats.md"]
# What pages name without making it first.
FILES = {"section.dat": "rae2822.dat", "slat.dat": "crmhl2d_slat.dat", "main.dat": "crmhl2d_main.dat",
         "flap.dat": "crmhl2d_flap.dat"}
MESHES = ["mesh.msh", "mesh.vtu"]


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
    pages = [page for page in [*repository.glob("*.md"), *repository.glob("docs/**/*.md"), repository / "web/README.md"]
             if "```python" in page.read_text()]
    assert sorted(str(page.relative_to(repository)) for page in pages) == sorted(PAGES)
