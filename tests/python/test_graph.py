"""Meshes as graphs, as those of other packages, and as values."""

import copy
import dataclasses
import importlib.util
import sys
import types

import numpy as np
import pytest

import lamina


@pytest.fixture(scope="module")
def mixed():
    return lamina.mesh("naca:0012", first_height=1e-3, layers=4, layer_topology="quads")


@pytest.fixture(scope="module", params=["triangles", "quads"])
def mesh(request, small, mixed):
    return {"triangles": small, "quads": mixed}[request.param]


def cells_of(mesh):
    return mesh.triangles.tolist() + mesh.quads.tolist()


def test_edges(mesh):
    beside = {}
    for number, cell in enumerate(cells_of(mesh)):
        for a, b in zip(cell, cell[1:] + cell[:1]):
            beside.setdefault((min(a, b), max(a, b)), []).append(number)
    assert mesh.edges.dtype == mesh.edge_cells.dtype == mesh.neighbours.dtype == np.int64
    assert list(map(tuple, mesh.edges.tolist())) == sorted(beside)
    assert mesh.edge_cells.tolist() == [(beside[edge] + [-1])[:2] for edge in sorted(beside)]
    boundary = mesh.edges[mesh.edge_cells[:, 1] < 0]
    marked = np.sort(np.concatenate(list(mesh.markers.values())).astype(np.int64), axis=1)
    assert sorted(map(tuple, boundary.tolist())) == sorted(map(tuple, marked.tolist()))
    # Euler: vertices - edges + cells of a region with one hole.
    assert len(mesh.points) - len(mesh.edges) + len(mesh) == 0


def test_neighbours(mesh):
    cells = cells_of(mesh)
    assert mesh.neighbours.shape == (len(mesh), 4 if len(mesh.quads) else 3)
    for number in range(0, len(mesh), 37):
        cell = cells[number]
        for i, other in enumerate(mesh.neighbours[number].tolist()[:len(cell)]):
            if other >= 0:
                assert {cell[i], cell[(i + 1) % len(cell)]} <= set(cells[other])
                assert number in mesh.neighbours[other]
    assert (mesh.neighbours >= 0).sum() == 2 * (mesh.edge_cells[:, 1] >= 0).sum()


def test_areas_centres_and_normals(mesh):
    assert mesh.areas.sum() == pytest.approx(lamina.check(mesh).area, rel=1e-12) and (mesh.areas > 0).all()
    # Gauss: the normals of each cell sum to zero, and the flux of the position is twice the area.
    a, b = (mesh.points[mesh.edges[:, k]] for k in (0, 1))
    scaled = mesh.edge_normals * np.hypot(*(b - a).T)[:, None]
    flux = (scaled * 0.5 * (a + b)).sum(axis=1)
    sums, areas = np.zeros((len(mesh), 2)), np.zeros(len(mesh))
    first, second = mesh.edge_cells.T
    inner = second >= 0
    np.add.at(sums, first, scaled)
    np.add.at(sums, second[inner], -scaled[inner])
    np.add.at(areas, first, 0.5 * flux)
    np.add.at(areas, second[inner], -0.5 * flux[inner])
    assert np.abs(sums).max() < 1e-12 * np.abs(mesh.points).max()
    assert np.allclose(areas, mesh.areas, rtol=1e-6, atol=1e-10)
    # The first moment of all cells is that of the region: the far field is a square about the middle of the section.
    section = mesh.points[mesh.wall.vertex]
    x, y = section.T
    cross = x * np.roll(y, -1) - y * np.roll(x, -1)
    hole = ((section + np.roll(section, -1, axis=0)) * cross[:, None]).sum(axis=0) / 6
    corners = mesh.points[np.unique(mesh.markers["farfield"])]
    middle = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
    whole = mesh.areas.sum() + 0.5 * cross.sum()
    moment = (mesh.areas[:, None] * mesh.cell_centres).sum(axis=0)
    assert moment == pytest.approx(whole * middle - hole, abs=1e-6 * whole)


@pytest.mark.parametrize("turn", [1, -1])
def test_normals_of_a_cell_without_its_centre(turn):
    corners = np.array([[0, 0], [4, 0], [0.1, 0.1], [0, 4]])
    mesh = lamina.mesh_of_arrays(corners, [], {}, quads=[[0, 1, 2, 3][::turn]])
    a, b = (mesh.points[mesh.edges[:, k]] for k in (0, 1))
    scaled = mesh.edge_normals * np.hypot(*(b - a).T)[:, None]
    assert scaled.sum(axis=0) == pytest.approx([0, 0], abs=1e-12) and mesh.areas == pytest.approx([0.4 * turn])
    assert 0.5 * (scaled * 0.5 * (a + b)).sum() == pytest.approx(0.4)


def test_plot_of_clockwise_cells():
    pytest.importorskip("matplotlib").use("Agg")
    mesh = lamina.mesh_of_arrays([[0, 0], [1, 0], [0, 1]], [[0, 2, 1]], {"wall": [[0, 1]]})
    axes = mesh.plot(color="size")
    assert np.isfinite(axes.collections[0].get_array()).all()


def test_edge_index(mesh):
    plain, both = mesh.edge_index(), mesh.edge_index(both_directions=True)
    assert plain.dtype == np.int64 and plain.shape == (2, len(mesh.edges)) and np.array_equal(plain.T, mesh.edges)
    assert np.array_equal(both[:, :plain.shape[1]], plain) and np.array_equal(both[::-1, plain.shape[1]:], plain)
    of_cells = mesh.edge_index(of="cells", dtype=np.int32)
    assert of_cells.dtype == np.int32 and of_cells.min() >= 0 and of_cells.max() == len(mesh) - 1
    for wrong in (np.uint32, np.int16, float):
        with pytest.raises(TypeError, match="int64 or int32"):
            mesh.edge_index(dtype=wrong)
    with pytest.raises(lamina.UsageError, match="'edges'"):
        mesh.edge_index(of="edges")


def test_node_type(mesh):
    types = mesh.node_type
    names = np.array(lamina.NODE_TYPES)[types]
    assert set(names) == {"inside", "wall", "far_field"}
    assert set(np.flatnonzero(names == "wall")) == set(mesh.wall.vertex.tolist())
    assert (mesh.wall_distance[names == "inside"] > 0).all()
    for name, edges in mesh.markers.items():
        assert set(np.flatnonzero(mesh.node_marker == list(mesh.markers).index(name))) == set(edges.reshape(-1).tolist())
    assert ((mesh.node_marker < 0) == (names == "inside")).all()


def test_nodes_tell_bodies_and_layers_apart(mesh):
    two = lamina.mesh({"main": "naca:0012", "flap": 0.3 * lamina.naca("0012", 60) + [1.2, -0.1]}, preset="euler",
                      surface_points=60)
    names = [list(two.markers)[number] for number in two.node_marker[two.wall.vertex]]
    assert names == [list(two.markers)[number] for number in two.wall.marker] and {"main", "flap"} == set(names)
    assert (two.node_layer == 0).all()
    lowest = {}
    for cell, layer in zip(cells_of(mesh), mesh.layer.tolist()):
        for point in cell if layer else ():
            lowest[point] = min(layer, lowest.get(point, layer))
    assert mesh.node_layer.tolist() == [lowest.get(point, 0) for point in range(len(mesh.points))]
    assert (mesh.node_layer[mesh.wall.vertex] == 1).all() and mesh.node_layer.max() > 1
    without = lamina.mesh_of_arrays(mesh.points, mesh.triangles, {}, quads=mesh.quads)
    assert len(without.node_layer) == 0 and "node_layer" not in without.to_row()


def test_graph_arrays_cannot_change(mesh):
    for name in ("edges", "edge_cells", "neighbours", "areas", "cell_centres", "edge_normals", "node_type",
                 "node_marker", "node_layer"):
        with pytest.raises(ValueError):
            getattr(mesh, name)[...] = 0
    assert mesh.edges is mesh.edges


def test_meshio_has_markers_and_distances(mesh):
    pytest.importorskip("meshio")
    other = mesh.to_meshio()
    assert np.array_equal(other.point_data["wall_distance"], mesh.wall_distance)
    for name in ("node_type", "node_marker", "node_layer"):
        assert np.array_equal(other.point_data[name], getattr(mesh, name))
    assert set(other.cell_sets) == set(mesh.markers)


def test_rows(mesh):
    row = mesh.to_row()
    assert np.array_equal(np.column_stack([row["x"], row["y"]]), mesh.points)
    assert np.array_equal(row["triangles"].reshape(-1, 3), mesh.triangles)
    assert all(values.ndim == 1 and values.dtype != np.uint32 for key, values in row.items() if key != "hash")
    if importlib.util.find_spec("pyarrow"):
        import pyarrow

        table = pyarrow.Table.from_pylist([row, row])
        assert table.num_rows == 2 and table["edge_to"][1].as_py() == mesh.edges[:, 1].tolist()


def test_networkx(mesh):
    pytest.importorskip("networkx")
    graph = mesh.to_networkx()
    assert graph.number_of_edges() == len(mesh.edges) and graph.nodes[5]["pos"] == tuple(mesh.points[5])
    assert [graph.nodes[point]["node_layer"] for point in graph] == mesh.node_layer.tolist()
    assert sorted(map(sorted, graph.edges)) == mesh.edges.tolist()


def test_xarray(mesh):
    pytest.importorskip("xarray")
    data = mesh.to_xarray()
    assert data.sizes["face"] == len(mesh) and data.attrs["hash"] == mesh.hash
    assert np.array_equal(data["edge_nodes"], mesh.edges) and data["mesh"].attrs["cf_role"] == "mesh_topology"


def test_pyvista(mesh):
    pytest.importorskip("pyvista")
    grid = mesh.to_pyvista()
    assert grid.n_cells == len(mesh) and np.array_equal(grid.point_data["wall_distance"], mesh.wall_distance)
    assert grid.compute_cell_sizes()["Area"].sum() == pytest.approx(mesh.areas.sum())


def test_arrays_for_pytorch_geometric(mesh, monkeypatch):
    # The packages take a gigabyte: modules of the same names see what they would be given.
    torch, geometric, data = (types.ModuleType(name) for name in ("torch", "torch_geometric", "torch_geometric.data"))
    torch.from_numpy, data.Data = (lambda array: array), types.SimpleNamespace
    for module in (torch, geometric, data):
        monkeypatch.setitem(sys.modules, module.__name__, module)
    graph = mesh.to_pyg()
    assert all(array.flags.writeable for array in vars(graph).values())
    assert graph.edge_index.dtype == np.int64 and graph.edge_index.shape == (2, 2 * len(mesh.edges))
    start, end = graph.pos[graph.edge_index]
    assert np.array_equal(graph.edge_attr[:, :2], end - start)
    assert np.allclose(graph.edge_attr[:, 2], np.linalg.norm(end - start, axis=1))
    assert hasattr(graph, "face") == (len(mesh.quads) == 0) and np.array_equal(graph.node_type, mesh.node_type)
    assert np.array_equal(graph.node_marker, mesh.node_marker) and np.array_equal(graph.node_layer, mesh.node_layer)


def test_pytorch_geometric(mesh):
    utils = pytest.importorskip("torch_geometric.utils")
    data = mesh.to_pyg()
    assert data.validate() and data.num_nodes == len(mesh.points)
    assert utils.is_undirected(data.edge_index)  # and its attributes are not: they change sign with the direction
    assert data.num_edges == 2 * len(mesh.edges) and data.edge_attr.shape == (data.num_edges, 3)


def make_objects():
    points = np.random.default_rng(1).random((30, 2))
    t = lamina.delaunay(points)
    mesh = lamina.mesh("naca:0012", preset="euler", surface_points=60)
    yield t
    yield t.voronoi()
    yield t.half_edges_at_points
    yield mesh
    yield mesh.wall
    check = mesh.quality()
    yield check
    yield check.isotropic
    yield lamina.remesh(mesh, np.full(len(mesh.points), 0.5))
    yield lamina.BatchResult("name", {"alpha": 1}, mesh, None, 1.0)
    (failed,) = lamina.batch(["no.dat"])
    yield dataclasses.replace(failed, options={"background": (points, t.triangles, np.ones(30))}, seconds=1.0)
    flow = lamina.flow("naca:0012", alpha=15, reynolds=5e3)
    assert flow.warnings
    yield flow


@pytest.fixture(scope="module")
def objects():
    return [list(make_objects()) for _ in range(2)]


@pytest.mark.parametrize("number", range(11))
def test_objects_are_values(number, objects):
    one, other = (made[number] for made in objects)
    assert one == other and hash(one) == hash(other) and one == copy.deepcopy(one)
    assert one != 3 and len({one, other}) == 1
    assert "\n" not in repr(one) and len(repr(one)) < 800
    if dataclasses.is_dataclass(one) and not isinstance(one, lamina.Triangulation):
        name = dataclasses.fields(one)[0].name
        assert dataclasses.replace(one, **{name: np.ones(1)}) != one


def test_triangulations_have_lengths():
    t = lamina.delaunay([[0, 0], [1, 0], [1, 1], [0, 1]])
    t.locate([[0.5, 0.2]])
    assert len(t) == 2 and repr(t) == "<lamina.Triangulation: 4 points, 2 triangles, 0 edges of segments>"
    assert lamina.delaunay([]) and len(lamina.delaunay([])) == 0
    assert repr(lamina.DynamicTriangulation(t.points)).startswith("<lamina.DynamicTriangulation: 4 points")
