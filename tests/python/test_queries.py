"""Connectivity, queries, Voronoi diagrams, merged input and triangulations that change."""

import copy
import pickle

import numpy as np
import pytest

import lamina


@pytest.fixture(scope="module")
def cloud():
    return lamina.delaunay(np.random.default_rng(3).random((3000, 2)))


def inside(t, triangles, queries, slack=1e-12):
    a, b, c = (t.points[t.triangles[triangles, k]] for k in range(3))
    return [((y - x)[:, 0] * (queries - x)[:, 1] - (y - x)[:, 1] * (queries - x)[:, 0] >= -slack).all()
            for x, y in ((a, b), (b, c), (c, a))]


def as_set(triangles):
    return {tuple(sorted(row)) for row in triangles.tolist()}


def polygon_area(corners):
    x, y = corners.T
    return 0.5 * float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


def test_connectivity(cloud):
    twins, ends = cloud.half_edges, np.roll(cloud.triangles, -1, axis=1).reshape(-1)
    starts = cloud.triangles.reshape(-1)
    paired = twins >= 0
    assert (twins[twins[paired]] == np.flatnonzero(paired)).all()
    assert (starts[twins[paired]] == ends[paired]).all()
    # The neighbour across the edge opposite corner 0 shares corners 1 and 2.
    t = int(np.flatnonzero(cloud.neighbours[:, 0] >= 0)[0])
    assert set(cloud.triangles[t, 1:]) <= set(cloud.triangles[cloud.neighbours[t, 0]])
    assert (cloud.neighbours < 0).sum() == (~paired).sum()
    assert len(cloud.half_edges_at_points) == 3000
    assert all((starts[cloud.half_edges_at_points[p]] == p).all() for p in range(0, 3000, 100))
    assert sum(map(len, cloud.half_edges_at_points)) == len(starts)
    (hull,) = cloud.boundary
    assert len(hull) == (~paired).sum() and polygon_area(cloud.points[hull]) > 0


def test_location(cloud, generator):
    queries = generator.random((5000, 2)) * 1.2 - 0.1
    found = cloud.locate(queries)
    assert all(inside(cloud, found[found >= 0], queries[found >= 0]))
    (hull,) = cloud.boundary
    corners, outside = cloud.points[hull], queries[found < 0]
    sides = np.roll(corners, -1, axis=0) - corners
    relative = outside[:, None, :] - corners[None, :, :]
    assert len(outside) > 500 and (sides[:, 0] * relative[..., 1] - sides[:, 1] * relative[..., 0]).min(axis=1).max() < 0
    nearest = cloud.nearest(queries[:200])
    squares = ((queries[:200, None, :] - cloud.points[None, :, :])**2).sum(axis=2)
    assert (nearest == squares.argmin(axis=1)).all()
    assert (cloud.triangles[cloud.locate(cloud.points)] == np.arange(3000)[:, None]).any(axis=1).all()


@pytest.mark.parametrize("method", ["linear", "sibson"])
def test_interpolation(cloud, generator, method):
    queries = generator.random((1000, 2))
    values = 3 + 2 * cloud.points[:, 0] - 5 * cloud.points[:, 1]
    result = cloud.interpolate(values, queries, method=method)
    assert (np.isnan(result) == (cloud.locate(queries) < 0)).all()
    known = ~np.isnan(result)
    assert np.allclose(result[known], (3 + 2 * queries[:, 0] - 5 * queries[:, 1])[known], rtol=0, atol=1e-9)
    vertices, weights = cloud.natural_neighbours([0.5, 0.5])
    assert weights.sum() == pytest.approx(1) and weights @ cloud.points[vertices] == pytest.approx([0.5, 0.5])


def test_wrong_questions(cloud, square):
    with pytest.raises(lamina.OptionError):
        cloud.interpolate(np.zeros(3000), [[0, 0]], method="cubic")
    with pytest.raises(lamina.InputError):
        cloud.interpolate(np.zeros(7), [[0, 0]])
    notch = lamina.constrained_delaunay([[0, 0], [2, 0], [2, 2], [1, 0.5], [0, 2]],
                                        [[0, 1], [1, 2], [2, 3], [3, 4], [4, 0]], keep="inside_segments")
    assert notch.locate([[1, 1], [1, 0.2]]).tolist()[0] == -1 and notch.locate([[1, 0.2]])[0] >= 0
    with pytest.raises(lamina.UsageError):
        notch.nearest([[0, 0]])
    assert square.locate(np.empty((0, 2))).shape == (0,)


def test_voronoi(cloud):
    frame = [[0, 0], [1, 0], [1, 1], [0, 1]]
    cells = cloud.voronoi_cells(frame)
    assert len(cells) == 3000 and sum(map(polygon_area, cells)) == pytest.approx(1)
    diagram = cloud.voronoi()
    assert len(diagram.rays) == len(cloud.boundary[0]) and len(diagram.corners) == len(cloud.triangles)
    for p in range(0, 3000, 250):
        corners = diagram.corners[diagram.cells[p]]
        own = np.hypot(*(corners - cloud.points[p]).T)
        all_points = np.hypot(*(corners[:, None, :] - cloud.points[None, :, :]).transpose(2, 0, 1)).min(axis=1)
        assert np.allclose(own, all_points, rtol=1e-6)


def test_rings_and_duplicates():
    outer = [[0, 0], [3, 0], [3, 3], [0, 3], [0, 0]]
    inner = [[1, 1], [2, 1], [2, 2], [1, 2], [1, 1]]
    points, segments = lamina.ring_segments([outer, inner])
    t = lamina.constrained_delaunay(points, segments, keep="even_odd", merge_distance=0)
    area = sum(polygon_area(t.points[row]) for row in t.triangles)
    assert area == pytest.approx(8) and t.merged_into[4] == 0 and t.merged_into[9] == 5
    filled = lamina.constrained_delaunay(points, segments, keep="non_zero", merge_distance=0)
    assert sum(polygon_area(filled.points[row]) for row in filled.triangles) == pytest.approx(9)
    assert lamina.merge_points([[0, 0], [1, 0], [0.05, 0]], 0.1).tolist() == [0, 1, 0]
    with pytest.raises(lamina.OptionError):
        lamina.merge_points([[0, 0]], -1)
    with pytest.raises(lamina.InputError):
        lamina.constrained_delaunay(points, segments, keep="even_odd")


@pytest.mark.parametrize("distance", [0, 1e-6])
def test_refinement_of_merged_points(distance):
    outer = [[0, 0], [3, 0], [3, 3], [0, 3], [0.5 * distance, 0]]
    inner = [[1, 1], [1, 2], [2, 2], [2, 1], [1, 1]]
    points, segments = lamina.ring_segments([outer, inner])
    t = lamina.constrained_delaunay(points, segments, keep="even_odd", merge_distance=distance)
    fine = lamina.refine(t, 0.1)
    assert fine.stats["below_bound"] == 0 and fine.merged_into.tolist() == t.merged_into.tolist()
    assert sum(polygon_area(fine.points[row]) for row in fine.triangles) == pytest.approx(8, abs=1e-5)
    adopted = lamina.constrain_triangles(points, t.triangles, segments, t.merged_into)
    assert len(lamina.refine(adopted, 0.1).triangles) == len(fine.triangles)
    if distance == 0:
        assert len(lamina.constrain_triangles(points, t.triangles, segments).segments) == 8


def make_plain(points):
    return lamina.delaunay(points)


def make_constrained(points):
    return lamina.constrained_delaunay(points, [[0, 1]], crossings="insert", merge_distance=0)


def make_refined(points):
    return lamina.refine(make_constrained(points), 0.2)


@pytest.mark.parametrize("make", [make_plain, make_constrained, make_refined])
@pytest.mark.parametrize("given", ["owned", "view", "column-major", "marked", "buffer"])
def test_arrays_belong_to_the_triangulation(make, given, generator):
    numbers = generator.random((100, 2))
    points = {"owned": numbers, "view": np.vstack([numbers, numbers])[:100], "column-major": np.asfortranarray(numbers),
              "marked": numbers.copy(),
              "buffer": np.frombuffer(memoryview(bytearray(numbers.tobytes())).toreadonly()).reshape(-1, 2)}[given]
    if given == "marked":
        points.flags.writeable = False
    t = make(points)
    before, place = t.locate([[0.5, 0.5]]), np.array(t.points)
    if given == "buffer":
        points.base.base.obj[:] = bytes(1600)
    else:
        points.flags.writeable = True
        points += 1
    assert np.array_equal(t.points, place) and np.array_equal(make(place[:100]).locate([[0.5, 0.5]]), before)
    for array in (t.points, t.triangles, t.segments, t.parents, t.merged_into, t.half_edges, t.neighbours,
                  t.half_edges_at_points.items):
        if array.size == 0:
            continue
        with pytest.raises(ValueError):
            array[...] = 0
        while isinstance(array, np.ndarray):
            with pytest.raises(ValueError):
                array.flags.writeable = True
            array = array.base
    t.boundary.clear()
    assert len(t.boundary) == 1
    for name in ("points", "triangles", "stats"):
        with pytest.raises(AttributeError):
            setattr(t, name, getattr(t, name))
    with pytest.raises(AttributeError):
        t.half_edges_at_points.items = t.parents
    with pytest.raises(TypeError):
        t.stats["refused"] = 3


@pytest.mark.parametrize("make", [make_plain, make_constrained, make_refined])
def test_pickles_and_copies(make, generator):
    t = make(generator.random((100, 2)))
    for _ in range(2):
        for again in (pickle.loads(pickle.dumps(t)), copy.copy(t), copy.deepcopy(t), copy.deepcopy([t])[0]):
            assert again == t and hash(again) == hash(t) and again.given_points == t.given_points
            assert again.stats == t.stats and np.array_equal(again.merged_into, t.merged_into)
            assert np.array_equal(again.parents, t.parents) and not again.points.flags.writeable
            assert np.array_equal(again.locate([[0.5, 0.5]]), t.locate([[0.5, 0.5]]))
            assert np.array_equal(again.boundary, t.boundary)
        t.locate([[0.5, 0.5]]), t.neighbours, t.half_edges_at_points  # which prepares the triangulation
    assert t != make(generator.random((100, 2))) and t != 3


def test_refinement_of_given_triangles():
    # The wrong diagonal of a quadrilateral is flipped, unless it is a segment.
    points = [[0, 0], [2, 0.9], [4, 0], [2, -0.9]]
    given = [[0, 2, 1], [0, 3, 2]]
    assert as_set(lamina.constrain_triangles(points, given).triangles) == {(0, 1, 3), (1, 2, 3)}
    kept = lamina.constrain_triangles(points, given, [[0, 2]])
    assert as_set(kept.triangles) == as_set(np.array(given))
    fine = lamina.refine(kept, 0.2)
    assert sum(polygon_area(fine.points[row]) for row in fine.triangles) == pytest.approx(3.6)
    with pytest.raises(lamina.InputError) as caught:
        lamina.constrain_triangles(points, given, [[1, 3]])
    assert caught.value.segments == [0]


def test_changes(generator):
    points = generator.random((500, 2))
    t = lamina.DynamicTriangulation(points[:300])
    numbers = t.insert(points[250:])
    assert numbers[:50].tolist() == list(range(250, 300)) and len(t) == 500
    gone = numbers[60:160]
    t.remove(gone)
    assert len(t) == 400 and int(gone[0]) not in t and 0 in t and -1 not in t
    left = np.array([i for i in range(len(t.points)) if i in t])
    plain = lamina.delaunay(t.points[left])
    assert as_set(t.triangles) == as_set(left[plain.triangles])
    assert t.find(points[3]) == 3 and t.find([9, 9]) is None
    edges = t.insert_segment(0, 1)
    assert edges[0, 0] == 0 and edges[-1, 1] == 1 and len(t.segments) == len(edges)
    with pytest.raises(lamina.InputError):
        t.remove(0)
    state = t.triangulation()
    assert (state.locate(t.points[left]) >= 0).all()
    t.remove_segment(0, 1)
    assert len(t.segments) == 0
    t.remove(0)
    empty = lamina.DynamicTriangulation()
    assert len(empty) == 0 and len(empty.triangles) == 0


def test_flat_triangles_at_the_hull_are_dropped_on_request():
    angle = 0.5
    x, y = np.meshgrid(0.1 * np.arange(20), 0.1 * np.arange(10))
    points = np.column_stack([np.cos(angle) * x.ravel() - np.sin(angle) * y.ravel(),
                              np.sin(angle) * x.ravel() + np.cos(angle) * y.ravel()])
    t = lamina.constrained_delaunay(points, [], drop_flat=1e-10)
    assert len(t.triangles) == 2 * 19 * 9
    assert len(lamina.constrained_delaunay(points, []).triangles) > len(t.triangles)
    for wrong in (-1.0, 0.2):
        with pytest.raises(lamina.OptionError):
            lamina.constrained_delaunay(points, [], drop_flat=wrong)
    with pytest.raises(lamina.OptionError):
        lamina.constrained_delaunay(points, [], keep="inside_segments", drop_flat=1e-10)
