"""lamina.compat.triangle, against what the package `triangle` (20250106, of Triangle 1.6) made of the same input."""

import json
import pathlib

import numpy as np
import pytest

import lamina
from lamina.compat.triangle import triangulate

RECORD = json.loads((pathlib.Path(__file__).parent / "triangle_form.json").read_text())
BOUNDED = set("qaD")


def given(name):
    result = dict(RECORD["inputs"][name])
    for key in ("segment_markers", "vertex_markers"):
        if key in result:
            result[key] = np.array(result[key])[:, None]
    return result


def rows(pairs, markers):
    return sorted([*sorted(pair), mark] for pair, (mark,) in zip(pairs.tolist(), markers.tolist()))


@pytest.mark.parametrize("case", RECORD["cases"], ids=lambda case: f"{case['input']}-{case['switches']}")
def test_results_are_those_of_triangle(case):
    ours = triangulate(given(case["input"]), case["switches"])
    assert sorted(ours) == sorted(case["arrays"])
    for key, (kind, shape) in case["arrays"].items():
        assert str(ours[key].dtype) == kind and list(ours[key].shape[1:]) == shape[1:], key
    count = case["arrays"]["triangles"][1][0]
    assert len(ours["triangles"]) <= 1.1 * count + 1  # of so few, one is much
    if BOUNDED & set(case["switches"]):
        return
    assert sorted(map(sorted, ours["triangles"].tolist())) == case["triangles"]
    for key in ("segments", "edges"):
        if key in case:
            assert rows(ours[key], ours[key[:-1] + "_markers"]) == case[key]
    if "vertex_markers" in case:
        assert ours["vertex_markers"].ravel().tolist() == case["vertex_markers"]


def measures(result):
    a, b, c = (result["vertices"][result["triangles"][:, k]] for k in range(3))
    area = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    angles = []
    for p, q, r in ((a, b, c), (b, c, a), (c, a, b)):
        u, v = q - p, r - p
        angles.append(np.degrees(np.arctan2(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], (u * v).sum(axis=1))))
    return area, np.min(angles, axis=0)


def test_bounds_hold():
    area, angle = measures(triangulate(given("hole"), "pq30a0.05"))
    assert area.max() <= 0.05 and angle.min() >= 30 and area.sum() == pytest.approx(measures(
        triangulate(given("hole"), "p"))[0].sum())
    result = triangulate(given("regions"), "pqAa")
    area, angle = measures(result)
    number = result["triangle_attributes"].ravel()
    assert angle.min() >= 20 and area[number == 3].max() <= 0.05 and area[number == 4].max() <= 0.4
    assert set(number) == {3, 4}
    # The attribute of the points is x, which is linear.
    assert np.allclose(result["vertex_attributes"][:, 0], result["vertices"][:, 0], atol=1e-7)


def test_refinement_of_a_result():
    coarse = triangulate(given("hole"), "pq")
    coarse["triangle_max_area"] = np.full((len(coarse["triangles"]), 1), 0.02)
    finer = triangulate(coarse, "prqa")
    assert measures(finer)[0].max() <= 0.02 and set(finer["segment_markers"].ravel()) == {1, 2, 3, 4, 5}
    assert len(finer["triangles"]) > 3 * len(coarse["triangles"])
    # Regions give attributes alone here.
    coarse = triangulate(given("regions"), "pqAa")
    coarse["triangle_max_area"] = np.full((len(coarse["triangles"]), 1), 0.01)
    finer = triangulate(coarse, "prqaA")
    left = finer["vertices"][finer["triangles"]].mean(axis=1)[:, 0] < 2.025
    assert measures(finer)[0].max() <= 0.01 and np.array_equal(finer["triangle_attributes"].ravel(), np.where(left, 3, 4))


def test_areas_of_all_and_of_regions():
    area, _ = measures(result := triangulate(given("regions"), "pqAa0.1a"))
    number = result["triangle_attributes"].ravel()
    assert area[number == 3].max() <= 0.05 and 0.05 < area[number == 4].max() <= 0.1
    result = triangulate(given("hole"), "pqaa.05")
    assert measures(result)[0].max() <= 0.05


def test_attributes_where_segments_cross():
    square = {"vertices": [[0, 0], [1, 0], [1, 1], [0, 1]], "segments": [[0, 2], [1, 3], [0, 1], [1, 2], [2, 3], [3, 0]],
              "vertex_attributes": np.column_stack([np.full(4, 10.0), [0, 1, 3, 2]])}
    for switches in ("p", "pqa0.02", "pqa0.02o2"):
        result = triangulate(square, switches)
        values = result["vertex_attributes"]
        assert len(values) == len(result["vertices"]) > 4 and np.allclose(values[:, 0], 10, atol=1e-7)
        assert np.allclose(values[:, 1], result["vertices"] @ [1, 2], atol=1e-7)
    # All triangles are reached from outside, or from the hole.
    assert np.allclose(triangulate({**square, "segments": [[0, 2], [1, 3]]}, "p")["vertex_attributes"][:, 0], 10)
    assert np.allclose(triangulate({**square, "holes": [[0.5, 0.1], [0.5, 0.9]]}, "p")["vertex_attributes"][:, 0], 10)


def test_quadratic_nodes_are_opposite_of_corners():
    result = triangulate(given("hole"), "po2")
    points, nodes = result["vertices"], result["triangles"]
    assert nodes.shape[1] == 6 and len(result["vertex_markers"]) == len(points)
    for k in range(3):
        assert np.array_equal(points[nodes[:, 3 + k]], 0.5 * (points[nodes[:, (k + 1) % 3]] + points[nodes[:, (k + 2) % 3]]))


def test_unused_points_are_dropped():
    repeated = [[0, 0], [1, 0], [0, 0], [1, 1]]
    assert len(triangulate({"vertices": repeated})["vertices"]) == 4
    dropped = triangulate({"vertices": repeated}, "j")
    assert len(dropped["vertices"]) == 3 and dropped["triangles"].max() == 2


def test_quadratic_nodes_have_the_markers_of_their_edges():
    outline = {**given("hole"), "vertices": [*given("hole")["vertices"], [1.4, 1.6]], "vertex_markers": np.zeros(9, int)}
    outline["vertex_attributes"] = np.array(outline["vertices"])
    whole = triangulate(outline, "po2e")
    middles = 0.5 * whole["vertices"][whole["edges"]].sum(axis=1)
    assert np.array_equal(whole["vertices"][9:], middles)
    assert np.array_equal(whole["vertex_markers"][9:], whole["edge_markers"]) and 5 in whole["vertex_markers"][9:]
    # The point in the hole is in no triangle.
    dropped = triangulate(outline, "pjo2e")
    assert len(dropped["vertices"]) == len(whole["vertices"]) - 1
    assert np.array_equal(dropped["vertex_attributes"], dropped["vertices"])
    assert np.array_equal(np.delete(whole["vertex_markers"], 8, axis=0), dropped["vertex_markers"])
    assert np.array_equal(dropped["vertices"][dropped["triangles"]], whole["vertices"][whole["triangles"]])


@pytest.mark.parametrize("switches", ["u", "k", "p3", "q20w", "%", "pqS100", "q."])
def test_unknown_switches(switches):
    with pytest.raises(lamina.UsageError, match="switch"):
        triangulate(given("hole"), switches)
