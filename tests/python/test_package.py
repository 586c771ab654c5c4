"""The package as a whole: options, stubs, documentation and examples."""

import inspect
import os
import pathlib
import runpy
import subprocess
import sys

import numpy as np
import pytest

import lamina
from lamina import _options, _stubs


def test_stub_is_current(repository):
    assert (repository / "python/lamina/_meshing.pyi").read_text() == _stubs.stub(), \
        "run: python -m lamina._stubs > python/lamina/_meshing.pyi (./dev docs does)"


def test_options_are_those_of_the_program(repository):
    page = (repository / "docs/options.md").read_text()
    of_program = {line.split("`")[1].lstrip("-").split()[0].replace("-", "_") for line in page.splitlines()
                  if line.startswith("| `--")}
    of_run = {"format", "parts", "span", "span_cells", "span_ends", "wall_distance", "wall_data", "report", "html", "stream",
              "progress", "quiet", "strict"}
    assert set(_options.option_rows()) == of_program - of_run


def test_every_default_can_be_given():
    """Each default is a value that the option takes, alone."""
    for key, row in _options.option_rows().items():
        if row["default"] in (None, [], "") or key == "threads":
            continue
        value = row["default"]
        options = {key: value}
        if key in ("far_field", "first_height", "y_plus"):
            options["preset"] = "none"
        lamina.mesh("naca:0012", **{"layers": 5, "first_height": 1e-3, **options})


def test_signature_and_help():
    parameters = inspect.signature(lamina.mesh).parameters
    assert set(_options.option_rows()) | {"sections", "progress"} == set(parameters)
    for key in _options.option_rows():
        assert f"  {key}: " in lamina.mesh.__doc__


def test_everything_public_is_described():
    for name in lamina.__all__:
        thing = getattr(lamina, name)
        assert isinstance(thing, str) or inspect.getdoc(thing), name
        if inspect.isclass(thing):
            for member, value in vars(thing).items():
                if not member.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)):
                    assert inspect.getdoc(value), f"{name}.{member}"


def test_the_tour_names_every_function():
    functions = {name for name in lamina.__all__ if inspect.isfunction(getattr(lamina, name))}
    assert functions - set(lamina.__doc__.replace(",", " ").split()) == set()


def test_version(program):
    version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout
    assert lamina.__version__ in version


def test_versions_agree(repository):
    written = {"CITATION.cff": f"version: {lamina.__version__}", "web/package.json": f'"version": "{lamina.__version__}"',
               "packaging/vcpkg/vcpkg.json": f'"version": "{lamina.__version__}"'}
    for file, text in written.items():
        assert text in (repository / file).read_text(), file


#: What examples are called with so that they take seconds.
ARGUMENTS = {"data_set": ["--sections", "5", "--jobs", "2"], "graphs": ["--meshes", "3"]}
#: That of PyTorch is a part of test_morph.py.
EXAMPLES = sorted(path for path in (pathlib.Path(__file__).resolve().parent.parent.parent / "examples/python").glob("*.py")
                  if path.stem != "morphing_in_torch")


def test_there_are_examples():
    assert EXAMPLES


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_example(example, tmp_path):
    run = subprocess.run([sys.executable, str(example), *ARGUMENTS.get(example.stem, [])], cwd=tmp_path,
                         env={**os.environ, "MPLBACKEND": "Agg"}, capture_output=True, text=True, timeout=120)
    assert run.returncode == 0, run.stderr
    assert any(tmp_path.iterdir()) or "is not installed" in run.stdout, "an example leaves files"
    for mesh in tmp_path.glob("*.su2"):
        assert lamina.check(lamina.read(mesh)).valid


def arrays_of(archive):
    """Returns the arrays of a NumPy archive or of an HDF5 file."""
    if archive.suffix == ".npz":
        return dict(np.load(archive))
    import h5py

    with h5py.File(archive) as file:
        return {name: item.asstr()[:] if item.dtype.kind == "S" else item[:] for name, item in file.items()}


@pytest.mark.parametrize("suffix", ["npz", "h5"])
def test_data_set(repository, tmp_path, suffix):
    """The archive holds walls and layers that stack, and meshes that are valid and the program's."""
    if suffix == "h5":
        pytest.importorskip("h5py")
    example = runpy.run_path(str(repository / "examples/python/data_set.py"))
    archive = tmp_path / f"sections.{suffix}"
    subprocess.run([sys.executable, str(repository / "examples/python/data_set.py"), "--sections", "4", "--jobs", "2",
                    "--seed", "7", "-o", str(archive)], check=True, capture_output=True, timeout=120)
    data = arrays_of(archive)
    assert list(data["name"]) == [f"cst{s:05d}" for s in range(4)] and len(data["failed"]) == 0
    rays = example["POINTS"] + 36  # the fan of half a turn, 5 degrees apart, has 37 in place of one
    assert data["wall"].shape == (4, example["POINTS"], 2)
    assert data["layer"].shape == (4, rays, example["LAYERS"] + 1, 2)
    heights = np.linalg.norm(data["layer"][:, :, 1] - data["layer"][:, :, 0], axis=2)
    assert np.allclose(heights, example["OPTIONS"]["first_height"], rtol=0.02)
    for s, name in enumerate(data["name"]):
        mesh = lamina.mesh(example["outline"](data["coefficients"][s]), **example["OPTIONS"])
        part = {key: slice(data[f"first_{key[:-1]}"][s], data[f"first_{key[:-1]}"][s + 1])
                for key in ("points", "triangles", "quads")}
        for key, range_ in part.items():
            assert np.array_equal(data[key][range_], getattr(mesh, key))
        assert np.array_equal(data["wall"][s], mesh.points[mesh.wall.vertex])
        assert mesh.quality().valid
