"""delaunay(), constrained_delaunay() and refine()."""

import numpy as np
import pytest

import lamina


def areas(t):
    a, b, c = (t.points[t.triangles[:, k]] for k in range(3))
    (ax, ay), (bx, by) = (b - a).T, (c - a).T
    return 0.5 * (ax * by - ay * bx)


def smallest_angle(t):
    corners = t.points[t.triangles]
    after, before = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    cross = after[..., 0] * before[..., 1] - after[..., 1] * before[..., 0]
    return float(np.degrees(np.arctan2(cross, (after * before).sum(axis=2))).min())


def test_delaunay(generator):
    points = generator.random((2000, 2))
    t = lamina.delaunay(points)
    assert (areas(t) > 0).all() and t.given_points == 2000 and t.points is not None
    # Euler: a triangulation of n points with h on the hull has 2 n - 2 - h triangles.
    edges = np.sort(np.concatenate([t.triangles[:, [0, 1]], t.triangles[:, [1, 2]], t.triangles[:, [2, 0]]]), axis=1)
    _, uses = np.unique(edges, axis=0, return_counts=True)
    assert len(t.triangles) == 2 * 2000 - 2 - int((uses == 1).sum())
    # No point lies in a circumcircle: some triangles, all points.
    for a, b, c in t.points[t.triangles[::200]]:
        m = np.array([b - a, c - a])
        center = np.linalg.solve(2 * m, (m * m).sum(axis=1)) + a
        radius = np.hypot(*(a - center))
        assert np.hypot(*(points - center).T).min() >= radius * (1 - 1e-9)
    order = generator.permutation(2000)
    other = lamina.delaunay(points[order])
    assert {tuple(sorted(r)) for r in order[other.triangles].tolist()} == {tuple(sorted(r)) for r in
                                                                         t.triangles.tolist()}


def test_wrong_points():
    with pytest.raises(lamina.InputError) as caught:
        lamina.delaunay([[0, 0], [1, 0], [0, 0], [0, 1]])
    assert caught.value.points == [0, 2] and caught.value.at == (0, 0)
    for bad in ([[0, 0, 0]], [[np.inf, 0], [0, 0], [1, 1]]):
        with pytest.raises(lamina.InputError):
            lamina.delaunay(bad)
    assert len(lamina.delaunay(np.empty((0, 2))).triangles) == 0


def test_constrained_delaunay(square):
    assert len(square.triangles) == 2 and len(square.segments) == 4
    points = [[0, 0], [1, 0], [1, 1], [0, 1]]
    cross = [[0, 2], [1, 3]]
    with pytest.raises(lamina.InputError) as caught:
        lamina.constrained_delaunay(points, cross)
    assert sorted(caught.value.segments) == [0, 1]
    t = lamina.constrained_delaunay(points, cross, crossings="insert")
    assert t.points[4] == pytest.approx([0.5, 0.5]) and len(t.triangles) == 4
    assert sorted(t.parents.tolist()) == [0, 0, 1, 1]
    with pytest.raises(lamina.OptionError, match="did you mean"):
        lamina.constrained_delaunay(points, cross, crossings="inserts")
    with pytest.raises(lamina.InputError):
        lamina.constrained_delaunay(points, [[0, 4]])


def test_holes():
    outer = [[0, 0], [3, 0], [3, 3], [0, 3]]
    inner = [[1, 1], [2, 1], [2, 2], [1, 2]]
    segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]]
    t = lamina.constrained_delaunay(outer + inner, segments, keep="inside_segments", holes=[[1.5, 1.5]])
    assert areas(t).sum() == pytest.approx(8)


def test_uniform_size(square):
    t = lamina.refine(square, 0.05)
    assert areas(t).sum() == pytest.approx(1) and smallest_angle(t) > 20.7
    equilateral = 1 / (0.4330127 * 0.05**2)
    assert len(t.triangles) == pytest.approx(equilateral, rel=0.1)
    assert np.array_equal(t.points[:4], square.points) and t.given_points == 4
    assert t.stats["below_bound"] == 0
    on_border = (t.points[t.segments] % 1 == 0).any(axis=2).all()
    assert on_border and len(t.segments) >= 80


def test_angles_and_limits(square):
    assert smallest_angle(lamina.refine(square, 0.2, min_angle=30)) > 30
    with pytest.raises(lamina.LimitError):
        lamina.refine(square, 1e-3, max_triangles=1000)
    with pytest.raises(lamina.OptionError):
        lamina.refine(square, 0.1, min_angle=60)
    with pytest.raises(lamina.OptionError):
        lamina.refine(square, -1.0)


def test_sizes_of_the_points(square):
    t = lamina.refine(square, np.array([0.01, 0.1, 0.1, 0.1]), gradation=0.2)
    size = np.sqrt(areas(t))
    near = np.hypot(*t.points[t.triangles].mean(axis=1).T)
    assert size[near < 0.05].mean() < 0.3 * size[near > 0.9].mean()
    for bad in (np.ones(3), np.zeros(4), np.full(4, np.nan)):
        with pytest.raises(lamina.InputError):
            lamina.refine(square, bad)


def test_function_and_background_agree(square):
    def size(p):
        return 0.02 + 0.1 * np.abs(p[:, 0] - 0.5)

    by_function = lamina.refine(square, size, gradation=0.2)
    x, y = np.meshgrid(np.linspace(0, 1, 41), np.linspace(0, 1, 41))
    grid = np.column_stack([x.ravel(), y.ravel()])
    by_background = lamina.refine(square, (grid, lamina.delaunay(grid).triangles, size(grid)), gradation=0.2)
    assert len(by_function.triangles) == pytest.approx(len(by_background.triangles), rel=0.05)
    middle = by_function.points[by_function.triangles].mean(axis=1)
    wanted = size(middle)
    ratio = np.sqrt(areas(by_function) / (0.4330127 * wanted**2))
    assert 0.85 < np.median(ratio) < 1.1
    with pytest.raises(ZeroDivisionError):
        lamina.refine(square, lambda p: 1 / 0)


def test_plot(square):
    pytest.importorskip("matplotlib").use("Agg")
    assert lamina.refine(square, 0.2).plot() is not None
