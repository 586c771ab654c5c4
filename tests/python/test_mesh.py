"""The mesh as an object: arrays, files, check, pictures, other packages."""

import copy
import dataclasses
import importlib.util
import pickle
from collections.abc import Mapping
from functools import cached_property

import numpy as np
import pytest

import lamina


def area_of(polygon):
    x, y = polygon.T
    return 0.5 * float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


def test_arrays_are_views_that_cannot_change(small):
    for name in ("points", "triangles", "quads", "region", "layer", "piece", "constraints"):
        array = getattr(small, name)
        assert array.dtype == {"points": np.float64, "region": np.uint8, "layer": np.uint16}.get(name, np.int32)
        assert not array.flags.writeable
        with pytest.raises(ValueError):
            array[...] = 0
        assert len(array) == 0 or np.shares_memory(array, getattr(small._data, name)())
    assert small.points.shape[1] == 2 and small.triangles.shape[1] == 3 and small.quads.shape[1] == 4


def arrays_within(value):
    """Yields the arrays of a value, of its fields and of what it holds."""
    if isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, (list, tuple)):
        for entry in value:
            yield from arrays_within(entry)
    elif isinstance(value, Mapping):
        yield from arrays_within(list(value.values()))
    elif dataclasses.is_dataclass(value):
        yield from arrays_within([getattr(value, part.name) for part in dataclasses.fields(value)])


def test_indices_do_not_wrap(small, square):
    """0 - 1 is -1 with all indices that users get, as in numpy.diff(mesh.markers["airfoil"])."""
    dynamic = lamina.DynamicTriangulation(square.points, square.segments)
    curved = lamina.mesh("naca:0012", first_height=1e-3, layers=4, order=2)
    refined = lamina.refine(square, 0.3, regions=[(0.5, 0.5, 0.1)])
    fields = {"p": small.points[:, 0] ** 2}
    values = [getattr(mesh, name) for mesh in (small, curved) for name in dir(mesh)
              if not name.startswith("_") and isinstance(getattr(type(mesh), name, None), (property, cached_property))]
    values += [square, refined, square.half_edges, square.neighbours, square.half_edges_at_points, square.boundary,
               lamina.delaunay(square.points).voronoi(), refined.nearest([[0.2, 0.3]]),
               lamina.delaunay(square.points).natural_neighbours([0.4, 0.3]), refined.locate([[0.2, 0.3]]),
               dynamic.triangles, dynamic.segments, dynamic.insert([[0.5, 0.25]]), dynamic.triangulation(),
               lamina.merge_points(square.points, 0.1), lamina.ring_segments([square.points]),
               lamina.MorphMap(small).wall, lamina.sizes(small, fields, vertices=20_000),
               lamina.flow("naca:0012", mach=0.5)]
    found = list(arrays_within(values))
    assert len(found) > 50
    assert {array.dtype.name for array in found if array.dtype.kind == "u"} == {"uint8", "uint16"}  # region and layer


def test_arrays_outlive_the_mesh():
    mesh = lamina.mesh("naca:0012", preset="euler")
    points, edges = mesh.points, mesh.markers["airfoil"]
    copies = points.copy(), edges.copy()
    del mesh
    for _ in range(3):
        lamina.mesh("naca:2412", preset="euler")  # would reuse the memory
    assert np.array_equal(points, copies[0]) and np.array_equal(edges, copies[1])


def test_cells(small):
    cells = len(small.triangles) + len(small.quads)
    assert len(small) == cells == len(small.region) == len(small.layer) == len(small.piece)
    assert ((small.layer > 0) == (small.region == 0)).all() and small.layer.max() == 12
    corners = small.points[small.triangles]
    (ax, ay), (bx, by) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    assert (ax * by - ay * bx > 0).all()
    assert lamina.check(small).area == pytest.approx(0.5 * float((ax * by - ay * bx).sum()), rel=1e-12)


def test_quads_come_last():
    mesh = lamina.mesh("naca:0012", first_height=1e-4, layers=12, layer_topology="quads")
    assert len(mesh.quads) > 1000
    assert (mesh.region[len(mesh.triangles):] == 0).all()


@pytest.mark.parametrize("topology", ["layered", "quads"])
def test_columns(topology):
    mesh = lamina.mesh("naca:0012", first_height=1e-4, layers=12, layer_topology=topology)
    column, layer = mesh.column, mesh.layer
    assert column.shape == (len(mesh),) and ((column >= 0) == (layer > 0)).all()
    assert column.max() == len(mesh.column_origin) - 1
    # The first cells of the columns stand on the wall, in its order; those of a fan have one vertex there.
    on_wall = dict(zip(mesh.wall.vertex.tolist(), range(len(mesh.wall))))
    places = [on_wall[vertex] for vertex in mesh.column_origin.tolist()]
    steps = np.diff(places + places[:1]) % len(on_wall)
    assert set(steps.tolist()) == {0, 1} and int(steps.sum()) == len(on_wall)
    cells = [tuple(c) for c in mesh.triangles.tolist()] + [tuple(c) for c in mesh.quads.tolist()]
    for cell in np.flatnonzero(layer == 1).tolist():
        origin = int(mesh.column_origin[column[cell]])
        following = int(mesh.column_origin[(column[cell] + 1) % len(mesh.column_origin)])
        standing = set(cells[cell]) & set(on_wall)
        assert standing <= {origin, following} and (standing or topology == "layered")
    # Each column has each of its layers from the wall up.
    for number in range(0, len(mesh.column_origin), 7):
        layers = np.unique(layer[column == number])
        assert np.array_equal(layers, np.arange(1, len(layers) + 1))
    assert np.array_equal(pickle.loads(pickle.dumps(mesh)).column, column)
    assert len(lamina.mesh("naca:0012", layer_topology="delaunay", layers=5).column) == 0


def test_markers(small):
    assert small.marker_kinds == {"airfoil": "wall", "farfield": "far_field"}
    edges = small.markers["airfoil"]
    starts, ends = set(edges[:, 0].tolist()), set(edges[:, 1].tolist())
    assert starts == ends and len(starts) == len(edges)


def test_wall(small):
    wall = small.wall
    assert len(wall) == len(small.markers["airfoil"]) and wall.bodies == [slice(0, len(wall))]
    outline = small.points[wall.vertex]
    assert area_of(outline) > 0.08  # counter-clockwise
    steps = np.hypot(*np.diff(outline, axis=0).T)
    assert np.allclose(np.diff(wall.arc_length), steps, rtol=1e-12)
    assert np.allclose(np.hypot(*wall.normal.T), 1)
    nose = int(np.argmin(outline[:, 0]))
    assert wall.normal[nose] == pytest.approx([-1, 0], abs=1e-6)
    assert np.median(wall.first_height) == pytest.approx(1e-4, rel=1e-3)
    assert (wall.marker == 0).all()


def test_wall_distance(small):
    distance = small.wall_distance
    assert distance.shape == (len(small.points),)
    assert (distance[small.wall.vertex] == 0).all() and (distance >= 0).all()
    far = np.unique(small.markers["farfield"])
    assert distance[far].min() > 90
    # Brute force at some points, against the edges of the wall.
    a, b = (small.points[small.markers["airfoil"][:, k]] for k in (0, 1))
    for i in range(0, len(small.points), len(small.points) // 50):
        p, along = small.points[i], b - a
        share = np.clip(((p - a) * along).sum(1) / (along * along).sum(1), 0, 1)
        assert distance[i] == pytest.approx(np.hypot(*(a + share[:, None] * along - p).T).min(), rel=1e-9, abs=1e-15)


@pytest.mark.parametrize("suffix", ["su2", "vtu", "msh"])
def test_files(small, suffix, tmp_path):
    file = tmp_path / f"mesh.{suffix}"
    small.write(file)
    again = lamina.read(file)
    assert again == small and again.warnings == [] and again.facts == {}
    small.write(str(tmp_path / "named"), format="su2")
    assert lamina.read(tmp_path / "named", format="su2") == small
    with pytest.raises(lamina.UsageError):
        small.write(tmp_path / "mesh.unknown")
    with pytest.raises(lamina.IoError):
        small.write(tmp_path / "no" / "folder" / "mesh.su2")
    assert "su2" in lamina.formats()


def test_span(small, tmp_path):
    cells = len(small)
    small.write(tmp_path / "case", format="openfoam", span=0.5, span_cells=3, span_ends="periodic")
    folder = tmp_path / "case" / "constant" / "polyMesh"
    assert f"nCells:{3 * cells}" in (folder / "owner").read_text()
    assert "cyclic" in (folder / "boundary").read_text()
    small.write(tmp_path / "deep.vtu", span=0.5, span_cells=2)
    assert f'NumberOfPoints="{3 * len(small.points)}"' in (tmp_path / "deep.vtu").read_text(errors="replace")
    for bad in ({"span": 1}, {"span_cells": 2}, {"span_ends": "wall", "span": 1}, {"span": -1}, {"span": float("nan")}):
        with pytest.raises(lamina.UsageError):
            small.write(tmp_path / "mesh.su2", **bad)
    assert not (tmp_path / "mesh.su2").exists()


def test_wall_data(small, tmp_path):
    small.write_wall_data(tmp_path / "wall.csv")
    rows = np.genfromtxt(tmp_path / "wall.csv", delimiter=",", skip_header=1)
    assert np.array_equal(rows[:, 1].astype(int), small.wall.vertex)
    assert np.array_equal(rows[:, 4], small.wall.arc_length) and np.array_equal(rows[:, 7], small.wall.first_height)


def test_pickle(small):
    again = pickle.loads(pickle.dumps(small))
    assert again == small and again.facts == small.facts and again.marker_kinds == small.marker_kinds
    for name in ("points", "triangles", "quads", "region", "layer", "piece", "constraints"):
        assert np.array_equal(getattr(again, name), getattr(small, name))


@pytest.mark.parametrize("order", [2, 3, 4])
def test_curved(order, tmp_path):
    mesh = lamina.mesh("naca:0012", order=order, layer_topology="quads", layers=4, far_field=3, gradation=0.4)
    assert mesh.order == order and mesh.quality().valid and mesh.facts["curved"]["order"] == order
    nodes = mesh.cell_nodes
    assert nodes["triangles"].shape == (len(mesh.triangles), (order + 1) * (order + 2) // 2)
    assert nodes["quads"].shape == (len(mesh.quads), (order + 1) ** 2)
    assert np.array_equal(nodes["quads"][:, :4], mesh.quads)
    name, = (name for name, kind in mesh.marker_kinds.items() if kind == "wall")
    wall = mesh.nodes[mesh.marker_nodes[name]]
    assert np.array_equal(wall[:, :2], mesh.points[mesh.markers[name]])
    begin, step = wall[:, :1], wall[:, 1:2] - wall[:, :1]
    share = ((wall[:, 2:] - begin) * step).sum(2) / (step * step).sum(2)
    assert np.allclose(share, np.arange(1, order) / order, atol=0.05)  # they run from the first end to the second
    mesh.write(tmp_path / "curved.vtu")
    for again in (lamina.read(tmp_path / "curved.vtu"), pickle.loads(pickle.dumps(mesh))):
        assert again == mesh and again.order == order and np.array_equal(again.nodes, mesh.nodes)
        assert np.array_equal(again.cell_nodes["quads"], nodes["quads"])
        assert np.array_equal(again.marker_nodes["farfield"], mesh.marker_nodes["farfield"])
    straight = lamina.mesh_of_arrays(mesh.points, mesh.triangles, mesh.markers, quads=mesh.quads)
    assert mesh.hash == straight.hash and mesh != straight
    with pytest.raises(lamina.UsageError, match="straight"):
        mesh.write(tmp_path / "curved.su2")
    with pytest.raises(lamina.UsageError, match="straight"):
        lamina.MorphMap(mesh)


def test_nodes_of_gauss_and_lobatto(tmp_path):
    mesh = lamina.mesh("naca:0012", order=3, node_distribution="gauss-lobatto", layer_topology="quads", layers=4,
                       far_field=3, gradation=0.4)
    assert mesh.node_distribution == "gauss-lobatto" and mesh.quality().valid
    edge = mesh.nodes[mesh.marker_nodes["farfield"]]
    share = np.linalg.norm(edge[:, 2] - edge[:, 0], axis=1) / np.linalg.norm(edge[:, 1] - edge[:, 0], axis=1)
    assert np.allclose(share, (1 - 5**-0.5) / 2)
    mesh.write(tmp_path / "m.xml")
    again = lamina.read(tmp_path / "m.xml")
    assert again.node_distribution == "gauss-lobatto" and again.quality().valid
    same = pickle.loads(pickle.dumps(mesh))
    assert same == mesh and same.node_distribution == "gauss-lobatto"
    with pytest.raises(lamina.UsageError, match="evenly spaced"):
        mesh.write(tmp_path / "m.vtu")
    assert lamina.mesh("naca:0012", order=2, layers=4, far_field=3).node_distribution == "equidistant"


def test_nodes_of_no_cells_have_their_shape():
    mesh = lamina.mesh_of_arrays([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]], {"side": [[0, 1], [1, 2], [2, 0]], "none": []})
    assert mesh.cell_nodes["quads"].shape == (0, 4) and mesh.marker_nodes["none"].shape == (0, 2)
    curved = lamina.mesh("naca:0012", order=2, first_height=1e-3, layers=4, layer_topology="layered")
    assert len(curved.quads) == 0 and curved.cell_nodes["quads"].shape == (0, 9)


def test_straight_cells_have_their_corners_as_nodes(small):
    assert small.order == 1 and np.array_equal(small.nodes, small.points)
    assert np.array_equal(small.cell_nodes["triangles"], small.triangles)
    assert all(np.array_equal(small.marker_nodes[name], edges) for name, edges in small.markers.items())


def test_never_changes(small):
    hash_before, walls = small.hash, len(small.markers["airfoil"])
    with pytest.raises(AttributeError):
        small.markers.clear()
    with pytest.raises(TypeError):
        small.markers["airfoil"] = small.constraints
    with pytest.raises(TypeError):
        del small.marker_kinds["airfoil"]
    for name in ("points", "markers", "hash", "warnings", "_data", "other"):
        with pytest.raises(AttributeError, match="never changes"):
            setattr(small, name, None)
    with pytest.raises(AttributeError, match="never changes"):
        del small.points
    again = pickle.loads(pickle.dumps(small))
    for mesh in (small, again):
        for array in (mesh.points, mesh.triangles, mesh.layer, mesh.column, mesh.column_origin, mesh.wall.normal,
                      mesh.wall_distance, mesh.markers["airfoil"]):
            with pytest.raises(ValueError):
                array[...] = 0
            with pytest.raises(ValueError):
                array.flags.writeable = True
    small.wall.bodies.clear(), small.facts.clear(), small.warnings.clear()
    for value in small.facts.values():
        if isinstance(value, (list, dict)):
            value.clear()
    assert small.facts == again.facts and small.wall.bodies and small.hash == hash_before
    assert len(small.markers["airfoil"]) == walls
    assert copy.copy(small) == small and copy.deepcopy(small) == small


def test_sheets_need_no_section():
    plate = lamina.mesh([], sheet=["plate:0,0,1,0"], first_height=1e-4, far_field=10)
    assert lamina.check(plate).valid and set(plate.markers) == {"plate", "farfield"}
    strip = lamina.mesh("naca:0012", sheet=["gurney:1,0,1,-0.01"], first_height=1e-4, far_field=10)
    assert lamina.check(strip).valid and set(strip.markers) == {"gurney", "airfoil", "farfield"}
    with pytest.raises(lamina.InputError, match="crosses or touches airfoil"):
        lamina.mesh("naca:0012", sheet=["wall:0.5,-1,0.5,1"])


def test_meshes_of_arrays():
    points = [[0, 0], [1, 0], [1, 1], [0, 1]]
    mesh = lamina.mesh_of_arrays(points, [[0, 1, 2], [0, 2, 3]], {"all": [[0, 1], [1, 2], [2, 3], [3, 0]]},
                                 marker_kinds={"all": "symmetry"})
    check = lamina.check(mesh)
    assert check.valid and check.area == 1 and check.euler_characteristic == 1
    line = lamina.mesh_of_arrays(points, [[0, 1, 2], [0, 2, 3]],
                                 {"all": [[0, 1], [1, 2], [2, 3], [3, 0]], "line": [[0, 2]]},
                                 marker_kinds={"line": "internal"})
    assert lamina.check(line).valid and line.marker_kinds["line"] == "internal"
    clockwise = lamina.mesh_of_arrays(points, [[0, 2, 1], [0, 2, 3]], {"all": [[0, 1], [1, 2], [2, 3], [3, 0]]})
    assert not lamina.check(clockwise).valid and lamina.check(clockwise).defects[0][0]
    for triangles in ([[0, 1, 4]], [[0, 1, -1]], [[0.5, 1, 2]], [[0, 1]]):
        with pytest.raises(lamina.InputError):
            lamina.mesh_of_arrays(points, triangles, {})
    with pytest.raises(TypeError):
        lamina.Mesh()


def test_quality(small):
    check = small.quality()
    assert check.valid and check.defects == [] and check.layer.cells + check.isotropic.cells == len(small)
    assert sum(check.isotropic.angle_histogram) == check.isotropic.cells
    assert check.isotropic.min_angle > 20.7 and check.isotropic.max_angle < 140
    assert check.walls.median_first_height == pytest.approx(1e-4, rel=1e-3)
    assert small.quality(min_angle=30).isotropic.angles_below_bound >= check.isotropic.angles_below_bound


def test_pictures(small, tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    for color in ("none", "quality", "size", "piece", "layer"):
        ax = small.plot(color=color, window=(0.9, 1.1, -0.1, 0.1))
        assert ax.get_xlim() == (0.9, 1.1)
        ax.figure.savefig(tmp_path / "m.png")
        assert (tmp_path / "m.png").stat().st_size > 5000
        pyplot.close(ax.figure)
    figure, ax = pyplot.subplots()
    assert small.plot(ax) is ax
    pyplot.close(figure)
    with pytest.raises(ValueError):
        small.plot(color="blue")


def test_notebooks(small):
    html = small._repr_html_()
    drawn = importlib.util.find_spec("matplotlib") is not None
    assert ("data:image/png;base64," in html) == drawn and f"{len(small.triangles):,}" in html and "airfoil" in html
    assert "<table>" in small.quality()._repr_html_()
    assert "airfoil" in repr(small)


def test_meshio(small, tmp_path):
    meshio = pytest.importorskip("meshio")
    other = small.to_meshio()
    assert sum(len(block.data) for block in other.cells if block.type == "triangle") == len(small.triangles)
    lines = sum(len(block.data) for block in other.cells if block.type == "line")
    assert lines == sum(map(len, small.markers.values()))
    meshio.write(tmp_path / "m.vtu", other)
    assert np.array_equal(meshio.read(tmp_path / "m.vtu").points[:, :2], small.points)


def test_pyvista(small):
    pytest.importorskip("pyvista")
    grid = small.to_pyvista()
    assert grid.n_cells == len(small) and grid.n_points == len(small.points)
    assert np.array_equal(grid.cell_data["layer"], small.layer)


def test_files_hold_names_of_markers_that_every_format_takes(small, tmp_path):
    named = {"1 left" if name == "airfoil" else name: edges for name, edges in small.markers.items()}
    mesh = lamina.mesh_of_arrays(small.points, small.triangles, named, quads=small.quads,
                                 marker_kinds={"farfield": "far_field"})
    for file in ("m.su2", "m.vtu", "case/constant/polyMesh"):
        with pytest.warns(lamina.MeshWarning, match="the marker is 'wall_1_left'") as caught:
            mesh.write(tmp_path / file)
        assert caught[0].message.code == "marker_renamed"
        assert list(lamina.read(tmp_path / file).markers) == ["wall_1_left", "farfield"]
    with pytest.warns(lamina.MeshWarning, match="the name '0012'"):
        assert "wall_0012" in lamina.mesh({"0012": "naca:0012"}, preset="euler").markers
