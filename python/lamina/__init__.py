"""Two-dimensional viscous meshes round airfoils, and the Delaunay triangulation that makes them.

    import lamina

    mesh = lamina.mesh("naca:0012", reynolds=6e6)
    mesh.write("naca0012.su2")

docs/python.md is the guide.
"""

from ._batch import BatchResult, batch
from ._errors import (Error, InputError, IoError, LimitError, MeshError, MeshWarning, OptionError, RunEstimate,
                      UsageError)
from ._lamina import version as __version__
from ._mesh import (Mesh, MeshCheck, QualitySummary, TransitionSummary, WallSummary, WallVertices, check, formats,
                    mesh_of_arrays, read)
from ._meshing import mesh
from ._sections import naca, outlines
from ._triangulation import Triangulation, constrained_delaunay, delaunay, refine

__all__ = ["BatchResult", "Error", "InputError", "IoError", "LimitError", "Mesh", "MeshCheck", "MeshError",
           "MeshWarning", "OptionError", "QualitySummary", "RunEstimate", "TransitionSummary", "Triangulation",
           "UsageError", "WallSummary", "WallVertices", "__version__", "batch", "check", "constrained_delaunay",
           "delaunay", "formats", "mesh", "mesh_of_arrays", "naca", "outlines", "read", "refine"]
