"""Remeshing by a metric."""

import lamina
import numpy as np
import pytest


@pytest.fixture(scope="module")
def square():
    n = 10
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1))
    at = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    a, b, c, d = at[:-1, :-1].ravel(), at[:-1, 1:].ravel(), at[1:, 1:].ravel(), at[1:, :-1].ravel()
    ring = np.concatenate([at[0, :], at[1:, -1], at[-1, -2::-1], at[-2::-1, 0]])
    return lamina.mesh_of_arrays(np.stack([x.ravel(), y.ravel()], axis=1),
                                 np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]),
                                 {"box": np.stack([ring[:-1], ring[1:]], axis=1)})


def test_a_metric_decides_on_lengths(square):
    n = len(square.points)
    made = lamina.remesh(square, np.tile([400.0, 0, 10000], (n, 1)), divide_borders=True)
    assert made.mesh.quality().valid and made.metric.shape == (len(made.mesh.points), 3)
    assert made.unit_edges > 0.95 and made.mean_quality > 0.9
    edges = np.abs(made.mesh.points[made.mesh.triangles[:, 0]] - made.mesh.points[made.mesh.triangles[:, 1]])
    assert edges[:, 0].mean() > 2 * edges[:, 1].mean()


def test_metrics_have_several_shapes(square):
    n = len(square.points)
    by_size = lamina.remesh(square, np.full(n, 0.0625))
    assert by_size.mesh == lamina.remesh(square, np.tile([256.0, 0, 256], (n, 1))).mesh
    assert by_size.mesh == lamina.remesh(square, np.tile(256 * np.eye(2), (n, 1, 1))).mesh
    assert len(lamina.remesh(square, np.full(n, 0.0625), vertices=2000, gradation=0.3, max_ratio=2).mesh.points) > 1500


def test_metrics_are_read_from_files(square, tmp_path):
    file = tmp_path / "m.sol"
    file.write_text("MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n2\n1 3\n1 2 5\n4 0 9\nEnd\n")
    assert lamina.read_metric(file).tolist() == [[1, 2, 5], [4, 0, 9]]


def test_what_is_no_metric_is_refused(square):
    n = len(square.points)
    with pytest.raises(lamina.InputError):
        lamina.remesh(square, np.ones(n - 1))
    with pytest.raises(lamina.InputError) as error:
        lamina.remesh(square, np.where(np.arange(n) == 5, -1.0, 1.0))
    assert error.value.points == [5]
    with pytest.raises(lamina.InputError):
        lamina.remesh(square, np.ones((n, 4)))
    with pytest.raises(lamina.OptionError):
        lamina.remesh(square, np.ones(n), max_ratio=0.5)
