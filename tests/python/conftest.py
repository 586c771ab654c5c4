"""What the tests of the Python package share."""

import os
import pathlib

import numpy as np
import pytest

import lamina

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent.parent


@pytest.fixture(scope="session")
def repository():
    return REPOSITORY


@pytest.fixture(scope="session")
def program():
    """The program lamina of the same build."""
    return os.environ["LAMINA_PROGRAM"]


@pytest.fixture(scope="session")
def small():
    """A mesh with a layer; none of the tests may change it, which its arrays refuse."""
    return lamina.mesh("naca:0012", first_height=1e-4, layers=12)


@pytest.fixture(scope="session")
def square():
    """The unit square with its four sides as segments."""
    return lamina.constrained_delaunay([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1], [1, 2], [2, 3], [3, 0]])


@pytest.fixture
def generator():
    return np.random.default_rng(20)
