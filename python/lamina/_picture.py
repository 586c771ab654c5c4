"""Pictures of meshes with matplotlib."""

from __future__ import annotations

import base64
import io
from typing import TYPE_CHECKING, Any

import numpy as np

from ._optional import packages_of

if TYPE_CHECKING:
    from ._mesh import Mesh
    from ._triangulation import Triangulation

#: Notebooks show no more cells than this; the walls alone stand for a mesh with more of them in view.
_MAX_CELLS_IN_NOTEBOOK = 200_000


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    with packages_of("plot"):
        import matplotlib.pyplot as plt  # type: ignore[import-not-found, unused-ignore]

    return plt.subplots()[1]


def _window_round(points: np.ndarray) -> tuple[float, float, float, float]:
    lower, upper = points.min(axis=0), points.max(axis=0)
    margin = 0.15 * float((upper - lower).max())
    return lower[0] - margin, upper[0] + margin, lower[1] - margin, upper[1] + margin


def _bodies_window(mesh: Mesh) -> tuple[float, float, float, float]:
    walls = [edges for name, edges in mesh.markers.items() if mesh.marker_kinds[name] == "wall"]
    vertices = np.unique(np.concatenate(walls)) if walls else slice(None)
    return _window_round(mesh.points[vertices])


def _in_window(points: np.ndarray, cells: np.ndarray, window: Any) -> np.ndarray:
    """Returns the numbers of the cells whose boxes meet the window."""
    x0, x1, y0, y1 = window
    x, y = points[:, 0][cells], points[:, 1][cells]
    return np.flatnonzero((x.max(axis=1) >= x0) & (x.min(axis=1) <= x1) & (y.max(axis=1) >= y0)
                          & (y.min(axis=1) <= y1)) if len(cells) else np.empty(0, dtype=int)


def _cell_values(mesh: Mesh, color: str, kind: str, chosen: np.ndarray) -> np.ndarray:
    """Returns what the colours of these triangles or quads show."""
    numbers = chosen + (0 if kind == "triangles" else len(mesh.triangles))
    if color == "size":
        return np.asarray(np.log10(np.sqrt(np.abs(mesh.areas[numbers]))))
    if color == "quality":
        corners = mesh.points[(mesh.triangles if kind == "triangles" else mesh.quads)[chosen]]
        after, before = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
        cross = after[..., 0] * before[..., 1] - after[..., 1] * before[..., 0]
        return np.asarray(np.degrees(np.arctan2(cross, (after * before).sum(axis=2))).min(axis=1))
    values = mesh.piece if color == "piece" else mesh.layer
    if len(values) == 0:
        return np.zeros(len(chosen))
    return np.asarray(values[numbers], dtype=float)


def _edges_of(cells: np.ndarray) -> np.ndarray:
    edges = np.stack([cells, np.roll(cells, -1, axis=1)], axis=2).reshape(-1, 2)
    return np.unique(np.sort(edges, axis=1), axis=0)


def _add_lines(ax: Any, points: np.ndarray, edges: np.ndarray, style: dict[str, Any]) -> None:
    from matplotlib.collections import LineCollection  # type: ignore[import-not-found, unused-ignore]

    ax.add_collection(LineCollection(points[edges], **style), autolim=False)


def draw_mesh(mesh: Mesh, ax: Any, window: Any, color: str, style: dict[str, Any]) -> Any:
    """Draws a mesh: Mesh.plot()."""
    with packages_of("plot"):
        from matplotlib.collections import PolyCollection  # type: ignore[import-not-found, unused-ignore]

    if color not in ("none", "quality", "size", "piece", "layer"):
        raise ValueError(f"color: '{color}' is none of none, quality, size, piece, layer")
    ax = _axes(ax)
    window = window or _bodies_window(mesh)
    chosen = {kind: _in_window(mesh.points, getattr(mesh, kind), window) for kind in ("triangles", "quads")}
    if color != "none":
        polygons = [p for kind, n in chosen.items() for p in mesh.points[getattr(mesh, kind)[n]]]
        values = np.concatenate([_cell_values(mesh, color, kind, n) for kind, n in chosen.items()])
        filled = PolyCollection(polygons, array=values, cmap="viridis", edgecolors="none")
        ax.add_collection(filled, autolim=False)
        label = {"quality": "smallest angle in degrees", "size": "log10 of the size", "piece": "piece",
                 "layer": "layer"}[color]
        ax.figure.colorbar(filled, ax=ax, label=label)
    edges = np.concatenate([_edges_of(getattr(mesh, kind)[n]) for kind, n in chosen.items() if len(n)] or
                           [np.empty((0, 2), dtype=np.int32)])
    _add_lines(ax, mesh.points, edges, {"colors": "0.25", "linewidths": 0.3, **style})
    _draw_walls(mesh, ax)
    _set_window(ax, window)
    return ax


def _draw_walls(mesh: Mesh, ax: Any) -> None:
    for name, edges in mesh.markers.items():
        if mesh.marker_kinds[name] == "wall":
            _add_lines(ax, mesh.points, edges, {"colors": "red", "linewidths": 1.0})


def _set_window(ax: Any, window: Any) -> None:
    ax.set_xlim(window[0], window[1])
    ax.set_ylim(window[2], window[3])
    ax.set_aspect("equal")


def draw_triangles(triangulation: Triangulation, ax: Any, style: dict[str, Any]) -> Any:
    """Draws a triangulation: Triangulation.plot()."""
    ax = _axes(ax)
    _add_lines(ax, triangulation.points, _edges_of(triangulation.triangles),
               {"colors": "0.25", "linewidths": 0.4, **style})
    _add_lines(ax, triangulation.points, triangulation.segments, {"colors": "red", "linewidths": 1.0})
    _set_window(ax, _window_round(triangulation.points))
    return ax


def picture_html(mesh: Mesh) -> str:
    """Returns the picture of a mesh as HTML; empty where matplotlib is not installed."""
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg  # type: ignore[import-not-found, unused-ignore]
        from matplotlib.figure import Figure  # type: ignore[import-not-found, unused-ignore]
    except ImportError:
        return ""
    figure = Figure(figsize=(8, 4), dpi=120, layout="tight")
    FigureCanvasAgg(figure)
    ax = figure.subplots()
    window = _bodies_window(mesh)
    in_view = sum(len(_in_window(mesh.points, cells, window)) for cells in (mesh.triangles, mesh.quads))
    if in_view <= _MAX_CELLS_IN_NOTEBOOK:
        draw_mesh(mesh, ax, window, "none", {})
    else:
        _draw_walls(mesh, ax)
        _set_window(ax, window)
    png = io.BytesIO()
    figure.savefig(png, format="png")
    data = base64.b64encode(png.getvalue()).decode()
    return f"<img alt='the mesh round the bodies' src='data:image/png;base64,{data}'/>"
