"""Two-dimensional viscous meshes round airfoils, and the Delaunay triangulation that makes them.

    import lamina

    mesh = lamina.mesh("naca:0012", reynolds=6e6)
    mesh.write("naca0012.su2")

docs/python.md is the guide. NODE_TYPES and BOUNDARY_LAYER_STATES name the numbers of Mesh.node_type and FlowSide.state.

    >>> lamina.NODE_TYPES[:3], lamina.BOUNDARY_LAYER_STATES
    (('inside', 'wall', 'far_field'), ('laminar', 'turbulent', 'separated'))
    >>> lamina.__version__.count(".")
    2
"""

from typing import TYPE_CHECKING, Any

from ._batch import BatchResult, batch
from ._dynamic import DynamicTriangulation
from ._errors import (Error, InputError, IoError, LimitError, MeshError, MeshWarning, OptionError, RunEstimate,
                      UsageError, WrongTypeError)
from ._graph import NODE_TYPES
from ._lamina import version as __version__
from ._mesh import (Mesh, MeshCheck, QualitySummary, TransitionSummary, WallSummary, WallVertices, check, formats,
                    mesh_of_arrays, read, write)
from ._meshing import mesh
from ._morph import MorphMap
from ._remesh import RemeshedMesh, read_metric, remesh
from ._sections import naca, outlines
from ._shape_parameters import ShapeParameters, cst_shape, hicks_henne_shape, hinge_shape, naca_shape
from ._triangulation import (IndexLists, Triangulation, VoronoiDiagram, constrain_triangles, constrained_delaunay,
                             delaunay, merge_points, refine, ring_segments)

if TYPE_CHECKING:
    from ._commands import (BOUNDARY_LAYER_STATES, ElementFlow, FamilyMember, Flow, FlowSide, Forecast, Info, Page,
                            Polar, SolutionSizes, WallForecast, case, convert, family, flow, forecast, info, polar,
                            read_polar, sizes, view)

__all__ = ["BOUNDARY_LAYER_STATES", "BatchResult", "DynamicTriangulation", "ElementFlow", "Error", "FamilyMember",
           "Flow", "FlowSide", "Forecast", "IndexLists", "Info", "InputError", "IoError", "LimitError", "Mesh",
           "MeshCheck", "MeshError", "MeshWarning", "MorphMap", "NODE_TYPES", "OptionError", "Page", "Polar",
           "QualitySummary", "RemeshedMesh", "RunEstimate", "ShapeParameters", "SolutionSizes", "TransitionSummary",
           "Triangulation", "UsageError", "VoronoiDiagram", "WallForecast", "WallSummary", "WallVertices",
           "WrongTypeError", "__version__", "batch", "case", "check", "constrain_triangles", "constrained_delaunay",
           "convert", "cst_shape", "delaunay", "family", "flow", "forecast", "formats", "hicks_henne_shape",
           "hinge_shape", "info", "merge_points", "mesh", "mesh_of_arrays", "naca", "naca_shape", "outlines", "polar",
           "read", "read_metric", "read_polar", "refine", "remesh", "ring_segments", "sizes", "view", "write"]


def __getattr__(name: str) -> Any:
    # Commands that few programs call are read when the first of them is asked for: they take a third of the import.
    if name in __all__:
        from . import _commands

        return getattr(_commands, name)
    raise AttributeError(f"module 'lamina' has no attribute '{name}'")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
