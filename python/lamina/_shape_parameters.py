"""Shapes by parameters: the wall points of a mesh and their derivative, to be chained with that of the mesh."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import comb
from typing import Any

import numpy as np

from ._errors import InputError
from ._morph import MorphMap


class ShapeParameters:
    """Wall points that follow from k parameters.

    `wall(parameters)` is (n, 2) in the order of MorphMap.wall, `derivative(parameters)` is (n, 2, k); `initial` (k,) gives
    the reference mesh, except for naca_shape().

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> shape = lamina.hinge_shape(lamina.MorphMap(mesh), (0.7, 0))
    >>> shape.wall(np.array([5.0])).shape[1], shape.initial
    (2, array([0.]))
    """

    def __init__(self, moving: MorphMap, initial: Any, wall: Callable[[np.ndarray], np.ndarray],
                 derivative: Callable[[np.ndarray], np.ndarray]) -> None:
        self.moving = moving
        self.initial = np.asarray(initial, float)
        self._wall, self._derivative = wall, derivative

    def _vector(self, parameters: Any) -> np.ndarray:
        vector = np.asarray(parameters, float)
        if vector.shape != self.initial.shape:
            raise InputError(f"parameters of shape {vector.shape} for {len(self.initial)} of them")
        return vector

    def wall(self, parameters: Any) -> np.ndarray:
        """Returns the wall points, (n, 2)."""
        return self._wall(self._vector(parameters))

    def derivative(self, parameters: Any) -> np.ndarray:
        """Returns the derivative of the wall points, (n, 2, k)."""
        return self._derivative(self._vector(parameters))

    def positions(self, parameters: Any) -> np.ndarray:
        """Returns the places of all vertices, (vertices, 2)."""
        return self.moving.positions(self.wall(parameters))

    def jacobian_vector(self, parameters: Any, direction: Any) -> np.ndarray:
        """Returns the derivative of positions() in a direction of the parameters, (vertices, 2)."""
        along = self.derivative(parameters) @ self._vector(direction)
        return self.moving.jacobian_vector(self.wall(parameters), along)

    def vector_jacobian(self, parameters: Any, gradient: Any) -> np.ndarray:
        """Returns the gradient by the parameters, (k,), of a function whose gradient by all vertices is given."""
        by_wall = self.moving.vector_jacobian(self.wall(parameters), gradient)
        return np.asarray(np.einsum("nd,ndk->k", by_wall, self.derivative(parameters)))


class _Surfaces:
    """The vertices of a body by their share of the chord, which runs from its foremost to its rearmost vertex."""

    def __init__(self, moving: MorphMap, body: int) -> None:
        bodies = moving.mesh.wall.bodies
        if not 0 <= body < len(bodies):
            raise InputError(f"there is no body {body}: the mesh has {len(bodies)}")
        self.part = bodies[body]
        points = moving.wall_points[self.part]
        tail, nose = int(points[:, 0].argmax()), int(points[:, 0].argmin())
        self.chord = points[tail, 0] - points[nose, 0]
        self.x = (points[:, 0] - points[nose, 0]) / self.chord
        after_tail = (np.arange(len(points)) - tail) % len(points)
        self.upper = after_tail <= (nose - tail) % len(points)  # walls run counter-clockwise from the tail


def _bumps(moving: MorphMap, body: int, upper: Sequence[Callable[[np.ndarray], np.ndarray]],
           lower: Sequence[Callable[[np.ndarray], np.ndarray]]) -> ShapeParameters:
    """Returns y + chord sum p_i f_i(x) on both surfaces of a body."""
    surfaces = _Surfaces(moving, body)
    shift = np.zeros((len(moving.wall_points), 2, len(upper) + len(lower)))
    for k, function in enumerate([*upper, *lower]):
        on = surfaces.upper if k < len(upper) else ~surfaces.upper
        shift[surfaces.part, 1, k] = np.where(on, surfaces.chord * function(surfaces.x), 0)
    return ShapeParameters(moving, np.zeros(shift.shape[2]), lambda p: moving.wall_points + shift @ p, lambda p: shift)


def cst_shape(moving: MorphMap, order: int = 5, *, body: int = 0) -> ShapeParameters:
    """Returns changes of the Bernstein coefficients of both surfaces, the order + 1 of the upper one first.

    y changes by chord sqrt(x) (1 - x) sum p_i C(order, i) x^i (1 - x)^(order - i), x in chords from the nose. Raises
    InputError for a body that the mesh lacks. Source: B. M. Kulfan, Universal parametric geometry representation method,
    J. Aircraft 45 (2008), equations 1 to 5.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> len(lamina.cst_shape(lamina.MorphMap(mesh), order=3).initial)
    8
    """
    def term(i: int) -> Callable[[np.ndarray], np.ndarray]:
        return lambda x: np.sqrt(x) * (1 - x) * comb(order, i) * x**i * (1 - x)**(order - i)

    terms = [term(i) for i in range(order + 1)]
    return _bumps(moving, body, terms, terms)


def hicks_henne_shape(moving: MorphMap, crests: Sequence[float], *, width: float = 3, body: int = 0) -> ShapeParameters:
    """Returns bumps sin(pi x^(log 1/2 / log crest))^width of both surfaces, those of the upper one first.

    Parameters are heights in chords; crests are shares of the chord between 0 and 1. Raises InputError for others. Source:
    R. M. Hicks, P. A. Henne, Wing design by numerical optimization, J. Aircraft 15 (1978).

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> shape = lamina.hicks_henne_shape(lamina.MorphMap(mesh), [0.25, 0.5])
    >>> shape.initial.tolist()
    [0.0, 0.0, 0.0, 0.0]
    """
    if not all(0 < crest < 1 for crest in crests):
        raise InputError("crests must be between 0 and 1")
    if not width > 0:
        raise InputError("width must be > 0")

    def bump(crest: float) -> Callable[[np.ndarray], np.ndarray]:
        return lambda x: np.abs(np.sin(np.pi * x**(np.log(0.5) / np.log(crest))))**width

    terms = [bump(crest) for crest in crests]
    return _bumps(moving, body, terms, terms)


def naca_shape(moving: MorphMap, *, body: int = 0) -> ShapeParameters:
    """Returns NACA 4-digit sections with sharp tails of (thickness, camber, place of the camber), all in chords.

    Vertices keep their x. The camber line is added to the thickness without turning it, so that shapes are smooth functions
    of all three. `initial` has the extent of the body in y, no camber, and its place at 0.4. Source: E. N. Jacobs, K. E.
    Ward, R. M. Pinkerton, NACA report 460 (1933).

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> lamina.naca_shape(lamina.MorphMap(mesh)).initial.round(3).tolist()
    [0.12, 0.0, 0.4]
    """
    surfaces = _Surfaces(moving, body)
    points, x, chord = moving.wall_points, surfaces.x, surfaces.chord
    side = np.where(surfaces.upper, 1.0, -1.0)
    half = 5 * side * (0.2969 * np.sqrt(x) + x * (-0.126 + x * (-0.3516 + x * (0.2843 - 0.1036 * x))))
    middle = points[surfaces.part][x.argmin(), 1]

    def camber(place: float) -> tuple[np.ndarray, np.ndarray]:
        """Returns the camber line for a camber of 1, and its derivative by the place."""
        if not 0 < place < 1:
            raise InputError("the place of the camber must be between 0 and 1")
        ahead = x < place
        front = (2 * place * x - x**2) / place**2, 2 * (x**2 - place * x) / place**3
        rear = 1 - ((x - place) / (1 - place))**2, 2 * (x - place) * (1 - x) / (1 - place)**3
        return np.where(ahead, front[0], rear[0]), np.where(ahead, front[1], rear[1])

    def wall(p: np.ndarray) -> np.ndarray:
        moved = points.copy()
        moved[surfaces.part, 1] = middle + chord * (p[0] * half + p[1] * camber(p[2])[0])
        return moved

    def derivative(p: np.ndarray) -> np.ndarray:
        line, by_place = camber(p[2])
        by = np.zeros((*points.shape, 3))
        by[surfaces.part, 1] = chord * np.stack([half, line, p[1] * by_place], axis=1)
        return by

    thickness = np.ptp(points[surfaces.part, 1]) / chord
    return ShapeParameters(moving, [thickness, 0, 0.4], wall, derivative)


def hinge_shape(moving: MorphMap, hinge: tuple[float, float], *, body: int = 0) -> ShapeParameters:
    """Returns a body that turns about a hinge by one parameter: degrees, positive with its trailing edge down.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> shape = lamina.hinge_shape(lamina.MorphMap(mesh), (0.75, 0))
    >>> shape.initial.tolist()
    [0.0]
    """
    part = _Surfaces(moving, body).part
    points = moving.wall_points
    arm = points[part] - np.asarray(hinge, float)
    across = np.stack([arm[:, 1], -arm[:, 0]], axis=1)

    def wall(p: np.ndarray) -> np.ndarray:
        turn = np.radians(p[0])
        moved = points.copy()
        moved[part] += (np.cos(turn) - 1) * arm + np.sin(turn) * across
        return moved

    def derivative(p: np.ndarray) -> np.ndarray:
        turn = np.radians(p[0])
        by = np.zeros((*points.shape, 1))
        by[part, :, 0] = np.radians(1) * (np.cos(turn) * across - np.sin(turn) * arm)
        return by

    return ShapeParameters(moving, [0], wall, derivative)
