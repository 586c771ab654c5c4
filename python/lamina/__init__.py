"""Two-dimensional viscous meshes round airfoils, and the Delaunay triangulation that makes them.

    import lamina

    mesh = lamina.mesh("naca:0012", reynolds=6e6)
    mesh.write("naca0012.su2")

help(lamina.mesh) lists all options of meshes, help(lamina.Mesh) what a mesh knows. The functions are:

    make meshes                mesh, batch, family, case (for a solver)
    before there is a mesh     naca, outlines, info, forecast, flow, polar, read_polar
    files and pictures         formats, read, write, convert, check, mesh_of_arrays, view, Mesh.plot
    to other libraries         Mesh.to_pyg, to_meshio, to_pyvista, to_networkx, to_xarray
    sizes from a solution      sizes, read_metric, remesh
    the mesh on other shapes   Mesh.morph, cst_shape, hicks_henne_shape, hinge_shape, naca_shape
    triangulations             delaunay, constrained_delaunay, refine, constrain_triangles, ring_segments, merge_points,
                               DynamicTriangulation; as with the package triangle: lamina.compat

All errors are lamina.Error, and what a mesh's user should know is issued as lamina.MeshWarning. NODE_TYPES and
BOUNDARY_LAYER_STATES name the numbers of Mesh.node_type and FlowSide.state. The program is there, too: python -m lamina.

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
