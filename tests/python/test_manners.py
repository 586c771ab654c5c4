"""Errors, arguments, progress and types as Python programs expect them."""

import errno
import importlib.util
import pickle
import re
import subprocess
import sys
import warnings

import numpy as np
import pytest

import lamina

OPTIONS = {"preset": "euler", "gradation": 0.4, "surface_points": 60}


def test_missing_files_are_those_of_python(tmp_path, small):
    for call in (lambda: lamina.mesh(tmp_path / "none.dat"), lambda: lamina.read(tmp_path / "none.su2"),
                 lambda: small.write(tmp_path / "no" / "folder.su2")):
        with pytest.raises(FileNotFoundError) as caught:
            call()
        error = caught.value
        assert isinstance(error, lamina.IoError) and error.errno == errno.ENOENT and error.exit_code == 5
        assert error.filename == error.file and str(tmp_path) in error.filename and str(error).startswith(error.filename)
        again = pickle.loads(pickle.dumps(error))
        assert (type(again), str(again), again.errno, again.filename) == (type(error), str(error), error.errno, error.filename)
    (tmp_path / "folder.dat").mkdir()
    with pytest.raises(IsADirectoryError):
        lamina.mesh(tmp_path / "folder.dat")


@pytest.mark.parametrize("wrong", [5, None, 3.5, object()])
def test_wrong_types_are_named(wrong):
    for call in (lamina.mesh, lamina.delaunay, lambda value: lamina.mesh("naca:0012", growth=object())):
        with pytest.raises(TypeError) as caught:
            call(wrong)
        assert isinstance(caught.value, lamina.Error)
        assert re.search("int|NoneType|float|object", str(caught.value))
    with pytest.raises(lamina.InputError, match="shape"):
        lamina.mesh([[0, 0], [1, [2]], [1, 1]])
    with pytest.raises(TypeError, match="str 'points'"):
        lamina.delaunay("points")
    with pytest.raises(TypeError, match="progress"):
        lamina.mesh("naca:0012", progress=3)


@pytest.mark.parametrize("call", [
    lambda t, mesh: lamina.delaunay([[0, 0], [1]]),
    lambda t, mesh: lamina.constrained_delaunay(t.points, [[0, 1], [2]]), lambda t, mesh: lamina.refine(t, max_area="x"),
    lambda t, mesh: lamina.refine(t, "x", max_area=1), lambda t, mesh: lamina.refine(t, "x"),
    lambda t, mesh: t.interpolate(["x"] * 4, [0.5, 0.5]), lambda t, mesh: mesh.edge_index(dtype=float),
    lambda t, mesh: mesh.edge_index(dtype="x"), lambda t, mesh: lamina.sizes(mesh, {"p": mesh.points[:, 0]}, vertices="x")])
def test_errors_of_wrong_types_are_of_lamina(call, square, small):
    with pytest.raises(lamina.WrongTypeError):
        call(square, small)


class Foil:
    def __init__(self, name, coordinates):
        setattr(self, name, coordinates)


class Frame:
    def __init__(self, values):
        self.values = values

    def to_numpy(self):
        return self.values


def test_sections_of_other_packages():
    section = lamina.naca("2412", 60)
    expected = lamina.mesh(section, **OPTIONS)
    ring = Foil("coords", [tuple(p) for p in section])
    given = [Foil("coordinates", section), Foil("exterior", ring), Frame(section), (tuple(p) for p in section), ring,
             list(section), [list(p) for p in section], Foil("get_coords_selig_format", lambda: section)]
    for one in given:
        assert lamina.mesh(one, **OPTIONS) == expected
    pair = {"main": Foil("coordinates", section), "flap": Frame(0.3 * section + [1.1, -0.1])}
    assert list(lamina.outlines(pair)) == ["main", "flap"]
    assert len(lamina.delaunay(tuple(p) for p in section[:-1]).points) == len(section) - 1
    with pytest.raises(lamina.InputError, match="holes"):
        lamina.mesh(type("Polygon", (), {"exterior": ring, "interiors": [ring]})())


class Labelled:
    """An array whose axes have names, as those of xarray; they are no coordinates of points."""

    def __init__(self, values):
        self.values, self.coords, self.interiors = values, {"point": range(len(values))}, [3]

    def __array__(self, dtype=None, copy=None):
        return np.array(self.values, dtype=dtype)


class LabelledFrame(Labelled):
    __array__ = None

    def to_numpy(self):
        return self.values


class Collection:
    """Polygons of shapely."""

    def __init__(self, geoms):
        self.geoms = geoms

    @property
    def coords(self):
        raise NotImplementedError("Multi-part geometries do not provide a coordinate sequence")


@pytest.mark.parametrize("kind", [Labelled, LabelledFrame])
def test_arrays_are_taken_as_such(kind):
    section = lamina.naca("2412", 60)
    assert np.array_equal(lamina.delaunay(kind(section[:-1])).points, section[:-1])
    assert np.array_equal(*(outline for given in (kind(section), section) for outline in lamina.outlines(given).values()))


def test_collections_are_no_points():
    section = lamina.naca("2412", 60)
    assert len(lamina.outlines(Collection([Foil("exterior", Foil("coords", section + [2 * i, 0])) for i in (0, 1)]))) == 2
    with pytest.raises(lamina.WrongTypeError):
        lamina.delaunay(Collection([]))


def test_shapely_and_pandas():
    shapely, pandas = pytest.importorskip("shapely"), pytest.importorskip("pandas")
    section = lamina.naca("0012", 60)
    expected = lamina.mesh(section, **OPTIONS)
    assert lamina.mesh(shapely.Polygon(section), **OPTIONS) == expected
    assert lamina.mesh(pandas.DataFrame(section, columns=["x", "y"]), **OPTIONS) == expected
    two = shapely.MultiPolygon([shapely.Polygon(section), shapely.Polygon(section + [2, 0])])
    assert len(lamina.outlines(two)) == 2


@pytest.mark.parametrize("package, extra, method", [
    ("matplotlib", "plot", "plot"), ("meshio", "meshio", "to_meshio"), ("pyvista", "pyvista", "to_pyvista"),
    ("torch", "graphs", "to_pyg"), ("networkx", "networkx", "to_networkx"), ("xarray", "xarray", "to_xarray")])
def test_missing_packages_say_how_to_get_them(package, extra, method, small, monkeypatch):
    for name in [package, *(name for name in sys.modules if name.startswith(package + "."))]:
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(ModuleNotFoundError, match=rf"{package}.* is missing: pip install 'lamina-mesh\[{extra}\]'$"):
        getattr(small, method)()


def test_names_of_options_in_messages():
    messages = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        lamina.mesh("naca:0012", first_height=1e-4, layers=12)
    messages += [str(w.message) for w in caught] + [w.message.message for w in caught]
    for wrong in ({"growht": 1}, {"first_height": -1}, {"layers": 3, "layer_topology": "hexes"}, {"points": "5:x"}):
        with pytest.raises(lamina.UsageError) as error:
            lamina.mesh("naca:0012", **wrong)
        messages.append(str(error.value))
    assert len(messages) > 4
    assert not [text for text in messages if re.search(r"(^|\s)--\w", text)]


def test_names_of_files_in_messages(tmp_path, monkeypatch):
    (tmp_path / "--layer-topology.dat").write_text("no section\n")
    monkeypatch.chdir(tmp_path)
    for path in (tmp_path / "--layer-topology.dat", "--layer-topology.dat"):
        with pytest.raises(lamina.InputError) as error:
            lamina.mesh(path)
        assert str(path) in str(error.value) and error.value.file == str(path)


class Bar:
    def __init__(self):
        self.stages, self.updates = [], 0

    def set_description_str(self, text):
        self.stages.append(text)

    def set_postfix_str(self, text):
        self.estimate = text

    def update(self):
        self.updates += 1


def test_progress(capsys, monkeypatch):
    seen, bar = [], Bar()
    lamina.mesh("naca:0012", progress=lambda stage, estimate: seen.append(stage), **OPTIONS)
    lamina.mesh("naca:0012", progress=bar, **OPTIONS)
    assert bar.stages == seen and bar.updates == len(seen) > 3 and "triangles" in bar.estimate
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    lamina.mesh("naca:0012", progress=True, **OPTIONS)
    assert len(capsys.readouterr().err.splitlines()) == len(seen)
    with pytest.raises(lamina.OptionError) as caught:
        lamina.mesh("naca:0012", progress=True, growth=-1)
    assert caught.value.__context__ is None
    monkeypatch.undo()
    if importlib.util.find_spec("tqdm"):
        lamina.mesh("naca:0012", progress=True, **OPTIONS)


def test_points_and_values_of_any_shape(square):
    t = lamina.refine(square, 0.3)
    assert t.locate([0.2, 0.3]) == t.locate([[0.2, 0.3]])[0] and isinstance(t.locate((0.2, 0.3)), int)
    assert t.locate([5, 5]) == -1
    vectors = np.column_stack([t.points, t.points.sum(axis=1)])
    assert t.interpolate(vectors, [0.2, 0.3]) == pytest.approx([0.2, 0.3, 0.5])
    tensors = np.einsum("ni,nj->nij", np.ones_like(t.points), t.points)
    assert t.interpolate(tensors, [[0.2, 0.3], [9, 9]]).shape == (2, 2, 2)
    assert t.interpolate(t.points[:, 0], [0.25, 0.5]) == pytest.approx(0.25)
    assert isinstance(lamina.delaunay(t.points).nearest([0, 0]), int)
    assert t.interpolate(np.empty((len(t.points), 0)), [[0.2, 0.3], [9, 9]]).shape == (2, 0)


def test_refinement_to_areas(square):
    t = lamina.refine(square, max_area=0.01)
    triangles = t.points[t.triangles]
    (ax, ay), (bx, by) = (triangles[:, 1] - triangles[:, 0]).T, (triangles[:, 2] - triangles[:, 0]).T
    assert 0.5 * (ax * by - ay * bx).max() <= 0.01 and t.stats["oversized"] == 0 and t.check() == []
    coarse = lamina.refine(square)
    assert len(coarse) < 10 and coarse.stats["oversized"] == 0
    finer = lamina.refine(t, max_area=np.where(np.arange(len(t)) == 0, 1e-4, 0))
    assert len(t) < len(finer) < 10 * len(t)
    for wrong in (0, -1, np.ones(3)):
        with pytest.raises(ValueError, match="max_area"):
            lamina.refine(t, max_area=wrong)
    with pytest.raises(lamina.OptionError, match="max_area_ratio"):
        lamina.refine(square, max_area=0.1, max_area_ratio=-1)


def test_regions(square):
    halved = lamina.constrained_delaunay(square.points, [*square.segments.tolist(), [0, 2]])
    t = lamina.refine(halved, regions=[(0.7, 0.3, 0.001), (0.3, 0.7, 0.1)])
    centres = t.points[t.triangles].mean(axis=1)
    assert ((centres[:, 0] > centres[:, 1]) == (t.regions == 0)).all() and set(t.regions) == {0, 1}
    assert (t.regions == 0).sum() > 5 * (t.regions == 1).sum()
    assert np.array_equal(pickle.loads(pickle.dumps(t)).regions, t.regions) and len(halved.regions) == 0


def test_regions_keep_the_bound_of_all_areas(square):
    for area in (0, 0.1, 0.001):
        t = lamina.refine(square, max_area=0.01, regions=[(0.5, 0.4, area)])
        (ax, ay), (bx, by) = (t.points[t.triangles[:, k]].T - t.points[t.triangles[:, 0]].T for k in (1, 2))
        assert 0.5 * (ax * by - ay * bx).max() <= min(0.01, area or 1)
    with pytest.raises(lamina.UsageError, match="max_area"):
        lamina.refine(square, max_area=np.full(2, 0.01), regions=[(0.5, 0.4, 0)])


def test_conforming(generator):
    points = np.concatenate([generator.random((60, 2)), [[-1, 0.5], [2, 0.51]]])
    t = lamina.constrained_delaunay(points, [[60, 61]])
    conforming = lamina.refine(t, min_angle=0, smoothing=0, conforming=True)
    plain = lamina.delaunay(conforming.points)
    # Rounding moves points of the hull inwards, where the plain triangulation has flat triangles.
    assert {tuple(sorted(r)) for r in conforming.triangles.tolist()} <= {tuple(sorted(r)) for r in plain.triangles.tolist()}
    assert len(plain) - len(conforming) < 20 and len(conforming) > len(t)


def test_quadratic_nodes(square):
    t = lamina.refine(square, 0.5)
    points, nodes = t.quadratic_nodes()
    assert nodes.shape == (len(t), 6) and np.array_equal(nodes[:, :3], t.triangles)
    for i in range(3):
        ends = t.points[t.triangles[:, [(i + 1) % 3, (i + 2) % 3]]]
        assert np.array_equal(points[nodes[:, 3 + i]], ends.mean(axis=1))
    assert len(np.unique(nodes)) == len(points)


def test_check_of_a_triangulation():
    bad = lamina.Triangulation(np.array([[0, 0], [1, 0], [0, 1.0]]), np.array([[0, 2, 1]], dtype=np.uint32),
                               np.empty((0, 2), dtype=np.uint32), np.empty(0, dtype=np.uint32), 3)
    assert len(bad.check()) == 1


def test_types_are_strict(repository, tmp_path):
    if importlib.util.find_spec("mypy") is None:
        pytest.skip("mypy is not installed")
    user = tmp_path / "user.py"
    user.write_text("import lamina\n\nmesh: lamina.Mesh = lamina.mesh('naca:0012', first_height='0.1u', layers='auto')\n"
                    "print(mesh.edges.shape, lamina.flow('naca:0012', alpha=2).lift)\n")
    checked = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"),
                              str(repository / "python/lamina"), str(user)], capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout
    user.write_text("import lamina\n\nlamina.mesh('naca:0012', first_hight=1, progress=3)\n")
    checked = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), str(user)],
                             capture_output=True, text=True, env={"MYPYPATH": str(repository / "python")})
    assert "first_hight" in checked.stdout and '"progress"' in checked.stdout
