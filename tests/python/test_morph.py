"""Meshes moved to other shapes, and the derivative of the places of their vertices."""

import numpy as np
import pytest

import lamina


@pytest.fixture(scope="module")
def reference():
    return lamina.mesh("naca:0012:80", first_height=1e-4, layers=15, far_field=10)


@pytest.fixture(scope="module")
def moving(reference):
    return lamina.MorphMap(reference)


def test_morph_keeps_the_cells(reference):
    for morphed in (reference.morph("naca:0014:200"), reference.morph(transform="all:rotate:-8:0.25,0"),
                    reference.morph(displacements=np.full((len(reference.wall.vertex), 2), 0.01))):
        assert np.array_equal(morphed.triangles, reference.triangles)
        assert not np.array_equal(morphed.points, reference.points)
        assert morphed.quality().valid
        assert np.array_equal(morphed.column, reference.column)
        assert morphed.facts["fraction"] == 1 and morphed.facts["max_first_height_change"] < 0.01
        assert morphed.facts["after"]["min_scaled_jacobian"] > 0


def test_shapes_are_arrays_too(reference, moving):
    points = lamina.naca("0013", 200)
    assert np.array_equal(moving.walls_on(points), moving.walls_on("naca:0013:200"))
    assert np.array_equal(reference.morph(points).points, moving.morph(moving.walls_on(points)).points)


def test_walls_that_stay_change_nothing(reference, moving):
    assert moving.morph(moving.wall_points) == reference
    assert np.array_equal(moving.wall, reference.wall.vertex)


def test_products_of_the_derivative(reference, moving):
    rng = np.random.default_rng(1)
    wall = moving.walls_on("naca:2412:200")
    direction, gradient = rng.normal(size=wall.shape), rng.normal(size=reference.points.shape)
    jv, vj = moving.jacobian_vector(wall, direction), moving.vector_jacobian(wall, gradient)
    assert np.sum(gradient * jv) == pytest.approx(np.sum(vj * direction), rel=1e-11)
    smooth, h = moving.walls_on("naca:2413:200") - wall, 1e-3
    difference = (moving.positions(wall + h * smooth) - moving.positions(wall - h * smooth)) / (2 * h)
    assert np.abs(moving.jacobian_vector(wall, smooth) - difference).max() < 1e-9


def test_many_shapes_make_one_array(moving, reference):
    walls = [moving.walls_on("naca:0013:200"), moving.wall_points + [9.0, 0.0], moving.wall_points]
    points, errors = moving.morph_all(walls)
    assert points.shape == (3, *reference.points.shape)
    assert [bool(error) for error in errors] == [False, True, False]
    assert np.isnan(points[1]).all() and np.array_equal(points[2], reference.points)


def test_motions_that_end(reference, moving):
    far = moving.wall_points + [9.0, 0.0]
    with pytest.raises(lamina.MeshError, match="turns over"):
        moving.morph(far)
    morphed = moving.morph(far, as_far_as_possible=True)
    assert 0 < morphed.facts["fraction"] < 1 and "triangle" in morphed.facts["stopped_by"]
    assert morphed.quality().valid


def test_bad_input(reference, moving):
    with pytest.raises(lamina.UsageError):
        reference.morph()
    with pytest.raises(lamina.UsageError):
        reference.morph("naca:0012", transform="all:shift:0,1")
    with pytest.raises(lamina.InputError, match="corners"):
        reference.morph("naca:0012:101:blunt")
    with pytest.raises(lamina.InputError, match="bodies"):
        reference.morph(["naca:0012", lamina.naca("0012") + [2, 0]])
    for wall in (moving.wall_points[1:], np.full_like(moving.wall_points, np.nan)):
        with pytest.raises(lamina.InputError):
            moving.morph(wall)
    with pytest.raises(lamina.InputError):
        moving.positions(moving.wall_points[1:])
    with pytest.raises(lamina.InputError, match="displacements"):
        reference.morph(displacements=np.zeros((3, 2)))
    with pytest.raises(lamina.InputError):
        moving.vector_jacobian(moving.wall_points, np.zeros((3, 2)))
