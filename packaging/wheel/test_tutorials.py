"""Ten tasks each from the tutorials of scipy.spatial, triangle, meshpy and pygmsh: the original's answer beside ours."""

import math

import numpy as np
import pytest

import lamina
from lamina.compat.triangle import triangulate

TUTORIAL = np.array([[0, 0], [0, 1.1], [1, 0], [1, 1]], dtype=float)
CLOUD = np.random.default_rng(11).random((300, 2))
QUERIES = np.random.default_rng(12).random((500, 2)) * 1.4 - 0.2
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
RING = [(i, (i + 1) % 4) for i in range(4)]


def sets(cells):
    """Returns cells as a sorted list of their sorted points."""
    return sorted(tuple(sorted(map(int, cell))) for cell in cells)


def areas(points, triangles):
    a, b, c = (np.asarray(points)[np.asarray(triangles)[:, k]] for k in range(3))
    return 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])


def least_angle(points, triangles):
    corners = np.asarray(points)[np.asarray(triangles)]
    angles = []
    for k in range(3):
        u, v = corners[:, (k + 1) % 3] - corners[:, k], corners[:, (k + 2) % 3] - corners[:, k]
        angles.append(np.arctan2(np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]), (u * v).sum(axis=1)))
    return math.degrees(np.min(angles))


def mean_edge(points, triangles):
    triangles = np.asarray(triangles)
    edges = np.unique(np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])), axis=0)
    return np.linalg.norm(np.diff(np.asarray(points)[edges], axis=1)[:, 0], axis=1).mean()


# --- scipy.spatial: "Spatial data structures and algorithms", and the examples of Delaunay, Voronoi and interpolate

@pytest.fixture(scope="module")
def spatial():
    return pytest.importorskip("scipy.spatial")


@pytest.fixture(scope="module")
def both(spatial):
    return spatial.Delaunay(CLOUD), lamina.delaunay(CLOUD)


@pytest.mark.parametrize("points", [TUTORIAL, CLOUD], ids=["tutorial", "cloud"])
def test_scipy_simplices(spatial, points):
    assert sets(spatial.Delaunay(points).simplices) == sets(lamina.delaunay(points).triangles)


def test_scipy_neighbours(both):
    theirs, ours = both
    across = {}
    for simplex, neighbours in zip(theirs.simplices, theirs.neighbors):
        for k in range(3):
            other = theirs.simplices[neighbours[k]] if neighbours[k] >= 0 else []
            across[tuple(sorted(simplex)), simplex[k]] = tuple(sorted(other))
    for triangle, neighbours in zip(ours.triangles, ours.neighbours):
        for k in range(3):
            other = ours.triangles[neighbours[k]] if neighbours[k] >= 0 else []
            assert across[tuple(sorted(triangle)), triangle[k]] == tuple(sorted(other))


def test_scipy_find_simplex(both):
    theirs, ours = both
    found, located = theirs.find_simplex(QUERIES), ours.locate(QUERIES)
    assert np.array_equal(found < 0, located < 0) and (found < 0).any()
    inside = found >= 0
    assert np.array_equal(np.sort(theirs.simplices[found[inside]]), np.sort(ours.triangles[located[inside]]))


def test_scipy_convex_hull(spatial, both):
    hull, (loop,) = spatial.ConvexHull(CLOUD).vertices.tolist(), both[1].boundary
    start = loop.tolist().index(hull[0])
    assert np.roll(loop, -start).tolist() == hull  # both counter-clockwise


def test_scipy_vertex_neighbours(both):
    theirs, ours = both
    indptr, indices = theirs.vertex_neighbor_vertices
    on_hull = set(ours.boundary[0].tolist())
    for vertex in range(len(CLOUD)):
        expected = set(indices[indptr[vertex]:indptr[vertex + 1]].tolist())
        found = {int(ours.triangles[h // 3, (h + 1) % 3]) for h in ours.half_edges_at_points[vertex]}
        assert found <= expected and len(found) == len(expected) - (vertex in on_hull)


def test_scipy_linear_interpolation(spatial, both):
    from scipy.interpolate import LinearNDInterpolator

    values = np.column_stack([np.sin(5 * CLOUD[:, 0]), CLOUD[:, 1] ** 2])
    theirs, ours = LinearNDInterpolator(both[0], values)(QUERIES), both[1].interpolate(values, QUERIES)
    assert np.allclose(theirs, ours, rtol=0, atol=1e-12, equal_nan=True)


def test_scipy_nearest(spatial, both):
    assert np.array_equal(spatial.cKDTree(CLOUD).query(QUERIES)[1], both[1].nearest(QUERIES))


def test_scipy_voronoi(spatial, both):
    theirs, ours = spatial.Voronoi(CLOUD), both[1].voronoi()
    compared = 0
    for point, region in enumerate(theirs.point_region):
        corners = theirs.regions[region]
        if -1 in corners:
            continue
        found = ours.corners[np.asarray(ours.cells[point])]
        # qhull may join corners that are equal but for rounding.
        distances = np.linalg.norm(theirs.vertices[corners][:, None] - found[None], axis=2)
        assert distances.min(axis=1).max() < 1e-9 and distances.min(axis=0).max() < 1e-9
        compared += 1
    assert compared > 250


def test_scipy_incremental(spatial):
    theirs, ours = spatial.Delaunay(CLOUD[:100], incremental=True), lamina.DynamicTriangulation(CLOUD[:100])
    theirs.add_points(CLOUD[100:])
    numbers = ours.insert(CLOUD[100:])
    assert numbers.tolist() == list(range(100, 300))
    assert sets(theirs.simplices) == sets(ours.triangles)


def test_scipy_lattice(spatial):
    """Many cocircular points: both cover the hull once."""
    lattice = np.array([[x, y] for x in range(20) for y in range(15)], dtype=float)
    theirs, ours = spatial.Delaunay(lattice).simplices, lamina.delaunay(lattice)
    assert len(theirs) == len(ours) and not ours.check()
    assert areas(lattice, ours.triangles).sum() == pytest.approx(np.abs(areas(lattice, theirs)).sum()) == 19 * 14


# --- triangle: the pages of its documentation, with the data that the package brings

TRIANGLE_TASKS = [("spiral", ""), ("dots", ""), ("face", "p"), ("A", "pc"), ("double_hex", "p"),
                  ("spiral", "q"), ("face", "pq"), ("square_circle_hole", "pqa0.1"), ("A", "pqa0.002"),
                  ("double_hex3", "pqa0.05")]


@pytest.mark.parametrize("name, switches", TRIANGLE_TASKS)
def test_triangle(name, switches):
    triangle = pytest.importorskip("triangle")
    given = triangle.get_data(name)
    theirs, ours = triangle.triangulate(given, switches), triangulate(given, switches)
    assert set(ours) == set(theirs)
    for key in theirs:
        assert ours[key].dtype == np.asarray(theirs[key]).dtype and ours[key].ndim == np.asarray(theirs[key]).ndim
    if "q" not in switches:
        assert len(ours["triangles"]) == len(theirs["triangles"])
        if sets(ours["triangles"]) != sets(theirs["triangles"]):  # corners of regular shapes are cocircular
            for made in (ours, theirs):
                assert not lamina.constrain_triangles(made["vertices"], made["triangles"], made.get("segments", ())).check()
        return
    found = areas(ours["vertices"], ours["triangles"])
    assert found.min() > 0
    if "p" in switches:  # else both cover the hull
        assert found.sum() == pytest.approx(areas(theirs["vertices"], theirs["triangles"]).sum())
    if "a" in switches:
        assert found.max() <= float(switches.split("a")[1])
    their_angle = least_angle(theirs["vertices"], theirs["triangles"])
    assert least_angle(ours["vertices"], ours["triangles"]) >= min(20, their_angle) - 1e-9
    assert len(ours["triangles"]) <= 1.1 * len(theirs["triangles"]) + 1


# --- meshpy: "Getting started", and the examples of meshpy.triangle

@pytest.fixture(scope="module")
def meshpy():
    return pytest.importorskip("meshpy.triangle")


def info_of(meshpy, points, segments, holes=()):
    info = meshpy.MeshInfo()
    info.set_points(points)
    info.set_facets(segments)
    info.set_holes(holes)
    return info


def square_here(keep="inside_segments", **options):
    return lamina.constrained_delaunay(SQUARE, RING, keep=keep, **options)


def test_meshpy_square(meshpy):
    made = meshpy.build(info_of(meshpy, SQUARE, RING), quality_meshing=False)
    assert len(made.elements) == len(square_here()) == 2


def test_meshpy_max_volume(meshpy):
    made = meshpy.build(info_of(meshpy, SQUARE, RING), max_volume=1e-3, min_angle=25)
    ours = lamina.refine(square_here(), max_area=1e-3, min_angle=25)
    assert areas(ours.points, ours.triangles).max() <= 1e-3 and len(ours) <= 1.1 * len(made.elements)
    assert least_angle(ours.points, ours.triangles) >= 25


def test_meshpy_refinement_func(meshpy):
    def bound(x, y):
        return 0.001 + 0.02 * math.hypot(x, y)

    def needs(vertices, area):
        x, y = np.mean(np.array(vertices), axis=0)
        return bool(area > bound(x, y))

    made = meshpy.build(info_of(meshpy, SQUARE, RING), refinement_func=needs)
    sizes = lambda p: np.sqrt((0.001 + 0.02 * np.hypot(p[:, 0], p[:, 1])) / (1.1 * 0.25 * math.sqrt(3)))  # noqa: E731
    ours = lamina.refine(square_here(), sizes, max_area_ratio=1.1, gradation=0.2)
    centres = ours.points[ours.triangles].mean(axis=1)
    limits = np.array([bound(x, y) for x, y in centres])
    assert (areas(ours.points, ours.triangles) <= limits).all()
    assert len(ours) <= 1.1 * len(made.elements)


def test_meshpy_hole(meshpy):
    inner = [(0.3 + 0.4 * x, 0.3 + 0.4 * y) for x, y in SQUARE]
    points, segments = SQUARE + inner, RING + [(a + 4, b + 4) for a, b in RING]
    made = meshpy.build(info_of(meshpy, points, segments, [(0.5, 0.5)]), max_volume=0.01)
    ours = lamina.refine(lamina.constrained_delaunay(points, segments, keep="inside_segments", holes=[(0.5, 0.5)]),
                         max_area=0.01)
    assert areas(ours.points, ours.triangles).sum() == pytest.approx(1 - 0.16)
    assert areas(np.array(made.points), np.array(made.elements)).sum() == pytest.approx(1 - 0.16)
    assert len(ours) <= 1.1 * len(made.elements)


def test_meshpy_regions(meshpy):
    points = [(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (0, 1)]
    segments = [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (5, 0), (1, 4)]
    info = info_of(meshpy, points, segments)
    info.regions.resize(2)
    info.regions[0] = [0.5, 0.5, 1, 0.05]
    info.regions[1] = [1.5, 0.5, 2, 0.005]
    made = meshpy.build(info, volume_constraints=True, attributes=True)
    ours = lamina.refine(lamina.constrained_delaunay(points, segments, keep="inside_segments"),
                         regions=[(0.5, 0.5, 0.05), (1.5, 0.5, 0.005)])
    found = areas(ours.points, ours.triangles)
    for region, bound in enumerate([0.05, 0.005]):
        assert found[ours.regions == region].max() <= bound and found[ours.regions == region].sum() == pytest.approx(1)
    assert len(ours) <= 1.1 * len(made.elements)


def test_meshpy_min_angle(meshpy):
    points = [(0, 0), (3, 0), (3, 0.2), (0, 1)]
    made = meshpy.build(info_of(meshpy, points, RING), min_angle=30)
    ours = lamina.refine(lamina.constrained_delaunay(points, RING, keep="inside_segments"), min_angle=30)
    assert least_angle(ours.points, ours.triangles) >= 30 - 1e-9
    assert len(ours) <= 1.1 * len(made.elements) + 1


def test_meshpy_quadratic_elements(meshpy):
    points = CLOUD[:40].tolist()
    info = meshpy.MeshInfo()
    info.set_points(points)
    hull = lamina.delaunay(points).boundary[0].tolist()
    info.set_facets(list(zip(hull, hull[1:] + hull[:1])))
    made = meshpy.build(info, mesh_order=2, quality_meshing=False)
    nodes, triangles = lamina.delaunay(points).quadratic_nodes()
    assert len(made.points) == len(nodes) and len(made.elements) == len(triangles)
    assert sorted(np.round(np.array(made.points), 9).tolist()) == sorted(np.round(nodes, 9).tolist())


def test_meshpy_neighbours(meshpy):
    made = meshpy.build(info_of(meshpy, SQUARE, RING), max_volume=0.02, generate_neighbor_lists=True)
    ours = lamina.constrain_triangles(np.array(made.points), np.array(made.elements))
    number = {cell: n for n, cell in enumerate(tuple(sorted(e)) for e in made.elements)}
    order = [number[cell] for cell in (tuple(sorted(t.tolist())) for t in ours.triangles)]
    for triangle, neighbours in enumerate(ours.neighbours):
        assert sorted(-1 if n < 0 else order[n] for n in neighbours) == sorted(made.neighbors[order[triangle]])


def test_meshpy_edges(meshpy):
    made = meshpy.build(info_of(meshpy, SQUARE, RING), max_volume=0.05, generate_faces=True)
    ours = lamina.constrain_triangles(np.array(made.points), np.array(made.elements))
    edges = {tuple(sorted((int(ours.triangles.ravel()[h]), int(ours.triangles[h // 3, (h + 1) % 3]))))
             for h, twin in enumerate(ours.half_edges) if twin < 0 or h < twin}
    assert sorted(edges) == sets(made.faces)


def test_meshpy_border_stays(meshpy):
    angle = np.linspace(0, 2 * math.pi, 60, endpoint=False)
    points = np.column_stack([np.cos(angle), np.sin(angle)]).tolist()
    ring = [(i, (i + 1) % 60) for i in range(60)]
    made = meshpy.build(info_of(meshpy, points, ring), max_volume=0.01, allow_boundary_steiner=False)
    ours = lamina.refine(lamina.constrained_delaunay(points, ring, keep="inside_segments"), max_area=0.01,
                         split_segments=False)
    assert len(ours.segments) == 60 and sets(ours.segments) == sets(ring)
    assert areas(ours.points, ours.triangles).sum() == pytest.approx(
        areas(np.array(made.points), np.array(made.elements)).sum())
    assert len(ours) <= 1.1 * len(made.elements)


# --- pygmsh: the examples of its README and of Gmsh's first tutorials

@pytest.fixture
def geometry():
    try:
        import pygmsh
    except (ImportError, OSError) as error:  # Gmsh wants libraries of X
        pytest.skip(str(error))
    with pygmsh.geo.Geometry() as made:
        yield made


def triangles_of(mesh):
    """Returns points and counter-clockwise triangles of a mesh of meshio."""
    triangles = mesh.cells_dict["triangle"].astype(np.int64)
    flat = mesh.points[:, :2]
    turned = areas(flat, triangles) < 0
    triangles[turned] = triangles[turned][:, ::-1]
    return flat, triangles


def compare(theirs, ours, size=None, angle=20):
    """Both cover the same area with edges of the same length, and ours have the better angles of a bound."""
    points, triangles = triangles_of(theirs)
    assert areas(ours.points, ours.triangles).sum() == pytest.approx(areas(points, triangles).sum(), rel=1e-3)
    assert least_angle(ours.points, ours.triangles) >= angle
    if size is not None:
        assert mean_edge(ours.points, ours.triangles) == pytest.approx(size, rel=0.15)
        assert mean_edge(ours.points, ours.triangles) == pytest.approx(mean_edge(points, triangles), rel=0.2)


def test_pygmsh_polygon(geometry):
    corners = [[0, 0], [1, -0.2], [1.1, 1.2], [0.1, 0.7]]
    geometry.add_polygon(corners, mesh_size=0.1)
    compare(geometry.generate_mesh(), lamina.refine(lamina.constrained_delaunay(corners, RING, keep="even_odd"), 0.1), 0.1)


def test_pygmsh_circle(geometry):
    geometry.add_circle([0, 0], 1, mesh_size=0.1)
    angle = np.linspace(0, 2 * math.pi, 63, endpoint=False)  # an edge of 0.1 each
    points, segments = lamina.ring_segments([np.column_stack([np.cos(angle), np.sin(angle)])])
    ours = lamina.refine(lamina.constrained_delaunay(points, segments, keep="even_odd"), 0.1)
    theirs = geometry.generate_mesh()
    compare(theirs, ours, 0.1)


def test_pygmsh_hole(geometry):
    inner = np.array([[0.4, 0.4], [0.6, 0.4], [0.6, 0.6], [0.4, 0.6]])
    hole = geometry.add_polygon(inner, mesh_size=0.05, make_surface=False)
    geometry.add_polygon(SQUARE, mesh_size=0.05, holes=[hole])
    points, segments = lamina.ring_segments([SQUARE, inner])
    compare(geometry.generate_mesh(), lamina.refine(lamina.constrained_delaunay(points, segments, keep="even_odd"), 0.05),
            0.05)


def test_pygmsh_size_callback(geometry):
    geometry.add_polygon(SQUARE)
    geometry.set_mesh_size_callback(lambda dim, tag, x, y, z, size: 0.02 + 0.1 * math.hypot(x, y))
    theirs = geometry.generate_mesh()
    ours = lamina.refine(square_here(), lambda p: 0.02 + 0.1 * np.hypot(p[:, 0], p[:, 1]))
    compare(theirs, ours)
    assert len(ours) == pytest.approx(len(triangles_of(theirs)[1]), rel=0.3)
    near = ours.points[ours.triangles].mean(axis=1)
    corner = np.hypot(*near.T) < 0.1
    assert mean_edge(ours.points, ours.triangles[corner]) == pytest.approx(0.0265, rel=0.15)


def test_pygmsh_sizes_of_points(geometry):
    geometry.add_polygon(SQUARE, mesh_size=[0.02, 0.2, 0.2, 0.2])
    theirs = geometry.generate_mesh()
    # Linear in the square, as Gmsh has them along its sides.
    ours = lamina.refine(square_here(), (SQUARE, [[0, 1, 2], [0, 2, 3]], [0.02, 0.2, 0.2, 0.2]), gradation=0.3)
    compare(theirs, ours)
    assert len(ours) == pytest.approx(len(triangles_of(theirs)[1]), rel=0.35)


def test_pygmsh_line_in_a_surface(geometry):
    surface = geometry.add_polygon(SQUARE, mesh_size=0.1)
    ends = [geometry.add_point([0.2, 0.3], 0.1), geometry.add_point([0.8, 0.6], 0.1)]
    geometry.in_surface(geometry.add_line(*ends), surface.surface)
    theirs = geometry.generate_mesh()
    points, segments = [*SQUARE, (0.2, 0.3), (0.8, 0.6)], [*RING, (4, 5)]
    ours = lamina.refine(lamina.constrained_delaunay(points, segments, keep="inside_segments"), 0.1)
    compare(theirs, ours, 0.1)
    along = ours.points[ours.segments[ours.parents == 4]]
    assert np.linalg.norm(np.diff(along, axis=1)[:, 0], axis=1).sum() == pytest.approx(math.hypot(0.6, 0.3))


def test_pygmsh_point_in_a_surface(geometry):
    surface = geometry.add_polygon(SQUARE, mesh_size=0.1)
    geometry.in_surface(geometry.add_point([0.37, 0.41], 0.1), surface.surface)
    theirs = geometry.generate_mesh()
    ours = lamina.refine(lamina.constrained_delaunay([*SQUARE, (0.37, 0.41)], RING, keep="inside_segments"), 0.1)
    compare(theirs, ours, 0.1)
    for points, triangles in (triangles_of(theirs), (ours.points, ours.triangles)):
        assert np.linalg.norm(points[np.unique(triangles)] - [0.37, 0.41], axis=1).min() < 1e-12


def test_pygmsh_physical_groups(geometry):
    surface = geometry.add_polygon(SQUARE, mesh_size=0.2)
    geometry.add_physical(surface.surface, "inside")
    geometry.add_physical(surface.lines[:1], "below")
    geometry.add_physical(surface.lines[1:], "rest")
    theirs = geometry.generate_mesh()
    ours = lamina.refine(square_here(), 0.2)
    lengths = [np.linalg.norm(np.diff(ours.points[ours.segments[np.isin(ours.parents, sides)]], axis=1)[:, 0], axis=1).sum()
               for sides in ([0], [1, 2, 3])]
    for name, length in zip(("below", "rest"), lengths):
        lines = np.concatenate([block.data[chosen] for block, chosen in zip(theirs.cells, theirs.cell_sets[name])
                                if block.type == "line" and len(chosen)])
        assert np.linalg.norm(np.diff(theirs.points[lines], axis=1)[:, 0], axis=1).sum() == pytest.approx(length)


def test_pygmsh_boundary_layer(geometry):
    """The heights of the first cells are as asked for."""
    section = lamina.naca("0012", 60)
    wall = geometry.add_polygon(section, mesh_size=0.05, make_surface=False)
    geometry.add_polygon([[-2, -2], [3, -2], [3, 2], [-2, 2]], mesh_size=0.5, holes=[wall])
    field = geometry.add_boundary_layer(edges_list=wall.curves, lcmin=1e-3, lcmax=0.3, distmin=0, distmax=1)
    geometry.set_background_mesh([field], operator="Min")
    theirs = geometry.generate_mesh()
    ours = lamina.mesh(section, first_height=1e-3, layers=8)
    assert len(triangles_of(theirs)[1]) > 0 and ours.quality().valid
    heights = ours.wall.first_height
    assert np.median(heights) == pytest.approx(1e-3, rel=1e-3)


def test_pygmsh_file(geometry, tmp_path):
    """Both programs read what ours writes."""
    import gmsh
    import meshio

    ours = lamina.mesh("naca:0012", first_height=1e-3, layers=8, layer_topology="quads")
    ours.write(tmp_path / "mesh.msh")
    read = meshio.read(tmp_path / "mesh.msh")
    assert len(read.cells_dict["triangle"]) == len(ours.triangles) and len(read.cells_dict["quad"]) == len(ours.quads)
    gmsh.open(str(tmp_path / "mesh.msh"))  # in the session that the fixture began
    _, cells, _ = gmsh.model.mesh.getElements(2)
    assert sum(map(len, cells)) == len(ours.triangles) + len(ours.quads)
    assert {gmsh.model.getPhysicalName(*group) for group in gmsh.model.getPhysicalGroups()} >= set(ours.markers)
