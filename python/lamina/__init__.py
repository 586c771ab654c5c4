"""Two-dimensional viscous meshes round airfoils, and the Delaunay triangulation that makes them.

    import lamina

    mesh = lamina.mesh("naca:0012", reynolds=6e6)
    mesh.write("naca0012.su2")

docs/python.md is the guide.
"""

from ._batch import BatchResult, batch
from ._dynamic import DynamicTriangulation
from ._errors import (Error, InputError, IoError, LimitError, MeshError, MeshWarning, OptionError, RunEstimate,
                      UsageError)
from ._graph import NODE_TYPES
from ._lamina import version as __version__
from ._mesh import (Mesh, MeshCheck, QualitySummary, TransitionSummary, WallSummary, WallVertices, check, formats,
                    mesh_of_arrays, read)
from ._meshing import mesh
from ._morph import MorphMap
from ._remesh import RemeshedMesh, read_metric, remesh
from ._sections import naca, outlines
from ._triangulation import (IndexLists, Triangulation, VoronoiDiagram, constrain_triangles, constrained_delaunay,
                             delaunay, merge_points, refine, ring_segments)

__all__ = ["BatchResult", "DynamicTriangulation", "Error", "IndexLists", "InputError", "IoError", "LimitError", "Mesh",
           "MeshCheck", "MeshError", "MeshWarning", "MorphMap", "NODE_TYPES", "OptionError", "QualitySummary", "RemeshedMesh", "RunEstimate",
           "TransitionSummary", "Triangulation", "UsageError", "VoronoiDiagram", "WallSummary", "WallVertices",
           "__version__", "batch", "check", "constrain_triangles", "constrained_delaunay", "delaunay", "formats",
           "merge_points", "mesh", "mesh_of_arrays", "naca", "outlines", "read", "read_metric", "refine", "remesh",
           "ring_segments"]
