"""Meshes moved to other shapes, and the derivative of the places of their vertices."""

import runpy
from pathlib import Path

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


def test_motions_in_further_steps(moving):
    assert moving.morph(moving.walls_on("naca:0013:200"), incremental=True).facts["maps"] == 1
    far = moving.wall_points + [9.0, 0.0]  # nearly at the far field
    morphed = moving.morph(far, incremental=True)
    assert morphed.facts["maps"] > 1 and morphed.facts["fraction"] == 1 and morphed.quality().valid
    assert np.array_equal(morphed.points[moving.wall], far)


def test_morph_reconnects_on_request(reference):
    as_it_is = reference.morph(transform="all:rotate:-25:0.25,0")
    better = reference.morph(transform="all:rotate:-25:0.25,0", reconnect=True)
    assert better.quality().valid and not np.array_equal(better.triangles, reference.triangles)
    assert np.array_equal(better.points[better.wall.vertex], as_it_is.points[as_it_is.wall.vertex])
    assert better.facts["after"]["mean_min_angle"] > as_it_is.facts["after"]["mean_min_angle"]
    assert len(better.points) == len(reference.points) and len(better.piece) == 0
    # The layer keeps its cells, with their columns.
    assert np.array_equal(better.triangles[better.column >= 0], reference.triangles[reference.column >= 0])
    assert np.array_equal(better.column[better.region == 0], reference.column[reference.region == 0])


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


def richardson(function, at, direction, step):
    """Returns the derivative by central differences whose error is of the sixth order in the step."""
    def central(h):
        return (function(at + h * direction) - function(at - h * direction)) / (2 * h)

    return (64 * central(step / 4) - 20 * central(step / 2) + central(step)) / 45


@pytest.mark.parametrize("name, step", [("cst", 1e-2), ("hicks-henne", 1e-2), ("naca", 4e-3), ("hinge", 1)])
def test_derivative_by_parameters(moving, reference, name, step):
    shape = {"cst": lambda: lamina.cst_shape(moving, 3), "hicks-henne": lambda: lamina.hicks_henne_shape(moving, [0.3, 0.6]),
             "naca": lambda: lamina.naca_shape(moving), "hinge": lambda: lamina.hinge_shape(moving, (0.25, 0))}[name]()
    rng = np.random.default_rng(2)
    at = shape.initial + 0.3 * step * rng.normal(size=shape.initial.shape)
    for _ in range(3):
        direction = rng.normal(size=at.shape)
        exact = shape.jacobian_vector(at, direction)
        # The second derivative by the place of the camber's maximum jumps there.
        if name == "naca":
            direction[2] = 0
            exact = shape.jacobian_vector(at, direction)
        assert np.abs(exact - richardson(shape.positions, at, direction, step)).max() < 1e-8 * np.abs(exact).max()
        gradient = rng.normal(size=reference.points.shape)
        by = shape.vector_jacobian(at, gradient)
        scale = np.linalg.norm(gradient) * np.linalg.norm(exact)
        assert abs(np.sum(gradient * exact) - by @ direction) < 1e-12 * scale


def test_derivative_by_place_of_camber(moving):
    shape = lamina.naca_shape(moving)
    at, along, step = np.array([0.12, 0.02, 0.4]), np.array([0, 0, 1.0]), 1e-4
    exact = shape.jacobian_vector(at, along)
    central = (shape.positions(at + step * along) - shape.positions(at - step * along)) / (2 * step)
    assert np.abs(exact - central).max() < 1e-6 and np.abs(exact).max() > 1e-3
    for place in (0, 1, -0.2, float("nan")):
        with pytest.raises(lamina.InputError):
            shape.wall([0.12, 0.02, place])


def test_shapes_by_parameters(moving, reference):
    for shape in (lamina.cst_shape(moving), lamina.hicks_henne_shape(moving, [0.2, 0.5]),
                  lamina.hinge_shape(moving, (0.25, 0))):
        assert np.array_equal(shape.wall(shape.initial), moving.wall_points)
    sections = lamina.naca_shape(moving)
    assert np.abs(sections.wall([0.12, 0, 0.4]) - moving.wall_points).max() < 3e-4  # the wall is a spline
    line = sections.wall([0.12, 0.02, 0.4]) - sections.wall([0.12, 0, 0.4])
    assert line[:, 1].max() == pytest.approx(0.02, abs=1e-4) and line[0, 1] == pytest.approx(0, abs=1e-12)
    assert np.allclose(lamina.hinge_shape(moving, (0.25, 0)).wall([10]), moving.walls_moved("all:rotate:-10:0.25,0"))
    upper = lamina.cst_shape(moving, 2).derivative(np.zeros(6))[:, 1, :3]
    assert np.all((upper > 0).any(axis=1) == (moving.wall_points[:, 1] > 1e-9))
    for bad in (lambda: lamina.cst_shape(moving, body=1), lambda: lamina.hicks_henne_shape(moving, [1.5]),
                lambda: sections.wall([0.12])):
        with pytest.raises(lamina.InputError):
            bad()


def test_example_in_torch(moving, reference):
    torch = pytest.importorskip("torch")
    example = runpy.run_path(str(Path(__file__).parents[2] / "examples/python/morphing_in_torch.py"))
    shape = lamina.cst_shape(moving, 2)
    parameters = torch.full((6,), 0.001, dtype=torch.float64, requires_grad=True)
    example["Morph"].apply(parameters, shape)[:, 1].sum().backward()
    gradient = shape.vector_jacobian(np.full(6, 0.001), np.tile([0.0, 1.0], (len(reference.points), 1)))
    assert np.array_equal(parameters.grad.numpy(), gradient)
    pytest.importorskip("torch_geometric")
    graphs = example["graphs"](moving, ["naca:0013:200", "naca:0011:200"])
    assert len(graphs) == 2 and graphs[0].pos.shape == (len(reference.points), 2)


def test_map_says_what_it_is(moving):
    assert repr(moving).startswith(f"<lamina.MorphMap of {len(moving)} wall vertices of <lamina.Mesh round")
